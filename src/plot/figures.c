/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures, one row each. */
#include "plot/figure.h"

static const figure_row rows[] = {
    {"distribution", "Codes along z",
     "the curve d(z) with every code carried over to z (up to 128 codes); codes per unit of depth for real formats",
     CHART_SETUPS, FIGURE_SETUPS | FIGURE_SIGNED | FIGURE_STAGED | FIGURE_BESIDE, NULL, NULL, distribution_build},
    {"share", "Share of the codes between z and far", "share of the codes that are left between z and far",
     CHART_SETUPS, FIGURE_SETUPS | FIGURE_FLOAT | FIGURE_SIGNED | FIGURE_STAGED | FIGURE_BESIDE, NULL, NULL,
     share_build},
    {"linear01", "Window depth and Linear01, from the camera and from near",
     "window depth and both Linear01, z/far and (z - near)/(far - near), against z, for several far", 4, FIGURE_FARS,
     NULL, "fp32", linear01_build},
    {"error", "Worst error of the decoded depth",
     "certified envelope of |decoded depth - z| against z, log-log: guaranteed, over that of the lattice", CHART_SETUPS,
     FIGURE_SETUPS | FIGURE_FLOAT | FIGURE_SIGNED | FIGURE_GUARANTEED | FIGURE_BESIDE, NULL, NULL, error_build},
    {"interval", "Z-fighting interval",
     "guaranteed separation against z, log-log, over the z-fighting interval of the lattice; with --viewport that at "
     "any slant, too; with --model float what a census finds as points",
     CHART_SETUPS,
     FIGURE_SETUPS | FIGURE_FLOAT | FIGURE_TOLERANCE | FIGURE_SIGNED | FIGURE_SLANTED | FIGURE_GUARANTEED |
         FIGURE_BESIDE,
     NULL, NULL, interval_build},
    {"budget", "Guaranteed separation by cause",
     "shares of the separation that binary32 arithmetic guarantees, cause by cause, against z", CHART_PANELS,
     FIGURE_SETUPS | FIGURE_TERMS | FIGURE_FLOAT | FIGURE_BINARY32 | FIGURE_SIGNED | FIGURE_SLANTED, NULL, NULL,
     budget_build},
    {"map", "Worst z-fighting interval for each near and far plane",
     "near against far, colour = worst z-fighting interval over the range, or the interval at --at Z", CHART_PANELS,
     FIGURE_SETUPS | FIGURE_AT | FIGURE_TOLERANCE | FIGURE_SIGNED, NULL, NULL, map_build},
    {"pareto", "Time and worst error of methods",
     "methods of a family, interval by default: ns per element against worst error, log-log, the Pareto front marked",
     CHART_SETUPS, FIGURE_SETUPS | FIGURE_FLOAT | FIGURE_MINE, "interval", NULL, pareto_build},
    {"stability", "Correct digits of methods",
     "methods of a family, linearize by default, against far/near: colour = digits left, with the claims' ends",
     CHART_SETUPS, FIGURE_SETUPS | FIGURE_FLOAT | FIGURE_MINE, "linearize", NULL, stability_build},
    {"normals", "Angular error of normals from depth",
     "angular error of normals made from stored depths against z, on a plane and at the outline of a sphere",
     CHART_PANELS / 2, FIGURE_SETUPS, NULL, "unorm24 fp32", normals_build},
    {"shadow", "Gaps and needed bias of shadow maps",
     "the bias that a surface needs at each angle to the light, cause by cause, and the gap that each of three opens",
     1, FIGURE_SHADOW, NULL, NULL, shadow_build},
    {"world", "Safe separation and jitter in large worlds",
     "the separation that is safe and the jitter of a picture against the distance from the world's origin, by scheme",
     1, FIGURE_SETUPS | FIGURE_AT | FIGURE_FLOAT | FIGURE_BINARY32, NULL, "fp32", world_build},
    {"fight", "Z-fighting of a wall and a decal, as rasterized",
     "a wall and a decal before it, pixel by pixel, as slanted triangles: nearer than is guaranteed, and as far as "
     "that",
     1, FIGURE_SETUPS | FIGURE_AT | FIGURE_FLOAT | FIGURE_BINARY32 | FIGURE_DRAWN, NULL, "unorm24", fight_build},
    {"scene", "Depths from which surfaces may z-fight",
     "a model from above and from the side: where surfaces overlap, colour = depth from which they may z-fight", 1,
     FIGURE_MODEL, NULL, NULL, scene_build},
    {"needs", "Separations and errors, allowed and given",
     "a requirement file: the separation (or error) that each requirement allows against what its set-up gives",
     CHART_PANELS, FIGURE_FILE, NULL, NULL, needs_build},
};

const figure_row *figure_get(size_t index) {
    return index < sizeof rows / sizeof *rows ? &rows[index] : NULL;
}
