/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refusals and their ends: the option at fault is named first, nothing is written, and the exit status is 2
 * (1 for a check that failed, 3 for a file that cannot be read or written). */
#define _GNU_SOURCE /* symlink() */
#include <unistd.h>

#include "printed.h"

#define STREET "tests/models/street.obj"

typedef struct refusal {
    const char *arguments, *option; /* without its dashes; "" where no option is at fault */
    int status;
} refusal;

/* Commands that take planes, each with what else it needs. */
static const char *const commands[] = {"table",
                                       "budget",
                                       "zfight",
                                       "bias",
                                       "methods interval",
                                       "world",
                                       "plot interval -o x.svg",
                                       "plot map --csv",
                                       "plot pareto interval -o x.svg",
                                       "texture --synthetic plane --size 8x6",
                                       "texture --product effect:fog",
                                       "solve --separation 0.1 --at 5 --for format"};

/* Faults of the planes themselves: near is named for near, far for far. */
static const struct {
    const char *planes, *option;
} planes[] = {{"-n 0 -f 10", "near"},  {"-n x -f 10", "near"},       {"-n 1e13 -f 1e14", "near"},
              {"-n=-1 -f 10", "near"}, {"-n 5 -f 2", "far"},         {"-n 1 -f x", "far"},
              {"-n 1 -f 1e29", "far"}, {"-n 1 -f 1.0000001", "far"}, {"-n 1e-13 -f 10", "near"},
              {"-n -5 -f 10", "near"}};

static const refusal refusals[] = {
    {"table --link=a#b", "link", 2},
    {"code --language gappa -m d3d --depth-range 0.2:0.8", "language", 2},
    {"code --language fpcore -m d3d --depth-range 0.2:0.8", "language", 2},
    {"code encode --language fpcore -m d3d --depth-range 0.2:0.8", "language", 2},
    {"plot fight --link", "link", 2},
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
    {"table --at 1:2:lin:1000001", "at", 2},
    {"table --log-c 0 -m log", "log-c", 2},
    {"table --ortho -m log", "ortho", 2},
    {"table --ortho -n -1e-13 -f 10", "near", 2},
    {"table --ortho -n -1e13 -f 10", "near", 2},
    {"table --ortho -n -5 -f -5", "far", 2},
    {"table --ortho -n -5 -f 1e-13", "far", 2},
    {"table --ortho -n -5 -f 5 --at -1:5:log:3", "at", 2},
    {"zfight --ortho -n -5 -f 5 --range 4:6", "range", 2},
    {"plot normals --ortho -n 0 -f 5 -o x.svg", "near", 2},
    {"texture --ortho -n -5 -f 5 --product effect:fog", "product", 2},
    {"texture --ortho -n -5 -f 5 --product effect:edge", "product", 2},
    {"solve --ortho -n -5 -f 5 --for near --separation 1 --at 2", "for", 2},
    {"solve --ortho -f 5 --for near --separation 1 --at -2", "at", 2},
    {"solve --ortho -n -5 --for far --separation 1 --at -2", "at", 2},
    {"table -f inf -m linear", "far", 2},
    {"table --model float -m linear", "model", 2},
    {"table --model exakt", "model", 2},
    {"table --arith mess", "arith", 2},
    {"table --rounding up", "rounding", 2},
    {"table -F unorm33", "format", 2},
    {"table -m upside", "mapping", 2},
    {"table --tolerance -1", "tolerance", 2},
    {"table --separation 1", "separation", 2},
    {"table --json --csv", "csv", 2},
    {"table --csv --json", "json", 2},
    {"table -o ''", "output", 2},
    {"table -o /nonexistent/x", "", 3},
    {"table --preset nothing", "preset", 2},
    {"table --preset maplibre:zoom=4", "preset", 2},
    {"table --preset maplibre:zoom=4,height=700 --viewport 1280x800", "preset", 2},
    {"table --preset maplibre:zoom=4 --viewport 1280x800 --fov 40", "fov", 2},
    {"solve --preset unity,maplibre:zoom=4,height=700 --separation 1", "preset", 2},
    {"budget -m linear", "mapping", 2},
    {"budget --at 5000", "at", 2},
    {"budget --from-origin -1", "from-origin", 2},
    {"budget --interpolation x", "interpolation", 2},
    {"zfight -m log", "mapping", 2},
    {"zfight --seed 1", "seed", 2},
    {"zfight -f inf -m d3d", "range", 2},
    {"zfight --range 1.00000001:1.00000002", "range", 2},
    {"zfight --range 1:2 --separation 1", "separation", 2},
    {"zfight --range 1:2000", "range", 2},
    {"zfight --sample 0", "sample", 2},
    {"zfight --threads 0", "threads", 2},
    {"prepass --sample 0", "sample", 2},
    {"judge --pairs-for 7", "pairs-for", 2},
    {"scene " STREET " --threads 0", "threads", 2},
    {"table --viewport 640x480 --subpixel 0", "subpixel", 2},
    {"world --from-origin x", "from-origin", 2},
    {"world --from-origin -1", "from-origin", 2},
    {"world --from-origin 1e13", "from-origin", 2},
    {"world --from-origin 0:9:log:3", "from-origin", 2},
    {"world --scheme splt", "scheme", 2},
    {"world --scheme split:3", "scheme", 2},
    {"world --scheme absolute:3", "scheme", 2},
    {"world --at 1,2", "at", 2},
    {"world --at 0.01", "at", 2},
    {"world -m log", "mapping", 2},
    {"world --ortho", "ortho", 2},
    {"budget --scheme split", "scheme", 2},
    {"budget --from-origin 5 --scheme all", "scheme", 2},
    {"budget --from-origin 5 --scheme split --composition once", "composition", 2},
    {"budget --from-origin 5 --scheme split --ortho", "scheme", 2},
    {"zfight --against fma", "against", 2},
    {"prepass --viewport 64x48", "viewport", 2},
    {"prepass --against nothing", "against", 2},
    {"prepass --against fma,", "against", 2},
    {"prepass --against fma --program nothing", "program", 2},
    {"zfight --program fma", "program", 2},
    {"zfight --vertices box", "vertices", 2},
    {"zfight --from-origin 5", "from-origin", 2},
    {"prepass --against fma --separation 1", "separation", 2},
    {"prepass --against fma -f inf", "range", 2},
    {"prepass --against fma --range 1:2000", "range", 2},
    {"prepass --against fma -m log", "mapping", 2},
    {"prepass --against fma --ortho -n -5 -f 5", "vertices", 2},
    {"prepass --against fma --ortho -n 0 -f 5", "vertices", 2},
    {"prepass --prepass-format d25", "prepass-format", 2},
    {"prepass --prepass-format unorm25", "prepass-format", 2},
    {"prepass --prepass-format d16,rg", "prepass-format", 2},
    {"prepass --prepass-format d16 --resolve min", "prepass-format", 2},
    {"prepass --prepass-format d16 --sample 5", "prepass-format", 2},
    {"prepass --prepass-format d16 -m log", "mapping", 2},
    {"prepass --resolve least", "resolve", 2},
    {"prepass --resolve min:3", "resolve", 2},
    {"prepass --resolve min:32", "resolve", 2},
    {"prepass --resolve min:1", "resolve", 2},
    {"prepass --resolve min:", "resolve", 2},
    {"prepass --resolve min --half min", "resolve", 2},
    {"prepass --resolve min --arith mesa", "resolve", 2},
    {"prepass --half middle", "half", 2},
    {"prepass --half average", "half", 2},
    {"prepass --half min --program fma", "half", 2},
    {"bias --api d3d13", "api", 2},
    {"bias --units 1.5", "units", 2},
    {"bias --api all --units 1", "api", 2},
    {"bias --api all --at 1 --range 1:2", "range", 2},
    {"bias --check", "check", 2},
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
    {"shadow --cascades 4:2", "cascades", 2},
    {"shadow --range 1:2", "range", 2},
    {"shadow --light-box 1x1x10 --range 1:11", "range", 2},
    {"shadow --light-box 1x1x10 --cascades 2", "cascades", 2},
    {"shadow --light-box 1x1x10 -f 5", "far", 2},
    {"shadow --light-box 1x1", "light-box", 2},
    {"shadow --spot 0", "spot", 2},
    {"shadow --engine quake", "engine", 2},
    {"shadow --check", "check", 2},
    {"shadow --filter vsm", "filter", 2},
    {"shadow --bias 1", "bias", 2},
    {"shadow --normal-bias 1", "normal-bias", 2},
    {"shadow --engine three --normal-bias -1", "normal-bias", 2},
    {"shadow --spot 171", "spot", 2},
    {"shadow --spot 60 --point", "spot", 2},
    {"shadow --light-box 1x1x1 --point", "light-box", 2},
    {"shadow --spot 60 --size 512x256", "size", 2},
    {"shadow --spot 60 --size 6", "size", 2},
    {"shadow --spot 60 --cascades 2", "cascades", 2},
    {"shadow --spot 60 --curvature 5", "curvature", 2},
    {"shadow --spot 60 --camera-depth d16:d3d", "camera-depth", 2},
    {"shadow --spot 60 -n 0", "near", 2},
    {"shadow --spot 60 -n 5 -f 5", "far", 2},
    {"shadow --spot 60 -f inf", "range", 2},
    {"shadow --spot 60 --range 0.05:2", "range", 2},
    {"shadow --spot 60 -f inf --range 1:1e13", "range", 2},
    {"shadow --spot 60 --range 1:20 --at 0.5", "at", 2},
    {"shadow --spot 60 --range 1:20 --at 1:20:log:17", "at", 2},
    {"shadow --spot 60 --from-origin 1e6", "from-origin", 2},
    {"shadow --at 5", "at", 2},
    {"shadow --distance", "distance", 2},
    {"shadow --point --distance -f inf", "far", 2},
    {"shadow --point --distance --api gl", "distance", 2},
    {"shadow --light-box 1mx1x1", "light-box", 2},
    {"shadow --fov 50 --hfov 50", "hfov", 2},
    {"shadow --viewport 32768x1", "viewport", 2},
    {"shadow --hfov 179 --viewport 1x100", "hfov", 2},
    {"shadow --api d3d13", "api", 2},
    {"shadow --slant 0:5", "slant", 2},
    {"plot error --cascades 2 -o x.svg", "cascades", 2},
    {"plot error --from-origin 5 -o x.svg", "from-origin", 2},
    {"plot shadow --preset unity -o x.svg", "preset", 2},
    {"plot shadow --angle 0 -o x.svg", "", 2},
    {"table -m all", "mapping", 2},
    {"plot shadow -m d3d,reversed -o x.svg", "", 2},
    {"methods encode -F d16,d24", "format", 2},
    {"methods linearize -m d3d,reversed", "mapping", 2},
    {"plot pareto linearize -m d3d,reversed --mine x.glsl:f --csv", "mapping", 2},
    {"shadow --raster swiftshader --subpixel 4", "subpixel", 2},
    {"methods interval -F unorm9", "format", 2},
    {"methods interval -m log", "mapping", 2},
    {"methods nothing", "", 2},
    {"methods -m gl", "mapping", 2},
    {"methods --ortho", "ortho", 2},
    {"methods encode --ortho", "ortho", 2},
    {"methods normal --ortho", "ortho", 2},
    {"methods linearize -m log --ortho", "ortho", 2},
    {"methods linearize -n 0 --ortho", "near", 2},
    {"methods --tolerance 1%", "tolerance", 2},
    {"check /nonexistent", "", 3},
    {"check", "", 2},
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
    {"plot error -o x.svg --figure-size 9999999", "figure-size", 2},
    {"plot error -o x.svg --figure-size 800x70", "figure-size", 2},
    {"plot error -o x.svg --at 5", "at", 2},
    {"plot error -o x.svg --axes 1:2", "axes", 2},
    {"plot error -o x.svg --axes 2:1,1:2", "axes", 2},
    {"plot error -o x.svg --axes 1:2,0:2", "axes", 2},
    {"plot map -o x.svg --axes 1:2,1:2", "axes", 2},
    {"plot error -o x.svg --beside '-n -1'", "near", 2},
    {"plot error -o x.svg --beside '-n 1 --title x'", "beside", 2},
    {"plot interval -F d24 -o x.svg --beside '--viewport 640x480 --fov 40 --hfov 50'", "hfov", 2},
    {"plot distribution -o x.svg -F unorm24 --beside '-F unorm2'", "beside", 2},
    {"plot map -o x.svg --at 5 --range 1:2", "at", 2},
    {"plot error -o x.svg --from-origin 5", "from-origin", 2},
    {"plot distribution -o x.svg --model float", "model", 2},
    {"table --fov 50", "fov", 2},
    {"table --slant 0:5", "slant", 2},
    {"budget --hfov 50", "hfov", 2},
    {"budget --subpixel 8", "subpixel", 2},
    {"budget --triangle-class slim=4", "triangle-class", 2},
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
    {"zfight --slant 0:5", "slant", 2},
    {"plot fight --csv --at 2000", "at", 2},
    {"plot fight --csv --at 1:5:log:3", "at", 2},
    {"plot fight --csv --range 1:5", "range", 2},
    {"plot fight --csv --ortho", "ortho", 2},
    {"plot fight --csv --arith mesa", "arith", 2},
    {"plot fight --csv --subpixel 4", "subpixel", 2},
    {"plot fight --csv --raster spec-gl", "raster", 2},
    {"plot fight --csv --raster swiftshader -F d24", "format", 2},
    {"plot fight --csv -F d24,d16", "", 2},
    {"plot fight --csv --at 999 --slant 89,10", "", 2},
    {"plot error --csv --slant 5,5", "slant", 2},
    {"zfight --rasterize --raster spec-d3d", "raster", 2},
    {"zfight --rasterize --raster swiftshader -F unorm24", "format", 2},
    {"zfight --rasterize -F fp16", "format", 2},
    {"zfight --rasterize --raster softpipe -F unorm16", "format", 2},
    {"zfight --rasterize --raster softpipe -m gl", "mapping", 2},
    {"zfight --rasterize --ortho", "rasterize", 2},
    {"zfight --rasterize --arith ieee", "arith", 2},
    {"zfight --rasterize --rounding zero", "rounding", 2},
    {"zfight --rasterize --separation 1", "separation", 2},
    {"zfight --rasterize -m log", "mapping", 2},
    {"zfight --rasterize -f inf", "range", 2},
    {"zfight --rasterize --viewport 32768x8", "viewport", 2},
    {"plot interval --csv --model float --viewport 64x48 --slant 5,5", "slant", 2},
    {"zfight --rasterize --fov 50 --hfov 50", "hfov", 2},
    {"zfight --subpixel 4", "subpixel", 2},
    {"bias --viewport 64x48 -m d3d,log", "viewport", 2},
    {"bias --viewport 64x48 --ortho", "viewport", 2},
    {"bias --raster llvmpipe", "raster", 2},
    {"plot budget -o x.svg -F d24 -m d3d --subpixel 8", "subpixel", 2},
    {"plot interval -o x.svg -F d24 -m d3d --model staged --viewport 64x48", "viewport", 2},
    {"plot error -o x.svg -F d24 -m d3d --viewport 64x48", "viewport", 2},
    {"plot shadow -o x.svg --slant 0:5", "slant", 2},
    {"zfight --range 1:1.1 --viewport 64x48 --slant 5,5", "slant", 2},
    {"texture --synthetic plane --size 64x36 --fov 50 --hfov 50", "hfov", 2},
    {"texture --synthetic plane --size 1x4096 --hfov 170", "hfov", 2},
    {"texture --synthetic plane --size 8x8 --intrinsics 9,9,1,1 --matrix 1,0,0,0,0,1,0,0,0,0,2,-2,0,0,1,0", "matrix",
     2},
    {"texture --synthetic plane --size 64x36 --intrinsics 9,9,1,1 --hfov 50", "intrinsics", 2},
    {"texture --synthetic plane --radial --fov 50", "radial", 2},
    {"texture --synthetic plane --ortho --hfov 50", "hfov", 2},
    {"texture --product effect:fog --hfov 30", "hfov", 2},
    {"plot budget -o x.svg --model exact", "model", 2},
    {"plot error -o x.svg --tolerance 1%", "tolerance", 2},
    {"plot needs tests/needs/village.need -o x.svg -n 1", "near", 2},
    {"plot needs tests/needs/village.need -o x.svg -f 1", "far", 2},
    {"plot error -o x.svg --theme pink", "theme", 2},
    {"list nothing", "", 2},
    {"list formats --tolerance 1%", "tolerance", 2},
    {"texture", "", 2},
    {"texture /nonexistent.png", "", 3},
    {"texture --synthetic nothing", "synthetic", 2},
    {"texture --synthetic plane x.png", "synthetic", 2},
    {"texture --synthetic plane --fov 0", "fov", 2},
    {"texture --synthetic plane --ortho --fov 50", "fov", 2},
    {"texture --synthetic plane --ortho=0", "ortho", 2},
    {"texture --synthetic plane --look 1,2", "look", 2},
    {"texture --synthetic plane --look 0,0,0", "look", 2},
    {"texture --synthetic plane --sky 1", "sky", 2},
    {"texture --synthetic plane --size 0x5", "size", 2},
    {"texture --synthetic plane --eye 1,2", "eye", 2},
    {"texture --synthetic plane --parameter radius=1", "parameter", 2},
    {"texture --synthetic plane -F unorm16,fp32", "format", 2},
    {"texture --synthetic plane -m d3d,gl", "mapping", 2},
    {"texture --synthetic plane --error-map", "error-map", 2},
    {"texture --synthetic plane --error-map=x.npy", "error-map", 2},
    {"texture --synthetic plane --product eye -o x.npy --error-map=", "error-map", 2},
    {"texture --synthetic plane --product eye -o x.npy --error-map=x.txt", "error-map", 2},
    {"texture --synthetic plane --product eye -o x.npy --error-map=x.npy", "error-map", 2},
    {"texture --synthetic plane --product eye --figure x.svg --error-map=x.npy", "error-map", 2},
    {"texture --synthetic plane --product eye -o x.npy --error-map=y.npy --error-map=z.npy", "error-map", 2},
    {"texture --synthetic plane --product nothing -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect -o x.npy", "product", 2},
    {"texture --synthetic plane --product eye:low -o x.npy", "product", 2},
    {"texture --synthetic plane --product eye:low -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect:fog:low -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect:outline:nothing -o x.npy", "product", 2},
    {"texture --synthetic plane --at 5", "at", 2},
    {"texture --synthetic plane --size 5x4 --pixel '1,3;1,4'", "pixel", 2},
    {"texture --synthetic plane --pixel '1,3;1'", "pixel", 2},
    {"texture --synthetic plane --pixel '1;3'", "pixel", 2},
    {"texture --synthetic plane --pixel '1,3,5,6'", "pixel", 2},
    {"texture --synthetic plane --pixel 1,3 --product eye -o x.npy", "pixel", 2},
    {"texture --product effect:fog --pixel 1,3", "pixel", 2},
    {"texture --product effect:height-fog --pixel 640,3", "pixel", 2},
    {"texture --synthetic plane --product effect:fog --pixel 1,3 --error-map", "error-map", 2},
    {"texture --synthetic plane --product effect:intersection --pixel 1,3", "parameter", 2},
    {"texture --product effect:height-fog --pixel '1,3;2,2'", "pixel", 2},
    {"table --ortho=3", "ortho", 2},
    {"texture --product effect:height-fog --sky 0.1", "sky", 2},
    {"texture --product effect:motion-blur", "product", 2},
    {"texture --product effect:motion-blur --look 1,2,3 --last-eye 1,2,3 --last-look 1,2,3", "last-look", 2},
    {"texture --product effect:height-fog --eye 1,2,3 --look 1,2,3", "look", 2},
    {"texture --synthetic plane --product effect:motion-blur -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect:fog --last-look 0,1,5 -o x.npy", "last-look", 2},
    {"texture --synthetic plane --last-eye 1,2,3", "last-eye", 2},
    {"texture --synthetic plane --product effect:edge --parameter slope=1 -o x.npy", "parameter", 2},
    {"texture --product effect:edge --parameter sample-distance=2", "parameter", 2},
    {"texture --synthetic plane --overlay 1", "overlay", 2},
    {"texture --synthetic plane --histogram x.txt", "histogram", 2},
    {"texture --synthetic plane --histogram x.svg --pixel 1,1", "histogram", 2},
    {"texture --synthetic plane --histogram x.svg -o x.npy", "histogram", 2},
    {"texture --synthetic plane --histogram - --json", "histogram", 2},
    {"texture --synthetic plane --histogram x.svg --product eye --figure y.svg", "histogram", 2},
    {"texture --synthetic plane --histogram x.svg -o x.svg", "histogram", 2},
    {"texture --synthetic plane --product pack:rg -o x.png --histogram x.svg", "histogram", 2},
    {"texture --synthetic plane --overlay 1 --histogram x.svg", "overlay", 2},
    {"texture --product effect:fog --histogram x.svg", "histogram", 2},
    {"texture --synthetic plane --product normal:high --figure x.svg --overlay 1", "overlay", 2},
    {"texture --synthetic plane --product eye --error-map --figure x.svg --overlay 1", "overlay", 2},
    {"texture --synthetic plane --product pack:rg -o x.png --overlay 1", "overlay", 2},
    {"texture --product effect:fog --overlay 1", "overlay", 2},
    {"texture --synthetic plane --figure-size 330", "figure-size", 2},
    {"texture --synthetic plane --title x", "title", 2},
    {"texture --synthetic plane --type png", "type", 2},
    {"texture --product effect:fog --type png", "type", 2},
    {"texture --synthetic plane --product position:nothing -o x.npy", "product", 2},
    {"texture --synthetic plane --product normal:nothing -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect:nothing -o x.npy", "product", 2},
    {"texture --synthetic plane --product eye --product normal:high -o x.npy", "product", 2},
    {"texture --synthetic plane --product eye --product raw -o x.npy", "product", 2},
    {"texture --synthetic plane --product linear01 --product normal:high -o x.npy", "product", 2},
    {"texture --product effect:fog --product linear01", "product", 2},
    {"texture --product effect:fog --product raw", "product", 2},
    {"texture --synthetic plane --product eye -o x.txt", "output", 2},
    {"texture --synthetic plane --product eye --figure x.txt", "figure", 2},
    {"texture --synthetic plane --product eye --csv -o x.npy", "csv", 2},
    {"texture --synthetic plane --product eye --csv -o x.npy", "csv", 2},
    {"texture --product effect:fog -f inf", "far", 2},
    {"texture --product effect:fog --fov 30", "fov", 2},
    {"texture --product effect:fog --parameter level=1", "parameter", 2},
    {"texture --product effect:fog --at 5000", "at", 2},
    {"bias --arith mesa", "arith", 2},
    {"bias --units 5 --viewport 64x48 --rasterize --render x.txt -F d16 -m d3d", "render", 2},
    {"bias --units 5 --viewport 64x48 --rasterize --render x.png -F d16,d24 -m d3d", "render", 2},
    {"bias --remedy nothing", "remedy", 2},
    {"bias --rasterize --raster spec-d3d --viewport 64x48", "raster", 2},
    {"code --ortho --depth-range 0.2:0.8", "depth-range", 2},
    {"code --uniforms --language fpcore", "uniforms", 2},
    {"code --what encode -F fp32", "format", 2},
    {"code --what projection -m log", "mapping", 2},
    {"code -m d3d,gl", "mapping", 2},
    {"code -F d16,d24", "format", 2},
    {"code --what encode -F d16,d24", "mapping", 2},
    {"convert d24", "", 2},
    {"convert d24 nothing", "", 2},
    {"convert d24 rg", "", 2},
    {"convert fp32 d24 --read divide", "read", 2},
    {"convert d24 d16 --read divide --write shift", "read", 2},
    {"convert d24 fp32 --write shift", "write", 2},
    {"convert d24 fp32 --write round", "write", 2},
    {"convert d24 d16 --saturate --write shift", "saturate", 2},
    {"convert d24 fp32 --saturate", "saturate", 2},
    {"convert d24 d16 --flush", "flush", 2},
    {"judge x.csv -F d16,d24", "format", 2},
    {"methods encode --mine x.glsl:f", "mine", 2},
    {"methods interval --device x", "device", 2},
    {"methods encode -F fp16 --device x", "device", 2},
    {"plot budget -o x.svg --composition once", "composition", 2},
    {"table --lattice even", "lattice", 2},
    {"table --lattice even:0.1@0.2", "lattice", 2},
    {"scene " STREET " -F d16,d24", "format", 2},
    {"scene " STREET " --within 0.001", "within", 2},
    {"scene " STREET " --within 10 --report junit --csv", "report", 2},
    {"scene " STREET " --report junit", "report", 2},
    {"scene " STREET " --separation 0 --emit-need x.need", "emit-need", 2},
    {"scene " STREET " --api d3d11,gl", "api", 2},
    {"scene " STREET " --eye 1,2,3 --look 1,2,3", "look", 2},
    {"scene " STREET " --camera one", "camera", 2},
    {"scene " STREET " --path /nonexistent", "path", 3},
    {"scene " STREET " --eye 0,1,9 --look 0,0,0 --viewport 64x48 --slant 0:5", "slant", 2},
    {"scene " STREET " --eye 0,1,9 --look 0,0,0 --render x.txt", "render", 2},
    {"scene " STREET " --eye 0,1,9 --look 0,0,0 --render x.png --viewport 16384x16384", "viewport", 2},
    {"shadow --rasterize --raster spec-d3d", "raster", 2},
    {"shadow --rasterize --raster softpipe -F fp16", "format", 2},
    {"shadow --rasterize --render x.txt", "render", 2},
    {"shadow --rasterize --render x.png -F d16,d24", "render", 2},
    {"solve --viewport 64x48 --model exact --separation 0.1 --at 5", "model", 2},
    {"solve --viewport 64x48 -m log --separation 0.1 --at 5", "mapping", 2},
    {"solve --matrix 1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m d3d --for near --separation 0.1 --at 1.5", "matrix", 2},
    {"solve --model float --error 0.1 --at 5", "model", 2},
    {"solve --preset maplibre:height=800 -F d16,d24 --separation 1", "format", 2},
    {"solve --preset maplibre:height=800 -m d3d,gl --separation 1", "mapping", 2},
    {"solve --for frusta -f 1000 -F d16,d24 -m d3d --separation 0.1", "format", 2},
    {"solve --for frusta -f 1000 -F d16 -m d3d,gl --separation 0.1", "mapping", 2},
    {"texture --synthetic plane --as even:0.1", "as", 2},
    {"texture --synthetic plane --product raw --as even:0.1 -o x.npy", "as", 2},
    {"texture --synthetic plane --range 1:2", "range", 2},
    {"texture --synthetic plane --product eye --range 1:2 -o x.png", "range", 2},
    {"texture --synthetic plane --product effect:fog --range 0:1 -o x.npy", "range", 2},
    {"texture --synthetic plane --picture x.png", "picture", 2},
    {"texture --synthetic plane --product effect:fog --picture x.png -o x.npy", "picture", 2},
    {"texture --synthetic plane --normal-format directx", "normal-format", 2},
    {"texture --synthetic plane --product normal:low --normal-format directx -o x.npy", "normal-format", 2},
    {"texture --synthetic plane --hi-z 2", "hi-z", 2},
    {"texture --synthetic plane --channel z", "channel", 2},
    {"texture --synthetic plane --packing rgba", "packing", 2},
    {"table --depth-range 0.5", "depth-range", 2},
    {"table --depth-range 0.5:0.5", "depth-range", 2},
    {"table --depth-range 0:2", "depth-range", 2},
    {"budget -m d3d --log2 glsl", "log2", 2},
    {"table --slant 0:91 --viewport 64x48", "slant", 2},
    {"plot fight --csv --slant 91,0", "slant", 2},
    {"table --matrix 1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m log", "mapping", 2},
    {"table --matrix 1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m d3d -n 1", "matrix", 2},
    {"table --matrix 1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m d3d --ortho", "matrix", 2},
    {"table --matrix 1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m reversed", "mapping", 2},
    {"table --matrix=-1,0,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m d3d", "matrix", 2},
    {"table --matrix 1,2,0,0,0,2,0,0,0,0,2,-2,0,0,1,0 -m d3d", "matrix", 2},
    {"table --matrix 1,0,0,0,3,2,0,0,0,0,2,-2,0,0,1,0 -m d3d", "matrix", 2},
    {"table --matrix 1,0,0,0,0,2,0,0,0,0,0,0,0,0,1,0 -m d3d", "matrix", 2},
    {"table --matrix 1,2,3", "matrix", 2},
    {"table --matrix -1,1,-1,1", "matrix", 2},
    {"table -F rg -m d3d --rounding zero", "rounding", 2},
    {"table -F rg,d16 --arith mesa -m linear", "arith", 2},
    {"table -m linear --arith mesa", "arith", 2},
    {"table --at 1:5:lin:1", "at", 2},
    {"table --at 5:1:lin:3", "at", 2},
    {"table --at 0:5:log:3", "at", 2},
    {"table --at 1:5:codes", "at", 2},
    {"table --at @/nonexistent", "at", 3},
    {"table --at @/dev/null", "at", 2},
    {"table --nosuch", "", 2},
    {"table -Q", "", 2},
    {"qable", "", 2},
    {"table 5", "", 2},
    {"check", "", 2},
    {"help nothing", "", 2},
    {"table -o x.png", "output", 2},
    {"texture --synthetic plane --size 65536x65536", "size", 2},
    {"code --what encode --depth-range 0.2:0.8", "depth-range", 2},
    {"code --language glsl --what projection x", "", 2},
    {"code --what projection x -m d3d", "", 2},
    {"code encode", "", 2},
    {"convert d24 d16 --write shift:5", "write", 2},
    {"convert d24 fp32 --write cut:0.5", "write", 2},
    {"judge", "", 2},
    {"judge nosuch.glsl", "", 3},
    {"methods linearize --mine nosuch.glsl:f", "", 3},
    {"plot error", "", 2},
    {"plot error --tolerance 1% --csv -n 1 -f 5", "tolerance", 2},
    {"plot pareto --mine x:f --csv", "", 3},
    {"shadow --curvature x", "curvature", 2},
    {"shadow --camera-depth d16:d3d,1:5", "camera-depth", 2},
    {"shadow --filter pcf:99", "filter", 2},
    {"shadow --filter vsm:1", "filter", 2},
    {"solve --separation 1e6 --at 5 -f 1000", "separation", 2},
    {"solve --error 0.1 --at 5 --viewport 64x48", "error", 2},
    {"solve --for frusta -f 1000", "separation", 2},
    {"solve --for frusta -f inf --separation 1", "far", 2},
    {"solve --preset maplibre:height=800 --for far --separation 1", "for", 2},
    {"solve --preset maplibre:height=800", "separation", 2},
    {"solve --preset maplibre:height=800 --separation 1 --at 1,2", "at", 2},
    {"texture --synthetic plane --radial", "radial", 2},
    {"texture --synthetic plane --product effect:fog --parameter level=1 --parameter level=2 -o x.npy", "parameter", 2},
    {"texture --synthetic plane --product pack:rg", "", 2},
    {"texture --synthetic plane --product pack:rg -o x.pfm", "output", 2},
    {"texture --synthetic plane --product packed-normal -o x.npy", "product", 2},
    {"texture --synthetic plane --product effect:fog --error-map --range 0:1 -o x.png", "range", 2},
    {"methods linearize --mine x.glsl:f --ortho", "ortho", 2},
    {"table --preset maplibre:height=800,zoom=1,zoom=2", "preset", 2},
    {"texture --synthetic plane --parameter distance", "parameter", 2},
    {"texture --synthetic plane --parameter distance=-1", "parameter", 2},
    {"texture --synthetic plane --product eye", "", 2},
    {"texture --synthetic plane -F fp32 --product linear01 -o x.xyz", "output", 2},
    {"texture --parameter distance=1 x.npy", "parameter", 2},
    {"texture --metric mm", "", 2},
    {"texture --synthetic plane --metric mm", "metric", 2},
    {"texture --synthetic plane -F unorm32", "format", 2},
    {"texture --stereo focal=1 x.png", "stereo", 2},
    {"texture --stereo focal=x,baseline=1 x.png", "stereo", 2},
    {"texture --stereo nothing x.png", "stereo", 2},
    {"texture --metric mm,wrong x.png", "metric", 2},
    {"world -f 5", "at", 2},
    {"prepass --against fma -n 1 -f 1e39", "far", 2},
};

/* The line with a word of it changed, the last that stands behind a blank or one of ":,="; false: there is none. */
static bool put_word(const char *line, const char *from, const char *to, char out[320]) {
    const char *found = NULL;
    for (const char *at = strstr(line, from); at != NULL; at = strstr(at + 1, from))
        if (at > line && strchr(" :,=", at[-1]) != NULL && strchr(" ", at[strlen(from)]) != NULL)
            found = at;
    if (found != NULL)
        snprintf(out, 320, "%.*s%s%s", (int)(found - line), line, to, found + strlen(from));
    return found != NULL;
}

/* A limit that a refusal names is not refused so itself, and what lies beyond it is. */
static void check_limit(tally *t, const char *line, const char *errors, const char *got, const char *limit,
                        int beyond) {
    const size_t said = (size_t)(strstr(errors, ", got ") - errors), option = strcspn(errors, " ") + 1;
    const double step = strstr(errors, "whole") != NULL ? 1 : 1e-12 * fmax(fabs(strtod(limit, NULL)), 1);
    char text[40], changed[320];
    for (int wrong = 0; wrong < 2; wrong++) {
        snprintf(text, sizeof text, "%.17g", strtod(limit, NULL) + wrong * beyond * step);
        if (!put_word(line, got, wrong ? text : limit, changed))
            return;
        printed p = print_of("%s%s", changed, wrong ? "" : " -o /nonexistent/x"); /* which is all that is left to say */
        const size_t alike = wrong ? option + strcspn(errors + option, " ") : said;
        TALLY(t, (strncmp(p.errors, errors, alike) == 0) == wrong, "%s: %s", changed, p.errors);
        printed_free(&p);
    }
}

/* Where a single number was refused that must be from one to another. */
static void check_limits(tally *t, const char *line, const char *errors) {
    char lo[32], hi[32], got[32];
    const char *from = strstr(errors, "from "), *behind = strstr(errors, ", got ");
    if (from == NULL || behind == NULL || from > behind || strstr(errors, "LO:HI, ") != NULL ||
        strstr(errors, "0, or ") != NULL || sscanf(from, "from %31[-+0-9.e] to %31[-+0-9.e]", lo, hi) != 2 ||
        sscanf(behind + 6 + (behind[6] == '\''), "%31[^'\n]", got) != 1 || strspn(got, "-0123456789.e") < strlen(got) ||
        strstr(behind, " in ") != NULL)
        return;
    check_limit(t, line, errors, got, lo, -1);
    check_limit(t, line, errors, got, hi, 1);
}

/* The line again, without what names the program and the option. */
static void check_told(tally *t, const char *arguments, const printed *p, const char *option, const char *begin) {
    json_t *root = json_of(p->out);
    const char *at_fault = text_at(root, "error.option"), *text = text_at(root, "error.text");
    const size_t skipped = strlen(begin), length = strlen(p->errors);
    TALLY(t, strcmp(at_fault != NULL ? at_fault : "", option) == 0, "%s: %s", arguments, p->out);
    TALLY(t, length == skipped + strlen(text) + 1 && strncmp(p->errors + skipped, text, strlen(text)) == 0, "%s: %s%s",
          arguments, p->errors, p->out);
    TALLY(t, number_at(root, "error.status") == p->status, "%s: %s", arguments, p->out);
    json_decref(root);
}

/* None of the files that the lines name is there; one that is goes, or the next line would be accused. */
static void check_unwritten(tally *t, const char *arguments) {
    static const char *const names[] = {"x.svg", "x.npy", "x.png", "x.txt", "x.pfm", "x.xyz"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        TALLY(t, unlink(names[i]) != 0, "%s: wrote %s", arguments, names[i]);
}

static void check_refusal(tally *t, const char *arguments, const char *option, int status) {
    char begin[96];
    printed p = print_of("%s", arguments);
    check_unwritten(t, arguments);
    TALLY(t, p.status == status, "%s: exit status %d, not %d: %s", arguments, p.status, status, p.errors);
    snprintf(begin, sizeof begin, option != NULL && *option != '\0' ? "depthprec: --%s: " : "depthprec: ", option);
    if (option != NULL) {
        TALLY(t, strncmp(p.errors, begin, strlen(begin)) == 0, "%s: does not begin with '%s': %s", arguments, begin,
              p.errors);
        TALLY(t, (strncmp(p.errors, "depthprec: --", 13) == 0) == (*option != '\0'), "%s: %s", arguments, p.errors);
        TALLY(t, p.errors[0] != '\0' && strchr(p.errors, '\n') == p.errors + strlen(p.errors) - 1, "%s: not one line",
              arguments);
        if (p.out[0] != '\0' && strstr(arguments, "--json") != NULL) { /* the same as JSON */
            check_told(t, arguments, &p, option, begin);
        } else {
            TALLY(t, p.out[0] == '\0', "%s: printed something", arguments);
        }
        if (status == 2)
            check_limits(t, arguments, p.errors);
    } else {
        TALLY(t, p.out[0] != '\0', "%s: printed nothing", arguments);
    }
    printed_free(&p);
}

TEST(test_planes) {
    tally t = {.name = "planes"};
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

TEST(test_refusals) {
    tally t = {.name = "refusals"};
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++) {
        const char *given = refusals[i].arguments;
        char line[256];
        check_refusal(&t, given, refusals[i].option, refusals[i].status);
        const bool answers = strncmp(given, "solve ", 6) == 0 || strncmp(given, "bias ", 5) == 0;
        if (!answers || strstr(given, "--csv") != NULL || strstr(given, "--link") != NULL)
            continue;
        snprintf(line, sizeof line, "%s --json", given);
        check_refusal(&t, line, refusals[i].option, refusals[i].status);
    }
    tally_end(&t);
}

/* A file that cannot be read is told by its name and the system's reason, whichever way it is asked for. */
TEST(test_unreadable) {
    static const char *const lines[] = {
        "texture %s",
        "texture %s --product eye -o none/x.pfm",
        "check %s",
        "scene %s",
        "scene " STREET " --path %s",
        "judge --pairs %s",
        "judge %s:f",
        "methods linearize --mine %s:f",
        "table --at @%s",
        "texture --synthetic plane --matrix %s",
        "world --matrix %s",
        "table --arith ./%s",
        "bias --raster ./%s",
        "plot fight --raster ./%s -o /dev/null --type svg",
    };
    static const char *const named[] = {"--path", "--at", "--matrix", "--arith", "--raster"};
    static const struct {
        const char *path, *why;
    } files[] = {{"none.json", "No such file or directory"}, {"src/cli", "Is a directory"}};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        for (size_t k = 0; k < sizeof files / sizeof files[0]; k++) {
            char line[256];
            snprintf(line, sizeof line, lines[i], files[k].path);
            printed p = print_of("%s", line);
            if (p.status != 3 || strstr(p.errors, files[k].path) == NULL || strstr(p.errors, files[k].why) == NULL ||
                strchr(p.errors, '\n') != p.errors + strlen(p.errors) - 1 || p.out[0] != '\0')
                fail_msg("%s: exit status %d, %s", line, p.status, p.errors);
            for (size_t o = 0; o < sizeof named / sizeof named[0]; o++) {
                char begins[32];
                snprintf(begins, sizeof begins, "depthprec: %s: ", named[o]);
                assert_true(strstr(lines[i], named[o]) == NULL || strncmp(p.errors, begins, strlen(begins)) == 0);
            }
            printed_free(&p);
        }
    check_says(3, "none.npy: No such file or directory", "judge --pairs none.npy");
    static const char *const settings[] = {"matrix = \"none.txt\";", "near = 1; far = 9; arith = \"none.txt\";"};
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++) {
        char line[256];
        snprintf(line, sizeof line, "check %s",
                 scratch_text("names.need",
                              "cameras = { a = { %s mapping = \"d3d\"; format = \"fp32\"; }; };\n"
                              "requirements = { r = { camera = \"a\"; range = [2, 4]; separation = 0.1; }; };\n",
                              settings[i]));
        check_says(3,
                   i == 0 ? "names.need:1: matrix: 'none.txt' cannot be read: No such file or directory"
                          : "names.need:1: arith: 'none.txt' cannot be read: No such file or directory",
                   "%s", line);
    }
}

/* What is read is not overwritten, and stays as it is: what an option names, by a link too, and what a file names. */
TEST(test_read_and_written) {
    static const char matrix[] = "1 0 0 0 0 1 0 0 0 0 1.25 -1.25 0 0 1 0\n",
                      face[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const struct {
        const char *name, *text, *line;
    } rows[] = {{"depths.txt", "1 2 3\n", "table --at @%1$s -o %1$s.link"},
                {"pairs.csv", "in,out\n0,1\n0.5,2\n1,4\n", "judge --pairs %1$s -n 1 -f 4 -m d3d -o %1$s.link"},
                {"model.obj", face, "scene %1$s -o %1$s.link"},
                {"model.obj", face, "scene %1$s --emit-need %1$s.link"},
                {"matrix.txt", matrix, "texture --synthetic plane --matrix %1$s --product eye -o %1$s.link"},
                {"matrix.txt", matrix, "check %2$s -o %1$s.link"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char need[256], path[256], link[300], line[1024];
        snprintf(need, sizeof need, "%s",
                 scratch_text("camera.need",
                              "cameras = { a = { matrix = \"matrix.txt\"; mapping = \"d3d\"; format = \"fp32\"; }; };\n"
                              "requirements = { r = { camera = \"a\"; range = [2, 4]; separation = 0.1; }; };\n"));
        snprintf(path, sizeof path, "%s", scratch_text(rows[i].name, "%s", rows[i].text));
        snprintf(link, sizeof link, "%s.link", path);
        assert_int_equal(symlink(path, link), 0);
        snprintf(line, sizeof line, rows[i].line, path, need);
        printed p = print_of("%s", line);
        char *after = text_of_file(path);
        if (p.status != 2 || strstr(p.errors, "a file that is read") == NULL || strcmp(after, rows[i].text) != 0)
            fail_msg("%s: exit status %d, %s%s", line, p.status, p.errors, after);
        free(after);
        printed_free(&p);
        unlink(link);
    }
}

/* One letter in four may be wrong, and one more: what is farther from each name is another word. */
TEST(test_too_far) {
    check_says(2, "did you mean 'vulkan'", "bias --api vlkn");
    check_says(2, "!did you mean", "bias --api vln");
    check_says(2, "did you mean 'webgpu'", "bias --api webg");
    check_says(2, "did you mean 'list'", "lst");
    check_says(2, "!did you mean", "xyz");
}

/* Planes that nearly meet are told with the digits in which they differ. */
TEST(test_digits_of_planes) {
    check_says(2, "got near 0.30000000000000004, far 0.3\n", "table -n 0.30000000000000004 -f 0.3");
    check_says(2, "got near 0.3, far 0.3\n", "table -n 0.3 -f 0.3");
    check_says(2, "got 0.99999951 and 1\n", "table --depth-range 0.99999951:1");
}

/* Of what has two sides each is held to its limits by itself, and either may reach them. */
static const struct {
    const char *line, *option;
    int least[2], most[2];
} sides[] = {
    {"shadow --size", "size", {11, 11}, {32768, 32768}},
    {"texture --synthetic plane -F d16 --json --size", "size", {1, 1}, {65536, 65536}},
    {"table --at 5 --viewport", "viewport", {1, 1}, {32768, 32768}},
    {"plot share -F fp16 -m d3d --csv --figure-size", "figure-size", {320, 200}, {8192, 8192}},
};

TEST(each_side_has_its_limits) {
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++)
        for (int k = 0; k < 8; k++) {
            const int wrong = k < 4, which = k / 2 % 2;
            int size[2] = {sides[i].least[0], sides[i].least[1]};
            size[which] = k % 2 ? sides[i].most[which] + wrong : sides[i].least[which] - wrong;
            printed p = print_of("%s %dx%d", sides[i].line, size[0], size[1]);
            if (p.status != (wrong ? 2 : 0) || (wrong && strstr(p.errors, sides[i].option) == NULL))
                fail_msg("%s %dx%d: exit status %d, %s", sides[i].line, size[0], size[1], p.status, p.errors);
            printed_free(&p);
        }
}

/* The last value that is accepted, and the first that is not. */
TEST(limits_between_options) {
    static const struct {
        const char *line, *last, *beyond, *option;
    } rows[] = {
        {"convert d24 d16 --code", "16777215", "16777216", "code"},
        {"convert d16 d24 --code", "0,65535", "0,65536", "code"},
        {"code --what encode -F", "unorm24", "unorm25", "format"},
        {"scene " STREET " --angle", "89", "89.1", "angle"},
        {"scene " STREET " --separation", "1e50", "1.1e50", "separation"},
        {"scene " STREET " -f 500 --within", "500", "500.1", "within"},
        {"scene " STREET " -n 0.5 --within", "0.5", "0.49", "within"},
        {"shadow --rasterize --kernel", "32", "33", "rasterize"},
        {"table --at", "1:10:lin:2", "1:10:lin:1", "at"},
        {"table --at", "1:10:log:2", "1:10:log:1", "at"},
    };
    tally t = {.name = "limits"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[160];
        printed p = print_of("%s %s", rows[i].line, rows[i].last);
        TALLY(&t, p.status <= 1, "%s %s: exit status %d, %s", rows[i].line, rows[i].last, p.status, p.errors);
        printed_free(&p);
        snprintf(line, sizeof line, "%s %s", rows[i].line, rows[i].beyond);
        check_refusal(&t, line, rows[i].option, 2);
    }
    tally_end(&t);
}

/* A range needs two binary32 depths in it: those between the middles of their neighbours, none, one or two. */
TEST(test_depths_of_a_range) {
    static const struct {
        double lo, hi; /* in steps of binary32 from 4 on */
        bool enough;
    } rows[] = {{0.25, 0.75, false}, {1.25, 1.5, false}, {0.5, 1.5, false}, {1, 1.5, false},  {0.75, 1, false},
                {0.75, 2.25, true},  {1, 2, true},       {0, 1, true},      {0.5, 2.25, true}};
    tally t = {.name = "depths of a range"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[128];
        snprintf(line, sizeof line, "zfight -F fp32 -m reversed --range %.17g:%.17g", 4 + rows[i].lo * 0x1p-21,
                 4 + rows[i].hi * 0x1p-21);
        if (!rows[i].enough) {
            check_refusal(&t, line, "range", 2);
            continue;
        }
        printed p = print_of("%s", line);
        TALLY(&t, p.status == 0 && p.errors[0] == '\0', "%s: %d, %s", line, p.status, p.errors);
        printed_free(&p);
    }
    tally_end(&t);
}
