/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Stand-ins for what the page lacks: the commands and figures that need files, threads, GSL or jansson, and
 * the rows that their options name. Each refuses in a sentence; the program has them all.
 */
#include <stdio.h>

#include "bias/cmd_bias/trial.h"
#include "camera/cmd/setups.h"
#include "camera/depth_range.h"
#include "camera/profile.h"
#include "cli/link.h"
#include "cli/words.h"
#include "convert/convert.h"
#include "draw/pixels.h"
#include "judge/cmd_judge/request.h"
#include "judge/pairs.h"
#include "method/cmd_methods/methods.h"
#include "method/cmd_methods/mine.h"
#include "method/truth.h"
#include "plot/figure.h"
#include "quantity/cmd_table/constants.h"
#include "quantity/cmd_table/in_preset.h"
#include "quantity/cmd_table/levels.h"
#include "quantity/cmd_table/slices.h"
#include "scene/cmd_scene/drawing.h"
#include "scene/find.h"
#include "shader/pack.h"
#include "shadow/cmd_shadow/maps.h"
#include "shadow/engine.h"
#include "solve/check.h"
#include "solve/cmd_check/check_report.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"
#include "texture/cmd_texture/request.h"
#include "texture/device.h"
#include "texture/units.h"
#include "world/arithmetic.h"
#include "zfight/cmd_prepass/request.h"

static int absent(const asked_line *line) {
    return usage_error("%s is not in the page: the program has it", line->command->name);
}

#define ABSENT(name)                                                                                                   \
    int name(void *request) {                                                                                          \
        return absent(*(asked_line *const *)request);                                                                  \
    }

/* Their options are known of where others take them, too. */
static const option_use no_uses[] = {END};
static const option_place no_places[] = {{.table = NULL}};
#define ABSENT_COMMAND(of)                                                                                             \
    const command_row command_##of = {.name = #of, .request = sizeof(void *), .places = no_places, .uses = no_uses};   \
    ABSENT(cmd_##of)

static const option_row no_rows[] = {{.name = NULL}};
#define ABSENT_OPTIONS(of) const option_table of##_options = {.rows = no_rows};

ABSENT_OPTIONS(code)
ABSENT_OPTIONS(convert)
ABSENT_OPTIONS(range)
ABSENT_OPTIONS(scene)
ABSENT_OPTIONS(scene_eye)
ABSENT_OPTIONS(shadow)
ABSENT_OPTIONS(shadow_size)
const option_use scene_model[] = {END}, shadow_cascade_uses[] = {END}, shadow_map_uses[] = {END};

/* Options of a command that is there. */
static int absent_option(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)value;
    (void)group;
    (void)line;
    return option_refuse(row, "is not in the page: the program has it");
}

#define ABSENT_OPTION(of)                                                                                              \
    { .name = (of), .argument = "X", .help = "", .parse = absent_option }
static const option_row stored_rows[] = {ABSENT_OPTION("prepass-format"), ABSENT_OPTION("resolve"),
                                         ABSENT_OPTION("half"), END};
const option_table stored_options = {.rows = stored_rows};
const option_use stored_uses[] = {ROWS(stored_rows), END};

ABSENT_COMMAND(check)
ABSENT_COMMAND(code)
ABSENT(cmd_completions)
ABSENT_COMMAND(convert)
ABSENT(cmd_help)
ABSENT_COMMAND(list)
ABSENT_COMMAND(methods)
ABSENT_COMMAND(scene)
ABSENT_COMMAND(shadow)
ABSENT(cmd_texture)
ABSENT_COMMAND(world)

const column setup_end_columns[] = {{.kind = COLUMN_END}};

const setup_depths *setup_ends(const dp_spec *spec) {
    (void)spec;
    return NULL;
}

const char *setup_range(const setup_fields *f, char out[SETUP_RANGE_SIZE]) {
    (void)f;
    *out = '\0';
    return out;
}

int range_complete(const camera_asked *c) {
    (void)c;
    return EXIT_FINE;
}

int parse_depth_ranges(asked_line *line, const option_row *row, const char *value, void *group) {
    return absent_option(line, row, value, group);
}

const char *setup_range_option(const dp_spec *spec, char out[SETUP_RANGE_SIZE]) {
    (void)spec;
    *out = '\0';
    return out;
}

const char *setup_slice(const camera_asked *c, const dp_setup *setup, char out[SETUP_RANGE_SIZE]) {
    (void)c;
    (void)setup;
    *out = '\0';
    return out;
}

bool setup_repeats(const setups *all, size_t i) {
    (void)all;
    (void)i;
    return false;
}

bool camera_range_takes(const char *api, const double range[2], camera_fault *fault) {
    (void)api;
    return camera_range_suits(NULL, range, fault);
}

bool camera_range_suits(const bias_api *api, const double range[2], camera_fault *fault) {
    (void)api;
    (void)range;
    (void)fault;
    return true;
}

bool camera_range_refused(const dp_spec *spec, dp_status status, camera_fault *fault) {
    (void)spec;
    (void)status;
    (void)fault;
    return false;
}

const column slice_columns[] = {{.kind = COLUMN_END}};

double slice_codes(const dp_setup *setup) {
    (void)setup;
    return 0.0;
}

double slice_share(const dp_setup *setup) {
    return slice_codes(setup);
}

bool slices_shared(const setups *all, size_t index, slice_pair *out) {
    (void)out;
    return setup_repeats(all, index);
}

void slices_say(page *p, const camera_asked *c, const setups *all) {
    (void)p;
    (void)c;
    (void)all;
}

int constants_write(const table_request *o) {
    return absent(o->line);
}

int solve_preset(const solve_request *o) {
    (void)o;
    return usage_error("solve for a number that a preset leaves open is not in the page: the program has it");
}

void in_preset_find(const table_request *o, in_preset *out) {
    (void)o;
    *out = (in_preset){.parameter = NULL};
}

bool levels_wanted(const table_request *o) {
    return o->lattice != NULL;
}

int levels_write(const table_request *o) {
    return absent(o->line);
}

int prepass_stored(const prepass_request *o) {
    return absent(o->camera.line);
}

int link_write(const asked_line *line) {
    return absent(line);
}

int bias_try(const raster_row *row, const dp_setup *setup, const bias_state *state, double slope, double lo, double hi,
             const char *render, bias_judged *judged, bias_trial *out) {
    (void)row, (void)setup, (void)state, (void)slope, (void)lo, (void)hi, (void)render, (void)judged, (void)out;
    return usage_error("bias --rasterize is not in the page: the program has it");
}

const column bias_trial_columns[] = {{.kind = COLUMN_END}};

void bias_say_trial(page *p, bias_trial *trial) {
    (void)p, (void)trial;
}

#define ABSENT_FIGURE(name)                                                                                            \
    const char *name(const figure_request *request, chart *out) {                                                      \
        (void)request;                                                                                                 \
        (void)out;                                                                                                     \
        return "plot: this figure is not in the page: the program has it";                                             \
    }

ABSENT_FIGURE(cost_build)
ABSENT_FIGURE(fight_build)
ABSENT_FIGURE(linear01_build)
ABSENT_FIGURE(scene_build)
ABSENT_FIGURE(normals_build)
ABSENT_FIGURE(pareto_build)
ABSENT_FIGURE(needs_build)
ABSENT_FIGURE(shadow_build)
ABSENT_FIGURE(shadow_distance_build)
ABSENT_FIGURE(stability_build)
ABSENT_FIGURE(world_build)

/* ---- Rows that options of those commands name ---------------------------------------------------------------------
 */

#define ABSENT_ROWS(type, name)                                                                                        \
    const type *name(size_t index) {                                                                                   \
        (void)index;                                                                                                   \
        return NULL;                                                                                                   \
    }

#define ABSENT_TABLE(name) const named_table name##_table = {NULL, 0, 0};

ABSENT_TABLE(upscaler)
ABSENT_TABLE(effect)
ABSENT_TABLE(finder_filter)
ABSENT_TABLE(normal)
ABSENT_TABLE(pack)

ABSENT_TABLE(position)
ABSENT_TABLE(convert_read)
ABSENT_TABLE(convert_write)
ABSENT_TABLE(shadow_engine)
ABSENT_TABLE(shadow_filter)
ABSENT_TABLE(word)
ABSENT_TABLE(question)
ABSENT_TABLE(synthetic)

/* Families of methods but interval, which figures are drawn by. */
static const size_t none;
const method_family_row linearize_family = {.method_count = &none}, encode_family = {.method_count = &none},
                        worst_family = {.method_count = &none}, position_family = {.method_count = &none},
                        normal_family = {.method_count = &none};

void method_start(void) {}

int methods_resolve(const judge_request *o, const method_family_row *family, methods_asked *out) {
    (void)family;
    (void)out;
    return absent(o->line);
}

int methods_single(const judge_request *o, methods_asked *asked) {
    (void)asked;
    return absent(o->line);
}

const char *methods_machine(char *out, size_t size) {
    (void)size;
    return out;
}

double truth_width(const dp_setup *setup, uint32_t code, bool *cut) {
    (void)setup;
    (void)code;
    (void)cut;
    return 0.0;
}

/* What world and its figure compute with; the bounds are there. */
#define ABSENT_STEPS(name)                                                                                             \
    void arithmetic_##name(const world_scheme *s, const world_camera *camera, const world_place *place,                \
                           float out[3]) {                                                                             \
        (void)s, (void)camera, (void)place, (void)out;                                                                 \
    }
ABSENT_STEPS(camera_double)
ABSENT_STEPS(camera_float)
ABSENT_STEPS(cell)
ABSENT_STEPS(local)
ABSENT_STEPS(split)
ABSENT_STEPS(tile)
ABSENT_STEPS(two_sum)
ABSENT_STEPS(world)

int mine_open(const judge_request *o, methods_asked *asked, bool on_device, mine **out) {
    (void)asked;
    (void)on_device;
    (void)out;
    return absent(o->line);
}

const char *mine_device(const mine *m) {
    (void)m;
    return "";
}

void mine_close(mine *m) {
    (void)m;
}

/* ---- What the figures of those commands call ----------------------------------------------------------------------
 */

int check_read(const char *path, need_file *file) {
    (void)path;
    (void)file;
    return EXIT_USAGE;
}

int judge_pairs_read(const char *path, judge_pairs *out, char error[PAIRS_ERROR_SIZE]) {
    (void)path;
    (void)out;
    snprintf(error, PAIRS_ERROR_SIZE, "the page reads no files");
    return -1;
}

int shadow_maps_make(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out) {
    (void)format;
    (void)mapping;
    (void)out;
    return absent(o->line);
}

const bias_api *shadow_asked_api(const shadow_request *o, size_t index) {
    (void)o;
    (void)index;
    return NULL;
}

void need_release(need_file *file) {
    (void)file;
}

int scene_figure_begin(scene *s, const scene_request *o) {
    (void)s;
    return absent(o->line);
}

int scene_look(scene *s, output *out) {
    (void)s;
    (void)out;
    return EXIT_USAGE;
}

bool scene_figure_take(const scene *s, fights_asked *out, chart *c) {
    (void)s;
    (void)out;
    (void)c;
    return false;
}

int scene_figure_height(const chart *c, int width) {
    (void)c;
    return width;
}

void scene_end(scene *s) {
    (void)s;
}

bool pixels_write_png(FILE *out, const pixels *p, const notes *words) {
    (void)out;
    (void)p;
    (void)words;
    return false;
}

/* ---- Names alone, where the program reads the profile of a GPU too --------------------------------------------- */

int parse_arith(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_word(line, row, value, group);
}

int parse_raster(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_row(line, row, value, group);
}

bool profile_is_file(const char *text) {
    (void)text;
    return false;
}

/* ---- Of commands that are not here ------------------------------------------------------------------------------- */

#define ABSENT_PARSER(name)                                                                                            \
    int name(asked_line *line, const option_row *row, const char *value, void *group) {                                \
        (void)row;                                                                                                     \
        (void)value;                                                                                                   \
        (void)group;                                                                                                   \
        return absent(line);                                                                                           \
    }

ABSENT_PARSER(parse_error_map)
ABSENT_PARSER(parse_hi_z)
ABSENT_PARSER(parse_parameter)
ABSENT_PARSER(parse_define)
ABSENT_PARSER(parse_product)
