/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Models of one triangle in both views of plot scene, field by field: shown where it is, at its distance from the one
 * who looks, and nowhere else; one that is seen from its edge as a line without gaps. The places are barycentric.
 */
#include "plot/figure.h"
#include "scene/figure.h"
#include "scene/find.h"
#include "support.h"

/* Coordinates across, upwards and along the direction of view, which grow away from the one who looks or do not. */
static const struct seen {
    const char *title;
    int across, up, along;
    bool away;
} views[] = {
    {"From above: x to the right, z downwards", 0, 2, 1, false},
    {"From the front: x to the right, y upwards", 0, 1, 2, false},
    {"From above: z to the right, x upwards", 2, 0, 1, false},
    {"From the side: z to the right, y upwards", 2, 1, 0, true},
};
enum { VIEWS = sizeof views / sizeof views[0] };

static const struct seen *view_of(const chart_panel *p) {
    for (size_t i = 0; i < VIEWS; i++)
        if (strcmp(views[i].title, p->title) == 0)
            return &views[i];
    fail_msg("no view is called %s", p->title);
    return NULL;
}

/* Corners in fields from the first one's outer edge, and their distances, of which the extent is 1. */
typedef struct flat {
    double x[3], y[3], value[3];
} flat;

static flat flat_of(const chart_panel *p, const struct seen *v, double corner[3][3]) {
    const chart_map *m = &p->map;
    const double wide = (m->x[m->columns - 1] - m->x[0]) / (m->columns - 1);
    const double high = m->rows > 1 ? (m->y[m->rows - 1] - m->y[0]) / (m->rows - 1) : p->y.hi - p->y.lo;
    const double lo = fmin(fmin(corner[0][v->along], corner[1][v->along]), corner[2][v->along]);
    const double hi = fmax(fmax(corner[0][v->along], corner[1][v->along]), corner[2][v->along]);
    flat f;
    for (int i = 0; i < 3; i++) {
        f.x[i] = (corner[i][v->across] - m->x[0]) / wide + 0.5;
        f.y[i] = (corner[i][v->up] - m->y[0]) / high + 0.5;
        f.value[i] = (v->away ? corner[i][v->along] - lo : hi - corner[i][v->along]) / (hi - lo);
    }
    return f;
}

/* Twice the area to the left of the edge that begins at corner i. */
static double side_of(const flat *f, int i, double x, double y) {
    const int k = (i + 1) % 3;
    return (f->x[k] - f->x[i]) * (y - f->y[i]) - (f->y[k] - f->y[i]) * (x - f->x[i]);
}

/* The distance of a place from the triangle, 0 within. */
static double beside(const flat *f, double x, double y) {
    const double area = side_of(f, 0, f->x[2], f->y[2]);
    double least = HUGE_VAL;
    bool within = true;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3;
        const double dx = f->x[k] - f->x[i], dy = f->y[k] - f->y[i];
        const double along = ((x - f->x[i]) * dx + (y - f->y[i]) * dy) / (dx * dx + dy * dy);
        const double t = fmin(fmax(along, 0), 1);
        within = within && side_of(f, i, x, y) * area > 0;
        least = fmin(least, hypot(x - f->x[i] - t * dx, y - f->y[i] - t * dy));
    }
    return within ? 0 : least;
}

static void check_surface(tally *t, const chart_panel *p, const flat *f) {
    const double area = side_of(f, 0, f->x[2], f->y[2]);
    double steep = 0; /* of the values, in two directions, together */
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3;
        steep += (fabs(f->x[k] - f->x[i]) + fabs(f->y[k] - f->y[i])) * f->value[(i + 2) % 3] / fabs(area);
    }
    for (int row = 0; row < p->map.rows; row++)
        for (int column = 0; column < p->map.columns; column++) {
            const double x = column + 0.5, y = row + 0.5, off = beside(f, x, y);
            const double got = p->map.under[(size_t)row * (size_t)p->map.columns + (size_t)column];
            if (off > 1)
                TALLY(t, isnan(got), "%s: %g of a field beside it shows %g", p->title, off, got);
            if (off > 0)
                continue;
            double want = 0;
            for (int i = 0; i < 3; i++)
                want += side_of(f, i, x, y) / area * f->value[(i + 2) % 3];
            TALLY(t, fabs(got - want) <= steep + 1e-9, "%s: column %d, row %d shows %g, not %g", p->title, column, row,
                  got, want);
        }
}

/* The nearest that the edges of what is seen as a line are, so far along its way from corner 0 to corner 1. */
static double nearest_at(const flat *f, const double along[3], double at) {
    double least = HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3;
        const double t = (at - along[i]) / (along[k] - along[i]);
        if (t >= 0 && t <= 1)
            least = fmin(least, f->value[i] + t * (f->value[k] - f->value[i]));
    }
    return least;
}

/* A field in each column that the line runs through, or in each row where it is the steeper one. */
static void check_line(tally *t, const chart_panel *p, const flat *f, double part) {
    const double along[3] = {0, 1, part};
    const double dx = f->x[1] - f->x[0], dy = f->y[1] - f->y[0];
    const bool flatter = fabs(dx) >= fabs(dy);
    const double length = flatter ? dx : dy, first = flatter ? f->x[0] : f->y[0];
    const double steep = (1 / part + 1 / (1 - part)) * 2 / fabs(length); /* values in a field and the next */
    const double lo = fmin(first, first + length), hi = fmax(first, first + length);
    for (int i = (int)ceil(lo); i + 1 < hi; i++) {
        const double at = (i + 0.5 - first) / length, want = nearest_at(f, along, at);
        const int other = (int)floor(flatter ? f->y[0] + at * dy : f->x[0] + at * dx);
        double nearest = HUGE_VAL;
        for (int k = other - 1; k <= other + 1; k++) {
            const int row = flatter ? k : i, column = flatter ? i : k;
            const bool there = row >= 0 && row < p->map.rows && column >= 0 && column < p->map.columns;
            const double got =
                there ? p->map.under[(size_t)row * (size_t)p->map.columns + (size_t)column] : (double)NAN;
            nearest = fmin(nearest, got); /* without NaN */
        }
        TALLY(t, fabs(nearest - want) <= steep, "%s: a line shows %g, not %g, at %g", p->title, nearest, want, at);
    }
    for (size_t i = 0; i < (size_t)p->map.rows * (size_t)p->map.columns; i++) {
        const double x = (double)(i % (size_t)p->map.columns) + 0.5, y = (double)(i / (size_t)p->map.columns) + 0.5;
        TALLY(t, beside(f, x, y) <= 1 || isnan(p->map.under[i]), "%s: %g, %g is beside the line", p->title, x, y);
    }
}

TEST(a_triangle_is_shown_where_it_is) {
    rng r = rng_make("one triangle");
    tally t = {.name = "triangles"};
    int lines = 0;
    for (uint64_t n = test_cases(60, 300, 3000); n > 0; n--) {
        const bool upright = rng_below(&r, 2) == 0;
        const double stretch = rng_log(&r, 0.2, 5), part = rng_uniform(&r, 0.1, 0.9);
        double corner[3][3];
        uint32_t triangle[1][3] = {{0, 1, 2}};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                corner[i][k] = (k == 2 ? stretch : 1) * rng_uniform(&r, -1, 1);
        for (int k = 0; k < 3 && upright; k += 2)
            corner[2][k] = corner[0][k] + part * (corner[1][k] - corner[0][k]);
        const model m = {.vertices = 3, .triangles = 1, .position = corner, .triangle = triangle};
        const finder_found found = {.extent = 1};
        const fights_asked asked = {.m = &m, .found = &found};
        const figure_request request = {.fights = &asked, .columns = 96, .rows = 96};
        chart *c = chart_new();
        assert_non_null(c);
        assert_null(scene_build(&request, c));
        assert_int_equal(c->panel_count, 2);
        for (int i = 0; i < 2; i++) {
            const chart_panel *p = &c->panels[i];
            const struct seen *v = view_of(p);
            const flat f = flat_of(p, v, corner);
            if (v->along == 1 && upright)
                check_line(&t, p, &f, part);
            else
                check_surface(&t, p, &f);
            lines += v->along == 1 && upright;
        }
        chart_free(c);
    }
    assert_true(lines > 10);
    tally_end(&t);
}
