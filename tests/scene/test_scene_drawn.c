/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What is said of a finding, drawn: models of slanted walls with decals at several gaps, their vertices rounded to
 * binary32, are searched and judged, then drawn from random places by the models of src/raster, which recorded codes
 * guard, the farther surface first. Nearer than `certain_to` no pixel shows it where the nearer one is drawn too;
 * beyond `ties_from` some do. Which one is nearer is known from how the model was made.
 */
#include "depthprec/depthprec.h"
#include "raster/draw.h"
#include "scene/eye.h"
#include "scene/find.h"
#include "scene/judge.h"
#include "scene_made.h"
#include "support.h"

enum { PARTS = 4, SIDE = 256, DECALS = 3, EYES = 6, FARTHER = 1, NEARER = 2 };

static const double degree = 3.14159265358979323846 / 180.0;
static const char *const rasterizers[] = {"llvmpipe", "lavapipe", "softpipe", "swiftshader"};
static const char *const formats[] = {"fp32", "unorm24", "unorm16"};

/* Tallies of the drawings of one rasterizer and format. */
typedef struct outcome {
    tally pixels, found;
    uint64_t drawings, wrong; /* and those with wrong pixels */
    double nearest_wrong;     /* the least share of certain_to at which a pixel beyond it was wrong */
} outcome;

/* A plane, and the mesh of triangles that it is covered with: its axes have the lengths of cells. */
typedef struct wall {
    double at[3], normal[3], u[3], v[3];
    double slant; /* at which the cells are as wide as high, degrees; they are drawn out along u */
} wall;

typedef struct stage {
    const raster_row *row;
    dp_setup setup;
    draw_camera camera;
    draw_buffer buffer;
    wall wall;
    double gap[DECALS + 1]; /* of each surface before the wall, which is surface 0 */
    scene_made *made;
} stage;

/* ---- The model --------------------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void random_direction(rng *r, double out[3]) {
    const double z = rng_uniform(r, -1, 1), angle = rng_uniform(r, 0, 360 * degree), across = sqrt(1 - z * z);
    out[0] = across * cos(angle);
    out[1] = across * sin(angle);
    out[2] = z;
}

/* A direction at right angles to a normal, and the one that makes a right-handed frame with both. */
static void random_axes(rng *r, const double n[3], double u[3], double v[3]) {
    double any[3], length = 0.0;
    do {
        random_direction(r, any);
        for (int k = 0; k < 3; k++)
            u[k] = any[(k + 1) % 3] * n[(k + 2) % 3] - any[(k + 2) % 3] * n[(k + 1) % 3];
        length = sqrt(dot(u, u));
    } while (length < 0.1);
    for (int k = 0; k < 3; k++)
        u[k] /= length;
    for (int k = 0; k < 3; k++)
        v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
}

/* Cells that are about so many pixels wide and high at a depth. */
static void random_wall(rng *r, stage *s, double z) {
    wall *w = &s->wall;
    const double size = rng_log(r, 5, 150) * 2 * z / ((double)s->camera.p11 * s->camera.target.height);
    random_direction(r, w->normal);
    random_axes(r, w->normal, w->u, w->v);
    for (int k = 0; k < 3; k++) {
        w->at[k] = rng_uniform(r, -2, 2) * z;
        w->u[k] *= size / cos(w->slant * degree);
        w->v[k] *= size;
    }
}

/* A mesh of cells x cells on the plane a gap before the wall, its vertices moved by up to a quarter of a cell. */
static void add_mesh(rng *r, stage *s, double gap, int cells, double turn) {
    double place[7][7][3];
    const double along = cos(turn), across = sin(turn), off[2] = {rng_uniform(r, -1, 1), rng_uniform(r, -1, 1)};
    for (int i = 0; i <= cells; i++)
        for (int k = 0; k <= cells; k++) {
            const double x = i - 0.5 * cells + rng_uniform(r, -0.25, 0.25);
            const double y = k - 0.5 * cells + rng_uniform(r, -0.25, 0.25);
            for (int axis = 0; axis < 3; axis++) /* vertices are binary32 */
                place[i][k][axis] = (double)(float)(s->wall.at[axis] + gap * s->wall.normal[axis] +
                                                    s->wall.u[axis] * (x * along - y * across + off[0]) +
                                                    s->wall.v[axis] * (x * across + y * along + off[1]));
        }
    for (int i = 0; i < cells; i++)
        for (int k = 0; k < cells; k++) {
            scene_made_triangle(s->made, place[i][k], place[i + 1][k], place[i + 1][k + 1]);
            scene_made_triangle(s->made, place[i][k], place[i + 1][k + 1], place[i][k + 1]);
        }
}

static bool make_model(rng *r, stage *s, double z, double gap, finder_found *found) {
    static const char *const names[] = {"wall", "first", "second", "third"};
    const double apart[] = {0, gap, 1.7 * gap, 4 * gap};
    random_wall(r, s, z);
    scene_made_begin(s->made);
    for (int i = 0; i <= DECALS; i++) {
        s->gap[i] = apart[i];
        scene_made_surface(s->made, names[i], "");
        add_mesh(r, s, apart[i], i == 0 ? 6 : 3, i == 0 ? 0 : rng_uniform(r, 0, 360 * degree));
    }
    const finder_asked asked = {.gap = 8 * gap, .angle = 89, .threads = 1};
    return finder_find(&s->made->m, &asked, found) == FINDER_DONE;
}

/* ---- The camera -------------------------------------------------------------------------------------------------- */

static bool set_camera(rng *r, stage *s, const char *raster, const char *format) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, DP_MAPPING_GL};
    static const int sizes[][2] = {{1920, 1080}, {1280, 720}, {2048, 2048}, {800, 600}};
    const int size = (int)rng_below(r, 4);
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    s->row = raster_find(raster);
    assert_int_equal(dp_format_parse(format, found), 1);
    if (!raster_draws(s->row, found) || !raster_bounded(s->row, found))
        return false;
    spec.format = found[0];
    spec.model = DP_MODEL_FLOAT;
    spec.znear = rng_log(r, 0.05, 1);
    spec.zfar = rng_below(r, 2) == 0 ? INFINITY : spec.znear * rng_log(r, 1e3, 1e5);
    spec.triangles = dp_triangles_default();
    spec.triangles.width = sizes[size][0];
    spec.triangles.height = sizes[size][1];
    spec.triangles.fov_y = rng_uniform(r, 30, 90);
    raster_describe(s->row, &spec.triangles);
    do
        spec.mapping = mappings[rng_below(r, 3)];
    while (!raster_arith(s->row, dp_mapping_get(spec.mapping)->ndc_signed, &spec.arith));
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(&s->camera, s->row, &s->setup), RASTER_OK);
    return true;
}

/* An eye that sees a place at a depth, and the wall at about its slant, drawn out along the tilt. */
static bool random_eye(rng *r, const stage *s, const double place[3], double z, scene_eye *eye) {
    const wall *w = &s->wall;
    const double slant = (w->slant + rng_uniform(r, -1, 1) * fmin(w->slant, 4)) * degree;
    const double length = sqrt(dot(w->u, w->u)), side = rng_below(r, 2) == 0 ? 1.0 : -1.0;
    double from[3], up[3];
    for (int k = 0; k < 3; k++)
        from[k] = place[k] + z * (cos(slant) * w->normal[k] + side * sin(slant) / length * w->u[k]);
    random_direction(r, up);
    return scene_eye_look(from, place, up, eye);
}

static double plane_of(const stage *s, const scene_eye *eye, int surface, draw_plane *out) {
    double at[3], seen[3];
    for (int k = 0; k < 3; k++)
        at[k] = s->wall.at[k] + s->gap[surface] * s->wall.normal[k];
    scene_eye_sees(eye, at, seen);
    out->normal[0] = -dot(s->wall.normal, eye->right);
    out->normal[1] = -dot(s->wall.normal, eye->up);
    out->normal[2] = -dot(s->wall.normal, eye->ahead);
    return out->distance = dot(out->normal, seen);
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

/* Whether a triangle is drawn whole and is of the class, with a little to spare for what snapping moves. */
static bool in_class(const stage *s, const double seen[3][3], double depth) {
    const dp_triangles *class = &s->setup.spec.triangles;
    double at[3][2], longest = 0.0, widest = 0.0;
    const double nearest = fmin(fmin(seen[0][2], seen[1][2]), seen[2][2]);
    const double farthest = fmax(fmax(seen[0][2], seen[1][2]), seen[2][2]);
    if (!(nearest > 1.001 * s->setup.spec.znear && farthest < 0.999 * s->setup.spec.zfar))
        return false;
    for (int i = 0; i < 3; i++) {
        at[i][0] = 0.5 * class->width * (1 + (double)s->camera.p00 * seen[i][0] / seen[i][2]);
        at[i][1] = 0.5 * class->height * (1 + (double)s->camera.p11 * seen[i][1] / seen[i][2]);
        if (!(at[i][0] > 1 && at[i][0] < class->width - 1 && at[i][1] > 1 && at[i][1] < class->height - 1))
            return false;
    }
    const double area =
        fabs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]));
    for (int i = 0; i < 3; i++) {
        const double x = fabs(at[i][0] - at[(i + 1) % 3][0]), y = fabs(at[i][1] - at[(i + 1) % 3][1]);
        longest = fmax(longest, hypot(x, y));
        widest = fmax(widest, fmax(x, y));
    }
    return area > 4 && widest < class->pixels - 1 && longest * longest < 0.9 * class->slim * area &&
           farthest < 0.98 * depth * nearest;
}

static bool draw_surface(stage *s, const scene_eye *eye, uint32_t surface, double depth, unsigned who) {
    const model *m = &s->made->m;
    bool drawn = false;
    for (size_t i = 0; i < m->triangles; i++) {
        double seen[3][3];
        if (m->of[i] != surface)
            continue;
        for (int k = 0; k < 3; k++)
            scene_eye_sees(eye, m->position[m->triangle[i][k]], seen[k]);
        if (in_class(s, (const double(*)[3])seen, depth))
            drawn |= draw_triangle(&s->buffer, &s->camera, (const double(*)[3])seen, who);
    }
    return drawn;
}

/* Draws two surfaces; false where one of them is not seen. */
static bool draw_both(stage *s, const scene_eye *eye, const finder_finding *f, draw_plane *farther) {
    const double depth = s->setup.spec.triangles.depth;
    const double away = plane_of(s, eye, (int)f->a, farther);
    const double left = 1 - (s->gap[f->b] - s->gap[f->a]) / away; /* of a depth, at the nearer surface */
    const int middle[2] = {s->camera.target.width / 2, s->camera.target.height / 2};
    draw_buffer_clear(&s->buffer, (draw_area){middle[0] - SIDE / 2, middle[1] - SIDE / 2, SIDE, SIDE});
    return away > 0 && left > 0 && draw_surface(s, eye, f->a, depth, FARTHER) &&
           draw_surface(s, eye, f->b, depth * left, NEARER);
}

/* The least depth at which both were drawn and the farther one is seen; those nearer than `from` are counted. */
static double least_wrong(const stage *s, const draw_plane *farther, double from, uint64_t *pixels) {
    const draw_area *area = &s->buffer.area;
    double least = INFINITY;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double window[2] = {area->x + i % SIDE + 0.5, area->y + i / SIDE + 0.5};
        if (s->buffer.seen[i] != (FARTHER | NEARER))
            continue;
        const double z = farther->distance / draw_facing(&s->camera, farther, window);
        *pixels += z < from;
        if (s->buffer.winner[i] == FARTHER)
            least = fmin(least, z);
    }
    return least;
}

/* ---- Nearer than certain_to -------------------------------------------------------------------------------------- */

static void judge_finding(rng *r, stage *s, const finder_finding *f, outcome *out) {
    const double znear = s->setup.spec.znear, end = fmin(s->setup.spec.zfar, 1e4 * znear);
    const scene_verdict v = scene_judge(&s->setup, f->gap_min, f->gap_max, end);
    const double apart = s->gap[f->b] - s->gap[f->a];
    TALLY(&out->found, f->a < f->b && f->gap_min > 0.9 * apart && f->gap_max >= f->gap_min && f->gap_max < 1.1 * apart,
          "%g to %g, not %g", f->gap_min, f->gap_max, apart);
    for (int i = 0; i < EYES && v.certain_to > 1.5 * znear; i++) {
        const double share = i == 0 ? rng_log(r, 1, 8) : rng_below(r, 2) == 0 ? 0.95 : rng_log(r, 0.2, 1);
        scene_eye eye;
        draw_plane farther;
        if (!random_eye(r, s, f->place, share * v.certain_to, &eye) || !draw_both(s, &eye, f, &farther))
            continue;
        const double certain = v.certain_to * (1 - 1e-5); /* the wall's vertices are rounded */
        const double wrong = least_wrong(s, &farther, certain, &out->pixels.cases);
        out->drawings++;
        if (wrong < certain)
            tally_fail(&out->pixels, "%s %s: a wrong pixel at %.17g, though certain to %.17g, %g apart, slant %g",
                       s->row->name, s->setup.spec.format.name, wrong, v.certain_to, f->gap_min, s->wall.slant);
        else
            out->nearest_wrong = fmin(out->nearest_wrong, wrong / v.certain_to);
    }
}

/* A gap that the camera tells apart up to some depth. */
static void certain_model(rng *r, stage *s, outcome *out) {
    const double znear = s->setup.spec.znear, z = rng_log(r, 4 * znear, fmin(0.5 * s->setup.spec.zfar, 3000 * znear));
    const double gap = dp_separation(&s->setup, z);
    finder_found found;
    s->wall.slant = rng_below(r, 4) == 0 ? rng_uniform(r, 70, 84) : rng_uniform(r, 0, 70);
    if (!(gap < 0.2 * z) || !make_model(r, s, z, gap, &found))
        return;
    TALLY(&out->found, found.findings > 0, "no finding at %g apart", gap);
    for (size_t i = 0; i < found.findings; i++)
        judge_finding(r, s, &found.finding[i], out);
    finder_free(&found);
}

/* ---- Beyond ties_from -------------------------------------------------------------------------------------------- */

/* Surfaces that face the camera but for a few degrees, so that their depths run through several cells. */
static void ties_model(rng *r, stage *s, outcome *out) {
    const double znear = s->setup.spec.znear, end = fmin(0.5 * s->setup.spec.zfar, 1e4 * znear);
    const double z = rng_log(r, 8 * znear, end / 8);
    dp_setup exact = s->setup;
    finder_found found;
    exact.spec.model = DP_MODEL_EXACT;
    if (dp_setup_init(&exact, &exact.spec) != DP_OK)
        return;
    const double width = dp_cell_of(&exact, dp_code(&exact, z)).width;
    s->wall.slant = 10;
    if (!(width < 0.005 * z) || !make_model(r, s, z, width / 4, &found))
        return;
    for (size_t i = 0; i < found.findings; i++) {
        const finder_finding *f = &found.finding[i];
        const scene_verdict v = scene_judge(&s->setup, f->gap_min, f->gap_max, end);
        scene_eye eye;
        draw_plane farther;
        uint64_t pixels = 0;
        if (!(v.ties_from < end / 3) ||
            !random_eye(r, s, f->place, fmax(v.ties_from, 2 * znear) * rng_uniform(r, 1.5, 3), &eye) ||
            !draw_both(s, &eye, f, &farther))
            continue;
        const double wrong = least_wrong(s, &farther, INFINITY, &pixels);
        if (pixels < 400)
            continue;
        out->drawings++;
        out->wrong += wrong < INFINITY;
        TALLY(&out->pixels, wrong < INFINITY, "%s %s: none of %d pixels at %g ties, though all may from %g, %g apart",
              s->row->name, s->setup.spec.format.name, (int)pixels, v.ties_from, v.ties_from, f->gap_max);
    }
    finder_free(&found);
}

/* ---- All rasterizers --------------------------------------------------------------------------------------------- */

typedef void one_model(rng *r, stage *s, outcome *out);

/* Until so many pixels, or drawings, have been judged. */
static void judge_part(const char *raster, const char *format, int part, uint64_t cases, one_model *each,
                       outcome *out) {
    char name[64];
    stage s = {.made = malloc(sizeof *s.made)};
    snprintf(name, sizeof name, "%s %s %d", raster, format, part);
    rng r = rng_make(name);
    if (s.made != NULL && draw_buffer_open(&s.buffer, SIDE * SIDE)) {
        while (out->pixels.cases < cases && set_camera(&r, &s, raster, format))
            each(&r, &s, out);
        draw_buffer_close(&s.buffer);
    }
    free(s.made);
}

static void add_tally(tally *to, const tally *part) {
    to->cases += part->cases;
    if (part->failures > 0 && to->failures == 0)
        memcpy(to->first, part->first, sizeof to->first);
    to->failures += part->failures;
}

/* One rasterizer and format, in parts that may run at once. */
static outcome judge_all(const char *raster, const char *format, uint64_t cases, one_model *each) {
    const int parts = test_effort() == EFFORT_QUICK ? 1 : PARTS; /* a model is the least that is drawn */
    outcome part[PARTS], all = {.pixels = {.name = raster}, .found = {.name = "gaps"}, .nearest_wrong = INFINITY};
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < parts; i++) {
        part[i] = (outcome){.nearest_wrong = INFINITY};
        judge_part(raster, format, i, cases / (uint64_t)parts, each, &part[i]);
    }
    for (int i = 0; i < parts; i++) {
        add_tally(&all.pixels, &part[i].pixels);
        add_tally(&all.found, &part[i].found);
        all.drawings += part[i].drawings;
        all.wrong += part[i].wrong;
        all.nearest_wrong = fmin(all.nearest_wrong, part[i].nearest_wrong);
    }
    return all;
}

TEST(certain) {
    const uint64_t cases = test_cases(100000, 1500000, 12000000);
    uint64_t pixels = 0;
    for (int i = 0; i < 4; i++)
        for (int f = 0; f < 3; f++) {
            const outcome o = judge_all(rasterizers[i], formats[f], cases, certain_model);
            if (o.drawings == 0)
                continue;
            print_message("# %s %s: %lu pixels of %lu drawings; beyond, wrong ones from %.3g of the depth on\n",
                          rasterizers[i], formats[f], (unsigned long)o.pixels.cases, (unsigned long)o.drawings,
                          o.nearest_wrong);
            tally_end(&o.pixels);
            tally_end(&o.found);
            assert_true(test_effort() == EFFORT_QUICK || o.nearest_wrong < 8);
            pixels += o.pixels.cases;
        }
    print_message("# %lu pixels\n", (unsigned long)pixels);
    assert_true(pixels >= 8 * cases);
}

TEST(ties) {
    for (int i = 0; i < 4; i++)
        for (int f = 0; f < 3; f++) {
            const outcome o = judge_all(rasterizers[i], formats[f], test_cases(32, 160, 6400), ties_model);
            if (o.drawings == 0)
                continue;
            print_message("# %s %s: %lu of %lu drawings tie\n", rasterizers[i], formats[f], (unsigned long)o.wrong,
                          (unsigned long)o.drawings);
            tally_end(&o.pixels);
        }
}
