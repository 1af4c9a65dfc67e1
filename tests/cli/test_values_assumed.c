/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What solve and table say of any slant without a viewport is what they say with one of 1920x1080, of random cameras of
 * every mapping, format, preset and platform; it is never less than snapping alone asks for, nor than what surfaces
 * need that face the camera.
 */
#include "printed.h"

typedef struct drawn {
    char planes[64], set_up[64];
    double z, separation;
    bool slants; /* perspective, affine on the screen */
} drawn;

static drawn draw(rng *r) {
    static const char *const mappings[] = {"d3d", "gl", "reversed", "gl-reversed", "log", "linear"};
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16", "unorm32"};
    static const char *const whose[] = {"three", "unity", "godot-forward", "bevy"};
    drawn d = {.slants = true};
    const double znear = rng_log(r, 0.01, 5), zfar = znear * rng_log(r, 100, 1e5);
    const uint64_t kind = rng_below(r, 4), m = rng_below(r, 6);
    const bool ortho = kind == 0 && m < 4, endless = kind == 1 && m < 4;
    snprintf(d.planes, sizeof d.planes, endless ? "-n %.6g -f inf" : "-n %.6g -f %.6g", znear, zfar);
    if (kind == 2)
        snprintf(d.set_up, sizeof d.set_up, "--unit m --preset %s", whose[rng_below(r, 4)]);
    else
        snprintf(d.set_up, sizeof d.set_up, "-F %s -m %s%s", formats[rng_below(r, 5)], mappings[m],
                 ortho ? " --ortho" : "");
    d.slants = kind == 2 || (!ortho && m < 4);
    d.z = rng_log(r, 2 * znear, 0.5 * zfar);
    d.separation = d.z * rng_log(r, 1e-6, 1e-2);
    return d;
}

static bool same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

/* A pixel is tan(fov/2) z/540 scene units wide there; its vertices move by half a step of the grid each way. */
static double snapped(const json_t *any, double z) {
    const double fov = number_at(any, "fov"), subpixel = number_at(any, "subpixel");
    const double pixel = tan(fov * acos(-1.0) / 360) / 540 * z;
    return subpixel > 0 ? 2 * sqrt(2) * pixel * ldexp(0.5, -(int)subpixel) : 0;
}

TEST(solve) {
    static const char *const targets[] = {"near", "far", "distance", "separation"};
    tally t = {.name = "solve"};
    rng r = rng_make("assumed solve");
    int possible = 0, not = 0;
    for (uint64_t i = test_cases(40, 150, 1000); i > 0; i--) {
        const drawn d = draw(&r);
        const uint64_t k = rng_below(&r, 4);
        char line[512], asked[128], limit[64];
        snprintf(limit, sizeof limit, "--separation %.6g", d.separation);
        snprintf(asked, sizeof asked, "%s %s", k < 3 ? limit : "", k == 2 ? "" : "--at");
        snprintf(line, sizeof line, "solve --for %s %s %s %s %.6g", targets[k], d.planes, d.set_up, asked, d.z);
        if (k == 2)
            line[strrchr(line, ' ') - line] = '\0';
        if (k < 2) /* the plane is free */
            memset(strstr(line, k == 0 ? "-n " : "-f "), ' ',
                   strcspn(strstr(line, k == 0 ? "-n " : "-f ") + 3, " ") + 3);
        if (strstr(line, "-f inf") != NULL && k == 2)
            continue;
        printed p = print_of("%s --json", line);
        json_t *root = p.status < 2 ? json_of(p.out) : NULL;
        TALLY(&t, root != NULL, "%s: %s", line, p.errors);
        const json_t *any = root != NULL ? node_at(root, "answer.any_slant") : NULL;
        TALLY(&t, (any != NULL) == d.slants, "%s: any slant", line);
        if (any != NULL) {
            json_t *with = json_printed(-1, "%s --viewport 1920x1080", line);
            const bool does = flag_at(any, "possible");
            TALLY(&t, does == flag_at(with, "answer.possible"), "%s: possible", line);
            if (k < 2 && does)
                TALLY(&t, same(number_at(any, "%s", targets[k]), number_at(with, "answer.%s", targets[k])), "%s: plane",
                      line);
            if (k == 2)
                TALLY(&t, same(number_at(any, "distance"), number_at(with, "answer.distance")), "%s: distance", line);
            const double separation = number_at(any, "separation"), z = k == 2 ? NAN : number_at(any, "z");
            TALLY(&t, same(separation, number_at(with, "answer.separation")), "%s: separation", line);
            TALLY(&t, !(separation < 0.9999 * snapped(any, z)), "%s: %g is less than snapping", line, separation);
            TALLY(&t, !does || flag_at(root, "answer.possible"), "%s: at any slant alone", line);
            possible += does;
            not += !does;
            json_decref(with);
        }
        json_decref(root);
        printed_free(&p);
    }
    TALLY(&t, possible > 5 && not > 5, "%d do, %d do not", possible, not );
    tally_end(&t);
}

TEST(table) {
    tally t = {.name = "table"};
    rng r = rng_make("assumed table");
    for (uint64_t i = test_cases(30, 100, 1000); i > 0; i--) {
        const drawn d = draw(&r);
        char line[256];
        snprintf(line, sizeof line, "table %s %s --at %.6g", d.planes, d.set_up, d.z);
        json_t *without = json_printed(0, "%s", line);
        const json_t *set = node_at(without, "setups[0]");
        TALLY(&t, (node_at(set, "assumed") != NULL) == d.slants, "%s: assumed", line);
        json_t *with = d.slants ? json_printed(0, "%s --viewport 1920x1080", line) : NULL;
        for (size_t k = 0; k < 3; k++) {
            const double facing = number_at(set, "resolved[%zu].facing_to", k),
                         slanted = number_at(set, "resolved[%zu].slanted_to", k),
                         limit = number_at(set, "resolved[%zu].separation", k);
            TALLY(&t, !(slanted > facing), "%s: farther at any slant than facing", line);
            if (with == NULL)
                TALLY(&t, isnan(slanted), "%s: at a slant", line);
            else
                TALLY(&t, same(slanted, number_at(with, "setups[0].resolved[%zu].slanted_to", k)), "%s: %zu", line, k);
            TALLY(&t, isnan(slanted) || limit >= 0.9999 * snapped(node_at(set, "assumed"), slanted),
                  "%s: %g up to %g is less than snapping", line, limit, slanted);
        }
        json_decref(with);
        json_decref(without);
    }
    tally_end(&t);
}

/* Below a table of several, the farthest first, and rounded down: "... is resolved by fp32 reversed up to 577 m, ...".
 */
TEST(comparison) {
    static const char line[] = "table -n 0.1 -f 10000 -F fp32,d24 -m reversed,d3d,log";
    printed p = print_of("%s", line);
    json_t *root = json_printed(0, "%s", line);
    char *at = strstr(p.out, "At any slant (1920x1080, fov 60, 8 subpixel bits)");
    double before = INFINITY;
    int count = 0;
    assert_non_null(at);
    *strstr(at, ".\n") = '\0';
    for (char *c = at; (c = strstr(c, "\n  ")) != NULL;) { /* sentences go on behind a break */
        *c = ' ';
        memmove(c + 1, c + 3, strlen(c + 3) + 1);
    }
    for (size_t i = 0; i < 6; i++) {
        char name[64];
        const double slanted_to = number_at(root, "setups[%zu].resolved[1].slanted_to", i);
        snprintf(name, sizeof name, " %s %s up to ", text_at(root, "setups[%zu].format", i),
                 text_at(root, "setups[%zu].mapping", i));
        assert_int_equal(strstr(at, name) != NULL, !isnan(slanted_to));
        const double shown = isnan(slanted_to) ? 0 : strtod(strstr(at, name) + strlen(name), NULL);
        count += !isnan(slanted_to);
        assert_true(isnan(slanted_to) || (shown <= slanted_to && shown >= 0.989 * slanted_to));
    }
    for (char *c = at; (c = strstr(c, " up to ")) != NULL; c++) {
        assert_true(strtod(c + 7, NULL) <= before);
        before = strtod(c + 7, NULL);
    }
    assert_int_equal(count, 4);
    json_decref(root);
    printed_free(&p);
}
