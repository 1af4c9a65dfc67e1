/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far normals from depth are off: methods measured on a plane and at the outline of a sphere, at each depth. */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "core/bits.h"
#include "core/elementary.h"
#include "draw/theme.h"
#include "plot/figure.h"
#include "plot/refine.h"
#include "texture/normal_errors.h"

/* Each point of a curve stands for so many pixel columns, and each depth in it is an image of its own: how its pixels
 * meet the codes is chance, so the worst of some is shown. */
enum { COLUMNS_EACH = 16, DEPTHS_EACH = 4 };

/* The middle of an image of 1080 lines with a field of view of 60 degrees (orthographic: 10 units high). */
enum { SIDE = 48, LINES = 1080, RADIUS = 16, PLANE = 0, SPHERE };

static const char *const surfaces[] = {"plane at 60\u00b0", "outline of a sphere"};
static const int methods[] = {NORMAL_LOW, NORMAL_MEDIUM, NORMAL_HIGH, NORMAL_PROJECTIVE}; /* behind them the bound */
enum { BOUND = sizeof methods / sizeof methods[0] };

static bool middle(const dp_setup *setup, texture_camera *camera) {
    camera_spec spec = camera_spec_default();
    const double share = (double)SIDE / LINES;
    spec.width = spec.height = SIDE;
    spec.fov_y = 2 * dp_atan(dp_half_tangent(spec.fov_y) * share) / DP_DEGREE;
    spec.half_height *= share;
    return camera_init(camera, setup, &spec) == NULL;
}

/* The largest over the image; it changes slowly, so some pixels stand for all. */
static double bound_of(const texture_camera *camera, const double *parameters) {
    enum { APART = 8 };
    const synthetic_row *wall = &synthetic_rows[SYNTHETIC_PLANE];
    synthetic_hit hit;
    double worst = 0;
    wall->hit(camera, parameters, SIDE / 2, SIDE / 2, &hit);
    if (hit.surface == 0)
        return NAN;
    const normal_plane plane = normal_plane_at(camera, SIDE / 2, SIDE / 2, hit.z, hit.normal);
    for (uint32_t i = 0; i < SIDE; i += APART)
        for (uint32_t j = 0; j < SIDE; j += APART) {
            const double error = normal_plane_error(camera, i, j, &plane, DP_UNIT);
            if (isfinite(error))
                worst = fmax(worst, normal_plane_bound(camera, i, j, &plane, error));
        }
    return worst / DP_DEGREE;
}

/* A plane slanted askew: cos 33 cos 53.4 = 1/2. A sphere as large in the image at every depth, and a wall behind it as
 * far as it is large. */
static double drawn_error(const dp_setup *setup, size_t surface, size_t method, double z) {
    texture_camera camera;
    normal_measured m;
    if (!middle(setup, &camera))
        return NAN;
    const double radius = RADIUS * 2 * camera.half[1] / SIDE * (camera.ortho ? 1 : z);
    const double plane[] = {z, 33, 53.4, 0}, sphere[] = {z, radius, z + 2 * radius, 0};
    if (method == BOUND)
        return bound_of(&camera, plane);
    if (!normal_measure(&normal_methods[methods[method]], &camera,
                        &synthetic_rows[surface == PLANE ? SYNTHETIC_PLANE : SYNTHETIC_SPHERE],
                        surface == PLANE ? plane : sphere, 0, SIDE, &m))
        return NAN;
    const bool whole = z - radius >= setup->spec.znear && m.sky == 0; /* neither sphere nor wall leaves the view */
    return (surface == PLANE ? m.inside.p99 : whole ? m.edges.mean : (double)NAN) / DP_DEGREE;
}

/* The worst of `count` set-ups. */
static void add_curve(const figure_request *request, const dp_setup *setups, size_t count, normals_error *error,
                      chart *out, chart_panel *panel, size_t surface, size_t method) {
    const chart_axis *x = &panel->x;
    const int slices = request->columns / COLUMNS_EACH, last = slices * DEPTHS_EACH - 1;
    chart_series *s = chart_add_series(out, panel, CHART_LINE, (size_t)slices);
    if (s == NULL)
        return;
    s->style =
        method == BOUND
            ? (chart_style){.colour = -1, .stroke = THEME_DOTTED, .marker = -1, .thin = true}
            : (chart_style){.colour = (int)method, .stroke = THEME_DOTTED * (int)(method % 2), .marker = (int)method};
    snprintf(s->name, sizeof s->name, "%s",
             method == BOUND ? "bound of projective" : normal_methods[methods[method]].name);
    for (int k = 0; k < slices; k++) {
        double worst = NAN;
        for (int i = k * DEPTHS_EACH; i < (k + 1) * DEPTHS_EACH; i++) /* fmax drops NaN */
            for (size_t j = 0; j < count; j++)
                worst = fmax(worst, error(&setups[j], surface, method, refine_edge(x->scale, x->lo, x->hi, i, last)));
        s->x[k] = refine_edge(x->scale, x->lo, x->hi, 2 * k + 1, 2 * slices);
        s->y[k] = worst > 0 ? worst : (double)NAN; /* a log axis has no 0 */
    }
}

/* Outlines are much the same in each format: all of them are one panel, planes have one each. */
const char *normals_draw(const figure_request *request, normals_error *error, chart *out) {
    const chart_axis y = {.scale = CHART_LOG, .label = "angular error", .key = "error", .unit = "degrees"};
    const bool alone = request->count == 1; /* then the subtitle names it */
    for (size_t i = 0; i <= request->count; i++) {
        const bool plane = i < request->count;
        chart_panel *panel = figure_panel(request, out, y);
        snprintf(panel->title, sizeof panel->title, "%s%s%s%s", alone || !plane ? "" : request->names[i],
                 alone || !plane ? "" : ": ", surfaces[plane ? PLANE : SPHERE],
                 alone || plane ? "" : " (worst of all)");
        for (size_t method = 0; method < (plane ? BOUND + 1 : BOUND); method++)
            add_curve(request, &request->setups[plane ? i : 0], plane ? 1 : request->count, error, out, panel,
                      plane ? PLANE : SPHERE, method);
    }
    chart_fit(out);
    return NULL;
}

const char *normals_build(const figure_request *request, chart *out) {
    append(out->subtitle, sizeof out->subtitle, "; 1080 lines, %s; plane: 99 %% of the pixels, outline: mean",
           request->setups[0].spec.ortho ? "10 units high" : "field of view 60\u00b0");
    return normals_draw(request, drawn_error, out);
}
