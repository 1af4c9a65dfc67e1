/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "aims.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct aim {
    const char *what, *sense; /* "<=" or ">=" */
    double limit;
    const char *unit;
} aim;

/* L is a loop that moves the same bytes, or fills the same pixels. */
static const aim aims[AIM_COUNT] = {
    [AIM_TABLE] = {"table", "<=", 8, "empty programs"},
    [AIM_TABLE_SLANTED] = {"table at any slant", "<=", 8, "empty programs"},
    [AIM_MAP] = {"the figure map", "<=", 0.3, "s"},
    [AIM_JUDGE] = {"a shader judged by 2^24 codes", "<=", 5, "s"},
    [AIM_CERTIFIED] = {"certified against all codes", ">=", 10000, "times faster"},
    [AIM_PIPELINE_CODE] = {"a code in fp32", "<=", 2.5, "times its arithmetic"},
    [AIM_CENSUS] = {"census", ">=", 10, "times plain C"},
    [AIM_ZFIGHT] = {"zfight", ">=", 10, "times plain C"},
    [AIM_CAMERA] = {"a camera:", "<=", 5, "s"},
    [AIM_HALVES] = {"array", "<=", 1.1, "L"},
    [AIM_UNORM] = {"array", "<=", 1.25, "L"},
    [AIM_CODE] = {"array", "<=", 2.5, "L"},
    [AIM_EYE] = {"array", "<=", 1.5, "L"},
    [AIM_WIDTH] = {"array", "<=", 3.3, "L"},
    [AIM_SEPARATIONS] = {"separations", ">=", 12, "times one by one"},
    [AIM_PLACES] = {"places", "<=", 1.2, "plain copies to 3 planes"},
    [AIM_NORMALS] = {"normals", "<=", 2, "L"},
    [AIM_PLACES_HALF] = {"places", "<=", 1.5, "times the row in binary32"},
    [AIM_NORMALS_HALF] = {"normals", "<=", 2, "times the row in binary32"},
    [AIM_NORMALS_EXACT] = {"normals", "<=", 1.33, "times high-1"},
    [AIM_EYE_MAP] = {"map", "<=", 0.3, "s"},
    [AIM_PLACES_MAP] = {"map", "<=", 0.6, "s"},
    [AIM_NORMALS_MAP] = {"map", "<=", 0.8, "s"},
    [AIM_STATISTICS] = {"map", "<=", 0.5, "s"},
    [AIM_FIGURE] = {"map", "<=", 0.3, "s"},
    [AIM_FIGURE_MEMORY] = {"memory", "<=", 128, "MiB more"},
    [AIM_LOADED] = {"map beside a busy core", "<=", 2, "times one thread"},
    [AIM_SMALL_TRIANGLES] = {"small triangles", ">=", 3, "million/s"},
    [AIM_TRIANGLES] = {"triangles", ">=", 0.25, "L"},
    [AIM_TRIANGLES_BASELINE] = {"triangles, baseline", ">=", 100, "M px/s"},
};

void aim_missing(aim_id id, const char *what, const char *why) {
    const char *name = getenv("DEPTHPREC_AIMS");
    FILE *file = name != NULL ? fopen(name, "a") : NULL;
    printf("not measured: %s\n", why);
    if (file == NULL)
        return;
    fprintf(file, "unmeasured\t%s%s%s\t%s\n", aims[id].what, *what != '\0' ? " " : "", what, why);
    if (fclose(file) != 0)
        perror(name);
}

void aim_judge(aim_id id, const char *what, double value) {
    const aim *a = &aims[id];
    const int met = a->sense[0] == '<' ? value <= a->limit : value >= a->limit;
    const char *name = getenv("DEPTHPREC_AIMS");
    FILE *file = name != NULL ? fopen(name, "a") : NULL;
    printf("   %s %g %s  %s", a->sense, a->limit, a->unit, met ? "met" : "missed");
    if (file == NULL)
        return;
    fprintf(file, "%s\t%s%s%s\t%.3g %s, aim %s %g\n", met ? "met" : "missed", a->what, *what != '\0' ? " " : "", what,
            value, a->unit, a->sense, a->limit);
    if (fclose(file) != 0)
        perror(name);
}
