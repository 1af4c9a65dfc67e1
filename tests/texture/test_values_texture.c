/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that texture prints of a scene and of an image. */
#include "named.h"
#include "shader/decode.h"
#include "texture/frame.h"
#include "texture/recognise.h"
#include "texture/survey.h"
#include "texture/units.h"
#include "views.h"

enum { WIDTH = 40, HEIGHT = 24 };

typedef struct texture_case {
    const char *line, *format_from, *mapping_from, *direction_from;
    double yaw, pitch;
} texture_case;

#define SCENE "texture --size 40x24 --synthetic "

static const texture_case scenes[] = {
    {SCENE "decals -n 0.3 -f 1000 -F unorm16 -m d3d --unit cm --fov 40 --eye 1,-2,3 "
           "--look 107.73322205178,-55.775093275305,608.31418177148 --sky 0.001 --parameter gap=0.02 "
           "--parameter count=7",
     "given", "given", "given", 10, -5},
    {SCENE "plane -n 0.2 -f 500 -F unorm24 -m reversed --rounding zero --parameter distance=9 --parameter tilt=82",
     "given", "given", "given", 0, 0},
    {SCENE "sphere -n 0.3 -f inf -F fp32 -m reversed --parameter radius=4", "given", "given", "given", 0, 0},
    {SCENE "sphere -n 1 -f 60 -F fp16 -m gl --ortho=3 --parameter radius=4", "given", "given", "given", 0, 0},
};

/* ---- Statistics -------------------------------------------------------------------------------------------------- */

static void want_errors(values *v, size_t i, const char *name, const char *unit, uint64_t pixels,
                        const frame_summary *s) {
    values_under(v, "errors[%zu].", i);
    want(v, "name=%s unit=%s masked=%lu", name, unit, pixels - s->count - s->infinite);
    want(v, "pixels=%lu unbounded=%lu mean=%f p99=%f max=%f", s->count, s->infinite, s->mean, s->p99, s->hi);
    want(v, "column=%u row=%u", s->hi_column, s->hi_row);
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

/* The error that a decoding in binary32 adds to what is stored, over the pixels that are not sky. */
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

static void want_survey(values *v, const frame *f, uint64_t invalid) {
    static survey s;
    assert_true(survey_make(f, &s));
    values_under(v, "%s", "");
    want(v, "pixels=%lu invalid=%lu lo=%f hi=%f codes=%lu", pixels_of(f), invalid, s.lo, s.hi, (uint64_t)s.codes);
    values_under(v, "sky.");
    want(v, "pixels=%lu limit=%f from=%f", (uint64_t)s.sky, f->sky, s.sky_from);
    want(v, "~share=%f", 100 * (double)s.sky / (double)s.pixels);
    if (f->synthetic != NULL)
        want(v, "hidden=%lu", hidden_by_sky(f));
    for (size_t i = 0; i < s.band_count; i++) {
        const survey_band *b = &s.bands[i];
        values_under(v, "bands[%zu].", i);
        want(v, "lo=%f hi=%f pixels=%lu codes=%lu", b->lo, b->hi, (uint64_t)b->pixels, (uint64_t)b->codes);
        want(v, "available=%lu gap=%f gap_z=%f", (uint64_t)b->available, b->gap, b->gap_z);
        want(v, "steps=%lu interval=%f", (uint64_t)b->steps, b->interval);
        want(v, "~steps_shown=%f", b->steps > 0 ? (double)b->steps : NAN);
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
    want(v, "count=%lu ties=%lu possible=%lu", (uint64_t)p.pairs, (uint64_t)p.ties, (uint64_t)p.possible);
    want(v, "first_tie=%f certain_to=%f", p.first_tie, p.certain_to);
}

/* Half the height of an orthographic camera, the field of view of another. */
static void want_camera(values *v, const texture_case *c, const frame *f) {
    const bool ortho = f->camera->setup.spec.ortho;
    values_under(v, "%s", "");
    want_setup(v, &f->camera->setup);
    want(v, "width=%u height=%u", f->camera->width, f->camera->height);
    want(v, "format_from=%s mapping_from=%s", c->format_from, c->mapping_from);
    want(v, "direction_from=%s fov=%f", c->direction_from, ortho ? NAN : number_behind(c->line, "--fov", 60));
    want(v, "half_height=%f", ortho ? number_behind(c->line, "--ortho", NAN) : NAN);
    want(v, "condition=%f", position_condition(f->camera));
    want_text(v, "truth", f->synthetic != NULL ? "synthetic" : NULL);
}

/* The error that 99 % do not exceed, and what none does: not less than it is. Unbounded errors and decodings have no
 * such. */
static void check_upwards(const values *v, const char *line) {
    static const char *const fields[] = {"mean", "p99", "max"};
    for (int k = 0; k < 3; k++) {
        char word[64], path[2 * PATH_SIZE];
        int used = 0;
        assert_int_equal(sscanf(line, " %63s%n", word, &used), 1);
        line += used;
        snprintf(path, sizeof path, "%s%s", v->prefix, fields[k]);
        if (k > 0 && strcmp(word, "-") != 0)
            assert_true(strtod(word, NULL) >= value_at(v, path)->number);
    }
}

/* Who asks for no more gets what is in the image, without what a programmer of shaders looks for. */
static void check_plain(const char *line) {
    static const char *const left_out[] = {"_ZBufferParams", "\n  condition", "\n  decode "};
    char *text = output_of(0, line, "");
    for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; i++)
        assert_null(strstr(text, left_out[i]));
    free(text);
}

static void check_text(values *v, const char *line, size_t errors) {
    check_plain(line);
    char *text = output_of(0, line, "--full"), label[64], path[PATH_SIZE];
    values_under(v, "%s", "");
    check_line(v, text, "sky  ", "sky.pixels:3, sky.share:3, sky.from:3, sky.limit:3");
    check_line(v, text, "depths  ", "lo:8, hi:8, codes:8");
    check_table(v, text, "bands[]",
                "lo:6, hi:6, pixels:10, codes:10, available:10, gap:6, gap_z:6, steps_shown:10, interval:6");
    check_line(v, text, "condition  ", "condition:4");
    if (strstr(text, "  pairs  ") != NULL) {
        const char *rest = strstr(strstr(text, "  pairs  "), "\n");
        check_line(v, text, "pairs  ", "pairs.count:6, pairs.ties:6, pairs.first_tie:6");
        check_line(v, rest + 1, "", "pairs.possible:6, pairs.certain_to:6");
        const char *words = strstr(rest, "up to z ="); /* where pairs cannot fight: not farther than it is */
        if (words != NULL)
            assert_true(strtod(words + strlen("up to z ="), NULL) <= value_at(v, "pairs.certain_to")->number);
    }
    for (size_t i = 0; i < errors; i++) {
        snprintf(path, sizeof path, "errors[%zu].name", i);
        snprintf(label, sizeof label, "%-24.60s", value_at(v, path)->text);
        values_under(v, "errors[%zu].", i);
        check_line(v, text, label, "mean:4, p99:4, max:4, column:4, row:4");
        check_upwards(v, strstr(text, label) + strlen(label));
    }
    free(text);
}

/* The set-up stands at the top. */
static void check_all(values *v, const char *line, size_t errors) {
    check_forms(v, 0, line, "bands[]",
                SETUP_CSV "from [scene] = lo, to [scene] = hi, pixels, codes, available, gap [scene], gap_z [scene], "
                          "steps, interval [scene]");
    check_text(v, line, errors);
}

/* The scene's own, but for those of the line. */
static void want_parameters(values *v, const char *line, const synthetic_row *synthetic, double *parameters) {
    parameter_defaults(synthetic->parameters, parameters);
    for (size_t i = 0; i < PARAMETERS_MAX && synthetic->parameters[i].name != NULL; i++) {
        char given[64];
        snprintf(given, sizeof given, " --parameter %s=", synthetic->parameters[i].name);
        const char *at = strstr(line, given);
        if (at != NULL)
            parameters[i] = strtod(at + strlen(given), NULL);
        values_under(v, "parameters[%zu].", i);
        want(v, "name=%s value=%f", synthetic->parameters[i].name, parameters[i]);
    }
}

TEST(synthetic) {
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const texture_case *c = &scenes[i];
        const char *name = word_behind(c->line, "--synthetic");
        const texture_camera camera = view_placed(c->line, WIDTH, HEIGHT, c->yaw, c->pitch);
        double parameters[PARAMETERS_MAX];
        values v = values_of(c->line);
        want_parameters(&v, c->line, synthetic_find(name), parameters);
        const frame f = {.camera = &camera,
                         .synthetic = synthetic_find(name),
                         .parameters = parameters,
                         .sky = number_behind(c->line, "--sky", 1e-4)};
        values_under(&v, "%s", "");
        want_text(&v, "file", NULL);
        want_text(&v, "synthetic", name);
        want_camera(&v, c, &f);
        want_survey(&v, &f, 0);
        want_pairs(&v, &f);
        check_all(&v, c->line, want_all_errors(&v, &f));
        values_free(&v);
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

static void want_image(values *v, const char *path, const texture_case *c, const image *shot,
                       const dp_recognised *found, const char *why) {
    values_under(v, "%s", "");
    want(v, "file=%s type=%s channels=%u", path, image_type_name(shot->type), 1U);
    want_text(v, "synthetic", NULL);
    want_text(v, "packing", NULL); /* test_packing has it otherwise */
    want_text(v, "lossy", NULL);   /* and test_image_compressed this */
    want_text(v, "channel", NULL); /* and test_image_tools this, */
    want_text(v, "moved", NULL);   /* and test_sensor_files these */
    want_text(v, "moved_from", NULL);
    values_under(v, "sky.");
    want_count(v, "zeros", 0); /* of packings, in test_packing */
    values_under(v, "recognised.");
    want_text(v, "format", found->depth ? found->format.name : NULL);
    want(v, "certain=%d why=%s", found->certain, why);
    if (found->direction)
        want_bool(v, "reversed", found->reversed);
    else
        want_text(v, "reversed", NULL);
    unit_reading units[UNITS_MAX]; /* test_stereo has which there are */
    const bool open = strcmp(c->format_from, "assumed") == 0 && strcmp(c->mapping_from, "assumed") == 0;
    const bool holes = found->at_one == 0 && found->at_zero > found->samples / 1000;
    const size_t count = found->metric || (open && holes && shot->type == IMAGE_U16) ? units_find(shot, units) : 0;
    for (size_t i = 0; i < count; i++) {
        values_under(v, "recognised.units[%zu].", i);
        want(v, "option=%s lo=%f hi=%f", units[i].option, units[i].lo, units[i].hi);
    }
}

/* The step in scene units is that of metric depth, which these are not; test_image_truth has what is shifted up. */
static void want_samples(values *v, const grain *g, bool coarser) {
    values_under(v, "%s", "");
    want_number(v, "metric", NAN);
    want_number(v, "radial", NAN);
    want_text(v, "metric_from", NULL);
    values_under(v, "samples.");
    want(v, "step=%f steps=%f steps_or=%f", NAN, g->kind == GRAIN_STEPS ? g->steps : NAN, NAN);
    want(v, "bits=%f coarser=%d", g->kind == GRAIN_FLOATS ? g->bits : NAN, coarser);
    want_text(v, "rounded",
              g->kind == GRAIN_CODES         ? NULL
              : g->rounding == GRAIN_ANY     ? "unknown"
              : g->rounding == GRAIN_NEAREST ? "nearest"
                                             : "zero");
}

/* The camera in the end, and what is written of it, the rest of which is found or assumed. */
static const struct {
    texture_case asked;
    const char *written;
    bool floats, damaged;
    uint32_t sky, spread;
    grain samples;
    bool coarser;
} images[] = {
    {{"texture -n 0.3 -f 700 -F unorm16 -m reversed --sky 0.0002", "found", "assumed", "assumed", 0, 0},
     "-n 0.3 -f 700 --sky 0.0002",
     true,
     false,
     0,
     30000,
     {.kind = GRAIN_FLOATS, .buffer = true, .bits = 24, .least = 0x1p-149},
     false},
    {{"texture -n 0.5 -f 90 -F unorm24 -m gl --fov 35", "given", "given", "given", 0, 0},
     "-n 0.5 -f 90 --fov 35 -F unorm24 -m gl --rounding nearest",
     true,
     true,
     65535,
     30000,
     {.kind = GRAIN_FLOATS, .rounding = GRAIN_NEAREST, .buffer = true, .bits = 24, .least = 0x1p-149},
     false},
    {{"texture -n 0.5 -f 90 -F unorm24 -m reversed --fov 50", "given", "given", "given", 0, 0},
     "-n 0.5 -f 90 --fov 50 -F unorm24 -m reversed",
     true,
     false,
     0,
     30000,
     {.kind = GRAIN_STEPS, .steps = 65535, .buffer = true, .bits = 24, .least = 0x1p-149},
     true},
    {{"texture -n 0.5 -f 90 -F unorm16 -m reversed --rounding zero", "assumed", "given", "given", 0, 0},
     "-n 0.5 -f 90 -m reversed --rounding zero",
     false,
     false,
     65535,
     30000,
     {.kind = GRAIN_STEPS, .rounding = GRAIN_ZERO, .steps = 65535, .margin = 0x1p-24, .least = 0x1p-149},
     false},
    {{"texture -n 0.2 -f 400 -F unorm16 -m reversed", "assumed", "assumed", "found", 0, 0},
     "-n 0.2 -f 400",
     false,
     false,
     0,
     16000,
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
    want(v, "what=%s name=%s z=%f column=%u row=%u", what, name, z, pixel % COLUMNS, pixel / COLUMNS);
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
TEST(images_of_depths) {
    for (size_t i = 0; i < sizeof images / sizeof images[0]; i++) {
        const texture_case *c = &images[i].asked;
        const char *path = scratch_file("a\"b\\c.npy");
        const texture_camera camera = view_placed(c->line, COLUMNS, ROWS, c->yaw, c->pitch);
        char line[1024];
        image shot;
        image_error error;
        dp_recognised found;
        char why[RECOGNISE_WHY_SIZE];
        values v = values_of(c->line);
        const uint64_t holes = write_image(path, images[i].floats, images[i].damaged, images[i].sky, images[i].spread);
        assert_true(image_read(path, &shot, &error));
        recognise(&shot, &found, why);
        const frame f = {.camera = &camera,
                         .image = &shot,
                         .grain = &images[i].samples,
                         .sky = number_behind(c->line, "--sky", 1e-4)};
        want_image(&v, path, c, &shot, &found, why);
        want_samples(&v, &images[i].samples, images[i].coarser);
        want_readings(&v, i, &camera.setup);
        want_camera(&v, c, &f);
        want_survey(&v, &f, holes);
        want_pairs(&v, &f);
        snprintf(line, sizeof line, "texture '%s' %s", path, images[i].written);
        check_all(&v, line, want_all_errors(&v, &f));
        image_free(&shot);
        values_free(&v);
    }
}

/* Then nothing is off, by no number and at no pixel. */
TEST(nothing_but_sky) {
    static const char line[] = "texture --synthetic plane --parameter distance=2000 --size 8x8 -q";
    check_says_all(
        0, line, SAID("!inf", "!0,0", "\n  eye depth                       -         -         -  - (scene units)\n"));
}

/* 8 bits times 256: shares of 65535/256, or of 255; also where all are below 128, which k/256 become, too. */
TEST(shifted_up) {
    static const unsigned all[] = {256, 100};
    uint16_t samples[64];
    const char *path = scratch_file("up.npy");
    for (unsigned k = 0; k < 2; k++) {
        for (unsigned i = 0; i < 64; i++)
            samples[i] = (uint16_t)((7 * i % all[k]) << 8);
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        image_writer *w = image_writer_open(file, IMAGE_NPY, IMAGE_U16, 8, 8, 1, NULL);
        assert_non_null(w);
        image_writer_rows(w, samples, 8);
        assert_true(image_writer_close(w) && fclose(file) == 0);
        json_t *root = json_printed(0, "texture %s -n 0.1 -f 100 -F d24 -m d3d", path);
        assert_relative(number_at(root, "samples.steps"), 65535.0 / 256.0, 1e-15);
        assert_true(number_at(root, "samples.steps_or") == 255);
        json_decref(root);
    }
}

LIST_TEST(check_apart)
/* z^2 s/(1 - z s) by hand, s = 1/200. */
TEST(a_lattice_in_words) {
    const char *path = scratch_file("levels.npy");
    check_says(0, "",
               "texture --synthetic plane --size 64x36 -n 0.3 -f 30 -F fp32 --product eye --as inverse:200 -o %s",
               path);
    check_says(0, "1/z in steps of 0.005; baseline times focal length over a step 200\n",
               "texture %s --metric 1 --lattice inverse:200 --full -q", path);
    check_says(0, " levels, apart by 0.005025 at 1, 0.0202 at 2, 0.1282 at 5, 0.5263 at 10\n",
               "texture %s --metric 1 --lattice inverse:200 --full -q", path);
}
