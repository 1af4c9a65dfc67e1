/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/commands.h"

#include <string.h>

#include "cli/option/uses.h"
#include "core/append.h"
#include "plot/figure.h"

static bool list_helped(size_t index, list_item *item);
static const name_list figures = {.get = list_figure};
static const name_list families = {.get = list_family};
static const name_list topics = {.get = list_topic};
static const name_list commands = {.words = (const char *const[]){"options", NULL}, .get = list_helped};
static const name_list shells = {.words = (const char *const[]){"bash", "zsh", "fish", NULL}};

/* clang-format off */
const command_row command_rows[CMD_COUNT] = {
    [CMD_TABLE] = {"table", CMD_TABLE, table_uses, "", 0, 0, NULL,
     .summary = "codes, errors, and how far surfaces are resolved",
     .example = "  depthprec table -n 0.1 -f 1000 -F unorm24 -m d3d,reversed\n"
     "  depthprec table -n 0.1 -f inf -F fp32 -m reversed --at 1,10,100,1000\n"
     "  depthprec table -n 0.1 -f inf -F fp32 -m reversed --viewport 1920x1080\n"
     "  depthprec table -F unorm24 -m d3d --depth 0.9987\n"
     "  depthprec table -F d32f --at 1:1000:log:10000 --csv -o depths.csv\n"
     "  depthprec table -n 0.3 -f 1000 -m reversed,gl --constants --at 1,10,100\n"
     "  depthprec table -n 0.1 -f 1000 -F d24 -m d3d --link\n",
     .group = "A camera", .words = LIST_CONSTANTS, .part = table_asked, .parts = table_parts},
    [CMD_BUDGET] = {"budget", CMD_BUDGET, budget_uses, "", 0, 0, NULL,
     .summary = "how much of the separation each cause takes",
     .example = "  depthprec budget -n 0.1 -f 1000 -F unorm24 -m d3d\n"
     "  depthprec budget -F fp32 -m reversed --from-origin 5km --linearize --at 10m\n"
     "  depthprec budget -F fp32 -m reversed --viewport 1920x1080 --raster spec-d3d\n"},
    [CMD_SOLVE] = {"solve", CMD_SOLVE, solve_uses, "", 0, 0, NULL,
     .summary = "near, far, format, mapping or distance for a separation",
     .example = "  depthprec solve --for distance -n 0.1 -f 1000 -F d24 -m d3d --separation 0.01\n"
     "  depthprec solve -F unorm24 -m d3d -f 10000 --separation 0.01 --at 5000\n"
     "  depthprec solve -n 0.1 -f 4000 --separation 0.001 --range 0.1:100\n"
     "  depthprec solve --for far -n 0.1 -F d24 -m d3d --error 0.05 --at 500\n",
     .part = solve_asked, .parts = solve_parts},
    [CMD_CHECK] = {"check", CMD_CHECK, check_uses, "FILE...", 1, 1000, NULL,
     .summary = "cameras against requirement files; exit 1 if one is missed",
     .example = "  depthprec check engine.need\n"
     "  depthprec check --report junit -o depth.xml engine.need\n"
     "  generate | depthprec check -\n",
     .files_from = 1},
    [CMD_ZFIGHT] = {"zfight", CMD_ZFIGHT, zfight_uses, "", 0, 0, NULL,
     .summary = "where surfaces start to z-fight, by a census of every depth",
     .example = "  depthprec zfight -n 0.1 -f 1000 -F unorm24,fp32 -m d3d,reversed\n"
     "  depthprec zfight -F d24 -m gl --arith mesa --separation 0.01\n"
     "  depthprec zfight -f inf -F fp32 -m reversed --range 0.1:1e9 --sample 1000000\n"
     "  depthprec zfight --rasterize -F fp32 -m reversed --range 16:64\n"},
    [CMD_PREPASS] = {"prepass", CMD_PREPASS, prepass_uses, "", 0, 0, NULL,
     .summary = "is EQUAL safe after a depth prepass, and what LEQUAL needs",
     .example = "  depthprec prepass -F d24 -m d3d\n"
     "  depthprec prepass --program once --against separate,fma -F fp32 -m reversed\n"
     "  depthprec list programs\n"},
    [CMD_BIAS] = {"bias", CMD_BIAS, bias_uses, "", 0, 0, NULL,
     .summary = "what a depth bias does and how much is needed, per API",
     .example = "  depthprec bias --api gl -F d24 -m gl --units -1 --at 1,10,100\n"
     "  depthprec bias --api all --separation 0.02 --at 300\n"
     "  depthprec bias --api webgpu -F depth24plus --separation 0.01 --range 1:100\n"
     "  depthprec bias --preset bevy --api vulkan --units 4 --factor 1 --slope 0.02\n"},
    [CMD_WORLD] = {"world", CMD_WORLD, world_uses, "", 0, 0, NULL,
     .summary = "precision far from the origin, by world-to-view scheme",
     .example = "  depthprec world --from-origin 100km --separation 1cm --at 10m\n"
     "  depthprec world --scheme camera-float,split --at 1m\n"},
    [CMD_SCENE] = {"scene", CMD_SCENE, scene_uses, "MODEL", 1, 1, NULL,
     .summary = "surfaces of a 3D model that z-fight, and from where on",
     .example = "  depthprec scene house.glb -n 0.1 -f 500\n"
     "  depthprec scene house.glb --viewport 1920x1080 --within 50\n"
     "  depthprec scene house.glb --eye 0,2,30 --look 0,2,0 --render seen.png\n"
     "  depthprec scene city.obj -F d24 -m d3d --separation 0.001 --json\n",
     .files_from = 1, .group = "A model, an image, a shadow map"},
    [CMD_TEXTURE] = {"texture", CMD_TEXTURE, texture_uses, "[FILE]", 0, 1, NULL,
     .summary = "a depth image: depths, positions, normals, effects, errors",
     .example = "  depthprec texture depth.png -n 0.3 -f 1000\n"
     "  capture | depthprec texture - -n 0.3 -f 1000\n"
     "  depthprec texture depth.png -n 0.3 -f 1000 --pixel 320,180\n"
     "  depthprec texture depth.png -f 1000 --product normal:high -o normals.npy\n"
     "  depthprec texture --synthetic decals --parameter gap=0.01 -F d24 -m reversed\n",
     .files_from = 1, .words = "COMPUTE_EYEDEPTH Hi-Z HiZ _CameraDepthTexture",
     .part = texture_asked, .parts = texture_parts},
    [CMD_SHADOW] = {"shadow", CMD_SHADOW, shadow_uses, "", 0, 0, NULL,
     .summary = "shadow maps: the bias that prevents acne, and its gap",
     .example = "  depthprec shadow -n 0.1 -f 150 --size 2048 --unit m\n"
     "  depthprec shadow --light-box 40x40x200 -F d16 --kernel 5 --angle 70 --api gl\n"
     "  depthprec shadow -f 300 --cascades 3:0.8 --api all\n"
     "  depthprec plot shadow -f 150 -o shadow.svg\n",
     .part = shadow_asked, .parts = shadow_parts},
    [CMD_METHODS] = {"methods", CMD_METHODS, methods_uses, "FAMILY", 0, 1, &families,
     .summary = "methods compared: time, worst error, where each fails",
     .example = "  depthprec methods\n"
     "  depthprec methods linearize -n 0.1 -f 1000\n"
     "  depthprec methods interval -F fp32 -m reversed --tolerance 1e-6\n"
     "  depthprec plot pareto linearize -o pareto.svg\n"
     "  depthprec plot stability interval -o stability.svg\n",
     .group = "Methods and hardware"},
    [CMD_CODE] = {"code", CMD_CODE, code_uses, "[METHOD]", 0, 1, NULL,
     .summary = "a method or a projection matrix as code to take away",
     .example = "  depthprec code -n 0.1 -f inf -m reversed\n"
     "  depthprec code complement -n 0.1 -f 1000 -m d3d --language wgsl\n"
     "  depthprec code --what projection -n 0.3 -f 1000 -m gl --fov 50 --language c\n"
     "  depthprec code rgba --what pack --language hlsl\n"},
    [CMD_JUDGE] = {"judge", CMD_JUDGE, judge_uses, "[FILE]", 0, 1, NULL,
     .summary = "what a function of yours computes, and what it loses",
     .example = "  depthprec judge depth.glsl:linearDepth -n 0.1 -f 1000 -F d24\n"
     "  depthprec judge fog.hlsl:EyeDepth --define _Planes=near_far -m reversed\n"
     "  depthprec judge --pairs-for 64 -o depths.csv\n"
     "  depthprec judge --pairs pairs.csv -n 0.1 -f 1000 -F d24 -m d3d\n"
     "  my-program | depthprec judge --pairs - --json\n",
     .part = judge_asked, .parts = judge_parts},
    [CMD_PROBE] = {"probe", CMD_PROBE, probe_uses, "", 0, 0, NULL,
     .summary = "what this machine's GPU does to depth, measured",
     .example = "  depthprec probe\n"
     "  depthprec probe --device 1 --keep codes.csv\n"
     "  depthprec probe --device gl\n"
     "  depthprec probe --json -o gpu.json\n"},
    [CMD_PLOT] = {"plot", CMD_PLOT, plot_uses, "FIGURE [FILE|FAMILY]", 1, 2, &figures,
     .summary = "a figure: SVG, PDF or PNG by the ending of -o, or --type",
     .example = "  depthprec plot error -F all -m d3d,reversed -o error.svg\n"
     "  depthprec plot error -F fp32 -m d3d,reversed -o - --type png >error.png\n"
     "  depthprec plot distribution -F unorm4 -n 1 -f 10 -o staircase.png --theme dark\n"
     "  depthprec plot fight -F fp32 -m reversed --at 500 -o fight.svg\n"
     "  depthprec plot needs engine.need -o needs.svg\n"
     "  depthprec plot scene house.glb -F d24 -m d3d -o house.svg\n",
     .files_from = 2, .group = "Figures, lists and help", .part = plot_asked,
     .shown = FIGURE_SETUPS | FIGURE_AT | FIGURE_SLANTED | FIGURE_BESIDE},
    [CMD_LIST] = {"list", CMD_LIST, list_uses, "WHAT", 0, 1, &topics,
     .summary = "formats, mappings, presets, methods, or what a word means",
     .example = "  depthprec list\n"
     "  depthprec list formats\n"
     "  depthprec list mappings --json\n"
     "  depthprec list polygonOffset\n"},
    [CMD_HELP] = {"help", CMD_HELP, no_uses, "COMMAND", 0, 1, &commands,
     .summary = "the options of a command; 'help options': those of all",
     .example = "  depthprec help table\n"
     "  depthprec help options\n"},
    [CMD_COMPLETIONS] = {"completions", CMD_COMPLETIONS, no_uses, "SHELL", 1, 1, &shells,
     .summary = "a script that completes commands, options and values",
     .example = "  . <(depthprec completions bash)\n"},
};
/* clang-format on */

bool list_command(size_t index, list_item *item) {
    const command_row *v = &command_rows[index];
    return index < command_count && list_fill(item, (list_item){.name = v->name, .note = v->summary, .row = v});
}

/* What help is asked about: a command, or one of its words, which no command line begins with. */
static bool list_helped(size_t index, list_item *item) {
    if (!list_command(index, item))
        return false;
    item->aliases = command_rows[index].words;
    return true;
}

const char *command_takers(int id, char out[NAMES_SIZE]) {
    out[0] = '\0';
    for (size_t i = 0; i < CMD_COUNT; i++)
        if (option_used(&command_rows[i], ~0U, (option_id)id) != NULL)
            append(out, NAMES_SIZE, "%s%s", out[0] != '\0' ? ", " : "", command_rows[i].name);
    return out;
}

const command_row *command_find(const char *name) {
    for (size_t i = 0; i < command_count; i++)
        if (strcmp(command_rows[i].name, name) == 0)
            return &command_rows[i];
    return NULL;
}
