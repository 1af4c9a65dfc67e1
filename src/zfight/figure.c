/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The fight that a user sees: a striped wall and, before it, a round decal, both at a slant and made of random
 * triangles, drawn by the model of a rasterizer in the middle of the view. On the left the decal is nearer to the wall
 * than is guaranteed at that slant, so near that a good part of it is wrong; on the right it is as far off as that.
 */
#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "core/elementary.h"
#include "plot/figure.h"
#include "raster/fight.h"
#include "raster/mesh.h"

enum { WALL = 1, DECAL = 2 };             /* who is drawn */
enum { PLAIN = 0, STRIPE, COVER, KINDS }; /* what a pixel shows */
enum { COLUMNS = 120, ROWS = 90 };        /* pixels that are shown, at most */

/* The decal's radius, a part of the height shown; a stripe, a part of that; pixels of a cell of the wall's
 * mesh, and of the decal's. */
static const double radius = 0.6, stripe = 0.25, cells[] = {37.0, 23.0};

/* The share of the decal that is to be wrong on the left, and where halving the gap for that ends. */
static const double wanted = 0.1, least_share = 0x1p-14;

typedef struct stage {
    const dp_setup *setup;
    draw_camera camera;
    draw_buffer buffer;
    draw_plane wall;
    double along[2][3]; /* two directions on the wall: across its slope and down it */
    double z, radius;   /* of the middle; of the decal */
    double guaranteed;  /* at every pixel that is shown, scene units */
} stage;

/* The counts of one drawing, with one gap. */
typedef struct shot {
    double share;
    size_t wrong, covered; /* pixels of the decal */
} shot;

/* ---- The scene --------------------------------------------------------------------------------------------------- */

/* Where a place of the window lies on the wall, from its middle. */
static void place_at(const stage *s, double x, double y, double at[2]) {
    const double window[2] = {x, y};
    const double z = s->wall.distance / draw_facing(&s->camera, &s->wall, window);
    double ray[3];
    draw_ray(&s->camera, window, ray);
    ray[2] -= s->z / z;
    for (int k = 0; k < 2; k++)
        at[k] = z * (s->along[k][0] * ray[0] + s->along[k][1] * ray[1] + s->along[k][2] * ray[2]);
}

/* The largest guaranteed separation in the area shown, that of a corner. */
static double guaranteed_over(const stage *s, double slant) {
    const draw_area *a = &s->buffer.area;
    double most = 0.0;
    for (int corner = 0; corner < 4; corner++) {
        const double window[2] = {a->x + (corner & 1) * a->width, a->y + (corner >> 1) * a->height};
        const double z = s->wall.distance / draw_facing(&s->camera, &s->wall, window);
        most = fmax(most, z > 0.0 ? draw_guaranteed(s->setup, slant, z) : (double)INFINITY);
    }
    return most;
}

static int at_most(int x, int most) {
    return x < most ? x : most;
}

static void set_stage(stage *s, const figure_request *request) {
    const double slant = request->slant * DP_DEGREE, azimuth = request->azimuth * DP_DEGREE;
    const int width = s->camera.target.width, height = s->camera.target.height;
    const int columns = at_most(COLUMNS, (width + 1) / 2), rows = at_most(ROWS, (height + 1) / 2);
    s->z = isnan(request->at) ? sqrt(s->setup->spec.znear * fmin(s->setup->spec.zfar, 1e6 * s->setup->spec.znear))
                              : request->at;
    s->wall = (draw_plane){{dp_sin(slant) * dp_cos(azimuth), dp_sin(slant) * dp_sin(azimuth), dp_cos(slant)},
                           s->z * dp_cos(slant)};
    const double along[2][3] = {{-dp_sin(azimuth), dp_cos(azimuth), 0.0},
                                {dp_cos(slant) * dp_cos(azimuth), dp_cos(slant) * dp_sin(azimuth), -dp_sin(slant)}};
    for (int k = 0; k < 2; k++)
        for (int axis = 0; axis < 3; axis++)
            s->along[k][axis] = along[k][axis];
    draw_buffer_clear(&s->buffer, (draw_area){(width - columns) / 2, (height - rows) / 2, columns, rows});
    s->radius = radius * rows * s->z * 2.0 / ((double)s->camera.p11 * height);
    s->guaranteed = guaranteed_over(s, request->slant);
}

/* ---- One picture ------------------------------------------------------------------------------------------------- */

static void draw_surface(stage *s, double distance, unsigned who) {
    const draw_area *a = &s->buffer.area;
    const dp_triangles *class = &s->setup->spec.triangles;
    const double room = fmin(s->camera.target.width, s->camera.target.height) / 10.0;
    const double side = fmin(cells[who - WALL], fmin(class->pixels / 2.0, room));
    const draw_plane plane = {{s->wall.normal[0], s->wall.normal[1], s->wall.normal[2]}, distance};
    const draw_mesh mesh = {{a->x - 2.0 * side, a->y - 2.0 * side},
                            {{side, 0.0}, {0.0, side}},
                            {(int)(a->width / side) + 4, (int)(a->height / side) + 4},
                            who,
                            0.0};
    draw_mesh_plane(&s->buffer, &s->camera, &plane, &mesh, class, who);
}

static int kind_of_wall(const stage *s, const double at[2]) {
    return (int)floor(at[0] / (s->radius * stripe)) % 2 != 0 ? STRIPE : PLAIN;
}

/* Draws with a gap. Each pixel of the map, where not null, gets what it shows: NaN for nothing. */
static shot draw(stage *s, double share, chart_map *m) {
    const draw_area *a = &s->buffer.area;
    shot out = {.share = share};
    draw_buffer_clear(&s->buffer, *a);
    draw_surface(s, s->wall.distance, WALL);
    draw_surface(s, s->wall.distance - share * s->guaranteed, DECAL);
    for (int row = 0; row < a->height; row++)
        for (int column = 0; column < a->width; column++) {
            const size_t i = (size_t)row * (size_t)a->width + (size_t)column;
            double at[2];
            place_at(s, a->x + column + 0.5, a->y + row + 0.5, at);
            const bool covered = dp_hypot(at[0], at[1]) < s->radius && (s->buffer.seen[i] & 1U << (DECAL - 1)) != 0;
            const bool wall = (s->buffer.seen[i] & 1U << (WALL - 1)) != 0;
            const bool shows_wall = wall && (!covered || s->buffer.winner[i] == WALL);
            out.covered += covered && wall;
            out.wrong += covered && shows_wall;
            if (m != NULL)
                *chart_field(m, row, column) = shows_wall ? kind_of_wall(s, at) : covered ? COVER : (double)NAN;
        }
    return out;
}

/* The largest of the halved gaps with which enough of the decal is wrong, or the most of it. */
static double share_of_fight(stage *s) {
    shot worst = {.share = 0.5};
    for (double share = 0.5; share > least_share; share /= 2.0) {
        const shot one = draw(s, share, NULL);
        if (one.wrong > worst.wrong)
            worst = one;
        if ((double)one.wrong >= wanted * (double)one.covered)
            break;
    }
    return worst.share;
}

/* ---- The chart --------------------------------------------------------------------------------------------------- */

static void add_kinds(chart *out, chart_panel *panel) {
    static const struct {
        const char *name;
        int colour;
    } kinds[KINDS] = {[PLAIN] = {"wall", 4}, [STRIPE] = {"its stripes", -1}, [COVER] = {"decal in front of it", 0}};
    for (int k = 0; k < KINDS; k++) {
        chart_series *s = chart_add_series(out, panel, CHART_AREA, 0);
        if (s == NULL)
            return;
        s->style.colour = kinds[k].colour;
        snprintf(s->name, sizeof s->name, "%s", kinds[k].name);
    }
}

static void add_panel(stage *s, double share, chart *out) {
    const draw_area *a = &s->buffer.area;
    const int top = s->camera.target.height - a->y - a->height;
    const char *unit = out->unit != NULL ? out->unit : "";
    chart_panel *panel = chart_add_panel(out);
    panel->x = (chart_axis){.lo = a->x, .hi = a->x + a->width, .label = "column", .key = "column", .unit = "px"};
    panel->y =
        (chart_axis){.scale = CHART_DOWN, .lo = top, .hi = top + a->height, .label = "row", .key = "row", .unit = "px"};
    add_kinds(out, panel);
    if (!chart_add_map(out, panel, a->width, a->height))
        return;
    const shot one = draw(s, share, &panel->map);
    const double wrong = one.covered > 0 ? 100.0 * (double)one.wrong / (double)one.covered : 0.0;
    char part[32] = "";
    if (share < 1.0)
        snprintf(part, sizeof part, "%.3g of ", share);
    snprintf(panel->title, sizeof panel->title, "%.3g%s%s, %sthe guarantee: %.2g %% wrong", share * s->guaranteed,
             *unit != '\0' ? " " : "", unit, part, wrong);
}

static const char *build(const figure_request *request, stage *s, chart *out) {
    const raster_status status = draw_camera_init(&s->camera, request->raster, s->setup);
    if (status != RASTER_OK)
        return raster_status_text(status);
    set_stage(s, request);
    if (!(s->guaranteed < s->wall.distance))
        return "plot fight: no separation is guaranteed there: name another depth with --at, or another --slant";
    add_panel(s, share_of_fight(s), out);
    add_panel(s, 1.0, out);
    out->classes = true;
    out->shape = s->buffer.area.width / (double)s->buffer.area.height;
    out->value = (chart_axis){.lo = 0.0, .hi = KINDS - 1, .label = "shown", .key = "shown", .unit = ""};
    return NULL;
}

const char *fight_build(const figure_request *request, chart *out) {
    stage s = {.setup = &request->setups[0]};
    const dp_triangles *view = &s.setup->spec.triangles;
    if (!draw_buffer_open(&s.buffer, COLUMNS * ROWS)) {
        chart_fail(out);
        return NULL;
    }
    const char *wrong = build(request, &s, out);
    draw_buffer_close(&s.buffer);
    if (wrong != NULL)
        return wrong;
    if (isnan(request->at))
        append(out->subtitle, sizeof out->subtitle, ", at depth %.4g", s.z);
    append(out->subtitle, sizeof out->subtitle, "; %s at %d x %d, field of view %.4g\u00b0, slant %.4g\u00b0",
           request->raster->name, view->width, view->height, view->fov_y, request->slant);
    return NULL;
}
