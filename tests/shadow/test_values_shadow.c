/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every number that shadow prints, against the room shadow with a light of the test's own; the split and the sphere of
 * a cascade by closed forms. */
#include "bias/cmd_bias/call.h"
#include "named.h"
#include "printed.h"
#include "shadow/shadow.h"

static const char *const ways[SHADOW_WAY_COUNT] = {"constant", "slope", "normal"};

enum { FORMATS = 2, MAPPINGS = 2, APIS = 11 };

/* Each line, what it lights of a box where that is not all of it, and what its rasterizer brings. */
static const struct {
    const char *line;
    double lo, hi;
    const char *arith;
} given[] = {
    {"shadow -n 0.25 -f 90 --cascades 3:0.7 --fov 50 --viewport 800x600 --casters 40 --size 1024x1024 "
     "--kernel 5 --angle 70 -F fp32,unorm24 -m d3d,reversed --api d3d11",
     0, 0, NULL},
    {"shadow --light-box 30mx20mx50m --size 512x256 -F unorm16 -m gl --range 5m:48.65m --api gl --subpixel 4 "
     "--triangle-class pixels=64,slim=8 --kernel 3 --angle 60 --from-origin 1km --curvature 2m:5cm --unit m",
     5, 48.65, NULL},
    {"shadow -f 300 --cascades 2 --hfov 100 --api all --camera-depth d16:reversed:2km --unit m", 0, 0, NULL},
    {"shadow --light-box 8x8x64 --api vulkan-float -m reversed --subpixel 1 --kernel 1 --angle 30", 0, 64,
     NULL}, /* no factor */
    {"shadow --light-box 10x10x40 --size 1024x1024 -F unorm24 --raster softpipe --range 10:30 --kernel 1 --angle 3 "
     "--api metal",
     10, 30, "softpipe"},
    /* Away from window depth 0, where a unit is worth nothing: 404/256. */
    {"shadow --light-box 40x40x404 --api d3d11", 1.578125, 404, NULL},
    {"shadow --light-box 40x40x404 -m reversed --api all", 0, 404 - 1.578125, NULL},
    {"shadow --light-box 40x40x0.2 -F unorm16 --api d3d11", 0, 0.2, NULL},   /* flatter than a gap is long */
    {"shadow --light-box 1e9x1e9x0.001 --api vulkan-float", 0, 0.001, NULL}, /* 2^31 units are not enough */
    {"shadow --light-box 1e9x1e9x0.001 -m d3d --range 0.0005:0.001 --api gl", 0.0005, 0.001, NULL},
};

enum { CASES = sizeof given / sizeof given[0] };

typedef struct shadow_case {
    const char *line;
    char formats[FORMATS][16];
    size_t format_count;
    dp_mapping mappings[MAPPINGS];
    size_t mapping_count;
    const char *api; /* null for all */
    int width, height, kernel, subpixel;
    double angle, pixels, slim, world;
    double curvature, facet; /* 0: planes */
    const char *arith;       /* of a rasterizer, which has no subpixels here; null: none is named */
    double box[3], lo, hi;   /* 0: the view; what is lit */
    double znear, zfar, fov, aspect, lambda, casters;
    int cascades;
} shadow_case;

/* A length in metres where a unit is written behind it. */
static double length_in(const char *text, char **end) {
    static const struct {
        const char *name;
        double metres;
    } units[] = {{"km", 1000}, {"cm", 0.01}, {"m", 1}};
    const double number = strtod(text, end);
    for (size_t i = 0; i < 3; i++)
        if (strncmp(*end, units[i].name, strlen(units[i].name)) == 0) {
            *end += strlen(units[i].name);
            return number * units[i].metres;
        }
    return number;
}

static double length_behind(const char *line, const char *option) {
    char *end;
    return is_given(line, option) ? length_in(word_behind(line, option), &end) : 0;
}

/* An option that is left out is as the help has it. */
static shadow_case case_of(size_t i) {
    const char *line = given[i].line, *formats = word_behind(line, "-F"), *mappings = word_behind(line, "-m");
    const char *api = word_behind(line, "--api");
    double size[2] = {2048, 2048}, viewport[2] = {1920, 1080};
    char words[64];
    double split[2] = {0, 0.5};
    numbers_behind(line, "--cascades", split, 2);
    numbers_behind(line, "--size", size, 2);
    numbers_behind(line, "--viewport", viewport, 2);
    shadow_case c = {.line = line,
                     .api = strcmp(api, "all") != 0 ? bias_api_find(api)->name : NULL,
                     .width = (int)size[0],
                     .height = (int)size[1],
                     .kernel = (int)number_behind(line, "--kernel", 3),
                     .subpixel = given[i].arith != NULL ? 0 : (int)number_behind(line, "--subpixel", 8),
                     .angle = number_behind(line, "--angle", 75),
                     .pixels = strstr(line, "pixels=64") != NULL ? 64 : 512,
                     .slim = strstr(line, "slim=8") != NULL ? 8 : 16,
                     .world = length_behind(line, "--from-origin"),
                     .arith = given[i].arith,
                     .lo = given[i].lo,
                     .hi = given[i].hi,
                     .znear = number_behind(line, "-n", 0.1),
                     .zfar = number_behind(line, "-f", 0),
                     .fov = number_behind(line, "--fov", 0),
                     .aspect = viewport[0] / viewport[1],
                     .lambda = split[1],
                     .casters = number_behind(line, "--casters", 100),
                     .cascades = (int)split[0]};
    char *end = NULL;
    if (is_given(line, "--curvature"))
        c.curvature = length_in(word_behind(line, "--curvature"), &end);
    if (end != NULL && *end == ':')
        c.facet = length_in(end + 1, &end);
    char *at = is_given(line, "--light-box") ? (char *)(uintptr_t)word_behind(line, "--light-box") : NULL;
    for (int k = 0; k < 3 && at != NULL; k++, at++)
        c.box[k] = length_in(at, &at);
    snprintf(words, sizeof words, "%s", formats != NULL ? formats : "fp32");
    for (char *word = strtok(words, ","); word != NULL; word = strtok(NULL, ","))
        snprintf(c.formats[c.format_count++], sizeof c.formats[0], "%s", word);
    snprintf(words, sizeof words, "%s", mappings != NULL ? mappings : "d3d");
    for (char *word = strtok(words, ","); word != NULL; word = strtok(NULL, ","))
        assert_int_equal(dp_mapping_parse(word, &c.mappings[c.mapping_count++]), DP_OK);
    return c;
}

static size_t setup_count(const shadow_case *c) {
    return c->format_count * c->mapping_count;
}

/* ---- The maps ---------------------------------------------------------------------------------------------------- */

static double radians(double degrees) {
    return degrees * (3.14159265358979323846 / 180);
}

static shadow_light light_of(const shadow_case *c, const char *format, dp_mapping mapping) {
    shadow_light light = shadow_light_default();
    dp_arith arith = 0;
    if (c->arith != NULL)
        assert_int_equal(dp_arith_parse(c->arith, &arith), DP_OK);
    light.setup = SETUP(format, .ortho = 1, .zfar = c->box[2] > 0 ? c->box[2] : 1, .mapping = mapping, .arith = arith);
    light.triangles.width = c->width;
    light.triangles.height = c->height;
    light.triangles.subpixel = c->subpixel;
    if (c->arith != NULL)
        light.triangles.plane = dp_anchor_get(DP_ANCHOR_ORIGIN_STEPPED)->plane;
    light.triangles.pixels = c->pixels;
    light.triangles.slim = c->slim;
    light.triangles.slant_hi = c->angle;
    light.kernel = c->kernel / 2.0;
    light.world = c->world;
    if (c->curvature > 0)
        light.radius = c->curvature;
    light.facet = c->facet;
    light.receiver_lo = c->lo;
    light.receiver_hi = c->box[2] > 0 ? c->hi : 1;
    if (c->box[2] > 0) {
        light.width = c->box[0];
        light.height = c->box[1];
    }
    return light;
}

static double fov_of(const shadow_case *c) {
    return c->fov > 0 ? c->fov : dp_fov_vertical(100, 1920, 1080);
}

/* Where cascade i begins, by the practical split scheme. */
static double split_at(const shadow_case *c, int i) {
    const double part = (double)i / c->cascades;
    const double even = c->znear + (c->zfar - c->znear) * part, log = c->znear * pow(c->zfar / c->znear, part);
    return c->lambda * log + (1 - c->lambda) * even;
}

/* The sphere about the corners of a frustum: through those of both ends, or about the far ones alone. */
static double radius_of(const shadow_case *c, double from, double to) {
    const double k = tan(radians(fov_of(c)) / 2) * sqrt(1 + c->aspect * c->aspect);
    if (k * k >= (to - from) / (to + from))
        return to * k;
    const double width = to - from, k2 = k * k;
    return 0.5 * sqrt(width * width + 2 * (to * to + from * from) * k2 + (to + from) * (to + from) * k2 * k2);
}

/* A box has the light alone. */
static shadow_cascade map_of(const shadow_case *c, const char *format, dp_mapping mapping, int i) {
    const shadow_light model = light_of(c, format, mapping);
    dp_triangles drawn = dp_triangles_default();
    drawn.fov_y = fov_of(c);
    const dp_setup camera =
        SETUP("unorm16", .znear = c->znear, .zfar = 2000, .mapping = DP_MAPPING_REVERSED, .triangles = drawn);
    const shadow_split split = {c->znear,   c->zfar,     fov_of(c),
                                c->aspect,  c->cascades, c->lambda,
                                c->casters, true,        is_given(c->line, "--camera-depth") ? &camera : NULL};
    shadow_cascade made = {.light = model};
    if (c->box[2] > 0) {
        assert_int_equal(shadow_light_check(&model), SHADOW_OK);
        return made;
    }
    assert_int_equal(shadow_cascade_of(&split, &model, i, &made), SHADOW_OK);
    assert_relative(made.from, split_at(c, i), 1e-13);
    assert_relative(made.to, split_at(c, i + 1), 1e-13);
    assert_relative(made.radius, radius_of(c, made.from, made.to), 1e-13);
    return made;
}

/* ---- What is wanted ---------------------------------------------------------------------------------------------- */

static size_t map_count(const shadow_case *c) {
    return c->box[2] > 0 ? 1 : (size_t)c->cascades;
}

static double with_sign(const shadow_light *light, double magnitude) {
    const bool reversed = light->setup.spec.mapping == DP_MAPPING_REVERSED;
    return !isfinite(magnitude) ? NAN : reversed && magnitude != 0 ? -magnitude : magnitude;
}

static double units_of(const shadow_light *light, const shadow_need *need, int way, const bias_api *api) {
    return isinf(need->bias[way].factor) ? NAN : with_sign(light, shadow_state_of(light, &need->bias[way], api).units);
}

static void want_way(values *v, const char *way, const char *field, double number) {
    char name[64];
    snprintf(name, sizeof name, "%s_%s", way, field);
    want_number(v, name, number);
}

static void want_ways(values *v, const shadow_light *light, const shadow_need *need, const bias_api *api) {
    bool limited = false;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        const shadow_bias *b = &need->bias[k];
        const shadow_state state = shadow_state_of(light, b, api);
        want_way(v, ways[k], "bias", b->window);
        want_way(v, ways[k], "units", units_of(light, need, k, api));
        const bool none = isnan(units_of(light, need, k, api));
        want_way(v, ways[k], "gap", none ? NAN : state.gap_light);
        want_way(v, ways[k], "gap_normal", none ? NAN : state.gap_normal);
        want_way(v, ways[k], "share", isinf(b->factor) ? NAN : b->share);
        if (k != SHADOW_CONSTANT)
            want_way(v, ways[k], "gap_facing", none ? NAN : state.gap_facing);
        limited = limited || b->limited || (!none && light->receiver_hi + state.gap_light > light->setup.spec.zfar);
    }
    want_bool(v, "limited", limited);
    want_number(v, "slope_factor", with_sign(light, need->bias[SHADOW_SLOPE].factor));
    want_number(v, "normal_offset", need->bias[SHADOW_NORMAL].offset);
    want_number(v, "normal_texels", need->bias[SHADOW_NORMAL].offset / fmax(need->texel_x, need->texel_y));
}

static void want_row(values *v, const shadow_case *c, const shadow_cascade *map, int cascade, const bias_api *api) {
    const shadow_light *light = &map->light;
    const double depth = light->setup.spec.zfar - light->setup.spec.znear;
    shadow_need need;
    shadow_need_of(light, &need);
    want_text(v, "api", api->name);
    if (c->box[2] == 0)
        want(v, "cascade=%u from=%f to=%f radius=%f", (unsigned)cascade + 1, map->from, map->to, map->radius);
    want(v, "width=%f height=%f depth=%f", light->width, light->height, depth);
    want(v, "texel_size=%f", fmax(light->width / c->width, light->height / c->height));
    want_ways(v, light, &need, api);
    values_under(v, "%scauses.", v->prefix);
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++)
        want_number(v, shadow_cause_name((shadow_cause)k), shadow_part_at(light, &need.part[k], c->angle) * depth);
}

/* Four digits of a positive number, or one a little larger. */
static double up4(double x) {
    const double unit = pow(10, floor(log10(x)) - 3);
    char text[32];
    snprintf(text, sizeof text, "%.4g", ceil(x / unit - 1e-9) * unit);
    return strtod(text, NULL);
}

/* The largest of all cascades; calls as bias writes them, which test_values_bias_all has. */
static void want_answer(values *v, const shadow_case *c, const char *format, dp_mapping mapping, const bias_api *api) {
    double units[SHADOW_WAY_COUNT] = {0}, factor = 0, texels = 0;
    want_text(v, "api", api->name);
    for (size_t i = 0; i < map_count(c); i++) {
        const shadow_light light = map_of(c, format, mapping, (int)i).light;
        shadow_need need;
        shadow_need_of(&light, &need);
        texels = fmax(texels, need.bias[SHADOW_NORMAL].offset / need.texel);
        factor = fmax(factor, need.bias[SHADOW_SLOPE].factor);
        for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
            const double one = units_of(&light, &need, k, api);
            units[k] = isnan(units[k]) || isnan(one) ? NAN : fmax(units[k], fabs(one));
        }
        if (isinf(factor))
            units[SHADOW_SLOPE] = NAN;
    }
    const double sign = mapping == DP_MAPPING_REVERSED ? -1 : 1;
    for (int k = 0; k < SHADOW_WAY_COUNT; k++) {
        char name[64], call[256] = "";
        want_way(v, ways[k], "units", sign * units[k]);
        if (k == SHADOW_NORMAL)
            snprintf(call, sizeof call, "%.4g texels, ", up4(texels));
        strcat(call, bias_call(api, sign * units[k], k == SHADOW_SLOPE ? sign * up4(factor) : 0).text);
        snprintf(name, sizeof name, "%s_call", ways[k]);
        want_text(v, name, isnan(units[k]) ? NULL : call);
    }
    want_number(v, "slope_factor", isinf(factor) ? NAN : sign * factor);
    want_number(v, "normal_texels", texels);
}

static void want_head(values *v, const shadow_case *c) {
    want(v, "api=%s arith=%s", c->api != NULL ? c->api : "all", c->arith != NULL ? c->arith : "ieee");
    want(v, "size.width=%u size.height=%u kernel=%u", (unsigned)c->width, (unsigned)c->height, (unsigned)c->kernel);
    want(v, "angle=%f subpixel=%u pixels=%f slim=%f", c->angle, (unsigned)c->subpixel, c->pixels, c->slim);
    want(v, "from_origin=%f curvature=%f facet=%f", c->world, c->curvature > 0 ? c->curvature : NAN, c->facet);
    want_text(v, "camera_depth", is_given(c->line, "--camera-depth") ? "d16:reversed:2km" : NULL);
    if (c->box[2] > 0) {
        want_text(v, "view", NULL);
        return;
    }
    want(v, "view.near=%f view.far=%f view.fov=%f view.aspect=%f", c->znear, c->zfar, fov_of(c), c->aspect);
    want(v, "view.cascades=%u view.lambda=%f view.casters=%f", (unsigned)c->cascades, c->lambda, c->casters);
}

static const bias_api *api_of(const shadow_case *c, size_t i) {
    return c->api != NULL ? bias_api_find(c->api) : bias_api_get(i);
}

static void want_setup_of(values *v, const shadow_case *c, size_t k) {
    const char *format = c->formats[k / c->mapping_count];
    const dp_mapping mapping = c->mappings[k % c->mapping_count];
    const size_t apis = c->api != NULL ? 1 : APIS;
    values_under(v, "setups[%zu].", k);
    want(v, "format=%s mapping=%s unit=%s", format, dp_mapping_get(mapping)->name, *v->unit != '\0' ? v->unit : NULL);
    want(v, "lit_from=%f lit_to=%f", c->box[2] > 0 ? c->lo : NAN, c->box[2] > 0 ? c->hi : NAN);
    for (size_t i = 0; i < apis; i++) {
        values_under(v, "setups[%zu].answers[%zu].", k, i);
        want_answer(v, c, format, mapping, api_of(c, i));
    }
    for (size_t i = 0; i < map_count(c) * apis; i++) {
        const shadow_cascade map = map_of(c, format, mapping, (int)(i / apis));
        values_under(v, "setups[%zu].rows[%zu].", k, i);
        want_row(v, c, &map, (int)(i / apis), api_of(c, i % apis));
    }
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* Four digits, of a gap three. */
static bool enough(double shown, double value, const char *field) {
    const double step = strstr(field, "gap") != NULL ? 0.0101 : 0.00101;
    return fabs(shown) >= fabs(value) * (1 - 1e-12) && fabs(shown) <= fabs(value) * (1 + step);
}

static double field_of(const values *v, size_t setup, size_t row, const char *field) {
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "setups[%zu].rows[%zu].%s", setup, row, field);
    return value_at(v, path)->number;
}

/* The row of eight numbers below "units     gap". */
static void check_bias_line(const values *v, const char *line, size_t setup, size_t row, bool split) {
    static const char *const fields[] = {"constant_units", "constant_gap",  "slope_factor", "slope_units",
                                         "slope_gap",      "normal_texels", "normal_units", "normal_gap"};
    char *end;
    if (split) {
        assert_int_equal(strtol(line, &end, 10), (long)row + 1);
        line = end;
    }
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++) {
        const double want = field_of(v, setup, row, fields[k]);
        line += strspn(line, " ");
        if (!isfinite(want)) {
            assert_int_equal(*line, '-');
            line += strcspn(line, " \n");
            continue;
        }
        const double shown = strtod(line, &end);
        if (end == line || !enough(shown, want, fields[k]) || (shown < 0) != (want < 0))
            fail_msg("%s %.17g in '%.80s'", fields[k], want, line);
        line = end;
    }
}

static void check_place_line(const values *v, const char *line, size_t setup, size_t row) {
    static const char *const fields[] = {"from", "to", "texel_size", "width", "depth"};
    char *end;
    assert_int_equal(strtol(line, &end, 10), (long)row + 1);
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++)
        assert_relative(strtod(end, &end), field_of(v, setup, row, fields[k]), k < 2 ? 5e-6 : 5e-4);
}

static const char *line_behind(const char *text, int lines) {
    for (; lines > 0; lines--)
        text = strchr(text, '\n') + 1;
    return text;
}

/* The text behind a label, its lines joined. */
static void note_of(const char *at, const char *label, char out[512]) {
    size_t used = 0;
    const char *line = strstr(at, label);
    assert_non_null(line);
    line += strlen(label);
    do {
        line += strspn(line, " ");
        const size_t length = strcspn(line, "\n");
        assert_true(used + length + 2 < 512);
        memcpy(out + used, line, length);
        used += length;
        out[used++] = ' ';
        line += length + 1;
    } while (strncmp(line, "                ", 16) == 0);
    out[used] = '\0';
}

/* The first three in a text; NaN for a dash. */
static void three_numbers(const char *text, double out[3]) {
    for (int k = 0; k < 3; k++) {
        char *end;
        text += strcspn(text, "0123456789-");
        out[k] = *text == '-' ? NAN : strtod(text, &end);
        text = *text == '-' ? text + 1 : end;
    }
}

/* Shares are those of the map that has the least of the constant bias; gaps the largest. */
static void check_notes(const values *v, const shadow_case *c, const char *at, size_t setup) {
    static const char *const shares[] = {"constant_share", "slope_share", "normal_share"};
    static const char *const gaps[] = {"constant_gap", "slope_gap_facing", "normal_gap_facing"};
    double share[3] = {INFINITY, INFINITY, INFINITY}, gap[3] = {0}, sum = 0;
    double shown[3];
    char text[512], path[64];
    size_t least = 0;
    for (size_t i = 0; i < map_count(c); i++)
        for (int k = 0; k < 3; k++) {
            const double value = field_of(v, setup, i, shares[k]);
            least = k == 0 && value < share[0] ? i : least;
            share[k] = fmin(share[k], value);
            gap[k] = fmax(gap[k], field_of(v, setup, i, gaps[k]));
        }
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++) {
        snprintf(path, sizeof path, "causes.%s", shadow_cause_name((shadow_cause)k));
        sum += field_of(v, setup, least, path);
    }
    note_of(at, "\n  causes ", text);
    if (map_count(c) > 1)
        assert_int_equal(strtol(strstr(text, "cascade ") + 8, NULL, 10), (long)least + 1);
    for (int k = 0; k < SHADOW_CAUSE_COUNT; k++) {
        const char *const name = shadow_cause_name((shadow_cause)k), *const found = strstr(text, name);
        snprintf(path, sizeof path, "causes.%s", name);
        const double percent = 100 * field_of(v, setup, least, path) / sum;
        assert_int_equal(found != NULL, percent >= 0.05);
        if (found != NULL)
            assert_relative(strtod(found + strlen(name), NULL), percent, 0.006);
    }
    note_of(at, "\n  needed ", text);
    three_numbers(text, shown);
    for (int k = 0; k < 3; k++)
        assert_true(isinf(share[k]) ? isnan(shown[k]) : shown[k] <= 100 * share[k] && shown[k] > 90 * share[k]);
    note_of(at, "\n  gap ", text);
    three_numbers(text, shown);
    for (int k = 0; k < 3; k++)
        assert_true(gap[k] == 0 ? isnan(shown[k]) : enough(shown[k], gap[k], "gap"));
}

/* The words about this set-up alone, in one line. */
static void joined(const char *at, char out[4096]) {
    const char *const next = strstr(at, "\nNo acne");
    size_t used = 0;
    for (const char *end = next != NULL ? next : at + strlen(at); at < end && used + 1 < 4096; at++)
        if (strchr(" \n", *at) == NULL || (used > 0 && out[used - 1] != ' '))
            out[used++] = *at == '\n' ? ' ' : *at;
    out[used] = '\0';
}

/* Where gaps are wider than is needed, and as deep as the box. */
static void check_remarks(const values *v, const shadow_case *c, const char *at, size_t setup) {
    static const char *const gaps[] = {"constant_gap", "slope_gap", "normal_gap"};
    double wide = 1;
    bool hidden = false, none = false,
         beyond = false; /* no units of the constant bias; for it is deeper than the box */
    char text[4096];
    for (size_t i = 0; i < map_count(c); i++) {
        const double depth = field_of(v, setup, i, "depth");
        const double bias = field_of(v, setup, i, "constant_bias");
        none = none || isnan(field_of(v, setup, i, "constant_units"));
        beyond = beyond || bias >= 1;
        wide = fmax(wide, field_of(v, setup, i, gaps[0]) / (bias * depth));
        for (int k = 0; k < 3; k++)
            hidden = hidden || beyond || field_of(v, setup, i, gaps[k]) >= depth;
    }
    joined(at, text);
    assert_int_equal(strstr(text, "nothing is in shadow") != NULL, hidden);
    const bool grows = strncmp(c->api, "vulkan-", 7) != 0 && strcmp(c->formats[setup / c->mapping_count], "fp32") == 0;
    assert_int_equal(strstr(text, "have no effect at window depth 0") != NULL, none && !beyond && grows);
    const char *const times = strstr(text, "the gap is up to ");
    assert_int_equal(times != NULL, wide > 1.5);
    if (times != NULL) {
        const double shown = strtod(times + 17, NULL);
        assert_true(shown >= wide && shown <= 1.101 * wide); /* two digits */
    }
}

/* A line for each API with what is enough in all maps. */
static void check_apis(const values *v, const shadow_case *c) {
    static const char *const fields[] = {"constant_units", "slope_factor", "slope_units", "normal_texels",
                                         "normal_units"};
    printed p = print_of("%s", c->line);
    const char *at = strstr(p.out, "\napi ");
    for (size_t i = 0; i < APIS; i++) {
        assert_non_null(at);
        at = strchr(at + 1, '\n');
        const char *const name = bias_api_get(i)->name;
        assert_int_equal(strncmp(at + 1, name, strlen(name)), 0);
        char *end = (char *)at + 1 + strlen(name);
        for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++) {
            char path[PATH_SIZE];
            snprintf(path, sizeof path, "setups[0].answers[%zu].%s", i, fields[k]);
            assert_true(enough(strtod(end, &end), value_at(v, path)->number, fields[k]));
        }
    }
    printed_free(&p);
}

static void check_text(const values *v, const shadow_case *c) {
    printed p = print_of("%s", c->line);
    const bool split = c->box[2] == 0;
    const char *at = p.out;
    assert_int_equal(p.status, 0);
    for (size_t k = 0; k < setup_count(c); k++) {
        for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
            char path[PATH_SIZE];
            snprintf(path, sizeof path, "setups[%zu].answers[0].%s_call", k, ways[way]);
            const wanted *call = value_at(v, path);
            const size_t first = strcspn(call->text, ","); /* the line may break behind it */
            at = strstr(at, shadow_way_name((shadow_way)way)) + 14;
            snprintf(path, sizeof path, "setups[%zu].answers[0].slope_factor", k);
            const bool none = way == SHADOW_SLOPE && isnan(value_at(v, path)->number); /* no factor, so no units */
            if (call->is_null)
                assert_int_equal(strncmp(at, none ? "no bias suffices:" : "no bias suffices\n", 17), 0);
            else
                assert_int_equal(strncmp(at, call->text, first), 0);
        }
        if (!split) {
            char texel[64];
            snprintf(texel, sizeof texel, ", texel %.4g\n", fmax(c->box[0] / c->width, c->box[1] / c->height));
            assert_non_null(strstr(p.out, texel));
        } else {
            at = strstr(at, " cascade       from         to      texel        box      depth\n");
            assert_non_null(at);
            for (size_t i = 0; i < map_count(c); i++)
                check_place_line(v, line_behind(at, (int)i + 1), k, i);
        }
        at = strstr(at, "units     gap  factor    units     gap  offset    units     gap\n");
        assert_non_null(at);
        for (size_t i = 0; i < map_count(c); i++)
            check_bias_line(v, line_behind(at, (int)i + 1), k, i, split);
        check_notes(v, c, at, k);
        check_remarks(v, c, at, k);
    }
    printed_free(&p);
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

#define WAY(name)                                                                                                      \
    name "_bias, " name "_units, " name "_gap [scene], " name "_gap_normal [scene], " name "_share, ?" name            \
         "_gap_facing [scene], "
static const char columns[] =
    "format = ^format, mapping = ^mapping, api, ?cascade, ?from [scene], ?to [scene], ?radius [scene], width [scene], "
    "height [scene], depth [scene], texel_size [scene], "
    /* of each way */
    WAY("constant") "slope_factor, " WAY("slope") "normal_offset [scene], normal_texels, " WAY("normal")
    /* and of all */
    "limited, texel [scene] = causes.texel, kernel [scene] = causes.kernel, lookup [scene] = causes.lookup, "
    "snapping [scene] = causes.snapping, set-up [scene] = causes.set-up, position [scene] = causes.position, "
    "receiver [scene] = causes.receiver, format [scene] = causes.format";

TEST(each_number) {
    for (size_t i = 0; i < CASES; i++) {
        const shadow_case c = case_of(i);
        values v = values_of(c.line);
        want_head(&v, &c);
        for (size_t k = 0; k < setup_count(&c); k++)
            want_setup_of(&v, &c, k);
        check_forms(&v, 0, c.line, "setups[].rows[]", columns);
        (c.api != NULL ? check_text : check_apis)(&v, &c);
        values_free(&v);
    }
}

/* Where nobody says where the camera's depth ends, it ends where the view does. */
TEST(camera_depth_of_the_view) {
    json_t *all[2];
    for (int i = 0; i < 2; i++)
        all[i] = json_printed(0, "shadow -f 300 --cascades 2 --camera-depth d16:reversed%s", i == 0 ? "" : ":300");
    assert_true(json_equal(node_at(all[0], "setups"), node_at(all[1], "setups")));
    json_decref(all[0]);
    json_decref(all[1]);
    check_says(2, "FAR must be at least --far", "shadow -f 300 --camera-depth d16:reversed:299");
}

/* Of several maps an engine's bias is what it is in the worst: acne begins next to where it ends being free of it, and
 * the least that is told is enough in all of them, a hundredth less is not. */
TEST(engines_of_cascades) {
    static const char line[] = "shadow -f 300 --cascades 3 --engine three";
    for (int i = 1; i <= 3; i++) {
        json_t *root = json_printed(0, "%s --bias=%g", line, -5e-4 * i);
        const json_t *row = node_at(root, "setups[0].engines[0]");
        const double free_to = number_at(row, "free_to"), acne = number_at(row, "acne_from");
        if (!(acne > free_to && acne < free_to + 2) || flag_at(row, "enough"))
            fail_msg("%d: free to %g, acne from %g", i, free_to, acne);
        for (int k = 0; k < 4; k++) {
            const double share = k % 2 == 0 ? 1 : 0.99;
            json_t *other = k < 2 ? json_printed(0, "%s --bias=%.17g", line, share * number_at(row, "least_bias"))
                                  : json_printed(0, "%s --bias=%g --normal-bias %.17g", line, -5e-4 * i,
                                                 share * number_at(row, "least_normal"));
            assert_int_equal(flag_at(other, "setups[0].engines[0].enough"), share == 1);
            json_decref(other);
        }
        json_decref(root);
    }
}

LIST_TEST(check_apart)

/*
 * Where a unit of bias is worth nothing at window depth 0 light begins twice the way of a constant bias from there, or
 * 1/256 of the box where that is more; not where that would be half of the box, and not in unorm formats.
 */
TEST(light_keeps_off_zero) {
    static const double widths[] = {0.25, 0.75, 4, 8, 20, 40, 80, 90, 100, 110, 130, 200, 400};
    tally t = {.name = "lit"};
    int seen[3] = {0};
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++)
        for (int k = 0; k < 4; k++) {
            const char *const format = k % 2 == 0 ? "fp32" : "unorm24", *const mapping = k < 2 ? "d3d" : "reversed";
            const double depth = 64;
            json_t *root = json_printed(0, "shadow --light-box %gx%gx%g --size 64x64 -F %s -m %s --api d3d11",
                                        widths[i], widths[i], depth, format, mapping);
            const double from = number_at(root, "setups[0].lit_from"), to = number_at(root, "setups[0].lit_to");
            const double covered = 2 * depth * number_at(root, "setups[0].rows[0].constant_bias");
            const int way = k % 2 != 0 || covered >= depth / 2 ? 0 : covered > depth / 256 ? 1 : 2;
            const double away = way == 0 ? 0 : way == 1 ? covered : depth / 256;
            seen[way]++;
            TALLY(&t, k < 2 ? to == depth : from == 0, "%g, %s %s: from %g to %g", widths[i], format, mapping, from,
                  to);
            TALLY(&t, fabs((k < 2 ? from : depth - to) - away) <= 1e-9 * depth, "%g, %s %s: from %g to %g, not %g away",
                  widths[i], format, mapping, from, to, away);
            json_decref(root);
        }
    assert_true(seen[0] >= 24 && seen[1] >= 4 && seen[2] >= 1);
    tally_end(&t);
}

/* The largest cause says what helps. */
TEST(why) {
    static const char *const rows[][2] = {
        {"", "why           steep receivers"},
        {"--from-origin 1e6", "why           positions in binary32"},
        {"--kernel 1 --angle 10 --size 16384", "why           codes of the format"},
        {"--from-origin 1e6 ", "no bias suffices: the smallest triangles may lose half"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_says(0, rows[i][1], "shadow --light-box 40x40x%s -F d16 %s", i == 2 ? "1000" : "100", rows[i][0]);
}

/* Window depth of the sun's box, DEEP long, that a unit of an engine's bias is worth, by the engines' shaders. */
enum { DEEP = 100 };
static const struct {
    const char *name;
    double standard, worth;
} biased[] = {{"three", 0, -1}, {"bevy", 0.02, 1.0 / DEEP}, {"babylon", 0.00005, 0.5}, {"godot", 0.1, 0.01 / DEEP}};
enum { BIASED = sizeof biased / sizeof biased[0] };

/* The numbers are those of the engine that is named first; every other one is told what does the same. */
TEST(numbers_of_the_first_engine) {
    rng r = rng_make("first engine");
    tally t = {.name = "numbers"};
    for (uint64_t n = test_cases(10, 24, 1000); n > 0; n--) {
        size_t order[BIASED];
        char names[96] = "", asked[48] = "";
        for (size_t i = 0; i < BIASED; i++) { /* any order */
            const size_t k = (size_t)rng_below(&r, i + 1);
            order[i] = order[k];
            order[k] = i;
        }
        const size_t count = 2 + (size_t)rng_below(&r, BIASED - 1), first = order[0];
        for (size_t i = 0; i < count; i++)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? "," : "",
                     biased[order[i]].name);
        const double drawn = rng_log(&r, 1e-5, 1e-2) / biased[first].worth;
        const bool given_one = rng_below(&r, 4) != 0;
        const double bias = given_one ? drawn : biased[first].standard;
        if (given_one)
            snprintf(asked, sizeof asked, "--bias=%.17g", bias);
        json_t *root =
            json_printed(0, "shadow --light-box 40x40x%d -F d24 --engine %s %s --normal-bias 0", DEEP, names, asked);
        bool told[BIASED] = {false};
        for (size_t i = 0; i < count; i++) {
            const char *const name = text_at(root, "setups[0].engines[%zu].engine", i);
            const double is = number_at(root, "setups[0].engines[%zu].bias", i);
            size_t k = 0;
            while (k < BIASED - 1 && strcmp(biased[k].name, name) != 0)
                k++;
            const double ought = bias * biased[first].worth / biased[k].worth;
            TALLY(&t, i > 0 ? !told[k] : k == first, "%s, %s: %s is engine %zu", names, asked, name, i);
            TALLY(&t, fabs(is - ought) <= 1e-9 * fabs(ought), "%s, %s: %s has %g, not %g", names, asked, name, is,
                  ought);
            told[k] = true;
        }
        json_decref(root);
    }
    tally_end(&t);
}

/* A 0 is as long in any unit, and needs none beside lengths that have one. */
TEST(a_zero_needs_no_unit) {
    check_says(0, "fp32 d3d", "shadow --light-box 20x20x100 --range 0:50m");
    check_says(2, "must have a unit in all places or in none", "shadow --light-box 20x20x100 --range 1:50m");
}
