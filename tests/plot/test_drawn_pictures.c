/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of depth textures, as drawn, against the product that the same command writes as an image of numbers. */
#include "drawn.h"
#include "drawn_map.h"
#include "drawn_truth.h"
#include "support.h"

static const char fight_words[] = "stored as one code with what is behind: they z-fight";

/* Below so many fields each is a rectangle. */
enum { FEW = 4096 };

typedef struct numbers {
    int width, height, channels;
    float *values;
} numbers;

/* The shape and the floats of an npy. */
static numbers read_npy(const char *path) {
    unsigned char head[10];
    char words[512];
    numbers n = {.channels = 1};
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    assert_int_equal(fread(head, 1, sizeof head, in), sizeof head);
    const size_t size = head[8] | (size_t)head[9] << 8;
    assert_true(size < sizeof words && fread(words, 1, size, in) == size);
    words[size] = '\0';
    const char *shape = strstr(words, "'shape': (");
    assert_true(strstr(words, "<f4") != NULL && shape != NULL);
    assert_true(sscanf(shape, "'shape': (%d, %d, %d", &n.height, &n.width, &n.channels) >= 2);
    const size_t count = (size_t)n.width * (size_t)n.height * (size_t)n.channels;
    n.values = calloc(count, sizeof *n.values);
    assert_non_null(n.values);
    assert_int_equal(fread(n.values, sizeof *n.values, count, in), count);
    fclose(in);
    return n;
}

static float value_at(const numbers *n, int column, int row, int channel) {
    return n->values[((size_t)row * (size_t)n->width + (size_t)column) * (size_t)n->channels + (size_t)channel];
}

typedef struct picture_case {
    const char *arguments;
    const char *title, *subtitle, *value; /* value: the caption of the bar; null where colours are directions */
    const char *headings[3];
    bool log, largest, holes;
    int fields; /* pixels of a side of a field */
} picture_case;

static const picture_case cases[] = {
    {"--synthetic steps -F unorm16 -m d3d --product eye",
     "Eye depth",
     "synthetic steps, 640 x 360; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "eye depth (scene units)",
     {""},
     true,
     false,
     false,
     1},
    {"--synthetic steps --parameter from=10 --parameter to=900 --parameter even=1 -F unorm24 -m d3d --sky 0 --product "
     "raw",
     "Window depth beside eye depth over far, Linear01Depth",
     "synthetic steps, 640 x 360; unorm24 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "depth",
     {"window depth", "eye depth over far"},
     false,
     false,
     false,
     1},
    {"--synthetic steps --parameter from=10 --parameter to=900 --parameter even=1 -F unorm24 -m d3d --sky 0 --product "
     "linear01",
     "Eye depth over far",
     "synthetic steps, 640 x 360; unorm24 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "eye depth over far",
     {""},
     false,
     false,
     false,
     1},
    {"--synthetic decals -F unorm16 -m d3d --product eye --size 640x360 --error-map --theme dark",
     "Error of eye depth",
     "synthetic decals, 640 x 360; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "error (scene units)",
     {""},
     true,
     true,
     false,
     1},
    {"--synthetic decals -F unorm16 -m d3d --product eye --size 1600x800 --error-map",
     "Error of eye depth",
     "synthetic decals, 1600 x 800; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact; a point is the "
     "largest "
     "of "
     "4 pixels",
     "error (scene units)",
     {""},
     true,
     true,
     false,
     2},
    {"--synthetic plane --parameter turn=20 --parameter tilt=30 -F unorm16 -m d3d --product eye --size 2400x1200",
     "Eye depth",
     "synthetic plane, 2400 x 1200; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact; one of 9 pixels",
     "eye depth (scene units)",
     {""},
     false,
     false,
     false,
     3},
    {"--synthetic plane --parameter distance=30 --parameter turn=6 --size 640x240 -F unorm16 -m d3d --product "
     "effect:soft-particles "
     "--parameter reference=27 --parameter fade-distance=18",
     "Soft-particles, fade-distance 18",
     "synthetic plane, 640 x 240; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "soft-particles",
     {""},
     false,
     false,
     false,
     1},
    {"--synthetic plane --parameter distance=30 --parameter turn=6 --size 640x240 -F unorm16 -m d3d --product "
     "effect:force-field "
     "--parameter reference=50 --parameter power=2",
     "Force-field, power 2",
     "synthetic plane, 640 x 240; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "force-field",
     {""},
     false,
     false,
     false,
     1},
    {"--synthetic sphere --product position:matrix --eye 3,1,-2 --look 16836.119889,1,46246.616794",
     "Positions, method matrix",
     "synthetic sphere, 640 x 360; unorm24 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "coordinate (scene units)",
     {"x (world)", "y (world)", "z (world)"},
     false,
     false,
     true,
     1},
    {"--synthetic sphere --parameter wall=20 -F unorm16 -m d3d --product normal:high",
     "Normals, method high",
     "synthetic sphere, 640 x 360; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact",
     NULL,
     {""},
     false,
     false,
     false,
     1},
    {"--synthetic sphere --parameter wall=20 -F unorm24 -m d3d --product eye --size 40x24",
     "Eye depth",
     "synthetic sphere, 40 x 24; unorm24 d3d, near 0.1, far 1000, perspective, nearest, exact",
     "eye depth (scene units)",
     {""},
     false,
     false,
     false,
     1},
};

/* x red, y green, towards us blue. */
static uint32_t direction(const numbers *n, int column, int row) {
    const double x = (double)value_at(n, column, row, 0), y = (double)value_at(n, column, row, 1);
    const double z = (double)value_at(n, column, row, 2);
    return 0xFF000000u | (uint32_t)lrint(127.5 * (x + 1)) << 16 | (uint32_t)lrint(127.5 * (y + 1)) << 8 |
           (uint32_t)lrint(127.5 * (1 - z));
}

/* The pixel that a field stands for: the largest of its pixels, or the one in its middle. */
static double field_value(const picture_case *q, const numbers *n, int column, int row, int channel) {
    const int side = q->fields;
    if (!q->largest)
        return (double)value_at(n, column * side + (side - 1) / 2, row * side + (side - 1) / 2, channel);
    double largest = NAN;
    for (int i = 0; i < side * side; i++)
        largest = fmax(largest, (double)value_at(n, column * side + i % side, row * side + i / side, channel));
    return largest;
}

static int distance(uint32_t a, uint32_t b) {
    int sum = 0;
    for (int shift = 0; shift <= 16; shift += 8)
        sum += abs((int)(a >> shift & 255) - (int)(b >> shift & 255));
    return sum;
}

static void check_panel(const drawn *d, const drawn_panel *p, const picture_case *q, const numbers *n, int channel) {
    rng r = rng_make("pictures");
    const int columns = n->width / q->fields, rows = n->height / q->fields;
    /* Frames lie on whole px, which are more than a pixel of the image. */
    const svg_box b = n->width * n->height < FEW ? p->frame : drawn_map_image(d, p)->box;
    int seen = 0;
    assert_px(drawn_px(&p->x, 0), p->frame.x0, 1.5);
    assert_px(drawn_px(&p->x, n->width), p->frame.x1, 1.5);
    assert_px(drawn_px(&p->y, 0), p->frame.y0, 1.5);
    assert_px(drawn_px(&p->y, n->height), p->frame.y1, 1.5);
    for (int i = 0; i < 500; i++) {
        const int column = (int)rng_below(&r, (uint64_t)columns), row = (int)rng_below(&r, (uint64_t)rows);
        const svg_point place = {b.x0 + (b.x1 - b.x0) * (column + 0.5) / columns,
                                 b.y0 + (b.y1 - b.y0) * (row + 0.5) / rows, false};
        const uint32_t pixel = drawn_map_shown(d, p, place);
        const double v = field_value(q, n, column, row, channel);
        if (isnan(v)) {
            assert_int_equal(pixel >> 24, 0);
            continue;
        }
        seen++;
        assert_int_equal(pixel >> 24, 255);
        if (q->value == NULL) {
            assert_true(distance(pixel, direction(n, column, row)) <= 3);
            continue;
        }
        const double bar = drawn_bar_px(d, pixel), top = d->bar->box.y0, bottom = d->bar->box.y1;
        const double want = v > 0 || !q->log ? drawn_px(&d->value, v) : bottom;
        if (fabs(bar - fmin(fmax(want, top), bottom)) > 2.5)
            fail_msg("%s: pixel %d,%d is shown as %.4g, should be %.4g", q->title, column, row,
                     drawn_at(&d->value, bar), v);
    }
    assert_true(seen > 50);
}

/* A ball that we look at: red to the right, green upwards, blue in its middle. */
static void check_ball(const drawn *d) {
    static const char *const meanings[] = {"red: right", "green: up", "blue: towards", "the camera"};
    const svg_mark *ball = NULL;
    const svg_box page = {0, 0, d->svg->width, d->svg->height};
    for (size_t i = 0; i < d->svg->count; i++)
        if (d->svg->marks[i].kind == SVG_IMAGE && d->svg->marks[i].box.x0 > d->panels[0].frame.x1)
            ball = &d->svg->marks[i];
    assert_non_null(ball);
    double below = ball->box.y1;
    for (int i = 0; i < 4; i++) {
        const svg_mark *words = drawn_words(d, page, meanings[i]);
        assert_non_null(words);
        assert_true(words->at.y > below && fabs(words->at.x - ball->box.x0) < 1);
        below = words->at.y;
    }
    for (int row = 0; row < ball->rows; row++)
        for (int column = 0; column < ball->columns; column++) {
            const double x = (column + 0.5) * 2 / ball->columns - 1, y = 1 - (row + 0.5) * 2 / ball->rows;
            const uint32_t pixel = ball->pixels[row * ball->columns + column];
            const float up[3] = {(float)x, (float)y, (float)-sqrt(fmax(0, 1 - x * x - y * y))};
            const numbers one = {1, 1, 3, (float *)up};
            if (x * x + y * y < 0.98)
                assert_true(distance(pixel, direction(&one, 0, 0)) <= 3);
            else if (x * x + y * y > 1.02)
                assert_int_equal(pixel >> 24, 0);
        }
}

static void check_bar(const drawn *d, const picture_case *q, const numbers *n) {
    const bool shares = strstr(q->arguments, "soft-particles") != NULL ||
                        strstr(q->arguments, "--product raw") != NULL ||
                        strstr(q->arguments, "--product linear01") != NULL; /* the scale is that of all of its kind */
    double lo = shares ? 0 : INFINITY, hi = shares ? 1 : -INFINITY;
    assert_string_equal(d->right_caption->text, q->value);
    if (shares && strstr(q->arguments, "effect") == NULL)
        drawn_bar_is_grey(d);
    else
        drawn_bar_is_viridis(d);
    for (size_t i = 0; i < (size_t)n->width * (size_t)n->height * (size_t)n->channels; i++)
        if (isfinite(n->values[i]) && (!q->largest || n->values[i] > 0)) {
            lo = fmin(lo, (double)n->values[i]);
            hi = fmax(hi, (double)n->values[i]);
        }
    if (q->largest) /* four decades of errors at most */
        lo = fmax(lo, 1e-4 * hi);
    assert_int_equal(d->value.log, q->log);
    assert_px(drawn_px(&d->value, hi), d->bar->box.y0, 3);
    assert_px(drawn_px(&d->value, lo), d->bar->box.y1, 3);
}

static bool is_hatched(const drawn *d) {
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_PATH && m->fill.a == 1 && svg_rgb(m->fill) == d->theme->empty &&
            svg_inside(d->panels[0].frame, m->box, 1))
            return true;
    }
    return false;
}

/* Beside window depth, between 0.1 and 1000, stands eye depth over far. */
static void put_beside(numbers *n) {
    const size_t count = (size_t)n->width * (size_t)n->height;
    float *both = calloc(2 * count, sizeof *both);
    assert_non_null(both);
    for (size_t i = 0; i < count; i++) {
        both[2 * i] = n->values[i];
        both[2 * i + 1] = (float)(0.1 / (1000 - (double)n->values[i] * (1000 - 0.1)));
    }
    free(n->values);
    n->values = both;
    n->channels = 2;
}

static void check_figure(const picture_case *q) {
    char path[320], shown[128] = "", subtitle[256], hatched[64] = "";
    size_t missing = 0;
    snprintf(path, sizeof path, "%s/product.npy", drawn_folder());
    const drawn_theme *look = strstr(q->arguments, "dark") != NULL ? &drawn_dark : &drawn_light;
    drawn *d = drawn_run(look, "texture %s -o %s", q->arguments, path);
    numbers n = read_npy(path);
    size_t panels = 0;
    if (strstr(q->arguments, "raw") != NULL)
        put_beside(&n);
    assert_string_equal(d->title, q->title);
    for (size_t i = 0; i < (size_t)n.width * (size_t)n.height; i++)
        missing += isnan(n.values[i * (size_t)n.channels]) ? 1 : 0;
    if (missing > 0)
        snprintf(hatched, sizeof hatched, "; hatched: no value, %zu pixels", missing);
    snprintf(subtitle, sizeof subtitle, "%s%s", q->subtitle, hatched);
    assert_string_equal(d->subtitle, subtitle);
    assert_int_equal(missing > 0, q->holes);
    assert_string_equal(d->x_caption->text, "column (px)");
    assert_string_equal(d->y_caption->text, "row (px)");
    for (; panels < 3 && q->headings[panels] != NULL; panels++)
        if (panels < d->panel_count) {
            assert_string_equal(d->panels[panels].heading, q->headings[panels]);
            snprintf(shown + strlen(shown), sizeof shown - strlen(shown), "%s%s%s",
                     q->headings[panels][0] != '\0' ? " " : "", q->headings[panels],
                     q->headings[panels][0] != '\0' ? "." : "");
        }
    assert_int_equal(d->panel_count, panels);
    if (strstr(q->arguments, "decals") != NULL)
        snprintf(shown + strlen(shown), sizeof shown - strlen(shown), " Shown: %s.", fight_words);
    drawn_description_is(d, shown);
    assert_int_equal(is_hatched(d), q->holes);
    for (size_t i = 0; i < panels; i++) {
        const svg_box f = d->panels[i].frame; /* pixels are square */
        assert_px((f.x1 - f.x0) / (f.y1 - f.y0), (double)n.width / n.height, 0.02);
        check_panel(d, &d->panels[i], q, &n, (int)i);
    }
    if (q->value != NULL)
        check_bar(d, q, &n);
    else
        check_ball(d);
    free(n.values);
    drawn_close(d);
}

TEST(pictures_show_the_product) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check_figure(&cases[i]);
}

/* Each decal that has the code of its tile, and no other. */
TEST(decals_that_fight) {
    cameras c = cameras_of(drawn_camera(0.1, 1000), "unorm16", "d3d");
    drawn *d =
        drawn_run(&drawn_light, "texture --synthetic decals -F unorm16 -m d3d --product eye --parameter count=6");
    drawn_marker all[64];
    const drawn_panel *p = &d->panels[0];
    const size_t count = drawn_markers(d, p, all, 64);
    size_t ties = 0;
    drawn_legend_is(d, 1, (const char *const[]){fight_words});
    for (int i = 0; i < 36; i++) { /* tiles row by row, from 1 to 300 in equal ratios */
        const double wall = pow(300, i / 35.0), x = 640 * (i % 6 + 0.5) / 6, y = 360 * (i / 6 + 0.5) / 6;
        bool found = false;
        for (size_t k = 0; k < count; k++)
            found = found || (drawn_alike(&all[k], &d->entries[0].marker) &&
                              hypot(all[k].x - drawn_px(&p->x, x), all[k].y - drawn_px(&p->y, y)) < 1.5);
        assert_int_equal(found, dp_code(&c.setups[0], wall) == dp_code(&c.setups[0], wall - 0.01));
        ties += found;
    }
    assert_int_equal(count, ties);
    assert_true(ties > 5 && ties < 31);
    drawn_close(d);
    d = drawn_run(&drawn_light, "texture --synthetic decals -F fp32 -m reversed --product eye");
    assert_int_equal(d->entry_count, 0);
    drawn_close(d);
}

/* One value alone has the middle of a bar that goes to both sides of it; no error at all is dark. */
TEST(a_single_value) {
    drawn *d =
        drawn_run(&drawn_light, "texture --synthetic plane --parameter distance=16 -F fp32 -m reversed --product eye");
    const svg_mark *image = drawn_map_image(d, &d->panels[0]);
    const double middle = svg_middle_y(d->bar->box);
    for (int i = 0; i < image->columns * image->rows; i += 997)
        assert_px(drawn_bar_px(d, image->pixels[i]), middle, 3);
    assert_true(fabs(drawn_at(&d->value, middle) - 16) < 0.2);
    drawn_close(d);
}

/* The subtitle says the name of a file, without its folder; the eye depth is what the image was made of. */
TEST(a_file) {
    char path[320];
    snprintf(path, sizeof path, "%s/depth.png", drawn_folder());
    free(drawn_output("texture --synthetic steps --size 160x90 -F unorm16 -m d3d -q -o %s", path));
    drawn *d = drawn_run(&drawn_light, "texture %s -F unorm16 -m d3d --product eye --title 'Of a file'", path);
    assert_string_equal(d->title, "Of a file");
    assert_string_equal(d->subtitle,
                        "depth.png, 160 x 90; unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact");
    const svg_mark *image = drawn_map_image(d, &d->panels[0]);
    for (int step = 0; step < 16; step++) { /* from 1 to 300, in equal ratios */
        const uint32_t pixel = image->pixels[45 * image->columns + step * 10 + 5];
        assert_px(drawn_bar_px(d, pixel), drawn_px(&d->value, pow(300, step / 15.0)), 5);
    }
    drawn_close(d);
    snprintf(path, sizeof path, "%s/depth.npy", drawn_folder());
    free(drawn_output("texture --synthetic steps --size 160x90 -F unorm16 -m d3d --product eye -q -o %s", path));
    d = drawn_run(&drawn_light, "texture %s --metric 1 --unit m --product eye", path);
    assert_string_equal(d->subtitle, "depth.npy, 160 x 90; metric depth, 1 m a unit");
    assert_string_equal(d->right_caption->text, "eye depth (m)");
    drawn_close(d);
}
