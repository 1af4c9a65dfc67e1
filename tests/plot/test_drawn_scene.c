/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The fights of a model as drawn: both views of a street and of the same street turned by a quarter, place by place,
 * against rectangles by hand; colours through the bar; the numbers beside their places; what CSV has of it.
 */
#include <jansson.h>

#include "drawn.h"
#include "drawn_map.h"
#include "support.h"

#define STREET "tests/models/street.obj"
#define CAMERA "--separation 0.02 -F unorm16 -m d3d"

/* Rectangles in x, y, z; the fight of wall and sign is the nearer one. */
typedef struct part {
    double lo[3], hi[3];
    int fight; /* of the list that scene prints; -1: none, but there is something */
} part;

static const part parts[] = {
    {{-1, 0, -4}, {1, 0, 4}, 1},           {{21, 1, 0}, {22, 3, 0}, 0},   {{-8, 0, -8}, {8, 0.0156, 8}, -1},
    {{20, 0, -0.001}, {24, 4, 0.001}, -1}, {{-6, 3, -2}, {-4, 3, 2}, -1}, /* a table on the road, of the street that is
                                                                             turned */
};

enum { PARTS = sizeof parts / sizeof parts[0] };

/* The same, by a quarter about y: x is -z, and z is x. */
static const char *turned_street(void) {
    static char path[320];
    char line[128];
    snprintf(path, sizeof path, "%s/turned.obj", drawn_folder());
    FILE *in = fopen(STREET, "r"), *out = fopen(path, "w");
    assert_true(in != NULL && out != NULL);
    while (fgets(line, sizeof line, in) != NULL) {
        double x, y, z;
        if (sscanf(line, "v %lf %lf %lf", &x, &y, &z) == 3)
            fprintf(out, "v %.17g %.17g %.17g\n", -z, y, x);
        else
            fputs(line, out);
    }
    fputs("o table\nv 2 3 -6\nv 2 3 -4\nv -2 3 -4\nv -2 3 -6\nf -1 -2 -3 -4\n", out);
    fclose(in);
    assert_int_equal(fclose(out), 0);
    return path;
}

static double depths_of(const char *file, double certain[2], double place[2][3]) {
    static const char *const axes[] = {"x", "y", "z"};
    char *text = drawn_output("scene %s %s --json", file, CAMERA);
    json_t *root = json_loads(text, 0, NULL);
    assert_non_null(root);
    for (size_t i = 0; i < 2; i++) {
        const json_t *f = json_array_get(json_object_get(root, "findings"), i);
        certain[i] = json_number_value(json_object_get(f, "certain_to"));
        for (int k = 0; k < 3; k++)
            place[i][k] = json_number_value(json_object_get(json_object_get(f, "place"), axes[k]));
    }
    const double within = json_number_value(json_object_get(root, "within"));
    json_decref(root);
    free(text);
    return within;
}

/* How far a place is within a rectangle of a view, negative outside; a flat one is as thick as a field. */
static double within(const part *p, int across, int up, double x, double y, double thick) {
    const double a = fmin(x - p->lo[across], p->hi[across] - x), b = fmin(y - p->lo[up], p->hi[up] - y);
    return fmin(a, p->hi[up] - p->lo[up] > thick ? b : b + thick);
}

static bool is_grey(uint32_t pixel) {
    return (pixel & 255) == (pixel >> 8 & 255) && (pixel & 255) == (pixel >> 16 & 255);
}

/* A panel whose axes are these of the street as the file has it; `mirrored`: what is across there is negative here. */
typedef struct side {
    int across, up;
    double sign; /* of what is upwards */
    const char *heading;
    int count; /* of parts */
} side;

static void check_side(const drawn *d, const drawn_panel *p, const side *v, const double certain[2]) {
    const double field = fabs(drawn_at(&p->x, p->frame.x0 + 1) - drawn_at(&p->x, p->frame.x0));
    tally t = {.name = v->heading};
    int seen[3] = {0};
    assert_string_equal(p->heading, v->heading);
    assert_px(fabs(p->x.b), fabs(p->y.b), 0.02 * fabs(p->x.b)); /* one scale */
    for (double px = p->frame.x0 + 3; px < p->frame.x1 - 3; px += 2.7)
        for (double py = p->frame.y0 + 3; py < p->frame.y1 - 3; py += 2.3) {
            const double x = drawn_at(&p->x, px), y = v->sign * drawn_at(&p->y, py);
            const uint32_t got = drawn_map_shown(d, p, (svg_point){px, py, false});
            double best = -HUGE_VAL;
            int fight = -2;
            bool edge = false;
            for (int i = 0; i < v->count; i++) {
                const double in = within(&parts[i], v->across, v->up, x, y, 1.5 * field);
                edge = edge || fabs(in) < 3.0 * field;
                if (in > 0.0 && fight == -2)
                    fight = parts[i].fight;
                best = fmax(best, in);
            }
            if (edge)
                continue;
            seen[fight < 0 ? 2 + (fight == -1 ? 0 : -2) : 1]++;
            if (fight == -2)
                TALLY(&t, got == 0, "%g, %g: shows %08x, and there is nothing", x, y, got);
            else if (fight == -1)
                TALLY(&t, got != 0 && is_grey(got), "%g, %g: shows %08x, not grey", x, y, got);
            else
                TALLY(&t, fabs(log(drawn_at(&d->value, drawn_bar_px(d, got)) / certain[fight])) < 0.05,
                      "%g, %g: shows %08x, %g and not %g", x, y, got, drawn_at(&d->value, drawn_bar_px(d, got)),
                      certain[fight]);
        }
    assert_true(seen[0] > 100 && seen[1] > 20 && seen[2] > 20);
    tally_end(&t);
}

/* The table is nearer to the one who looks down than the road, and lighter. */
static void check_table(const drawn *d, const drawn_panel *p) {
    const uint32_t table = drawn_map_shown(d, p, (svg_point){drawn_px(&p->x, -5), drawn_px(&p->y, 0), false});
    const uint32_t road = drawn_map_shown(d, p, (svg_point){drawn_px(&p->x, -5), drawn_px(&p->y, 6), false});
    assert_true(is_grey(table) && is_grey(road));
    assert_in_range((table & 255) - (road & 255), 20, 100);
}

static void check(const char *file, const drawn_theme *look, const side sides[2], const char *x, const char *y) {
    drawn *d = drawn_run(look, "plot scene %s %s --unit m%s", file, CAMERA, look == &drawn_dark ? " --theme dark" : "");
    double certain[2], place[2][3];
    char subtitle[256];
    const double within = depths_of(file, certain, place);
    assert_string_equal(d->title, "Depths from which surfaces may z-fight");
    snprintf(subtitle, sizeof subtitle,
             "%s: 2 pairs of surfaces may z-fight up to %.4g m; unorm16 d3d, near 0.1, far 1000, perspective, "
             "nearest, float ieee, lengths in m",
             strrchr(file, '/') + 1, within);
    assert_string_equal(d->subtitle, subtitle);
    drawn_legend_is(d, 1, (const char *const[]){"the nearest pairs, numbered as in scene"});
    assert_int_equal(d->panel_count, 2);
    assert_string_equal(d->x_caption->text, x);
    assert_string_equal(d->y_caption->text, y);
    assert_string_equal(d->right_caption->text, "may z-fight from (m)");
    drawn_bar_is_viridis(d);
    assert_true(d->panels[0].x.b > 0 && d->panels[1].y.b < 0); /* px grow downwards */
    assert_true((d->panels[0].y.b > 0) == (*x == 'x'));
    for (int k = 0; k < 2; k++) {
        const drawn_panel *p = &d->panels[k];
        const bool turned = strcmp(x, "z (m)") == 0;
        const int across = turned ? 2 : 0, up = k == 1 ? 1 : 2 - across;
        drawn_marker markers[4];
        check_side(d, p, &sides[k], certain);
        if (turned && k == 0)
            check_table(d, p);
        assert_int_equal(drawn_markers(d, p, markers, 4), 2);
        for (int i = 0; i < 2; i++) {
            const svg_point at = {drawn_px(&p->x, place[i][across]), drawn_px(&p->y, place[i][up]), false};
            drawn_label(d, p, at, i == 0 ? "1" : "2");
            assert_true(hypot(markers[i].x - at.x, markers[i].y - at.y) < 1.0);
        }
    }
    drawn_close(d);
}

TEST(test_views) {
    static const side along_x[2] = {{0, 2, 1, "From above: x to the right, z downwards", PARTS - 1},
                                    {0, 1, 1, "From the front: x to the right, y upwards", PARTS - 1}};
    static const side along_z[2] = {{0, 2, -1, "From above: z to the right, x upwards", PARTS},
                                    {0, 1, 1, "From the side: z to the right, y upwards", PARTS}};
    check(STREET, &drawn_light, along_x, "x (m)", "z, y (m)");
    check(turned_street(), &drawn_dark, along_z, "z (m)", "x, y (m)");
}

/* What fights at every depth, a door in its wall, is darker than the nearest that is certain up to some depth, a
 * path. */
TEST(test_darkest) {
    static const double path[] = {10, 8.5}, door[] = {-4.49, 0.7};
    drawn *d = drawn_run(&drawn_light, "plot scene tests/models/house.gltf -F d24 -m d3d --unit m");
    const drawn_panel *p = d->panels, *q = d->panels + 1;
    const uint32_t near = drawn_map_shown(d, p, (svg_point){drawn_px(&p->x, path[0]), drawn_px(&p->y, path[1]), false});
    const uint32_t always =
        drawn_map_shown(d, q, (svg_point){drawn_px(&q->x, door[0]), drawn_px(&q->y, door[1]), false});
    assert_non_null(strstr(d->subtitle, ", the darkest at every depth"));
    assert_true(!is_grey(near) && !is_grey(always));
    assert_true(drawn_at(&d->value, drawn_bar_px(d, always)) < 0.95 * drawn_at(&d->value, drawn_bar_px(d, near)));
    for (int n = 0; n < 18; n++) /* the numbers of both views, which test_views judges */
        assert_non_null(drawn_words(d, (svg_box){0, 0, 9999, 9999}, (char[]){(char)('1' + n / 2), '\0'}));
    drawn_close(d);
}

/* Fields that have a value, and they alone. */
TEST(test_numbers) {
    char *csv = drawn_output("plot scene %s %s --csv", STREET, CAMERA);
    double certain[2], place[2][3], sums[2] = {0};
    int lines = 0, points = 0;
    depths_of(STREET, certain, place);
    char *line = strtok(csv, "\r\n");
    assert_string_equal(line, "panel,series,across [scene units],up [scene units],fights_from [scene units],label");
    for (line = strtok(NULL, "\r\n"); line != NULL; line = strtok(NULL, "\r\n")) {
        const bool above = strstr(line, "From above") != NULL;
        const char *rest = strstr(line, ",map,");
        double x, y, value;
        if (rest == NULL) {
            points++;
            continue;
        }
        assert_int_equal(sscanf(rest, ",map,%lf,%lf,%lf", &x, &y, &value), 3);
        const part *p = &parts[x < 10 ? 0 : 1];
        assert_true(value == certain[p->fight]);
        assert_true(within(p, 0, above ? 2 : 1, x, y, 0.1) > -0.1);
        sums[above] += 1;
        lines++;
    }
    assert_int_equal(points, 4);
    assert_true(lines > 1000 && sums[0] > 100 && sums[1] > 500);
    free(csv);
}
