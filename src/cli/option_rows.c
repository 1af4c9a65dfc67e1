/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option_rows.h"

#include <string.h>

#include "cli/option_bias.h"
#include "cli/option_number.h"
#include "cli/option_texture.h"
#include "cli/suggest.h"

/* Steps through a comma-separated list: copies the next item, moves *text behind it. False when an item is too long. */
static bool next_item(const char **text, char *item, size_t size) {
    size_t length = strcspn(*text, ",");
    if (length >= size)
        return false;
    memcpy(item, *text, length);
    item[length] = '\0';
    *text += length + ((*text)[length] == ',' && (*text)[length + 1] != '\0');
    return true;
}

/* Items are separated by one comma each: an empty one, also at the end, is a slip of the hand. */
static bool well_separated(const char *text) {
    size_t length = strlen(text);
    return length > 0 && *text != ',' && text[length - 1] != ',' && strstr(text, ",,") == NULL;
}

static void add_format(options *o, const dp_format *format) {
    for (size_t i = 0; i < o->format_count; i++)
        if (strcmp(o->formats[i].name, format->name) == 0)
            return;
    if (o->format_count < OPTIONS_FORMATS_MAX)
        o->formats[o->format_count++] = *format;
}

static int unknown_format(const char *name) {
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE];
    for (size_t i = 0; i < dp_format_count(); i++) {
        suggest_offer(&s, dp_format_get(i)->format.name);
        suggest_offer(&s, dp_format_get(i)->aliases);
    }
    suggest_offer(&s, "all depth24plus");
    return option_error(
        OPTION_FORMAT,
        "must be all, fp16, fp32, unorm16, unorm24 (or a name from 'depthprec list formats'), unormN or "
        "floatE.M[bB], got '%s'%s",
        name, suggest_text(&s, "", text));
}

static int parse_format(options *o, const char *value) {
    char name[64];
    const char *rest = value;
    o->format_count = 0;
    if (!well_separated(value))
        return option_error(OPTION_FORMAT, "must be NAME[,NAME...] or all, got '%s'", value);
    while (*rest != '\0') {
        dp_format found[2];
        if (!next_item(&rest, name, sizeof name))
            return unknown_format(value);
        size_t count = dp_format_parse(name, found);
        if (count == 0 && strcmp(name, "all") != 0)
            return unknown_format(name);
        for (size_t i = 0; i < count; i++)
            add_format(o, &found[i]);
        for (size_t i = 0; count == 0 && i < dp_format_count(); i++)
            add_format(o, &dp_format_get(i)->format);
    }
    return EXIT_FINE;
}

static void add_mapping(options *o, dp_mapping mapping) {
    for (size_t i = 0; i < o->mapping_count; i++)
        if (o->mappings[i] == mapping)
            return;
    o->mappings[o->mapping_count++] = mapping;
}

static int unknown_mapping(const char *name) {
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE];
    for (int i = 0; i < DP_MAPPING_COUNT; i++) {
        suggest_offer(&s, dp_mapping_get((dp_mapping)i)->name);
        suggest_offer(&s, dp_mapping_get((dp_mapping)i)->aliases);
    }
    suggest_offer(&s, "all");
    return option_error(OPTION_MAPPING,
                        "must be all, d3d, gl, reversed, gl-reversed, linear or log (or a name from 'depthprec list "
                        "mappings'), got '%s'%s",
                        name, suggest_text(&s, "", text));
}

static int parse_mapping(options *o, const char *value) {
    char name[64];
    const char *rest = value;
    o->mapping_count = 0;
    if (!well_separated(value))
        return option_error(OPTION_MAPPING, "must be NAME[,NAME...] or all, got '%s'", value);
    while (*rest != '\0') {
        dp_mapping mapping;
        if (!next_item(&rest, name, sizeof name))
            return unknown_mapping(value);
        if (strcmp(name, "all") == 0) {
            add_mapping(o, DP_MAPPING_D3D);
            add_mapping(o, DP_MAPPING_REVERSED);
        } else if (dp_mapping_parse(name, &mapping) == DP_OK) {
            add_mapping(o, mapping);
        } else {
            return unknown_mapping(name);
        }
    }
    return EXIT_FINE;
}

static int parse_ortho(options *o, const char *value) {
    (void)value;
    o->ortho = true;
    return EXIT_FINE;
}

/* One word out of a row of names; `names` gives name i or null behind the last. */
static int parse_word(option_id id, const char *(*names)(unsigned), const char *value, unsigned *out) {
    suggestion s = suggest_start(value);
    char text[SUGGEST_TEXT_SIZE];
    char allowed[256] = "";
    for (unsigned i = 0; names(i) != NULL; i++) {
        if (strcmp(names(i), value) == 0) {
            *out = i;
            return EXIT_FINE;
        }
        suggest_offer(&s, names(i));
        if (i > 0)
            strcat(allowed, names(i + 1) != NULL ? ", " : " or ");
        strcat(allowed, names(i));
    }
    return option_error(id, "must be %s, got '%s'%s", allowed, value, suggest_text(&s, "", text));
}

static const char *rounding_name(unsigned index) {
    return dp_rounding_name((dp_rounding)index);
}

/* The models of the library, and behind them the wish to have one chosen. */
static const char *model_name(unsigned index) {
    return index == DP_MODEL_COUNT ? "auto" : dp_model_name((dp_model)index);
}

static const char *arith_name(unsigned index) {
    const dp_arith_row *row = dp_arith_get(index);
    return row != NULL ? row->name : NULL;
}

static const char *theme_name(unsigned index) {
    static const char *const names[THEME_COUNT] = {
        [THEME_LIGHT] = "light", [THEME_DARK] = "dark", [THEME_PRINT] = "print"};
    return index < THEME_COUNT ? names[index] : NULL;
}

static int parse_rounding(options *o, const char *value) {
    unsigned index = (unsigned)o->rounding;
    int status = parse_word(OPTION_ROUNDING, rounding_name, value, &index);
    o->rounding = (dp_rounding)index;
    return status;
}

static int parse_model(options *o, const char *value) {
    unsigned index = (unsigned)o->model;
    int status = parse_word(OPTION_MODEL, model_name, value, &index);
    o->model_auto = index == DP_MODEL_COUNT;
    o->model = o->model_auto ? DP_MODEL_EXACT : (dp_model)index;
    return status;
}

static int parse_arith(options *o, const char *value) {
    unsigned index = (unsigned)o->arith;
    int status = parse_word(OPTION_ARITH, arith_name, value, &index);
    o->arith = index;
    return status;
}

static const char *composition_name(unsigned index) {
    const dp_composition_row *row = dp_composition_get((dp_composition)index);
    return row != NULL ? row->name : NULL;
}

static int parse_composition(options *o, const char *value) {
    unsigned index = (unsigned)o->terms.composition;
    int status = parse_word(OPTION_COMPOSITION, composition_name, value, &index);
    o->terms.composition = (dp_composition)index;
    return status;
}

static int parse_theme(options *o, const char *value) {
    unsigned index = (unsigned)o->theme;
    int status = parse_word(OPTION_THEME, theme_name, value, &index);
    o->theme = (theme_id)index;
    return status;
}

static int parse_at(options *o, const char *value) {
    return depths_parse(value, &o->at);
}

static int parse_range(options *o, const char *value) {
    return range_parse(value, &o->range_lo, &o->range_hi);
}

static const char *target_name(unsigned index) {
    static const char *const names[] = {"near", "far", "format", "mapping", "separation", "distance"};
    return index < sizeof names / sizeof names[0] ? names[index] : NULL;
}

static int parse_for(options *o, const char *value) {
    unsigned index = 0;
    int status = parse_word(OPTION_FOR, target_name, value, &index);
    o->target = (solve_target)(index + 1);
    return status;
}

static int parse_linearize(options *o, const char *value) {
    (void)value;
    o->terms.linearize = 1;
    return EXIT_FINE;
}

static const char *report_name(unsigned index) {
    static const char *const names[REPORT_COUNT] = {
        [REPORT_TEXT] = "text", [REPORT_JSON] = "json", [REPORT_JUNIT] = "junit"};
    return index < REPORT_COUNT ? names[index] : NULL;
}

static int parse_report(options *o, const char *value) {
    unsigned index = (unsigned)o->report;
    int status = parse_word(OPTION_REPORT, report_name, value, &index);
    o->report = (report_form)index;
    return status;
}

static int parse_title(options *o, const char *value) {
    o->title = value;
    return EXIT_FINE;
}

static int set_form(options *o, option_id id, output_form form, const char *other) {
    if (o->form != FORM_TEXT && o->form != form)
        return option_error(id, "must not be given together with --%s", other);
    o->form = form;
    return EXIT_FINE;
}

static int parse_json(options *o, const char *value) {
    (void)value;
    return set_form(o, OPTION_JSON, FORM_JSON, "csv");
}

static int parse_csv(options *o, const char *value) {
    (void)value;
    return set_form(o, OPTION_CSV, FORM_CSV, "json");
}

static int parse_output(options *o, const char *value) {
    if (*value == '\0')
        return option_error(OPTION_OUTPUT, "must be a file name, or - for stdout, got ''");
    o->output = value;
    return EXIT_FINE;
}

static int parse_quiet(options *o, const char *value) {
    (void)value;
    o->quiet = true;
    return EXIT_FINE;
}

static int parse_verbose(options *o, const char *value) {
    (void)value;
    o->verbose = true;
    return EXIT_FINE;
}

/* Which commands take what. */
enum {
    MODELLED = VERB_TABLE | VERB_PLOT,
    BUDGETED = VERB_BUDGET | VERB_PLOT,
    ASKED = MODELLED | VERB_BUDGET,
    CAMERA = ASKED | VERB_ZFIGHT,
    PLACED = CAMERA | VERB_BENCH,
    COUNTED = VERB_ZFIGHT,
    SPREAD = COUNTED | VERB_CHECK | VERB_TEXTURE,
    DRAWN = VERB_PLOT | VERB_TEXTURE,
    WRITTEN = PLACED | VERB_TEXTURE | VERB_STABILITY | VERB_LIST | VERB_BIAS | VERB_CHECK | VERB_SOLVE,
    EVERY = ~0
};

/* clang-format off */
const option_row option_rows[OPTION_COUNT] = {
    [OPTION_NEAR] = {"near", 'n', "Z", PLACED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "near plane, scene units, 1e-12 to 1e12 (default 0.1)", parse_near},
    [OPTION_FAR] = {"far", 'f', "Z|inf", PLACED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "far plane, scene units, up to 1e18, or inf (default 1000)", parse_far},
    [OPTION_FORMAT] = {"format", 'F', "NAME[,NAME...]|all", PLACED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "depth formats: fp16, fp32, unorm16, unorm24, names as the APIs\n"
        "write them, unormN, floatE.M[bB] (default all: the first four)", parse_format},
    [OPTION_MAPPING] = {"mapping", 'm', "NAME[,NAME...]|all", PLACED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "d3d, gl, reversed, gl-reversed, linear, log\n"
        "(default all: d3d and reversed)", parse_mapping},
    [OPTION_ORTHO] = {"ortho", 0, NULL, CAMERA | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "orthographic projection (default: perspective)", parse_ortho},
    [OPTION_ROUNDING] = {"rounding", 0, "nearest|even|zero", CAMERA | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "how a depth between two codes is rounded (default nearest)", parse_rounding},
    [OPTION_PRESET] = {"preset", 0, "NAME", CAMERA | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "fill in near, far, mapping and format as an engine sets them,\n"
        "where they are not given; 'depthprec list presets'", parse_preset},
    [OPTION_MODEL] = {"model", 0, "exact|staged|fp32|auto", MODELLED | VERB_SOLVE,
        "the arithmetic before the buffer: none, the lattice alone;\n"
        "NDC and window depth each rounded to binary32; every operation\n"
        "in binary32; or the simplest that is enough (default exact;\n"
        "solve: fp32, the guarantee)", parse_model},
    [OPTION_ARITH] = {"arith", 0, "NAME", CAMERA | VERB_SOLVE,
        "the binary32 arithmetic: ieee, fused, reciprocal,\n"
        "fused-reciprocal, product, mesa, softpipe, ieee-remap,\n"
        "mesa-remap (default ieee)", parse_arith},
    [OPTION_TOLERANCE] = {"tolerance", 0, "SHARE", ASKED | VERB_BENCH | VERB_LIST,
        "what may be neglected, 0.05 or 5%: a model is enough when it\n"
        "adds no more to the separation (default 5%); and the cheapest\n"
        "method that claims no more is taken, or marked in a list", parse_tolerance},
    [OPTION_LOG_C] = {"log-c", 0, "C", MODELLED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "constant of the log mapping, 1e-12 to 1e12 (default 1)", parse_log_c},
    [OPTION_AT] = {"at", 0, "Z[,Z...]|LO:HI:log|lin:COUNT", ASKED | VERB_TEXTURE | VERB_BIAS | VERB_SOLVE,
        "the depths asked about, at most 1000000, within [near, far]\n"
        "(default: nine, log-spaced from near to far)", parse_at},
    [OPTION_RANGE] = {"range", 0, "LO:HI", MODELLED | VERB_ZFIGHT | VERB_BIAS | VERB_SOLVE,
        "the depths that worst cases are taken over\n"
        "(default: near to far)", parse_range},
    [OPTION_FOR] = {"for", 0, "WHAT", VERB_SOLVE,
        "what to solve for: near, far, format, mapping, separation, or\n"
        "distance, the depth up to which --separation holds\n"
        "(default: the first of them that is not given)", parse_for},
    [OPTION_SEPARATION] = {"separation", 0, "S", VERB_SOLVE,
        "surfaces S apart, scene units, must be told apart", parse_separation},
    [OPTION_ERROR] = {"error", 0, "E", VERB_SOLVE,
        "or: the stored depth may be E off, scene units, not more", parse_error},
    [OPTION_INTERPOLATION] = {"interpolation", 0, "E", BUDGETED,
        "error of a window depth interpolated across a triangle, in\n"
        "units of 2^-24, at most 16777216 (default 0)", parse_interpolation},
    [OPTION_WORLD] = {"world", 0, "R", BUDGETED,
        "world positions, no coordinate of them or of the camera beyond R\n"
        "(default 0: eye depth is given)", parse_world},
    [OPTION_COMPOSITION] = {"composition", 0, "once|products|relative", BUDGETED,
        "how they become clip coordinates: one binary32 matrix of view and\n"
        "projection formed in double, or multiplied in binary32; or less\n"
        "the camera's position, in double, first (default once)", parse_composition},
    [OPTION_LINEARIZE] = {"linearize", 0, NULL, BUDGETED,
        "count reading the eye depth back in a binary32 shader", parse_linearize},
    [OPTION_API] = {"api", 0, "NAME", VERB_BIAS,
        "whose rule: d3d11 (also d3d12), webgpu, vulkan, vulkan-exact,\n"
        "vulkan-unorm, vulkan-float, gl, d3d9 (default d3d11)", parse_api},
    [OPTION_UNITS] = {"units", 0, "U", VERB_BIAS,
        "constant bias in units of r; in window depth for d3d9 and\n"
        "vulkan-float", parse_units},
    [OPTION_FACTOR] = {"factor", 0, "F", VERB_BIAS,
        "bias in units of the window slope (default 0)", parse_factor},
    [OPTION_CLAMP] = {"clamp", 0, "C", VERB_BIAS,
        "greatest bias, or least when negative, in window depth\n"
        "(default 0: none)", parse_clamp},
    [OPTION_SLOPE] = {"slope", 0, "S", VERB_BIAS,
        "eye depth changes by S scene units from one pixel to the next\n"
        "(default 0: facing the camera)", parse_slope},
    [OPTION_GAP] = {"gap", 0, "G", COUNTED | VERB_BIAS,
        "zfight: ties and swaps of surfaces G apart, scene units\n"
        "(default: of neighbouring binary32 depths); bias: how much\n"
        "nearer a layer must come (default 0: be told apart)", parse_gap},
    [OPTION_SAMPLE] = {"sample", 0, "N", COUNTED,
        "draw N pairs at random (default: visit every depth)", parse_sample},
    [OPTION_SEED] = {"seed", 0, "S", COUNTED,
        "seed of --sample: the same pairs for the same seed (default 0)", parse_seed},
    [OPTION_THREADS] = {"threads", 0, "N", SPREAD,
        "at most N threads (default: all cores); results are the same", parse_threads},
    [OPTION_FOV] = {"fov", 0, "DEG", VERB_TEXTURE,
        "vertical field of view, 0.01 to 179 (default 60)", parse_fov},
    [OPTION_HALF_HEIGHT] = {"half-height", 0, "H", VERB_TEXTURE,
        "with --ortho: half the height of the view, scene units\n"
        "(default 5)", parse_half_height},
    [OPTION_YAW] = {"yaw", 0, "DEG", VERB_TEXTURE,
        "the camera's turn to the right (default 0: along world z)", parse_yaw},
    [OPTION_PITCH] = {"pitch", 0, "DEG", VERB_TEXTURE,
        "the camera's turn upwards, -90 to 90 (default 0)", parse_pitch},
    [OPTION_ORIGIN] = {"origin", 0, "X,Y,Z", VERB_TEXTURE,
        "where the camera stands, world coordinates (default 0,0,0)", parse_origin},
    [OPTION_SCENE] = {"scene", 0, "NAME", VERB_TEXTURE,
        "a synthetic scene in place of FILE: plane, sphere, steps or\n"
        "decals; 'depthprec list scenes' has their parameters", parse_scene},
    [OPTION_SIZE] = {"size", 0, "WxH", VERB_TEXTURE,
        "with --scene: its pixels (default 640x360)", parse_size},
    [OPTION_PARAMETER] = {"parameter", 0, "NAME=VALUE", VERB_TEXTURE,
        "of the scene or the effect; as often as needed", parse_parameter},
    [OPTION_SKY] = {"sky", 0, "T", VERB_TEXTURE,
        "window depths within T of the far plane's are sky\n"
        "(default 0.0001; 0: the far plane's alone)", parse_sky},
    [OPTION_METRIC] = {"metric", 0, "SCALE", VERB_TEXTURE,
        "the samples are eye depths in units of SCALE scene units, and 0,\n"
        "NaN and infinity are holes: 0.001 for millimetres", parse_metric},
    [OPTION_EYE] = {"eye", 0, NULL, VERB_TEXTURE,
        "product: eye depth", parse_eye},
    [OPTION_RADIAL] = {"radial", 0, NULL, VERB_TEXTURE,
        "with --eye: distance from the camera instead", parse_radial},
    [OPTION_POSITION] = {"position", 0, "METHOD", VERB_TEXTURE,
        "product: world positions by METHOD; exact for the truth", parse_position},
    [OPTION_NORMAL] = {"normal", 0, "METHOD", VERB_TEXTURE,
        "product: normals by METHOD", parse_normal},
    [OPTION_EFFECT] = {"effect", 0, "NAME", VERB_TEXTURE,
        "product: an effect that consumes depth; without an image,\n"
        "the smallest parameter above the noise", parse_effect},
    [OPTION_ERROR_MAP] = {"error-map", 0, NULL, VERB_TEXTURE,
        "the error of the product in place of the product", parse_error_map},
    [OPTION_FIGURE] = {"figure", 0, "FILE", VERB_TEXTURE,
        "draw the product: SVG, PDF or PNG", parse_figure},
    [OPTION_THEME] = {"theme", 0, "light|dark|print", DRAWN,
        "colours of the figure (default light)", parse_theme},
    [OPTION_WIDTH] = {"width", 0, "PX", DRAWN,
        "width of the figure in pixels (default: as suits it)", parse_width},
    [OPTION_HEIGHT] = {"height", 0, "PX", DRAWN,
        "height of the figure in pixels (default: as suits it)", parse_height},
    [OPTION_TITLE] = {"title", 0, "TEXT", DRAWN,
        "title of the figure in place of its own", parse_title},
    [OPTION_REPORT] = {"report", 0, "text|json|junit", VERB_CHECK,
        "how verdicts are written (default text)", parse_report},
    [OPTION_JSON] = {"json", 0, NULL, WRITTEN,
        "write JSON, one object, schema depthprec/1", parse_json},
    [OPTION_CSV] = {"csv", 0, NULL, WRITTEN,
        "write CSV (RFC 4180) with units in the header row", parse_csv},
    [OPTION_OUTPUT] = {"output", 'o', "FILE", WRITTEN,
        "write to FILE when all is done; - is stdout (default)", parse_output},
    [OPTION_QUIET] = {"quiet", 'q', NULL, WRITTEN,
        "no messages and no progress, only data and errors", parse_quiet},
    [OPTION_VERBOSE] = {"verbose", 'v', NULL, WRITTEN,
        "say more: the cell around each depth", parse_verbose},
    [OPTION_HELP] = {"help", 'h', NULL, (unsigned)EVERY,
        "this help", NULL},
    [OPTION_VERSION] = {"version", 0, NULL, (unsigned)EVERY,
        "version and licence", NULL},
};
/* clang-format on */
