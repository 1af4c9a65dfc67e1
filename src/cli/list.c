/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/list.h"
#include "cli/words.h"

#include <math.h>
#include <stdio.h>

#include "bias/bias.h"
#include "bias/limits.h"
#include "bias/remedy.h"
#include "camera/platform.h"
#include "camera/presets.h"
#include "camera/unit.h"
#include "camera/upscaler.h"
#include "code/language.h"
#include "convert/convert.h"
#include "core/append.h"
#include "method/method.h"
#include "plot/figure.h"
#include "raster/raster.h"
#include "raster/vertex_compare.h"
#include "report/number.h"
#include "scene/find.h"
#include "shader/constants.h"
#include "shader/pack.h"
#include "shader/packing.h"
#include "shadow/engine.h"
#include "shadow/filter.h"
#include "solve/model.h"
#include "texture/cmd_texture/products.h"
#include "texture/device.h"
#include "texture/synthetic.h"
#include "world/world.h"

bool list_format(size_t index, list_item *item) {
    const dp_format_row *row = dp_format_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->format.name, .aliases = row->aliases, .note = row->note, .source = row->source};
    append(item->bound, sizeof item->bound, "|value - d| <= %s", number_full(row->claim_absolute).text);
    if (row->claim_relative > 0.0)
        append(item->bound, sizeof item->bound, " + %s d", number_full(row->claim_relative).text);
    return true;
}

bool list_mapping(size_t index, list_item *item) {
    const dp_mapping_row *row = index < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)index) : NULL;
    return row != NULL &&
           list_fill(item,
                     (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source});
}

bool list_model(size_t index, list_item *item) {
    static const char *const notes[] = {
        [DP_MODEL_EXACT] = "real arithmetic and one rounding into the format: the lattice of codes",
        [DP_MODEL_STAGED] = "NDC depth, then window depth, each rounded once to binary32, then the format",
        [DP_MODEL_FLOAT] = "every operation in binary32, see 'depthprec list arithmetic'; not for linear and log",
        "the simplest of the three that suffices at the depths evaluated, see --tolerance",
    };
    return index < sizeof notes / sizeof notes[0] &&
           list_fill(item, (list_item){.name = model_word(index), .note = notes[index]});
}

bool list_rounding(size_t index, list_item *item) {
    *item = (list_item){.name = dp_rounding_name((dp_rounding)index)};
    return item->name != NULL;
}

bool list_arith(size_t index, list_item *item) {
    const dp_arith_row *row = dp_arith_get(index);
    return row != NULL && list_fill(item, (list_item){.name = row->name, .note = row->note, .source = row->source});
}

bool list_log2(size_t index, list_item *item) {
    const dp_log2_row *row = dp_log2_get(index);
    return row != NULL &&
           list_fill(item,
                     (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source});
}

bool list_composition(size_t index, list_item *item) {
    const dp_composition_row *row = dp_composition_get((dp_composition)index);
    return row != NULL && list_fill(item, (list_item){.name = row->name, .note = row->note});
}

static bool list_cause(size_t index, list_item *item) {
    static const char *const notes[DP_CAUSE_COUNT] = {
        [DP_CAUSE_EYE] = "rounding the eye depth itself to binary32: surfaces lie anywhere",
        [DP_CAUSE_COMPOSITION] = "world positions through view and projection, with --from-origin and --composition",
        [DP_CAUSE_PROJECTION] = "A z + B in binary32, and the remap if there is one",
        [DP_CAUSE_ARGUMENT] = "the argument of the logarithm, 1 + C w, of logarithmic mappings",
        [DP_CAUSE_LOG2] = "of them: the worst log2 that the language allows, see --log2",
        [DP_CAUSE_SCALE] = "of them: multiplying by 1/log2(C far + 1), or dividing",
        [DP_CAUSE_NDC] = "the divide and the viewport",
        [DP_CAUSE_SNAPPING] = "vertices of slanted triangles snapped to the subpixel grid, with --viewport",
        [DP_CAUSE_SETUP] = "the plane of a slanted triangle set up and evaluated in binary32, with --viewport",
        [DP_CAUSE_INTERPOLATION] = "across a triangle, as given with --interpolation",
        [DP_CAUSE_FORMAT] = "the step of the format and the conversion into it",
        [DP_CAUSE_LINEARIZATION] = "reading eye depth back in a binary32 shader, with --linearize",
    };
    return index < DP_CAUSE_COUNT &&
           list_fill(item, (list_item){.name = dp_cause_name((dp_cause)index), .note = notes[index]});
}

/* The numbers that planes are computed from. */
static void tell_parameters(const preset *row, list_item *item) {
    append(item->bound, sizeof item->bound, "near and far computed from: ");
    for (int i = 0; i < PRESET_PARAMETERS && row->function->parameters[i].name != NULL; i++) {
        const preset_parameter *p = &row->function->parameters[i];
        const char *unit = *p->unit != '\0' ? " " : "";
        append(item->bound, sizeof item->bound, "%s%s from %s to %s%s%s, ", i > 0 ? "; " : "", p->name,
               number_full(p->least).text, number_full(p->most).text, unit, p->unit);
        append(item->bound, sizeof item->bound, isnan(p->standard) ? "needed" : "by default %s",
               number_full(p->standard).text);
    }
    append(item->bound, sizeof item->bound, "; ");
}

static void tell_preset(const void *of, list_item *item) {
    static const char *const axes[] = {
        [PRESET_VERTICAL] = "vertical", [PRESET_HORIZONTAL] = "horizontal", [PRESET_LARGER] = "of the larger side"};
    const preset *row = of;
    const bool confirmed = row->unconfirmed[0] == '\0';
    if (row->function != NULL)
        tell_parameters(row, item);
    else
        append(item->bound, sizeof item->bound, "near %s, far %s, ", number_full(row->znear).text,
               number_full(row->zfar).text);
    append(item->bound, sizeof item->bound,
           "%s, %s, fov %s %s, %s, bias of %s, code in %s, scene in %s; checked %s, %s%s",
           dp_mapping_get(row->mapping)->name, row->format, number_full(row->fov).text, axes[row->axis], row->raster,
           row->api, row->language, row->unit, row->checked,
           confirmed ? "confirmed" : "not confirmed: ", row->unconfirmed);
}

/* A format that the device decides on, as it is shown: "unorm24 or fp32". */
static void append_stored(list_item *item, const char *asked, const char *name) {
    dp_format formats[2];
    const size_t count = dp_format_parse(name, formats);
    append(item->bound, sizeof item->bound, "%s: ", asked);
    for (size_t i = 0; i < count; i++)
        append(item->bound, sizeof item->bound, "%s%s", i > 0 ? " or " : "", formats[i].name);
}

static void tell_platform(const void *of, list_item *item) {
    static const char *const remaps[] = {[PLATFORM_REMAPS_NOT] = "",
                                         [PLATFORM_REMAPS] = "; [-1, 1] remapped in the vertex shader",
                                         [PLATFORM_MAY_REMAP] = "; [-1, 1] may be remapped in the vertex shader",
                                         [PLATFORM_SPREADS] = "; [0, 1] spread to [-1, 1] in the vertex shader"};
    const platform *row = of;
    append_stored(item, row->asks, row->stored);
    append_stored(item, "; with stencil", row->stencil);
    append(item->bound, sizeof item->bound, "%s; %s%s%s; sources up to %s", remaps[row->remap], row->raster,
           row->bias[0] != '\0' ? "; " : "", row->bias, row->newest);
}

/* "0.01 x scene units", and of spot and point lights where that is something else. */
static void append_measure(list_item *item, const char *name, const shadow_measure in[3], const double scale[3]) {
    static const char *const measures[] = {[SHADOW_IN_WINDOW] = "window depth",
                                           [SHADOW_IN_SCENE] = "scene units",
                                           [SHADOW_IN_TEXELS] = "texels at the point's depth",
                                           [SHADOW_IN_FAR_TEXELS] = "texels, half of them at far",
                                           [SHADOW_IN_SHARES] = "distance / texels of a side",
                                           [SHADOW_IN_CLIP] = "clip z range / distance",
                                           [SHADOW_IN_UNITS] = "units of the API"};
    static const char *const of[] = {"", ", of spot lights ", ", of point lights "};
    append(item->bound, sizeof item->bound, "%s: ", name);
    for (int k = 0; k < 3; k++)
        if (k == 0 || in[k] != in[k - 1] || scale[k] != scale[k - 1])
            append(item->bound, sizeof item->bound, "%s%g x %s", of[k], scale[k], measures[in[k]]);
}

static void tell_engine(const void *of, list_item *item) {
    static const char *const growths[] = {"at any angle", "times the sine of the angle",
                                          "times one less the cosine of the angle",
                                          "times one less the cosine of the angle, square to the ray"};
    const shadow_engine *row = of;
    if (row->instead[0] != '\0') {
        append(item->bound, sizeof item->bound, "%s", row->instead);
        return;
    }
    append_measure(item, row->bias, row->bias_in, row->bias_scale);
    if (row->normal != NULL) {
        append(item->bound, sizeof item->bound, "; ");
        append_measure(item, row->normal, row->normal_in, row->normal_scale);
        append(item->bound, sizeof item->bound, ", %s", growths[row->growth[0]]);
        if (row->growth[1] != row->growth[0])
            append(item->bound, sizeof item->bound, " (spot lights: in every direction)");
    }
    append(item->bound, sizeof item->bound,
           "; by default %g and %g, of spot lights %g and %g, of point lights %g and %g", row->standard[SHADOW_SUN][0],
           row->standard[SHADOW_SUN][1], row->standard[SHADOW_SPOT][0], row->standard[SHADOW_SPOT][1],
           row->standard[SHADOW_POINT][0], row->standard[SHADOW_POINT][1]);
    if (row->unconfirmed[0] != '\0')
        append(item->bound, sizeof item->bound, "; not confirmed: %s", row->unconfirmed);
}

static void tell_filter(const void *of, list_item *item) {
    const shadow_filter *row = of;
    if (row->instead[0] != '\0')
        append(item->bound, sizeof item->bound, "not covered: %s", row->instead);
    else if (row->per == 0.0)
        append(item->bound, sizeof item->bound, "%g texel%s beside the point", row->base, row->base == 1.0 ? "" : "s");
    else
        append(item->bound, sizeof item->bound, "%s%s%s%s texels beside the point", row->amount,
               row->per == 0.5 ? "/2" : "", row->base > 0.0 ? " + " : "",
               row->base == 0.5   ? "0.5"
               : row->base == 1.0 ? "1"
                                  : "");
}

static void tell_api(const void *of, list_item *item) {
    static const char *const rules[] = {
        [BIAS_ONE] = "1",
        [BIAS_CODE] = "1/(2^N - 1) as binary32",
        [BIAS_POWER] = "2^-N",
        [BIAS_BOUND] = "at most 2 x 2^-N",
        [BIAS_FREE] = "the implementation's choice",
        [BIAS_EXPONENT] = "2^(e - 23), e of the greatest depth",
        [BIAS_MANTISSA] = "2^-24",
    };
    const bias_api *row = of;
    snprintf(item->bound, sizeof item->bound, "unorm: r = %s; fp32: r = %s", rules[row->unorm], rules[row->real]);
    if (row->real == BIAS_EXPONENT)
        append(item->bound, sizeof item->bound, "; in [2^n, 2^(n+1)) e is %s",
               row->exponent == BIAS_EXPONENT_N ? "n" : "n or n+1, which is open");
    if (row->format != NULL)
        append(item->bound, sizeof item->bound, "; brings %s%s%s", row->mapping != NULL ? row->mapping : "",
               row->mapping != NULL ? ", " : "", row->format);
}

static void tell_remedy(const void *of, list_item *item) {
    const remedy *row = of;
    append(item->bound, sizeof item->bound, "%s%s%s; it costs: %s; reversed: %s", row->amount,
           row->amount[0] != '\0' ? ": worth " : "", row->worth, row->cost, row->turned);
}

static void tell_rasterizer(const void *of, list_item *item) {
    static const char *const clippings[] = {
        [RASTER_CLIP_PIECES] = "new vertices, each piece with its own plane",
        [RASTER_CLIP_KEEPS] = "the plane of the unclipped vertices",
    };
    const raster_row *row = of;
    append(item->bound, sizeof item->bound, "%s%d subpixel bits", row->at_least ? "at least " : "", row->subpixel_bits);
    if (row->model == NULL)
        return;
    const dp_anchor_row *anchor = dp_anchor_get(row->anchor);
    const dp_plane_error *e = &anchor->plane;
    append(item->bound, sizeof item->bound,
           ", depth %s; anchor %s: value %g, box %g, range %g, origin %g; clipped: %s; %s",
           row->plane_bits > 0 ? "snapped too" : "not snapped", anchor->name, e->value, e->box, e->range, e->origin,
           clippings[row->clipping], row->operations);
}

static void tell_upscaler(const void *of, list_item *item) {
    static const upscaler_view view = {1920, 1080, 60.0};
    const upscaler_row *row = of;
    append(item->bound, sizeof item->bound, "%s %% of z at %dx%d, fov %g", number_of(100.0 * row->share(&view), 3).text,
           view.width, view.height, view.fov_y);
}

static void tell_scheme(const void *of, list_item *item) {
    const world_row *row = of;
    if (row->size != NULL)
        append(item->bound, sizeof item->bound, "%s: %s%s unless %s:SIZE says another, scene units%s", row->size,
               number_full(row->standard).text, row->metres ? " m" : "", row->name,
               row->power2 ? ", a power of two" : "");
}

bool list_vertices(size_t index, list_item *item) {
    const char *name = vertex_spread_name((vertex_spread)index);
    return name != NULL && list_fill(item, (list_item){.name = name, .note = vertex_spread_note((vertex_spread)index)});
}

static void tell_encoding(const void *of, list_item *item) {
    const pack_row *row = of;
    if (row->kind != PACK_DEPTH)
        append(item->bound, sizeof item->bound, "angle: mean %g, at most %g degrees%s", row->normal.mean,
               row->normal.max, row->kind == PACK_DEPTH_NORMAL ? "; " : "");
    if (row->kind != PACK_NORMAL)
        append(item->bound, sizeof item->bound, "depth: mean %g, at most %g of far", row->depth.mean, row->depth.max);
}

static void tell_constant(const void *of, list_item *item) {
    (void)of;
    append(item->bound, sizeof item->bound, "depthprec table --constants");
}

static void tell_trap(const void *of, list_item *item) {
    const trap_row *row = of;
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = 0.3;
    spec.ortho = row->ortho;
    spec.mapping = row->ndc_signed ? DP_MAPPING_GL : DP_MAPPING_D3D;
    if (row->turns != NULL)
        append(item->bound, sizeof item->bound,
               "a normal turned by %s degrees, 45 off the view axis, half way between two that are 60 apart; right: %s",
               number_of(row->turns(45, 60), 3).text, row->right);
    else if (dp_setup_init(&setup, &spec) == DP_OK)
        append(item->bound, sizeof item->bound, "%s at 10, between %g and %g; right: %s",
               number_of(trap_reads(row, &setup, sqrt(3) / 3, 10), 6).text, spec.znear, spec.zfar, row->right);
}

bool list_lattice(size_t index, list_item *item) {
    const sensor_row *row = sensor_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source};
    append(item->bound, sizeof item->bound, "%s", row->gap);
    return true;
}

bool list_device(size_t index, list_item *item) {
    static const double at[] = {1, 2, 5, 10};
    const device_row *row = device_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row};
    const sensor s = device_sensor(row);
    append(item->bound, sizeof item->bound, "%s%s", row->unit > 0 ? number_of(1000 * row->unit, 6).text : "disparity",
           row->unit > 0 ? " mm a unit" : "");
    if (row->focal > 0)
        append(item->bound, sizeof item->bound, ", %s pixel%s, focal length %s", number_of(fabs(row->step), 6).text,
               fabs(row->step) > 1 ? "s" : "", number_of(row->focal, 7).text);
    if (row->baseline > 0)
        append(item->bound, sizeof item->bound, ", baseline %s mm", number_of(1000 * row->baseline, 6).text);
    append(item->bound, sizeof item->bound, "; %s%s to %s m%s", row->usual ? "not published, usual " : "",
           number_of(row->nearest, 3).text, number_of(row->farthest, 3).text, row->radial ? " along the ray" : "");
    for (size_t i = 0; row->levels != GRAIN_FINE && i < sizeof at / sizeof at[0]; i++)
        append(item->bound, sizeof item->bound, "%s%s at %s m", i == 0 ? "; apart by " : ", ",
               number_of(sensor_gap(&s, at[i]), 4).text, number_of(at[i], 4).text);
    return true;
}

static void tell_synthetic(const void *of, list_item *item) {
    const synthetic_row *row = of;
    for (size_t i = 0; row->parameters[i].name != NULL; i++)
        append(item->bound, sizeof item->bound, "%s%s=%g", i > 0 ? ", " : "", row->parameters[i].name,
               row->parameters[i].value);
}

static void tell_language(const void *of, list_item *item) {
    const code_language *row = of;
    char rules[CODE_RULES_SIZE];
    append(item->bound, sizeof item->bound, "%s", code_language_rules(row, rules));
}

bool list_family(size_t index, list_item *item) {
    const method_family_row *row = method_family_get(index);
    return row != NULL && list_fill(item, (list_item){.name = row->name, .note = row->summary, .row = row});
}

static const double formula_at = 1e4; /* where a claim that is a formula is shown */

bool list_method(size_t index, list_item *item) {
    const method_row *row = method_get(index);
    if (row == NULL)
        return false;
    const method_family_row *family = method_family_get(row->family);
    *item = (list_item){.name = row->name, .aliases = family->name, .note = row->note, .source = row->source};
    for (size_t i = 0; i < family->case_count; i++) {
        const method_claim *c = &row->claims[i];
        const double worst = method_claim_at(c, fmin(formula_at, c->ratio_hi));
        if (!method_speaks(row, i))
            continue;
        append(item->bound, sizeof item->bound, "%s%s %s", *item->bound != '\0' ? "; " : "", family->cases[i].name,
               isnan(c->worst) ? "nothing" : number_up(worst, 3).text);
        if (c->formula != NULL)
            append(item->bound, sizeof item->bound, " at far/near 10000");
        if (!isnan(c->worst) && c->ratio_hi < METHOD_RATIO_HI)
            append(item->bound, sizeof item->bound, " to far/near %s", number_down(c->ratio_hi, 3).text);
    }
    return true;
}

static void tell_word(const void *row, list_item *item) {
    const word_row *w = row;
    item->bound[0] = '\0';
    for (const char *at = w->commands; *at != '\0'; at += strcspn(at, "\n"), at += *at == '\n')
        append(item->bound, sizeof item->bound, "%sdepthprec %.*s", at > w->commands ? "; " : "",
               (int)strcspn(at, "\n"), at);
}

/* The topics that can be listed. */
static const topic topics[] = {
    {"formats", "depth formats and the bounds of their rounding", {.get = list_format}, .bound = "bound"},
    {"mappings", "how an eye depth becomes a window depth", {.get = list_mapping}, .bound = "bound"},
    {"models", "how much of the arithmetic before the buffer is modelled", {.get = list_model}, .bound = "bound"},
    {"arithmetic", "variants of binary32 arithmetic, for --arith", {.get = list_arith}, .bound = "bound"},
    {"transforms", "how world positions become clip coordinates", {.get = list_composition}, .bound = "bound"},
    {"causes", "the parts of the separation, for budget", {.get = list_cause}, .bound = "bound"},
    {"presets",
     "cameras as engines set them, for --preset",
     {.rows = &preset_table, .tell = tell_preset},
     .bound = "camera"},
    {"platforms",
     "what browsers and APIs store when asked for 24 bits",
     {.rows = &platform_table, .tell = tell_platform},
     .bound = "stored"},
    {"apis",
     "what one unit of depth bias is, for bias --api",
     {.rows = &bias_api_table, .tell = tell_api},
     .bound = "rule"},
    {"limits", "what no depth bias does", {.rows = &bias_limit_table}, .bound = "bound"},
    {"remedies",
     "what is written in place of a depth bias, for bias --remedy",
     {.rows = &remedy_table, .tell = tell_remedy},
     .bound = "worth"},
    {"engines",
     "the shadow biases of engines, for shadow --engine",
     {.rows = &shadow_engine_table, .tell = tell_engine},
     .bound = "rule"},
    {"filters",
     "filters of shadow maps, for shadow --filter",
     {.rows = &shadow_filter_table, .tell = tell_filter},
     .bound = "reads"},
    {"rasterizers",
     "how rasterizers snap vertices and step depth across triangles",
     {.rows = &raster_table, .tell = tell_rasterizer},
     .bound = "arithmetic"},
    {"programs",
     "how a vertex program makes clip coordinates, for prepass",
     {.rows = &vertex_program_table},
     .bound = "bound"},
    {"reads", "how convert reads integer codes, for --read", {.rows = &convert_read_table}, .bound = "bound"},
    {"writes", "how convert writes numbers as codes, for --write", {.rows = &convert_write_table}, .bound = "bound"},
    {"upscalers",
     "how far apart along z upscalers take two samples as separate surfaces",
     {.rows = &upscaler_table, .tell = tell_upscaler},
     .bound = "share"},
    {"schemes",
     "world-to-view schemes, for world --scheme",
     {.rows = &world_table, .tell = tell_scheme},
     .bound = "size"},
    {"encodings",
     "depth and normals in the channels of a texture, and their error bounds",
     {.rows = &pack_table, .tell = tell_encoding},
     .bound = "bound"},
    {"packings",
     "textures with depth or normals in several channels, for texture --packing and --product pack",
     {.rows = &packing_table, .tell = packing_tell},
     .bound = "bound"},
    {"constants",
     "what a shader is given of a camera, and makes of a depth: _ZBufferParams and its kin",
     {.rows = &constant_table, .tell = tell_constant},
     .bound = "values",
     .names = LIST_CONSTANTS},
    {"traps",
     "depth formulas found in shaders that are wrong",
     {.rows = &trap_table, .tell = tell_trap},
     .bound = "reads"},
    {"lattices", "what metric depth was rounded to, for texture --metric", {.get = list_lattice}, .bound = "gap"},
    {"sensors",
     "data sheets of depth cameras and data sets, for texture --stereo and --lattice",
     {.get = list_device},
     .bound = "sheet",
     .names = "datasets cameras"},
    {"products",
     "what texture makes of the depths, for --product",
     {.rows = &product_table, .tell = product_tell},
     .bound = "methods"},
    {"effects",
     "effects for texture --product effect: formulas and parameters",
     {.rows = &effect_table, .tell = effect_tell},
     .bound = "parameters"},
    {"figures", "figures, for plot", {.rows = &figure_table}, .bound = "bound"},
    {"parameters",
     "parameters of effects, for texture --parameter: default, unit and range",
     {.get = list_parameter},
     .bound = "range"},
    {"synthetic",
     "synthetic depth images, for texture --synthetic",
     {.rows = &synthetic_table, .tell = tell_synthetic},
     .bound = "bound",
     .shown = "parameters"},
    {"positions",
     "positions from window depth, for texture --product position",
     {.rows = &position_table},
     .bound = "bound",
     .names = "ReconstructViewPos ViewSpacePosAtScreenUV ComputeWorldSpacePosition"},
    {"normals",
     "normals from depth, for texture --product normal",
     {.rows = &normal_table},
     .bound = "bound",
     .names = "ReconstructNormal"},
    {"languages",
     "languages of code, and what each promises of its arithmetic",
     {.rows = &code_language_table, .tell = tell_language},
     .bound = "arithmetic"},
    {"methods",
     "methods by family: what each claims, for which set-up and far/near",
     {.get = list_method},
     .bound = "bound"},
    {"questions",
     "questions that people ask, and the command that answers each",
     {.rows = &question_table, .tell = tell_word},
     .bound = "command"},
    {"words",
     "words of articles, shaders and these pages: what each means, and the command that answers",
     {.rows = &word_table, .tell = tell_word},
     .bound = "command"},
};
enum { TOPIC_COUNT = sizeof topics / sizeof topics[0] };

bool list_topic(size_t index, list_item *item) {
    const struct topic *row = &topics[index];
    return index < TOPIC_COUNT &&
           list_fill(item, (list_item){.name = row->name, .aliases = row->names, .note = row->note, .row = row});
}
