# SPDX-License-Identifier: GPL-3.0-or-later
"""Random cameras in the form of cameras.txt, of which all doors must say the same:  walk.py SEED COUNT

Left out is what commands decide apart: a logarithm in the model float, or on slanted triangles.
"""
import random
import sys

seed, count = map(int, sys.argv[1:])
draw = random.Random(seed)
PRESETS = ("unity unity-gl unreal godot godot-mobile godot-compatibility three three-webgpu r3f aframe babylon playcanvas bevy "
           "cesium mujoco:extent=2 maplibre:zoom=20,height=800").split()
PERSPECTIVE = ["d3d", "gl", "reversed", "gl-reversed"]
OTHERS = ["linear", "log", "three-webgl", "three-webgpu", "cesium", "osgearth", "logarithmicDepthBuffer"]
UNITS = ["nm", "um", "mm", "cm", "in", "ft", "m", "km"]


def some(share, key, values, keys):
    if draw.random() < share:
        keys[key] = draw.choice(values)


def camera():
    keys = {}
    some(0.6, "preset", PRESETS, keys)
    slanted, computed = draw.random() < 0.3, draw.random() < 0.4
    often = 0.4 if keys else 1.0
    some(0.6, "unit", UNITS, keys)
    behind = ["10cm", "1in", "0.5km"] if "unit" in keys else []
    some(often, "near", ["0.1", "1", "0.01", "0", "-3"] + behind, keys)
    some(often, "far", ["1000", "inf", "50", "7"] + behind, keys)
    some(1.0 if slanted or computed or not keys.get("preset") else 0.4, "mapping",
         PERSPECTIVE if slanted or computed else PERSPECTIVE + OTHERS, keys)
    some(0.5 if keys.get("preset", "three-webgpu") != "three-webgpu" else 1.0, "format",
         ["fp32", "unorm24", "fp16", "unorm16", "D24_UNORM_S8_UINT"], keys)
    some(0.15, "ortho", ["true"], keys)
    some(0.3, "rounding", ["even", "zero"], keys)
    some(0.2, "log_c", ["2", "0.01"], keys)
    keys["model"] = "float" if slanted or computed else "exact"
    some(0.2, "arith", ["fused", "reciprocal", "mesa"], keys)
    if slanted:
        keys["viewport"] = draw.choice(["640,480", "480,640", "1,1"])
        some(0.5 if "preset" in keys else 1.0, draw.choice(["fov", "hfov"]), ["30", "90", "120"], keys)
        some(0.5 if "preset" in keys else 1.0, *draw.choice([("raster", ["llvmpipe", "spec-d3d", "spec-gl", "softpipe"]),
                                                             ("subpixel", ["4", "8"])]), keys)
        some(0.3, "slant", ["10,60", "0,0"], keys)
        some(0.3, "triangle", ["1.5,64,4"], keys)
    return {**keys, "at": draw.choice(["2", "5", "20"])}


print("# seed %d" % seed)
for _ in range(count):
    print("alike     | " + " ".join("%s=%s" % pair for pair in camera().items()))
