/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requirements and normals, as drawn: a requirement file of the test's own against the library, normals against error
 * maps of the same plane. */
#include "drawn.h"
#include "drawn_truth.h"
#include "named.h"
#include "plot/figure.h"
#include "support.h"
#include "texture/normal_errors.h"

/* ---- Requirements ------------------------------------------------------------------------------------------------ */

typedef struct need {
    const char *name;
    int camera;
    bool is_error;
    double lo, hi, limit;
} need;

static const char *const camera_names[] = {"street", "cockpit", "scope"};
static const char *const headings[] = {"street: unorm24 d3d, exact", "cockpit: fp32 reversed, float",
                                       "scope: fp32 reversed, exact"};
static const need needs[] = {
    {"kerb", 0, false, 0.5, 20, 1e-3},  {"paint", 0, false, 5, 500, 2e-2},     {"haze", 0, true, 1, 900, 0.4},
    {"fence", 0, true, 3, 300, 1e-3},   {"tower", 0, false, 1500, 1500, 5},    {"levers", 1, false, 0.1, 2, 1e-5},
    {"knobs", 1, false, 0.3, 20, 1e-6}, {"reticle", 2, false, 0.2, 2.2, 1e-6}, /* worst where a binade ends */
};
enum { NEEDS = sizeof needs / sizeof needs[0] };

static void write_needs(const char *path) {
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fprintf(
        out,
        "unit = \"m\";\ncameras = {\n"
        "  street = { near = 0.1; far = 2000.0; mapping = \"d3d\"; format = \"unorm24\"; model = \"exact\"; };\n"
        "  cockpit = { near = 0.05; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\"; model = \"float\"; "
        "};\n  scope = { near = 0.05; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\"; model = \"exact\"; };\n"
        "};\nrequirements = {\n");
    for (size_t i = 0; i < NEEDS; i++) {
        const need *n = &needs[i];
        fprintf(out, "  %s = { camera = \"%s\"; ", n->name, camera_names[n->camera]);
        if (n->lo == n->hi)
            fprintf(out, "at = %#.15g; ", n->lo);
        else
            fprintf(out, "range = [%#.15g, %#.15g]; ", n->lo, n->hi);
        fprintf(out, "%s = %#.15g; };\n", n->is_error ? "error" : "separation", n->limit);
    }
    fprintf(out, "  shimmer = { camera = \"cockpit\"; range = [1.0, 2.0]; ties = 0.5; };\n};\n");
    fclose(out);
}

/* The worst that a set-up gives over a range, and where that is worst. */
static double given(const dp_setup *s, const need *n, double *z) {
    dp_worst w;
    dp_separation_worst far;
    if (n->is_error) {
        assert_int_equal(dp_worst_over(s, n->lo, n->hi, &w), DP_OK);
        *z = w.error_z;
        return w.error;
    }
    assert_int_equal(dp_separation_over(s, n->lo, n->hi, n->limit, &far), DP_OK);
    *z = far.z;
    return far.bound;
}

/* Softened: a curve that runs along it can be seen on it. */
static svg_mark level_pen(const drawn *d, uint32_t colour) {
    svg_mark pen = {.stroke = {0, 0, 0, 1}, .width = 6 * d->scale};
    double *parts[3] = {&pen.stroke.r, &pen.stroke.g, &pen.stroke.b};
    for (int i = 0; i < 3; i++) {
        const int shift = 16 - 8 * i;
        const double own = (colour >> shift & 255) / 255.0, ground = (d->theme->background >> shift & 255) / 255.0;
        *parts[i] = ground + 0.45 * (own - ground);
    }
    return pen;
}

/* The allowed level over the range, in the colour of the verdict, below all curves; one at a single depth reaches a
 * little to both sides. */
static void check_level(const drawn *d, const drawn_panel *p, const need *n, bool passed) {
    const svg_mark pen = level_pen(d, d->theme->palette[passed ? 2 : 1]);
    const double y = drawn_px(&p->y, n->limit), from = drawn_px(&p->x, n->lo), to = drawn_px(&p->x, n->hi);
    const double more = fmax(22 * d->scale - (to - from), 0) / 2;
    const svg_mark *lines[32], *found = NULL;
    const size_t count = drawn_strokes(d, p, &pen, lines, 32);
    for (size_t i = 0; i < count; i++) {
        const svg_point a = lines[i]->points[0], b = lines[i]->points[1];
        if (fabs(a.y - y) < 1 && fabs(b.y - y) < 1 && fabs(a.x - (from - more)) < 1.5 && fabs(b.x - (to + more)) < 1.5)
            found = lines[i];
    }
    if (found == NULL)
        fail_msg("nothing shows what '%s' allows", n->name);
    for (size_t i = 0; i < d->entry_count; i++)
        if (d->entries[i].line != NULL && d->entries[i].line->width < 3 * d->scale) {
            const svg_mark *curve[1];
            if (drawn_strokes(d, p, d->entries[i].line, curve, 1) == 1)
                assert_true(curve[0] > found);
        }
}

/* No curve runs through the words, and no others stand there. */
static void check_clear(const drawn *d, const drawn_panel *p, const svg_mark *words) {
    for (size_t i = 0; i < d->entry_count; i++) {
        const svg_mark *curve[1];
        double top, bottom;
        if (d->entries[i].line == NULL || d->entries[i].line->width > 3 * d->scale ||
            drawn_strokes(d, p, d->entries[i].line, curve, 1) != 1)
            continue;
        const double middle = words->at.y - 0.36 * words->size;
        for (double x = words->box.x0 + 2; x < words->box.x1 - 2; x++)
            if (drawn_reach(curve[0], x, x + 1, &top, &bottom) && top < middle + 5 && bottom > middle - 5)
                fail_msg("'%s' is crossed by a curve", words->text);
    }
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m != words && m->kind == SVG_WORDS && m->box.x0 < words->box.x1 && words->box.x0 < m->box.x1 &&
            m->box.y0 + 3 < words->box.y1 && words->box.y0 + 3 < m->box.y1)
            fail_msg("'%s' and '%s' stand on each other", words->text, m->text);
    }
}

/* The level that is allowed, and a mark with the name where it is worst. */
static void check_need(const drawn *d, const drawn_panel *p, const dp_setup *setup, const need *n, size_t *met,
                       size_t *inner) {
    double z;
    const bool passed = given(setup, n, &z) <= n->limit;
    const drawn_entry *e = drawn_legend(d, passed ? "met, where it is worst" : "missed, where it is worst");
    drawn_marker all[32];
    char text[64];
    const size_t count = drawn_markers(d, p, all, 32);
    const double y = drawn_px(&p->y, n->limit);
    bool marked = false;
    *met += passed;
    *inner += drawn_px(&p->x, z) < drawn_px(&p->x, n->hi) - 3;
    check_level(d, p, n, passed);
    snprintf(text, sizeof text, "%s%s", n->name, n->is_error ? " (error)" : "");
    for (size_t i = 0; i < count && !marked; i++)
        if (drawn_alike(&all[i], &e->marker) && fabs(all[i].y - y) < 1.2 && fabs(all[i].x - drawn_px(&p->x, z)) < 2) {
            marked = true;
            check_clear(d, p, drawn_label(d, p, (svg_point){all[i].x, all[i].y, false}, text));
        }
    if (!marked)
        fail_msg("'%s' has no mark at %g", text, z);
}

static void check_legend(const drawn *d) {
    static const char *const texts[] = {"separation given",       "error given",     "allowed, met",
                                        "met, where it is worst", "allowed, missed", "missed, where it is worst"};
    drawn_legend_is(d, 6, texts);
    drawn_style_is(d, &d->entries[0], 0, 0, DRAWN_NONE, false);
    drawn_style_is(d, &d->entries[1], 3, 2, DRAWN_NONE, false);
    const drawn_marker *met = &d->entries[3].marker, *missed = &d->entries[5].marker;
    for (int i = 2; i < 6; i += 2) {
        const svg_mark pen = level_pen(d, d->theme->palette[i == 2 ? 2 : 1]);
        assert_int_equal(svg_rgb(d->entries[i].line->stroke), svg_rgb(pen.stroke));
        assert_px(d->entries[i].line->width, pen.width, 1e-6);
    }
    assert_int_equal(met->shape, DRAWN_DISC);
    assert_int_equal(met->inside, d->theme->palette[2]); /* green, and full */
    assert_int_equal(missed->shape, DRAWN_TRIANGLE_DOWN);
    assert_int_equal(missed->rim, d->theme->palette[1]);
    assert_int_equal(missed->inside, d->theme->background);
}

TEST(needs_of_a_file) {
    char path[320], subtitle[128];
    size_t met = 0, marks[3] = {0, 0, 0}, inner = 0;
    snprintf(path, sizeof path, "%s/street.need", drawn_folder());
    write_needs(path);
    dp_spec street = drawn_camera(0.1, 2000), cockpit = drawn_camera(0.05, INFINITY);
    cockpit.model = DP_MODEL_FLOAT;
    dp_spec scope = cockpit;
    scope.model = DP_MODEL_EXACT;
    const cameras c[3] = {cameras_of(street, "unorm24", "d3d"), cameras_of(cockpit, "fp32", "reversed"),
                          cameras_of(scope, "fp32", "reversed")};
    drawn *d = drawn_run(&drawn_light, "plot needs %s", path);
    assert_string_equal(d->title, "Separations and errors, allowed and given");
    assert_string_equal(d->x_caption->text, "eye depth z (m)");
    assert_string_equal(d->y_caption->text, "allowed and given (m)");
    check_legend(d);
    assert_int_equal(d->panel_count, 3);
    for (size_t i = 0; i < 3; i++) {
        const drawn_panel *p = &d->panels[i];
        drawn_marker all[32];
        assert_string_equal(p->heading, headings[i]);
        assert_true(p->x.log && p->y.log);
        const double from = drawn_at(&p->x, p->frame.x0), to = drawn_at(&p->x, p->frame.x1);
        assert_true(from > 0.02 && from < 0.09); /* a margin before the first depth asked about, 0.1, */
        assert_true(to > 5e3 && to < 1e6);       /* and one that a name fits into behind the last, 1500 */
        const svg_mark *curve = drawn_curve(d, p, &d->entries[0]);
        drawn_follows(p, &p->y, curve, true_separation, &c[i].setups[0], 80, 1.7);
        const svg_mark *error[1];
        assert_int_equal(drawn_strokes(d, p, d->entries[1].line, error, 1), i == 0);
        if (i == 0)
            drawn_follows(p, &p->y, error[0], true_error, &c[i].setups[0], 80, 1.5);
        for (size_t k = 0; k < NEEDS; k++)
            if (needs[k].camera == (int)i) {
                check_need(d, p, &c[i].setups[0], &needs[k], &met, &inner);
                marks[i]++;
            }
        assert_int_equal(drawn_markers(d, p, all, 32), marks[i]);
    }
    assert_true(met > 0 && met < NEEDS && inner > 0);
    snprintf(subtitle, sizeof subtitle, "street.need: %zu met, %zu missed; not shown: 1 of ties and biases", met,
             NEEDS - met);
    assert_string_equal(d->subtitle, subtitle);
    drawn_description_is(d,
                         " street: unorm24 d3d, exact. Shown: separation given; error given; allowed, met; met, where "
                         "it is worst; allowed, missed; missed, where it is worst. cockpit: fp32 reversed, float. "
                         "Shown: separation given; allowed, met; met, where it is worst; allowed, missed; missed, "
                         "where it is worst. scope: fp32 reversed, exact. Shown: separation given; allowed, met; "
                         "met, where it is worst.");
    drawn_close(d);
}

/* Part of the depths is shown: what is asked about others is not there; what reaches beyond them is named at the end.
 */
TEST(needs_in_part) {
    char path[320];
    snprintf(path, sizeof path, "%s/street.need", drawn_folder());
    write_needs(path);
    drawn *d = drawn_run(&drawn_light, "plot needs %s --range 0.4:100", path);
    const svg_box page = {0, 0, d->svg->width, d->svg->height};
    const drawn_panel *p = &d->panels[0];
    assert_px(drawn_px(&p->x, 0.4), p->frame.x0, 1.5);
    assert_px(drawn_px(&p->x, 100), p->frame.x1, 1.5);
    drawn_label(d, p, (svg_point){drawn_px(&p->x, 20), drawn_px(&p->y, 1e-3), false}, "kerb");
    drawn_label(d, p, (svg_point){p->frame.x1, drawn_px(&p->y, 2e-2), false}, "paint");
    assert_null(drawn_words(d, page, "tower"));
    for (size_t i = 0; i < NEEDS; i++) {
        drawn_marker all[32];
        const size_t count = drawn_markers(d, &d->panels[needs[i].camera], all, 32);
        for (size_t k = 0; k < count; k++)
            assert_true(all[k].x < d->panels[needs[i].camera].frame.x1 + 1);
    }
    svg_free(d->svg); /* the other names are looked at above */
    free(d);
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

/* Told apart by more than their curves are thick: each surface, method and set-up has its own height and slope. */
static double made_up(const dp_setup *setup, size_t surface, size_t method, double z) {
    assert_true(surface == 0 || method < 4); /* the bound holds on surface 0 alone */
    return pow(10, (double)method * 1.5 + (double)surface * 0.7 + (setup->reversed ? 0.35 : 0)) * pow(z, 0.3) * 1e-3;
}

typedef struct of_normals {
    const dp_setup *setup;
    size_t surface, method;
} of_normals;

static bool true_normal(const void *context, double from, double to, double *lo, double *hi) {
    const of_normals *n = context;
    *lo = made_up(n->setup, n->surface, n->method, from);
    *hi = made_up(n->setup, n->surface, n->method, to);
    return from > n->setup->spec.znear * 1.2 && to < n->setup->spec.zfar / 1.2; /* curves end within a slice of both */
}

/* Planes are those of a set-up, the outline is of all. */
static void check_heading(const drawn_panel *p, const char *name, bool outline) {
    char heading[80];
    snprintf(heading, sizeof heading, "%s%s", outline ? "" : name,
             outline ? "outline of a sphere (worst of all)" : ": plane at 60\u00b0");
    assert_string_equal(p->heading, heading);
}

TEST(normals_of_the_test) {
    static const char *const texts[] = {"low", "medium", "high", "projective", "bound of projective"};
    cameras c = cameras_of(drawn_camera(0.1, 1000), "unorm16", "d3d,reversed");
    const char *names[] = {c.names[0], c.names[1]};
    const figure_request request = {
        .setups = c.setups, .count = 2, .names = names, .lo = NAN, .hi = NAN, .at = NAN, .columns = 800, .rows = 500};
    chart *drawing = chart_new();
    assert_non_null(drawing);
    snprintf(drawing->title, sizeof drawing->title, "Of the test");
    snprintf(drawing->subtitle, sizeof drawing->subtitle, "sub");
    assert_null(normals_draw(&request, made_up, drawing));
    drawn *d = drawn_chart(&drawn_light, drawing, 800, 500);
    assert_string_equal(d->x_caption->text, "eye depth z (scene units)");
    assert_string_equal(d->y_caption->text, "angular error (degrees)");
    drawn_legend_is(d, 5, texts);
    drawn_style_is(d, &d->entries[0], 0, 0, DRAWN_DISC, false);
    drawn_style_is(d, &d->entries[1], 1, 2, DRAWN_SQUARE, false);
    drawn_style_is(d, &d->entries[2], 2, 0, DRAWN_DIAMOND, false);
    drawn_style_is(d, &d->entries[3], 3, 2, DRAWN_TRIANGLE, false);
    drawn_style_is(d, &d->entries[4], -1, 2, DRAWN_NONE, true);
    assert_int_equal(d->panel_count, 3);
    for (size_t i = 0; i < 3; i++) {
        const drawn_panel *p = &d->panels[i];
        check_heading(p, c.names[i % 2], i == 2);
        assert_true(p->x.log && p->y.log);
        for (size_t m = 0; m < (i < 2 ? 5 : 4); m++) { /* of outlines the worst, which is that of the second */
            const of_normals n = {&c.setups[i == 0 ? 0 : 1], i / 2, m};
            const svg_mark *curve = drawn_curve(d, p, &d->entries[m]);
            drawn_follows(p, &p->y, curve, true_normal, &n, 60, 3);
            if (m < 4)
                drawn_markers_on(d, p, &d->entries[m], curve);
        }
        if (i == 2) {
            const svg_mark *none[1];
            assert_int_equal(drawn_strokes(d, p, d->entries[4].line, none, 1), 0);
        }
    }
    drawn_close(d);
}

static int by_size(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* 99 % of the pixels of an error map of a plane slanted by 60 degrees, in the middle of a large view. */
static double mapped(const char *method, double z) {
    enum { SIDE = 48 };
    static float values[SIDE * SIDE];
    char path[320], head[10];
    const double fov = 2 * atan(tan(30 * 3.14159265358979323846 / 180) * SIDE / 1080) * 180 / 3.14159265358979323846;
    size_t count = 0;
    snprintf(path, sizeof path, "%s/normals.npy", drawn_folder());
    free(drawn_output("texture --synthetic plane --parameter distance=%.17g --parameter tilt=33 --parameter turn=53.4 "
                      "--size 48x48 --sky 0 --fov %.17g -F unorm16 -m d3d --product normal:%s --error-map -q -o %s",
                      z, fov, method, path));
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    assert_int_equal(fread(head, 1, sizeof head, in), sizeof head);
    assert_int_equal(fseek(in, (unsigned char)head[8] + 256 * (unsigned char)head[9], SEEK_CUR), 0);
    assert_int_equal(fread(values, sizeof values[0], SIDE * SIDE, in), SIDE * SIDE);
    fclose(in);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        if (!isnan(values[i]))
            values[count++] = values[i];
    assert_true(count > SIDE);
    qsort(values, count, sizeof values[0], by_size);
    return (double)values[(size_t)(0.99 * (double)(count - 1))];
}

/* The mean over the outline of a sphere as large at every depth, a wall behind it as far as it is large. */
static double outlined(const char *method, double z, bool ortho) {
    enum { SIDE = 48, RADIUS = 16 };
    const double tangent = tan(30 * 3.14159265358979323846 / 180), half = ortho ? 5 : tangent;
    dp_spec one = drawn_camera(0.1, 1000);
    one.ortho = ortho;
    cameras c = cameras_of(one, "unorm16", "d3d");
    camera_spec spec = camera_spec_default();
    texture_camera camera;
    normal_measured m;
    spec.width = spec.height = SIDE;
    spec.fov_y = 2 * atan(tangent * SIDE / 1080) * 180 / 3.14159265358979323846;
    spec.half_height = half * SIDE / 1080;
    assert_null(camera_init(&camera, &c.setups[0], &spec));
    const double radius = (ortho ? 1 : z) * RADIUS * 2 * half / 1080;
    const double sphere[] = {z, radius, z + 2 * radius, 0};
    assert_true(normal_measure(normal_find(method), &camera, synthetic_find("sphere"), sphere, 0, SIDE, &m));
    return m.edges.mean * 180 / 3.14159265358979323846;
}

/* The depths of a point, evenly in their logarithm. */
static double normal_depth(int slice, int i) {
    return 0.1 * pow(1e4, (slice * 4 + i) / 199.0);
}

TEST(normals_of_the_program) {
    static const char *const texts[] = {"low", "medium", "high", "projective", "bound of projective"};
    drawn *d = drawn_run(&drawn_light, "plot normals -F unorm16 -m d3d");
    assert_string_equal(d->title, "Angular error of normals from depth");
    assert_string_equal(d->subtitle, "unorm16 d3d, near 0.1, far 1000, perspective, nearest, exact (lattice of "
                                     "codes); 1080 lines, field of "
                                     "view 60\u00b0; plane: 99 % of the pixels, outline: mean");
    drawn_legend_is(d, 5, texts);
    assert_int_equal(d->panel_count, 2);
    assert_string_equal(d->panels[0].heading, "plane at 60\u00b0");
    assert_string_equal(d->panels[1].heading, "outline of a sphere");
    for (int m = 0; m < 8; m++) {
        const drawn_panel *p = &d->panels[m / 4];
        for (int slice = 8; slice < 50; slice += 20) { /* each point is the worst of four depths */
            double worst = 0, top, bottom;
            for (int i = 0; i < 4; i++)
                worst = fmax(worst, m < 4 ? mapped(texts[m % 4], normal_depth(slice, i))
                                          : outlined(texts[m % 4], normal_depth(slice, i), false));
            const double x = p->frame.x0 + (p->frame.x1 - p->frame.x0) * (slice + 0.5) / 50;
            assert_true(drawn_reach(drawn_curve(d, p, &d->entries[m % 4]), x - 0.5, x + 0.5, &top, &bottom));
            assert_px((top + bottom) / 2, drawn_px(&p->y, worst), 2);
        }
    }
    drawn_close(d);
}

/* A sphere of an orthographic camera is as large in the image wherever it is. */
TEST(normals_without_a_perspective) {
    static const char *const texts[] = {"low", "medium", "high", "projective"};
    drawn *d = drawn_run(&drawn_light, "plot normals -F unorm16 -m d3d --ortho");
    const drawn_panel *p = &d->panels[1];
    assert_true(p->x.log);
    for (int m = 0; m < 4; m++)
        for (int slice = 8; slice < 50; slice += 10) {
            double worst = 0, top, bottom;
            for (int i = 0; i < 4; i++)
                worst = fmax(worst, outlined(texts[m], normal_depth(slice, i), true));
            const double x = p->frame.x0 + (p->frame.x1 - p->frame.x0) * (slice + 0.5) / 50;
            assert_true(drawn_reach(drawn_curve(d, p, &d->entries[m]), x - 0.5, x + 0.5, &top, &bottom));
            assert_px((top + bottom) / 2, drawn_px(&p->y, worst), 2);
        }
    drawn_close(d);
}

/* As many set-ups as it shows where none are named, and each panel says all of what it shows. */
TEST(normals_by_default) {
    cameras c = cameras_of(drawn_camera(0.1, 1000), "fp32,unorm24", "d3d,reversed");
    drawn *d = drawn_run(&drawn_light, "plot normals");
    assert_int_equal(d->panel_count, c.count + 1);
    for (size_t i = 0; i < d->panel_count; i++)
        check_heading(&d->panels[i], i < c.count ? c.names[i] : NULL, i == c.count);
    drawn_close(d);
}
