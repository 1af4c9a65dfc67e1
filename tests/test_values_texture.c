/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that texture prints of a scene and of an image. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "frame/recognise.h"
#include "frame/survey.h"
#include "named.h"
#include "shader/decode.h"
#include "views.h"

enum { WIDTH = 40, HEIGHT = 24 };

typedef struct texture_case {
    camera_case camera;
    const char *synthetic, *options, *format_from, *mapping_from, *direction_from;
    double fov, half_height, yaw, pitch, origin[3], sky;
    struct {
        const char *name;
        double number;
    } parameters[3];
} texture_case;

static const texture_case scenes[] = {
    {{0.3, 1000, {"unorm16"}, {"d3d"}, .unit = "cm"},
     "decals",
     "--fov 40 --eye 1,-2,3 --look 107.73322205178,-55.775093275305,608.31418177148 --sky 0.001",
     "given",
     "given",
     "given",
     40,
     NAN,
     10,
     -5,
     {1, -2, 3},
     0.001,
     {{"gap", 0.02}, {"count", 7}}},
    {{0.2, 500, {"unorm24"}, {"reversed"}, .rounding = DP_ROUND_ZERO},
     "plane",
     "",
     "given",
     "given",
     "given",
     60,
     NAN,
     0,
     0,
     {0, 0, 0},
     1e-4,
     {{"distance", 9}, {"tilt", 82}}},
    {{0.3, INFINITY, {"fp32"}, {"reversed"}, .ortho = 0},
     "sphere",
     "",
     "given",
     "given",
     "given",
     60,
     NAN,
     0,
     0,
     {0, 0, 0},
     1e-4,
     {{"radius", 4}}},
    {{1, 60, {"fp16"}, {"gl"}, .ortho = 1, .half = 3},
     "sphere",
     "",
     "given",
     "given",
     "given",
     NAN,
     3,
     0,
     0,
     {0, 0, 0},
     1e-4,
     {{"radius", 4}}},
};

/* ---- Statistics -------------------------------------------------------------------------------------------------- */

static void want_errors(values *v, size_t i, const char *name, const char *unit, uint64_t pixels,
                        const frame_summary *s) {
    values_under(v, "errors[%zu].", i);
    want_count(v, "masked", pixels - s->count - s->infinite);
    want_text(v, "name", name);
    want_text(v, "unit", unit);
    want_count(v, "pixels", s->count);
    want_count(v, "unbounded", s->infinite);
    want_number(v, "mean", s->mean);
    want_number(v, "p99", s->p99);
    want_number(v, "max", s->hi);
    want_count(v, "column", s->hi_column);
    want_count(v, "row", s->hi_row);
}

static uint64_t pixels_of(const frame *f) {
    return (uint64_t)f->camera->width * f->camera->height;
}

static size_t want_product(values *v, const frame *f, size_t i, const char *name, const char *unit,
                           const frame_product *p) {
    frame_summary s;
    if (frame_refuses(f, p) != NULL)
        return i;
    assert_true(frame_summarise(f, p, &s));
    want_errors(v, i, name, unit, pixels_of(f), &s);
    return i + 1;
}

/* What a decoding in binary32 adds to what is stored, over the pixels that are not sky. */
static size_t want_decoding(values *v, const frame *f, size_t i, const decode_row *row) {
    const dp_setup *setup = &f->camera->setup;
    uint32_t codes[WIDTH];
    char name[64];
    frame_summary s = {.p99 = NAN, .hi = -1};
    if (!decode_applies(row, setup))
        return i;
    for (uint32_t y = 0; y < f->camera->height; y++) {
        double sum = 0; /* of a row: the order of the sums is part of their last digits */
        frame_codes(f, y, codes);
        for (uint32_t x = 0; x < f->camera->width; x++) {
            if (codes[x] == UINT32_MAX || frame_rank(setup, codes[x]) >= frame_sky_rank(f))
                continue;
            const float d = (float)dp_format_value(&setup->spec.format, codes[x]);
            const double want = decode_exact(setup, row->quantity, (double)d);
            float got;
            decode_run(row, setup, &d, &got, 1);
            const double off = want == (double)got ? 0 : fabs(((double)got - want) / want);
            if (!isfinite(off)) {
                s.infinite++;
                continue;
            }
            s.count++;
            sum += off;
            if (off > s.hi) {
                s.hi = off;
                s.hi_column = x;
                s.hi_row = y;
            }
        }
        s.mean += sum;
    }
    s.mean /= (double)s.count;
    snprintf(name, sizeof name, "decode %s", row->name);
    want_errors(v, i, name, "relative", pixels_of(f), &s);
    return i + 1;
}

static size_t want_all_errors(values *v, const frame *f) {
    frame_product p = {.kind = FRAME_EYE, .error = true};
    char name[64];
    size_t n = want_product(v, f, 0, "eye depth", "scene units", &p);
    for (size_t i = 0; decode_get(i) != NULL; i++)
        n = want_decoding(v, f, n, decode_get(i));
    p.kind = FRAME_POSITION;
    for (size_t i = 0; f->synthetic != NULL && (p.position = position_get(i)) != NULL; i++) {
        snprintf(name, sizeof name, "position %s", p.position->name);
        n = want_product(v, f, n, name, "scene units", &p);
    }
    p.kind = FRAME_NORMAL;
    for (size_t i = 0; f->synthetic != NULL && (p.normal = normal_get(i)) != NULL; i++) {
        snprintf(name, sizeof name, "normal %s", p.normal->name);
        n = want_product(v, f, n, name, "degrees", &p);
    }
    return n;
}

/* Pixels that show something and count as sky. */
static uint64_t hidden_by_sky(const frame *f) {
    uint64_t count = 0;
    uint32_t codes[WIDTH];
    for (uint32_t y = 0; y < f->camera->height; y++) {
        frame_codes(f, y, codes);
        for (uint32_t x = 0; x < f->camera->width; x++) {
            synthetic_hit hit;
            f->synthetic->hit(f->camera, f->parameters, x, y, &hit);
            count += hit.surface != 0 && frame_rank(&f->camera->setup, codes[x]) >= frame_sky_rank(f);
        }
    }
    return count;
}

static void want_survey(values *v, const frame *f, uint64_t invalid, line_places *lines) {
    static survey s;
    assert_true(survey_make(f, &s));
    values_under(v, "%s", "");
    want_count(v, "pixels", pixels_of(f));
    want_count(v, "invalid", invalid);
    want_number(v, "lo", s.lo);
    want_number(v, "hi", s.hi);
    want_count(v, "codes", s.codes);
    want_derived(v, "sky_share", 100 * (double)s.sky / (double)s.pixels);
    values_under(v, "sky.");
    want_count(v, "pixels", s.sky);
    want_number(v, "limit", f->sky);
    want_number(v, "from", s.sky_from);
    if (f->synthetic != NULL)
        want_count(v, "hidden", hidden_by_sky(f));
    for (size_t i = 0; i < s.band_count; i++) {
        const survey_band *b = &s.bands[i];
        values_under(v, "bands[%zu].", i);
        want_number(v, "lo", b->lo);
        want_number(v, "hi", b->hi);
        want_count(v, "pixels", b->pixels);
        want_count(v, "codes", b->codes);
        want_count(v, "available", b->available);
        want_number(v, "gap", b->gap);
        want_number(v, "gap_z", b->gap_z);
        want_count(v, "steps", b->steps);
        want_number(v, "interval", b->interval);
        want_derived(v, "steps_shown", b->steps > 0 ? (double)b->steps : NAN);
        place_add(lines, "", "bands[%zu].", i);
    }
}

static void want_pairs(values *v, const frame *f) {
    survey_pairs p;
    values_under(v, "%s", "");
    if (f->synthetic == NULL || !survey_pairs_make(f, &p)) {
        want_text(v, "pairs", NULL);
        return;
    }
    values_under(v, "pairs.");
    want_count(v, "count", p.pairs);
    want_count(v, "ties", p.ties);
    want_count(v, "possible", p.possible);
    want_number(v, "first_tie", p.first_tie);
    want_number(v, "certain_to", p.certain_to);
}

/* By hand, and rounded to binary32; null where Unity has no such helper. */
static void want_zbuffer(values *v, const dp_setup *setup) {
    const dp_mapping mapping = setup->spec.mapping;
    const long double n = (long double)setup->spec.znear, f = (long double)setup->spec.zfar;
    const bool reversed = mapping == DP_MAPPING_REVERSED || mapping == DP_MAPPING_GL_REVERSED;
    if (setup->spec.ortho || isinf(setup->spec.zfar) || mapping == DP_MAPPING_LINEAR || mapping == DP_MAPPING_LOG) {
        want_text(v, "zbuffer_params", NULL);
        return;
    }
    const long double x = reversed ? f / n - 1 : 1 - f / n, y = reversed ? 1 : f / n;
    values_under(v, "zbuffer_params.");
    want_number(v, "x", (double)(float)x);
    want_number(v, "y", (double)(float)y);
    want_number(v, "z", (double)(float)(x / f));
    want_number(v, "w", (double)(float)(y / f));
    values_under(v, "%s", "");
}

static void want_camera(values *v, const texture_case *c, const frame *f) {
    values_under(v, "%s", "");
    want_setup(v, &f->camera->setup);
    want_zbuffer(v, &f->camera->setup);
    want_count(v, "width", f->camera->width);
    want_count(v, "height", f->camera->height);
    want_text(v, "format_from", c->format_from);
    want_text(v, "mapping_from", c->mapping_from);
    want_text(v, "direction_from", c->direction_from);
    want_number(v, "fov", c->fov);
    want_number(v, "half_height", c->half_height);
    want_number(v, "condition", position_condition(f->camera));
    want_text(v, "truth", f->synthetic != NULL ? "synthetic" : NULL);
}

static const csv_column band_columns[] = {
    SETUP_COLUMNS,      {"from [scene]", "lo"},          {"to [scene]", "hi"},   {"pixels", "pixels"},
    {"codes", "codes"}, {"available", "available"},      {"gap [scene]", "gap"}, {"gap_z [scene]", "gap_z"},
    {"steps", "steps"}, {"interval [scene]", "interval"}};

/* What 99 % do not exceed, and what none does: not less than it is. Unbounded errors and decodings have no such. */
static void check_upwards(const values *v, const char *line, char at[][PATH_SIZE]) {
    for (int k = 0; k < 3; k++) {
        char word[64];
        int used = 0;
        assert_int_equal(sscanf(line, " %63s%n", word, &used), 1);
        line += used;
        if (k > 0 && strcmp(word, "-") != 0)
            assert_true(strtod(word, NULL) >= value_at(v, at[k])->number);
    }
}

static void check_text(const values *v, const char *arguments, size_t errors, const line_places *lines) {
    static const text_column bands[] = {{"lo", 6},     {"hi", 6},           {"pixels", 10},
                                        {"codes", 10}, {"available", 10},   {"gap", 6},
                                        {"gap_z", 6},  {"steps_shown", 10}, {"interval", 6}};
    static const char *const sky[] = {"sky.pixels", "sky_share", "sky.from", "sky.limit", NULL};
    static const char *const depths[] = {"lo", "hi", "codes", NULL}, *const condition[] = {"condition", NULL};
    static const char *const zbuffer[] = {"zbuffer_params.x", "zbuffer_params.y", "zbuffer_params.z",
                                          "zbuffer_params.w", NULL};
    static const char *const pairs[] = {"pairs.count", "pairs.ties", "pairs.first_tie", NULL};
    static const char *const certain[] = {"pairs.possible", "pairs.certain_to", NULL};
    static const char *const fields[] = {"mean", "p99", "max", "column", "row"};
    printed p = print_of("%s --full", arguments);
    check_text_numbers(v, p.out, "sky  ", 3, sky);
    check_text_numbers(v, p.out, "depths  ", 8, depths);
    check_text_table(v, p.out, bands, sizeof bands / sizeof bands[0], lines);
    check_text_numbers(v, p.out, "condition  ", 4, condition);
    if (value_find(v, zbuffer[0]) != NULL)
        check_text_numbers(v, p.out, "in Unity  ", 9, zbuffer);
    else
        assert_null(strstr(p.out, "_ZBufferParams"));
    if (strstr(p.out, "  pairs  ") != NULL) {
        const char *rest = strstr(strstr(p.out, "  pairs  "), "\n");
        check_text_numbers(v, p.out, "pairs  ", 6, pairs);
        check_text_numbers(v, rest + 1, "", 6, certain);
        const char *words = strstr(rest, "up to z ="); /* where pairs cannot fight: not farther than it is */
        if (words != NULL)
            assert_true(strtod(words + strlen("up to z ="), NULL) <= value_at(v, "pairs.certain_to")->number);
    }
    for (size_t i = 0; i < errors; i++) {
        char at[5][PATH_SIZE], label[64];
        const char *paths[6] = {at[0], at[1], at[2], at[3], at[4], NULL};
        snprintf(at[0], PATH_SIZE, "errors[%zu].name", i);
        snprintf(label, sizeof label, "%-24.60s", value_at(v, at[0])->text);
        for (size_t k = 0; k < 5; k++)
            snprintf(at[k], PATH_SIZE, "errors[%zu].%s", i, fields[k]);
        check_text_numbers(v, p.out, label, 4, paths);
        check_upwards(v, strstr(p.out, label) + strlen(label), at);
    }
    printed_free(&p);
}

static void check_forms(values *v, const char *arguments, size_t errors, line_places *lines) {
    check_json(v, 0, arguments);
    for (size_t i = 0; i < lines->count; i++)
        lines->items[i].outer[0] = '\0'; /* the set-up stands at the top */
    check_csv(v, 0, arguments, band_columns, sizeof band_columns / sizeof band_columns[0], lines);
    check_text(v, arguments, errors, lines);
}

/* The scene's own, but for those of the case; their options behind the others. */
static void want_parameters(values *v, const texture_case *c, const synthetic_row *synthetic, double *parameters,
                            char options[256]) {
    parameter_defaults(synthetic->parameters, parameters);
    options[0] = '\0';
    for (size_t i = 0; i < PARAMETERS_MAX && synthetic->parameters[i].name != NULL; i++) {
        const char *name = synthetic->parameters[i].name;
        for (size_t k = 0; k < 3 && c->parameters[k].name != NULL; k++)
            if (strcmp(c->parameters[k].name, name) == 0) {
                parameters[i] = c->parameters[k].number;
                snprintf(options + strlen(options), 256 - strlen(options), " --parameter %s=%.17g", name,
                         parameters[i]);
            }
        values_under(v, "parameters[%zu].", i);
        want_text(v, "name", name);
        want_number(v, "value", parameters[i]);
    }
}

static void test_synthetic(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const texture_case *c = &scenes[i];
        texture_camera camera;
        double parameters[PARAMETERS_MAX];
        char options[512], more[256], arguments[1024];
        line_places lines = {0};
        values v = values_of("texture");
        v.unit = c->camera.unit;
        camera = view_placed(&c->camera, WIDTH, HEIGHT, c->fov, c->half_height, c->yaw, c->pitch, c->origin);
        want_parameters(&v, c, synthetic_find(c->synthetic), parameters, more);
        const frame f = {
            .camera = &camera, .synthetic = synthetic_find(c->synthetic), .parameters = parameters, .sky = c->sky};
        values_under(&v, "%s", "");
        want_text(&v, "file", NULL);
        want_text(&v, "synthetic", c->synthetic);
        want_camera(&v, c, &f);
        want_survey(&v, &f, 0, &lines);
        want_pairs(&v, &f);
        snprintf(arguments, sizeof arguments, "texture --synthetic %s --size %dx%d %s %s%s", c->synthetic, WIDTH,
                 HEIGHT, camera_options(&c->camera, options), c->options, more);
        check_forms(&v, arguments, want_all_errors(&v, &f), &lines);
        values_free(&v);
        places_free(&lines);
    }
}

/* ---- Images ------------------------------------------------------------------------------------------------------ */

enum { COLUMNS = 20, ROWS = 12 };

/* Where the sky is 0 in the quarter of the codes beside it, or in nearly half of them. */
static uint32_t sample_at(uint32_t i, uint32_t sky, uint32_t spread) {
    return i % 9 == 4 ? sky : sky == 0 ? 7 + 31 * i * i % spread : 65528 - 31 * i * i % spread;
}

/* An npy file of binary32 or 16-bit samples of unorm16 codes, near and far, with sky and holes. @return the holes */
static uint64_t write_image(const char *path, bool floats, bool damaged, uint32_t sky, uint32_t spread) {
    char header[128];
    uint64_t holes = 0;
    const uint32_t length = 118;
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    snprintf(header, sizeof header, "{'descr': '<%s', 'fortran_order': False, 'shape': (%d, %d), }",
             floats ? "f4" : "u2", ROWS, COLUMNS);
    fwrite("\x93NUMPY\x01\x00", 1, 8, out);
    fputc((int)length, out);
    fputc(0, out);
    fprintf(out, "%-117s\n", header);
    for (uint32_t i = 0; i < ROWS * COLUMNS; i++) {
        const uint32_t code = sample_at(i, sky, spread);
        const uint16_t small = (uint16_t)code;
        float d = (float)((double)code / 65535);
        if (damaged && i % 25 == 3) {
            d = i % 2 == 0 ? (float)NAN : i % 3 == 0 ? 1.5f : -1e-3f;
            holes++;
        }
        if (floats)
            fwrite(&d, sizeof d, 1, out);
        else
            fwrite(&small, sizeof small, 1, out);
    }
    assert_int_equal(fclose(out), 0);
    return floats ? holes : 0;
}

static void want_image(values *v, const char *path, const image *shot, const recognised *found) {
    values_under(v, "%s", "");
    want_text(v, "file", path);
    want_text(v, "synthetic", NULL);
    want_text(v, "type", image_type_name(shot->type));
    want_count(v, "channels", 1);
    want_text(v, "packing", NULL); /* test_packing has it otherwise */
    want_text(v, "lossy", NULL);   /* and test_image_compressed this */
    values_under(v, "sky.");
    want_count(v, "zeros", 0); /* of packings, in test_packing */
    values_under(v, "recognised.");
    want_text(v, "format", found->depth ? found->format.name : NULL);
    want_bool(v, "certain", found->certain);
    if (found->direction)
        want_bool(v, "reversed", found->reversed);
    else
        want_text(v, "reversed", NULL);
    want_text(v, "why", found->why);
}

/* The step in scene units is that of metric depth, which these are not. */
static void want_samples(values *v, const grain *g, bool coarser) {
    values_under(v, "%s", "");
    want_number(v, "metric", NAN);
    values_under(v, "samples.");
    want_number(v, "step", NAN);
    want_number(v, "steps", g->kind == GRAIN_STEPS ? g->steps : NAN);
    want_number(v, "steps_or", NAN); /* test_image_truth has what is shifted up */
    want_number(v, "bits", g->kind == GRAIN_FLOATS ? g->bits : NAN);
    want_bool(v, "coarser", coarser);
    want_text(v, "rounded",
              g->kind == GRAIN_CODES         ? NULL
              : g->rounding == GRAIN_ANY     ? "unknown"
              : g->rounding == GRAIN_NEAREST ? "nearest"
                                             : "zero");
}

static const struct {
    texture_case asked;
    bool floats, damaged;
    uint32_t sky, spread;
    const char *given; /* on the command line, in place of what is found */
    grain samples;
    bool coarser;
} images[] = {
    {{{0.3, 700, {"unorm16"}, {"reversed"}, .ortho = 0},
      NULL,
      "-n 0.3 -f 700 --sky 0.0002",
      "found",
      "assumed",
      "assumed",
      60,
      NAN,
      0,
      0,
      {0, 0, 0},
      2e-4,
      {{NULL, 0}}},
     true,
     false,
     0,
     30000,
     "",
     {.kind = GRAIN_FLOATS, .buffer = true, .bits = 24, .least = 0x1p-149},
     false},
    {{{0.5, 90, {"unorm24"}, {"gl"}, .ortho = 0},
      NULL,
      "-n 0.5 -f 90 --fov 35",
      "given",
      "given",
      "given",
      35,
      NAN,
      0,
      0,
      {0, 0, 0},
      1e-4,
      {{NULL, 0}}},
     true,
     true,
     65535,
     30000,
     "-F unorm24 -m gl --rounding nearest",
     {.kind = GRAIN_FLOATS, .rounding = GRAIN_NEAREST, .buffer = true, .bits = 24, .least = 0x1p-149},
     false},
    {{{0.5, 90, {"unorm24"}, {"reversed"}, .ortho = 0},
      NULL,
      "-n 0.5 -f 90 --fov 50",
      "given",
      "given",
      "given",
      50,
      NAN,
      0,
      0,
      {0, 0, 0},
      1e-4,
      {{NULL, 0}}},
     true,
     false,
     0,
     30000,
     "-F unorm24 -m reversed",
     {.kind = GRAIN_STEPS, .steps = 65535, .buffer = true, .bits = 24, .least = 0x1p-149},
     true},
    {{{0.5, 90, {"unorm16"}, {"reversed"}, .rounding = DP_ROUND_ZERO},
      NULL,
      "-n 0.5 -f 90",
      "assumed",
      "given",
      "given",
      60,
      NAN,
      0,
      0,
      {0, 0, 0},
      1e-4,
      {{NULL, 0}}},
     false,
     false,
     65535,
     30000,
     "-m reversed --rounding zero",
     {.kind = GRAIN_STEPS, .rounding = GRAIN_ZERO, .steps = 65535, .margin = 0x1p-24, .least = 0x1p-149},
     false},
    {{{0.2, 400, {"unorm16"}, {"reversed"}, .ortho = 0},
      NULL,
      "-n 0.2 -f 400",
      "assumed",
      "assumed",
      "found",
      60,
      NAN,
      0,
      0,
      {0, 0, 0},
      1e-4,
      {{NULL, 0}}},
     false,
     false,
     0,
     16000,
     "",
     {.kind = GRAIN_STEPS, .steps = 65535, .margin = 0x1p-24, .least = 0x1p-149},
     false},
};

/* The pixel nearest to the middle that is neither hole nor sky; at the same distance the one before it. */
static uint32_t pixel_of_readings(size_t at) {
    const uint32_t middle = ROWS / 2 * COLUMNS + COLUMNS / 2;
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < ROWS * COLUMNS; i++) {
        const bool hole = images[at].damaged && i % 25 == 3;
        const uint32_t off = i > middle ? i - middle : middle - i;
        const uint32_t least = best == UINT32_MAX ? UINT32_MAX : best > middle ? best - middle : middle - best;
        best = !hole && i % 9 != 4 && off < least ? i : best;
    }
    return best;
}

static void want_reading(values *v, size_t i, uint32_t pixel, const char *what, const char *name, double z) {
    values_under(v, "readings[%zu].", i);
    want_text(v, "what", what);
    want_text(v, "name", name);
    want_count(v, "column", pixel % COLUMNS);
    want_count(v, "row", pixel / COLUMNS);
    want_number(v, "z", z);
}

static double eye_of(const dp_setup *setup, dp_mapping mapping, double d) {
    dp_setup other;
    dp_spec spec = setup->spec;
    spec.mapping = mapping;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    return dp_eye(&other, d, 1 - d);
}

/* Where a pixel would be with another mapping, where that is only assumed. All integers here go beyond fp16. */
static void want_readings(values *v, size_t at, const dp_setup *setup) {
    static const struct {
        const char *name;
        dp_mapping mapping;
    } curves[] = {{"d3d", DP_MAPPING_D3D},
                  {"reversed", DP_MAPPING_REVERSED},
                  {"linear", DP_MAPPING_LINEAR},
                  {"log", DP_MAPPING_LOG}};
    const texture_case *c = &images[at].asked;
    const uint32_t pixel = pixel_of_readings(at), code = sample_at(pixel, images[at].sky, images[at].spread);
    const double share = (double)code / 65535, d = images[at].floats ? (double)(float)share : share;
    for (size_t i = 0; i < 4 && strcmp(c->mapping_from, "assumed") == 0; i++)
        want_reading(v, i, pixel, "mapping", curves[i].name, eye_of(setup, curves[i].mapping, d));
}

/* The name of the file has a quote and a backslash. */
static void test_images(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof images / sizeof images[0]; i++) {
        const texture_case *c = &images[i].asked;
        texture_camera camera;
        char path[512], arguments[1024];
        image shot;
        image_error error;
        recognised found;
        line_places lines = {0};
        values v = values_of("texture");
        v.unit = c->camera.unit;
        snprintf(path, sizeof path, "%s", scratch_file("a\"b\\c.npy"));
        const uint64_t holes = write_image(path, images[i].floats, images[i].damaged, images[i].sky, images[i].spread);
        assert_true(image_read(path, &shot, &error));
        recognise(&shot, &found);
        camera = view_placed(&c->camera, COLUMNS, ROWS, c->fov, c->half_height, c->yaw, c->pitch, c->origin);
        const frame f = {.camera = &camera, .image = &shot, .grain = &images[i].samples, .sky = c->sky};
        want_image(&v, path, &shot, &found);
        want_samples(&v, &images[i].samples, images[i].coarser);
        want_readings(&v, i, &camera.setup);
        want_camera(&v, c, &f);
        want_survey(&v, &f, holes, &lines);
        want_pairs(&v, &f);
        snprintf(arguments, sizeof arguments, "texture '%s' %s %s", path, c->options, images[i].given);
        check_forms(&v, arguments, want_all_errors(&v, &f), &lines);
        image_free(&shot);
        values_free(&v);
        places_free(&lines);
    }
}

/* Then nothing is off, by no number and at no pixel. */
static void test_nothing_but_sky(void **state) {
    (void)state;
    printed p = print_of("texture --synthetic plane --parameter distance=2000 --size 8x8 -q");
    assert_int_equal(p.status, 0);
    assert_null(strstr(p.out, "inf"));
    assert_null(strstr(p.out, "0,0"));
    assert_non_null(strstr(p.out, "\n  eye depth                       -         -         -  - (scene units)\n"));
    printed_free(&p);
}

/* 8 bits times 256: shares of 65535/256, or of 255. */
static void test_shifted_up(void **state) {
    uint16_t samples[64];
    char path[512];
    (void)state;
    for (unsigned i = 0; i < 64; i++)
        samples[i] = (uint16_t)((7 * i % 256) << 8);
    snprintf(path, sizeof path, "%s", scratch_file("up.npy"));
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    image_writer *w = image_writer_open(file, IMAGE_NPY, IMAGE_U16, 8, 8, 1, NULL);
    assert_non_null(w);
    image_writer_rows(w, samples, 8);
    assert_true(image_writer_close(w) && fclose(file) == 0);
    printed p = print_of("texture %s -n 0.1 -f 100 -F d24 -m d3d --json", path);
    json_t *root = json_of(p.out), *said = json_object_get(root, "samples");
    assert_relative(json_number_value(json_object_get(said, "steps")), 65535.0 / 256.0, 1e-15);
    assert_true(json_number_value(json_object_get(said, "steps_or")) == 255);
    json_decref(root);
    printed_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_but_sky), cmocka_unit_test(test_synthetic), cmocka_unit_test(test_images),
        cmocka_unit_test(test_shifted_up),      cmocka_unit_test(check_apart),
    };
    return run_tap(tests);
}
