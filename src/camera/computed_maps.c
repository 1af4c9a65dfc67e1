/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of web maps. They count in pixels, or in heights of the canvas, which the zoom makes metres. */
#include <math.h>

#include "camera/computed.h"
#include "core/elementary.h"

enum { ZOOM, PITCH, LATITUDE, HEIGHT, FOV, NEAR = 4, FAR }; /* the first four of all */

#define MAP                                                                                                            \
    {"zoom", "", 0.0, 26.0, (double)NAN, 14.0}, {"pitch", "degrees", 0.0, 85.0, 0.0, 60.0},                            \
        {"latitude", "degrees", -85.05, 85.05, 0.0, 48.0}, {                                                           \
        "height", "pixels", 1.0, 32768.0, (double)NAN, 800.0                                                           \
    }

/* Metres of a pixel in the middle: the map is 512 pixels wide at zoom 0. */
static double metres(const double *given, double circumference) {
    return circumference * dp_cos(given[LATITUDE] * DP_DEGREE) / (512.0 * dp_exp2(given[ZOOM]));
}

/* How far behind the middle a plane that is tilted by `pitch` meets the ray that lies `above` the view axis. */
static double behind(double pitch, double above, double distance) {
    const double steep = fmin(fmax(90.0 * DP_DEGREE - pitch - above, 0.01), 180.0 * DP_DEGREE - 0.01);
    return dp_sin(pitch) * dp_sin(above) * distance / dp_sin(steep);
}

static const double circumference_maplibre = 2.0 * 3.14159265358979323846 * 6371008.8;

static void compute_maplibre(const double *given, preset_camera *out) {
    const double horizon_limit = 89.25, pixel = metres(given, circumference_maplibre);
    const double pitch = given[PITCH] * DP_DEGREE, half = 0.5 * given[FOV] * DP_DEGREE;
    const double middle = 0.5 / dp_tan(half) * given[HEIGHT];
    const double lowest = fmin(0.0, dp_cos(pitch) * middle * pixel - 100.0); /* 100 m below the camera, metres */
    const double ground = middle - lowest / pixel / dp_cos(pitch);
    const double horizon = fmin(dp_tan(90.0 * DP_DEGREE - pitch) * 0.85, dp_tan(horizon_limit * DP_DEGREE - pitch));
    const double above = fmax(dp_atan(horizon), (90.0 - horizon_limit) * DP_DEGREE);
    out->znear = given[HEIGHT] / 50.0 * pixel;
    out->zfar = (fmin(behind(pitch, half, ground), behind(pitch, above, ground)) + ground) * 1.01 * pixel;
    out->fov = given[FOV];
    out->focus = middle * pixel;
}

const preset_function computed_maplibre = {{MAP, {"fov", "degrees", 0.1, 150.0, FOV_OF_MAPS, 40.0}}, compute_maplibre};

static void compute_maplibre_globe(const double *given, preset_camera *out) {
    const double pixel = metres(given, circumference_maplibre);
    const double middle = 0.5 / dp_half_tangent(given[FOV]) * given[HEIGHT];
    const double radius = 6371008.8 / pixel; /* the globe grows towards the poles, so that its middle keeps its scale */
    out->znear = 0.5 * pixel;
    out->zfar = (middle + 2.0 * radius) * pixel;
    out->fov = given[FOV];
    out->focus = middle * pixel;
}

const preset_function computed_maplibre_globe = {{MAP, {"fov", "degrees", 0.1, 150.0, FOV_OF_MAPS, 40.0}},
                                                 compute_maplibre_globe};

static const double circumference_deckgl = 40.03e6, altitude_deckgl = 1.5;

static void compute_deckgl(const double *given, preset_camera *out) {
    const double screen = given[HEIGHT] * metres(given, circumference_deckgl), pitch = given[PITCH] * DP_DEGREE;
    const double farthest = behind(pitch, dp_atan(0.5 / altitude_deckgl), altitude_deckgl) + altitude_deckgl;
    out->znear = given[NEAR] * screen;
    out->zfar = fmin(farthest * given[FAR], 10.0 * altitude_deckgl) * screen;
    out->focus = altitude_deckgl * screen;
}

const preset_function computed_deckgl = {
    {MAP, {"near", "heights", 1e-6, 1.4, 0.1, 0.01}, {"far", "", 1.0, 100.0, 1.01, 2.0}}, compute_deckgl};

static void compute_deckgl_globe(const double *given, preset_camera *out) {
    const double radius =
        256.0 * dp_exp2(given[ZOOM]) / (180.0 * DP_DEGREE * dp_cos(given[LATITUDE] * DP_DEGREE)) / given[HEIGHT];
    const double screen = 6370972.0 / radius;
    out->znear = given[NEAR] * screen;
    out->zfar = (altitude_deckgl + 2.0 * radius / fmax(dp_cos(given[PITCH] * DP_DEGREE), 0.1)) * given[FAR] * screen;
    out->focus = altitude_deckgl * screen;
}

const preset_function computed_deckgl_globe = {
    {MAP, {"near", "heights", 1e-6, 1.4, 0.5, 0.01}, {"far", "", 1.0, 100.0, 1.0, 2.0}}, compute_deckgl_globe};
