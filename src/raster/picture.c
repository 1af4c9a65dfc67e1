/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/picture.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"

/* ---- The scene: lengths are parts of its depth --------------------------------------------------------------------
 */

enum { CORNERS = 8 };
enum { LEFT, RIGHT, GROUND, PLANES };
enum { LEFT_WALL = 1, SIGN, RIGHT_WALL, POSTER, ROAD, ROAD_MARKS, LAST = ROAD_MARKS }; /* who draws */

/* Two directions on the plane, and its normal, which looks away from the camera. */
typedef struct plane {
    double slant; /* degrees */
    double origin[3], along[2][3], normal[3];
} plane;

/* A convex polygon: corners along both directions of the plane. Each triangle has the first one. */
typedef struct polygon {
    int plane, who, corners;
    double corner[CORNERS][2];
} polygon;

#define ROOT_HALF  0.70710678118654752440
#define ROOT_THREE 1.73205080756887729353

static const double sway[2] = {0.02, 0.1};     /* sideways, and forth and back */
static const double least = 0.54, most = 1.61; /* depths of all that is drawn, gaps and sway included */
static const double across = 400.0;            /* pixels that the scene's depth takes across the view, at most */

static const plane planes[PLANES] = {
    [LEFT] = {45.0, {-0.62, 0.0, 1.05}, {{ROOT_HALF, 0, ROOT_HALF}, {0, 1, 0}}, {-ROOT_HALF, 0, ROOT_HALF}},
    [RIGHT] = {30.0, {0.26, 0.0, 1.5}, {{0.5 * ROOT_THREE, 0, -0.5}, {0, 1, 0}}, {0.5, 0, 0.5 * ROOT_THREE}},
    [GROUND] = {90.0, {0.0, -0.22, 0.0}, {{1, 0, 0}, {0, 0, 1}}, {0, -1, 0}},
};

/* clang-format off */
#define BOX(LO_U, LO_V, HI_U, HI_V) 4, {{LO_U, LO_V}, {HI_U, LO_V}, {HI_U, HI_V}, {LO_U, HI_V}}
static const polygon polygons[] = {
    {LEFT, LEFT_WALL, BOX(0.0, -0.22, 0.58, 0.29)},
    {LEFT, SIGN, 8, {{0.07, -0.043}, {0.20, -0.173}, {0.38, -0.173}, {0.51, -0.043},
                     {0.51, 0.113}, {0.38, 0.243}, {0.20, 0.243}, {0.07, 0.113}}},
    {RIGHT, RIGHT_WALL, BOX(0.0, -0.22, 0.58, 0.31)},
    {RIGHT, POSTER, BOX(0.06, -0.13, 0.52, 0.25)},
    {GROUND, ROAD, BOX(-0.13, 0.66, 0.15, 1.00)},
    {GROUND, ROAD, BOX(-0.13, 1.00, 0.15, 1.50)},
    {GROUND, ROAD_MARKS, BOX(-0.02, 0.70, 0.04, 0.80)},
    {GROUND, ROAD_MARKS, BOX(-0.02, 0.88, 0.04, 1.02)},
    {GROUND, ROAD_MARKS, BOX(-0.02, 1.13, 0.04, 1.31)},
};
/* clang-format on */
enum { POLYGONS = sizeof polygons / sizeof polygons[0] };

/* Who lies upon whom, a bit as in draw_buffer.seen. */
static const uint8_t upon[LAST + 1] = {
    [LEFT_WALL] = 1 << (SIGN - 1), [RIGHT_WALL] = 1 << (POSTER - 1), [ROAD] = 1 << (ROAD_MARKS - 1)};

static bool is_upon(int who) {
    return who == SIGN || who == POSTER || who == ROAD_MARKS;
}

static void eye_of(unsigned frame, double eye[3]) {
    const double turn = 2.0 * M_PI * (frame % DRAW_PICTURE_FRAMES) / DRAW_PICTURE_FRAMES;
    eye[0] = sway[0] * dp_sin(3.0 * turn);
    eye[1] = 0.0;
    eye[2] = sway[1] * dp_sin(turn);
}

/* About the place straight ahead at the scene's depth, so that slants stay; the ground as long as it is, else it would
 * be flat on the screen. */
static double made_smaller(const draw_picture *p, int on, int k, double at) {
    const double ahead = k == 2 ? 1.0 : 0.0;
    return on == GROUND && k == 2 ? at : ahead + p->scale * (at - ahead);
}

void draw_picture_triangles(const draw_picture *p, double gap, unsigned frame, draw_picture_take *take, void *context) {
    double eye[3];
    eye_of(frame, eye);
    for (int i = 0; i < POLYGONS; i++) {
        const polygon *shape = &polygons[i];
        const plane *on = &planes[shape->plane];
        const double lift = is_upon(shape->who) ? gap : 0.0;
        double place[CORNERS][3], triangle[3][3];
        for (int c = 0; c < shape->corners; c++)
            for (int k = 0; k < 3; k++)
                place[c][k] = p->z * made_smaller(p, shape->plane, k,
                                                  on->origin[k] + shape->corner[c][0] * on->along[0][k] +
                                                      shape->corner[c][1] * on->along[1][k]) -
                              p->z * p->scale * eye[k] - lift * on->normal[k];
        for (int c = 2; c < shape->corners; c++) {
            memcpy(triangle[0], place[0], sizeof triangle[0]);
            memcpy(triangle[1], place[c - 1], sizeof triangle[1]);
            memcpy(triangle[2], place[c], sizeof triangle[2]);
            take(context, (const double(*)[3])triangle, (unsigned)shape->who);
        }
    }
}

/* ---- What is guaranteed ------------------------------------------------------------------------------------------ */

static double guaranteed_by(const dp_setup *setup, double reach) {
    dp_separation_worst found;
    if (setup->spec.model != DP_MODEL_FLOAT || setup->spec.ortho)
        return (double)INFINITY;
    return dp_separation_over(setup, setup->spec.znear, fmin(reach, setup->spec.zfar), 0.0, &found) == DP_OK
               ? found.bound
               : (double)INFINITY;
}

double draw_picture_widest(const draw_picture *p) {
    return DRAW_PICTURE_GAP * p->scale * p->z;
}

/* ---- A picture --------------------------------------------------------------------------------------------------- */

/* The class of the set-up, and that of what is drawn: any slant. */
static dp_triangles class_of(const dp_triangles *asked) {
    const dp_triangles standard = dp_triangles_default();
    dp_triangles out = asked->width > 0 ? *asked : standard;
    out.slant_lo = 0.0;
    out.slant_hi = 90.0;
    out.depth = fmax(out.depth, standard.depth);
    out.pixels = fmax(out.pixels, standard.pixels);
    out.slim = fmax(out.slim, standard.slim);
    return out;
}

/* As what is asked for is guaranteed, and as it is drawn: the same where no rasterizer is named. */
static const char *make_setups(draw_picture *p, const dp_spec *asked, const raster_row *row) {
    const dp_mapping_row *mapping = dp_mapping_get(asked->mapping);
    const bool affine = mapping != NULL && mapping->curve == DP_CURVE_PERSPECTIVE;
    dp_spec spec = *asked;
    spec.model = affine ? DP_MODEL_FLOAT : DP_MODEL_EXACT;
    spec.triangles = class_of(&asked->triangles);
    if (spec.ortho || !affine)
        row = NULL;
    if (spec.ortho)
        spec.triangles.width = 0;
    dp_status status = dp_setup_init(&p->asked, &spec);
    p->setup = p->asked;
    if (status != DP_OK)
        return dp_status_text(status);
    p->setup.spec.triangles = class_of(&asked->triangles);
    if (row == NULL || row->model == NULL)
        return NULL;
    if (!raster_draws(row, &spec.format))
        return raster_status_text(RASTER_FORMAT);
    p->row = row;
    raster_describe(row, &spec.triangles);
    if (!raster_arith(row, mapping->ndc_signed, &spec.arith))
        return "the rasterizer draws mappings to [0, 1] alone: d3d and reversed";
    status = dp_setup_init(&p->setup, &spec);
    return status == DP_OK ? NULL : dp_status_text(status);
}

/* How large the scene is drawn, so that it fills the middle of the target and no triangle is larger than the class. */
static double scale_of(const dp_triangles *view) {
    const double pixel = 2.0 * dp_half_tangent(view->fov_y) / view->height;
    return fmin(1.0, across * pixel);
}

/* The things up to the depth asked for, between what clipping leaves of the planes. */
static const char *place_scene(draw_picture *p, double reach) {
    float lo = (float)p->setup.spec.znear, hi = (float)p->setup.spec.zfar;
    if (p->setup.spec.model == DP_MODEL_FLOAT)
        dp_pipeline_planes(&p->camera.pipeline, &lo, &hi);
    p->reach = reach;
    p->z = reach / most;
    if (!(p->z * least > (double)lo) || !(p->z * least > 0.0))
        return "the near plane cuts what is drawn";
    if (!(0.999 * reach < fmin((double)hi, 0x1p100))) /* where nothing lies any more */
        return "the far plane cuts what is drawn";
    return NULL;
}

static const char *set_up(draw_picture *p, const dp_spec *spec, const raster_row *row, double reach) {
    const char *wrong = make_setups(p, spec, row);
    if (wrong != NULL)
        return wrong;
    const dp_triangles *view = &p->setup.spec.triangles;
    if (view->width < DRAW_PICTURE_WIDTH || view->height < DRAW_PICTURE_HEIGHT)
        return "the picture is 640x360 pixels of the viewport, which has fewer";
    const raster_status status = draw_camera_init(&p->camera, p->row, &p->setup);
    if (status != RASTER_OK)
        return raster_status_text(status);
    p->scale = scale_of(view);
    wrong = place_scene(p, reach);
    if (spec->ortho && p->z > 0.0) {
        p->camera.p00 /= (float)p->z;
        p->camera.p11 /= (float)p->z;
    }
    return wrong;
}

const char *draw_picture_open(draw_picture *p, const dp_spec *spec, const raster_row *row, double reach) {
    *p = (draw_picture){0};
    const char *wrong = set_up(p, spec, row, reach);
    if (wrong != NULL) {
        *p = (draw_picture){0};
        return wrong;
    }
    if (!draw_buffer_open(&p->buffer, DRAW_PICTURE_WIDTH * DRAW_PICTURE_HEIGHT))
        return "no memory for a picture";
    p->guaranteed = fmax(guaranteed_by(&p->asked, reach), guaranteed_by(&p->setup, reach));
    return NULL;
}

void draw_picture_close(draw_picture *p) {
    draw_buffer_close(&p->buffer);
    *p = (draw_picture){0};
}

/* ---- A frame ----------------------------------------------------------------------------------------------------- */

enum { SKY = 0, FIELD = LAST + 1, WRONG, COLOURS };

/* Told apart by lightness, too; after Okabe and Ito's palette for all kinds of colour vision (2008). */
static const uint8_t colours[COLOURS][4] = {
    [SKY] = {0xE3, 0xEC, 0xF5, 0xFF},  [FIELD] = {0xB9, 0xC4, 0xA8, 0xFF},      [LEFT_WALL] = {0xD9, 0xCF, 0xC1, 0xFF},
    [SIGN] = {0x00, 0x4E, 0x80, 0xFF}, [RIGHT_WALL] = {0xC4, 0xBA, 0xAB, 0xFF}, [POSTER] = {0x8A, 0x3A, 0x0A, 0xFF},
    [ROAD] = {0x4A, 0x4D, 0x52, 0xFF}, [ROAD_MARKS] = {0xF7, 0xF3, 0xE0, 0xFF}, [WRONG] = {0xF0, 0xE4, 0x42, 0xFF},
};

typedef struct palette {
    uint32_t shown[LAST + 1], wrong[LAST + 1];
} palette;

static palette palette_of(int row, bool marks) {
    palette out;
    for (int who = 0; who <= LAST; who++) {
        const int shown = who == DRAW_NOBODY ? (2 * row < DRAW_PICTURE_HEIGHT ? FIELD : SKY) : who;
        memcpy(&out.shown[who], colours[shown], sizeof out.shown[who]);
        memcpy(&out.wrong[who], colours[marks ? WRONG : shown], sizeof out.wrong[who]);
    }
    return out;
}

static void draw_one(void *context, const double place[3][3], unsigned who) {
    draw_picture *p = context;
    draw_triangle(&p->buffer, &p->camera, place, who);
}

static draw_picture_count row_of(const draw_buffer *b, int row, bool marks, uint32_t *pixel) {
    const uint8_t *winner = b->winner + (size_t)row * DRAW_PICTURE_WIDTH;
    const uint8_t *seen = b->seen + (size_t)row * DRAW_PICTURE_WIDTH;
    const int all = upon[LEFT_WALL] | upon[RIGHT_WALL] | upon[ROAD];
    const palette of = palette_of(row, marks);
    draw_picture_count out = {0};
    for (int x = 0; x < DRAW_PICTURE_WIDTH; x++) {
        const bool wrong = (upon[winner[x]] & seen[x]) != 0;
        out.wrong += wrong;
        out.covered += (all & seen[x]) != 0;
        if (pixel != NULL)
            pixel[x] = wrong ? of.wrong[winner[x]] : of.shown[winner[x]];
    }
    return out;
}

draw_picture_count draw_picture_show(const draw_picture *p, bool marks, uint32_t *pixel) {
    draw_picture_count all = {0};
    for (int row = 0; row < DRAW_PICTURE_HEIGHT; row++) {
        uint32_t *out = pixel == NULL ? NULL : pixel + (size_t)(DRAW_PICTURE_HEIGHT - 1 - row) * DRAW_PICTURE_WIDTH;
        const draw_picture_count one = row_of(&p->buffer, row, marks, out);
        all.covered += one.covered;
        all.wrong += one.wrong;
    }
    return all;
}

draw_picture_count draw_picture_frame(draw_picture *p, double gap, unsigned frame, bool marks, uint32_t *pixel) {
    const int x = (p->camera.target.width - DRAW_PICTURE_WIDTH) / 2,
              y = (p->camera.target.height - DRAW_PICTURE_HEIGHT) / 2;
    draw_buffer_clear(&p->buffer, (draw_area){x, y, DRAW_PICTURE_WIDTH, DRAW_PICTURE_HEIGHT});
    draw_picture_triangles(p, gap, frame, draw_one, p);
    return draw_picture_show(p, marks, pixel);
}
