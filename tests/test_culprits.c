/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a refusal says and how it ends: the option at fault is named first, nothing is written, and the exit status is 2
 * (1 for a check that failed, 3 for a file that cannot be read or written). */
#include <stdio.h>
#include <string.h>

#include "printed.h"

typedef struct refusal {
    const char *arguments, *option; /* without its dashes; "" where no option is at fault */
    int status;
} refusal;

/* Commands that take planes, each with what else it needs. */
static const char *const commands[] = {"table",
                                       "budget",
                                       "zfight",
                                       "bias",
                                       "bench interval",
                                       "plot interval -o x.svg",
                                       "plot map --csv",
                                       "plot pareto interval -o x.svg",
                                       "texture --scene plane --size 8x6",
                                       "texture --effect fog",
                                       "solve --separation 0.1 --at 5 --for format"};

/* What is wrong with the planes themselves: near is named for near, far for far. */
static const struct {
    const char *planes, *option;
} planes[] = {{"-n 0 -f 10", "near"},  {"-n x -f 10", "near"},       {"-n 1e13 -f 1e14", "near"},
              {"-n=-1 -f 10", "near"}, {"-n 5 -f 2", "far"},         {"-n 1 -f x", "far"},
              {"-n 1 -f 1e19", "far"}, {"-n 1 -f 1.0000001", "far"}, {"-n 1e-13 -f 10", "near"},
              {"-n -5 -f 10", "near"}};

static const refusal refusals[] = {
    {"table --at 0.01", "at", 2},
    {"table --at 2000", "at", 2},
    {"table --range 0.01:5", "range", 2},
    {"table --depth 1.5", "depth", 2},
    {"table --code 15361", "code", 2},
    {"table --code 1 --depth 1", "code", 2},
    {"table --code 1 --at 1", "at", 2},
    {"table --depth 1 --range 1:2", "range", 2},
    {"table --depth 1 --tolerance 1%", "tolerance", 2},
    {"table --range 1:5000", "range", 2},
    {"table --range 5:1", "range", 2},
    {"table --at 1:2:sqrt:5", "at", 2},
    {"table --log-c 0 -m log", "log-c", 2},
    {"table --ortho -m log", "ortho", 2},
    {"table --ortho -n -1e-13 -f 10", "near", 2},
    {"table --ortho -n -1e13 -f 10", "near", 2},
    {"table --ortho -n -5 -f -5", "far", 2},
    {"table --ortho -n -5 -f 1e-13", "far", 2},
    {"table --ortho -n -5 -f 5 --at -1:5:log:3", "at", 2},
    {"zfight --ortho -n -5 -f 5 --range 4:6", "range", 2},
    {"plot normals --ortho -n 0 -f 5 -o x.svg", "near", 2},
    {"texture --ortho -n -5 -f 5 --effect fog", "effect", 2},
    {"texture --ortho -n -5 -f 5 --effect edge", "effect", 2},
    {"solve --ortho -n -5 -f 5 --for near --separation 1 --at 2", "for", 2},
    {"solve --ortho -f 5 --for near --separation 1 --at -2", "at", 2},
    {"solve --ortho -n -5 --for far --separation 1 --at -2", "at", 2},
    {"table -f inf -m linear", "far", 2},
    {"table --model fp32 -m linear", "model", 2},
    {"table --model exakt", "model", 2},
    {"table --arith mess", "arith", 2},
    {"table --rounding up", "rounding", 2},
    {"table -F unorm33", "format", 2},
    {"table -m upside", "mapping", 2},
    {"table --tolerance -1", "tolerance", 2},
    {"table --gap 1", "gap", 2},
    {"table --json --csv", "csv", 2},
    {"table --csv --json", "json", 2},
    {"table -o ''", "output", 2},
    {"table -o /nonexistent/x", "", 3},
    {"table --preset nothing", "preset", 2},
    {"budget -m linear", "mapping", 2},
    {"budget --at 5000", "at", 2},
    {"budget --world -1", "world", 2},
    {"budget --interpolation x", "interpolation", 2},
    {"zfight -m log", "mapping", 2},
    {"zfight --seed 1", "seed", 2},
    {"zfight -f inf -m d3d", "range", 2},
    {"zfight --range 1.00000001:1.00000002", "range", 2},
    {"zfight --range 1:2 --gap 1", "gap", 2},
    {"zfight --range 1:2000", "range", 2},
    {"zfight --sample 0", "sample", 2},
    {"zfight --threads 0", "threads", 2},
    {"zfight --against nothing", "against", 2},
    {"zfight --against fma,", "against", 2},
    {"zfight --against fma --program nothing", "program", 2},
    {"zfight --program fma", "program", 2},
    {"zfight --vertices box", "vertices", 2},
    {"zfight --world 5", "world", 2},
    {"zfight --against fma --gap 1", "gap", 2},
    {"zfight --against fma -f inf", "range", 2},
    {"zfight --against fma --range 1:2000", "range", 2},
    {"zfight --against fma -m log", "mapping", 2},
    {"zfight --against fma --ortho -n -5 -f 5", "vertices", 2},
    {"bias --api d3d13", "api", 2},
    {"bias --units 1.5", "units", 2},
    {"bias --api all --units 1", "api", 2},
    {"bias --api all --at 1 --range 1:2", "range", 2},
    {"bias --units 1 --gap 1", "units", 2},
    {"bias --clamp 1", "clamp", 2},
    {"bias --api d3d9 --units 1 --clamp 1", "clamp", 2},
    {"bias --slope -1", "slope", 2},
    {"bias --factor x", "factor", 2},
    {"bias --range 0.01:10", "range", 2},
    {"bias --at 5000", "at", 2},
    {"shadow -f inf", "far", 2},
    {"shadow -n 5 -f 1", "far", 2},
    {"shadow -f 2e12", "far", 2},
    {"shadow -n 0 -f 10", "near", 2},
    {"shadow -n 1e-12 -f 1e12", "far", 2},
    {"shadow -m log", "mapping", 2},
    {"shadow --size 4", "size", 2},
    {"shadow --size 40000x1", "size", 2},
    {"shadow --kernel 0", "kernel", 2},
    {"shadow --angle 90", "angle", 2},
    {"shadow --cascades 9", "cascades", 2},
    {"shadow --lambda 2", "lambda", 2},
    {"shadow --range 1:2", "range", 2},
    {"shadow --light-box 1x1x10 --range 1:11", "range", 2},
    {"shadow --light-box 1x1x10 --cascades 2", "cascades", 2},
    {"shadow --light-box 1x1x10 -f 5", "far", 2},
    {"shadow --light-box 1x1", "light-box", 2},
    {"shadow --light-box 1mx1x1", "light-box", 2},
    {"shadow --fov 50 --hfov 50", "hfov", 2},
    {"shadow --viewport 32768x1", "viewport", 2},
    {"shadow --hfov 179 --viewport 1x100", "hfov", 2},
    {"shadow --api d3d13", "api", 2},
    {"shadow --slant 0:5", "slant", 2},
    {"plot error --cascades 2 -o x.svg", "cascades", 2},
    {"plot error --world 5 -o x.svg", "world", 2},
    {"plot shadow --preset unity -o x.svg", "preset", 2},
    {"plot shadow --angle 0 -o x.svg", "", 2},
    {"plot shadow -m all -o x.svg", "", 2},
    {"shadow --raster swiftshader --subpixel 4", "subpixel", 2},
    {"bench interval -F unorm9", "format", 2},
    {"bench interval -m log", "mapping", 2},
    {"bench nothing", "", 2},
    {"stability nothing", "", 2},
    {"check /nonexistent", "", 3},
    {"check --report json --csv tests/needs/village.need", "report", 2},
    {"check tests/needs/village.need", NULL, 1},
    {"solve --separation 0.1 --error 0.1 --at 5", "error", 2},
    {"solve --separation 0.1 --at 5,6", "at", 2},
    {"solve --separation 0.1 --at 5 --range 1:2", "range", 2},
    {"solve --separation 0.1", "at", 2},
    {"solve --for near --at 5", "separation", 2},
    {"solve --for near -n 1 --separation 0.1 --at 5", "for", 2},
    {"solve --for far -f 10 --separation 0.1 --at 5", "for", 2},
    {"solve --for separation --separation 0.1 --at 5", "for", 2},
    {"solve --separation 0 --at 5", "separation", 2},
    {"solve --error 0 --at 5", "error", 2},
    {"solve --separation 0.1 --range 1:5000 -f 1000", "range", 2},
    {"solve --separation 0.1 --at 5000 -f 1000", "at", 2},
    {"solve -n 0.1 -f 1000 -F unorm16 -m d3d --for near --separation 1e-9 --at 500", "for", 2},
    {"solve --model exact -f 1000 -F unorm16 -m d3d --separation 1e-9 --at 500", NULL, 1},
    {"solve --model exact -n 1 -m log --ortho --separation 0.1 --at 5 -f 10", "ortho", 2},
    {"solve --model exact --for near -m linear -F fp32 --separation 0.1 --at 5", "far", 2},
    {"plot nothing", "", 2},
    {"plot error -o x.txt", "output", 2},
    {"plot error -o x.svg --type png", "type", 2},
    {"plot error -o - --type gif", "type", 2},
    {"plot error -o x.svg --width 9999999", "width", 2},
    {"plot error -o x.svg --height 70", "height", 2},
    {"plot error -o x.svg --at 5", "at", 2},
    {"plot map -o x.svg --at 5 --range 1:2", "at", 2},
    {"plot error -o x.svg --world 5", "world", 2},
    {"plot error -o x.svg --model fp32", "model", 2},
    {"table --fov 50", "fov", 2},
    {"table --slant 0:5", "slant", 2},
    {"budget --hfov 50", "hfov", 2},
    {"budget --subpixel 8", "subpixel", 2},
    {"budget --triangle slim=4", "triangle", 2},
    {"budget --raster llvmpipe", "raster", 2},
    {"table --viewport 64x48 --raster llvmpipe --subpixel 8", "subpixel", 2},
    {"table --viewport 64x48 --raster spec-d3d --subpixel 8", "subpixel", 2},
    {"budget --viewport 64x48 --raster spec-vulkan --subpixel 3", "subpixel", 2},
    {"budget --viewport 64x48 --raster softpipe -F fp32,unorm16", "raster", 2},
    {"budget --viewport 64x48 --raster opengl", "raster", 2},
    {"table --viewport 64x48 --fov 50 --hfov 50", "hfov", 2},
    {"table --viewport 1x32768 --hfov 179", "hfov", 2},
    {"table --viewport 64x48 --ortho", "viewport", 2},
    {"table --viewport 64x48 --depth 0.5", "viewport", 2},
    {"zfight --subpixel 4", "subpixel", 2},
    {"zfight --range 1:1.1 --viewport 64x48 --plane 5,5", "plane", 2},
    {"texture --scene plane --size 64x36 --fov 50 --hfov 50", "hfov", 2},
    {"texture --scene plane --size 1x4096 --hfov 170", "hfov", 2},
    {"texture --scene plane --ortho --hfov 50", "hfov", 2},
    {"texture --effect fog --hfov 30", "hfov", 2},
    {"plot budget -o x.svg --model exact", "model", 2},
    {"plot error -o x.svg --tolerance 1%", "tolerance", 2},
    {"plot scene tests/needs/village.need -o x.svg -n 1", "near", 2},
    {"plot scene tests/needs/village.need -o x.svg -f 1", "far", 2},
    {"plot error -o x.svg --theme pink", "theme", 2},
    {"list nothing", "", 2},
    {"list formats --tolerance 1%", "tolerance", 2},
    {"texture", "", 2},
    {"texture /nonexistent.png", "", 3},
    {"texture --scene nothing", "scene", 2},
    {"texture --scene plane x.png", "scene", 2},
    {"texture --scene plane --fov 0", "fov", 2},
    {"texture --scene plane --ortho --fov 50", "fov", 2},
    {"texture --scene plane --half-height 5", "half-height", 2},
    {"texture --scene plane --yaw 999", "yaw", 2},
    {"texture --scene plane --pitch 99", "pitch", 2},
    {"texture --scene plane --sky 1", "sky", 2},
    {"texture --scene plane --size 0x5", "size", 2},
    {"texture --scene plane --origin 1,2", "origin", 2},
    {"texture --scene plane --parameter radius=1", "parameter", 2},
    {"texture --scene plane -F unorm16,fp32", "format", 2},
    {"texture --scene plane -m d3d,gl", "mapping", 2},
    {"texture --scene plane --error-map", "error-map", 2},
    {"texture --scene plane --error-map=x.npy", "error-map", 2},
    {"texture --scene plane --eye -o x.npy --error-map=", "error-map", 2},
    {"texture --scene plane --eye -o x.npy --error-map=x.txt", "error-map", 2},
    {"texture --scene plane --eye -o x.npy --error-map=x.npy", "error-map", 2},
    {"texture --scene plane --eye --figure x.svg --error-map=x.npy", "error-map", 2},
    {"texture --scene plane --eye -o x.npy --error-map=y.npy --error-map=z.npy", "error-map", 2},
    {"texture --scene plane --radial", "radial", 2},
    {"texture --scene plane --at 5", "at", 2},
    {"texture --scene plane --size 5x4 --pixel '1,3;1,4'", "pixel", 2},
    {"texture --scene plane --pixel '1,3;1'", "pixel", 2},
    {"texture --scene plane --pixel '1;3'", "pixel", 2},
    {"texture --scene plane --pixel '1,3,5,6'", "pixel", 2},
    {"texture --scene plane --pixel 1,3 --eye -o x.npy", "pixel", 2},
    {"texture --effect fog --pixel 1,3", "pixel", 2},
    {"texture --effect height-fog --pixel 640,3", "pixel", 2},
    {"texture --scene plane --effect fog --pixel 1,3 --error-map", "error-map", 2},
    {"texture --scene plane --effect intersection --pixel 1,3", "parameter", 2},
    {"texture --effect height-fog --pixel '1,3;2,2'", "pixel", 2},
    {"texture --effect height-fog --half-height 3", "half-height", 2},
    {"texture --effect height-fog --sky 0.1", "sky", 2},
    {"texture --effect motion-blur", "effect", 2},
    {"texture --effect motion-blur --ortho --last-fov 50", "last-fov", 2},
    {"texture --scene plane --effect motion-blur -o x.npy", "effect", 2},
    {"texture --scene plane --effect fog --last-pitch 5 -o x.npy", "last-pitch", 2},
    {"texture --scene plane --last-origin 1,2,3", "last-origin", 2},
    {"texture --scene plane --effect edge --parameter slope=1 -o x.npy", "parameter", 2},
    {"texture --effect edge --parameter sample-distance=2", "parameter", 2},
    {"texture --scene plane --overlay 1", "overlay", 2},
    {"texture --scene plane --histogram x.txt", "histogram", 2},
    {"texture --scene plane --histogram x.svg --pixel 1,1", "histogram", 2},
    {"texture --scene plane --histogram x.svg -o x.npy", "histogram", 2},
    {"texture --scene plane --histogram - --json", "histogram", 2},
    {"texture --scene plane --histogram x.svg --eye --figure y.svg", "histogram", 2},
    {"texture --scene plane --histogram x.svg -o x.svg", "histogram", 2},
    {"texture --scene plane --pack rg -o x.png --histogram x.svg", "histogram", 2},
    {"texture --scene plane --overlay 1 --histogram x.svg", "overlay", 2},
    {"texture --effect fog --histogram x.svg", "histogram", 2},
    {"texture --scene plane --normal high --figure x.svg --overlay 1", "overlay", 2},
    {"texture --scene plane --eye --error-map --figure x.svg --overlay 1", "overlay", 2},
    {"texture --scene plane --pack rg -o x.png --overlay 1", "overlay", 2},
    {"texture --effect fog --overlay 1", "overlay", 2},
    {"texture --scene plane --width 300", "width", 2},
    {"texture --scene plane --title x", "title", 2},
    {"texture --scene plane --type png", "type", 2},
    {"texture --effect fog --type png", "type", 2},
    {"texture --scene plane --position nothing -o x.npy", "position", 2},
    {"texture --scene plane --normal nothing -o x.npy", "normal", 2},
    {"texture --scene plane --effect nothing -o x.npy", "effect", 2},
    {"texture --scene plane --eye --normal high -o x.npy", "normal", 2},
    {"texture --scene plane --eye --raw -o x.npy", "raw", 2},
    {"texture --scene plane --linear01 --normal high -o x.npy", "normal", 2},
    {"texture --effect fog --linear01", "linear01", 2},
    {"texture --effect fog --raw", "raw", 2},
    {"texture --scene plane --eye -o x.txt", "output", 2},
    {"texture --scene plane --eye --figure x.txt", "figure", 2},
    {"texture --scene plane --eye --csv -o x.npy", "csv", 2},
    {"texture --scene plane --eye --csv -o x.npy", "csv", 2},
    {"texture --effect fog -f inf", "far", 2},
    {"texture --effect fog --fov 30", "fov", 2},
    {"texture --effect fog --parameter level=1", "parameter", 2},
    {"texture --effect fog --at 5000", "at", 2},
};

static void check_refusal(tally *t, const char *arguments, const char *option, int status) {
    char begin[96];
    printed p = print_of("%s", arguments);
    TALLY(t, p.status == status, "%s: exit status %d, not %d: %s", arguments, p.status, status, p.errors);
    snprintf(begin, sizeof begin, option != NULL && *option != '\0' ? "depthprec: --%s: " : "depthprec: ", option);
    if (option != NULL) {
        TALLY(t, strncmp(p.errors, begin, strlen(begin)) == 0, "%s: does not begin with '%s': %s", arguments, begin,
              p.errors);
        TALLY(t, (strncmp(p.errors, "depthprec: --", 13) == 0) == (*option != '\0'), "%s: %s", arguments, p.errors);
        TALLY(t, p.errors[0] != '\0' && strchr(p.errors, '\n') == p.errors + strlen(p.errors) - 1, "%s: not one line",
              arguments);
        TALLY(t, p.out[0] == '\0', "%s: printed something", arguments);
    } else {
        TALLY(t, p.out[0] != '\0', "%s: printed nothing", arguments);
    }
    printed_free(&p);
}

static void test_planes(void **state) {
    tally t = {.name = "planes"};
    (void)state;
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        for (size_t k = 0; k < sizeof planes / sizeof planes[0]; k++) {
            char line[256];
            const bool solve = strncmp(commands[i], "solve", 5) == 0;
            if (solve && (k == 2 || k >= 4) && strcmp(planes[k].planes, "-n 1 -f x") != 0)
                continue; /* the depths asked about lie outside as well */
            snprintf(line, sizeof line, "%s %s", commands[i], planes[k].planes);
            check_refusal(&t, line, planes[k].option, 2);
        }
    tally_end(&t);
}

static void test_refusals(void **state) {
    tally t = {.name = "refusals"};
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++)
        check_refusal(&t, refusals[i].arguments, refusals[i].option, refusals[i].status);
    tally_end(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_planes), cmocka_unit_test(test_refusals)};
    return run_tap(tests);
}
