# SPDX-License-Identifier: GPL-3.0-or-later
"""Each camera of cameras.txt through the command line, a requirement file and the Python package:  doors.py PROGRAM FILE

Prints a line for each: its number and what each door says, the key at fault or the separation at a depth, to the bit; "-"
of a door that lacks a key.
"""
import json
import re
import struct
import subprocess
import sys

import depthprec

program, table = sys.argv[1:]
USUAL = {"near": "0.1", "far": "1000", "mapping": "d3d", "format": "fp32", "model": "exact"}
LIBRARY = {"near", "far", "format", "mapping", "ortho", "rounding", "model", "arith", "log_c", "viewport", "fov",
           "subpixel", "slant", "triangle", "preset", "unit", "raster"}
TRIANGLE = ("depth", "pixels", "slim")


def show(x):
    return struct.pack(">d", float("inf") if x is None else x).hex()  # JSON has null for it


def is_number(text):
    return re.fullmatch(r"[-+]?[0-9.]+(e[-+]?\d+)?", text) is not None


def option(key, value):
    name, parts = "--" + key.replace("_", "-"), value.split(",")
    if key == "ortho":
        return name
    if key == "triangle":
        return "--triangle-class=" + ",".join("%s=%s" % pair for pair in zip(TRIANGLE, parts))
    return "%s=%s" % (name, {"viewport": "x", "slant": ":"}.get(key, ",").join(parts))


def setting(key, value):
    if key == "preset":
        return 'preset = "%s";' % value
    parts = [part if is_number(part) or key == "ortho" else '"%s"' % part for part in value.split(",")]
    if key == "triangle":
        return "triangle = { %s };" % "; ".join("%s = %s" % pair for pair in zip(TRIANGLE, parts))
    return "%s = %s;" % (key, "(%s)" % ", ".join(parts) if len(parts) > 1 else parts[0])


def keyword(key, value):
    if key == "preset":
        return value
    parts = [float(part) if is_number(part) or part == "inf" else part for part in value.split(",")]
    if key == "subpixel" and parts[0] == int(parts[0]):
        return int(parts[0])
    if key == "viewport":
        return tuple(int(part) if isinstance(part, float) else part for part in parts)
    return value == "true" if key == "ortho" else parts[0] if len(parts) == 1 else tuple(parts)


def called(words, text=""):
    return subprocess.run([program, *words], input=text, capture_output=True, text=True, check=False)


def by_line(keys, at):
    got = called(["table", "--quiet", "--json", "--at=" + at, *(option(*pair) for pair in keys.items())])
    if got.returncode > 1:
        return re.search(r"--([a-z-]+): ", got.stderr).group(1).replace("-class", "").replace("-", "_")
    row = json.loads(got.stdout)["setups"][0]["rows"][0]
    return show(row.get("guarantee_slanted", row["guaranteed"]) if keys["model"] == "float" else row["separation"])


def by_file(keys, at):
    unit = 'unit = "%s";' % keys["unit"] if "unit" in keys else ""
    camera = " ".join(setting(*pair) for pair in keys.items() if pair[0] != "unit")
    got = called(["check", "--json", "-"], '%s cameras = { a = {\n%s }; };\n'
                 'requirements = { r = { camera = "a"; at = %s; separation = 1e300; }; };' % (unit, camera, at))
    if got.returncode > 1:
        line, key = re.search(r"-:(\d+): '?([a-z_]+)", got.stderr).groups()
        assert line == {"unit": "1", "at": "3"}.get(key, "2"), got.stderr
        return key
    return show(json.loads(got.stdout)["requirements"][0]["value"])


def by_python(keys, at):
    given = {{"triangle": "triangle_class"}.get(key, key): keyword(key, value) for key, value in keys.items()}
    if "preset" not in given and "unit" in given:
        return "-"
    try:
        camera = depthprec.Camera.preset(given.pop("preset"), **given) if "preset" in given else depthprec.Camera(**given)
        return show((camera.separation if keys["model"] == "float" else camera.lattice)(float(at)))
    except (depthprec.Error, TypeError, ValueError) as error:
        return str(error)


def with_units(keys):
    return any(re.search(r"[0-9][a-z]+$", keys.get(key, "")) for key in ("near", "far"))


for number, line in enumerate(open(table, encoding="ascii"), 1):
    if line.startswith("#"):
        continue
    said = dict(pair.split("=", 1) for pair in line.split("|")[1].split())
    depth = said.pop("at", "5")
    whole = {**({"model": "exact"} if "preset" in said else USUAL), **said}
    print(number, line.split("|")[0].strip(), by_line(whole, depth), by_file(whole, depth),
          by_python(whole, depth) if set(whole) <= LIBRARY and not with_units(whole) else "-", sep="\t", flush=True)
