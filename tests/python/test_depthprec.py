# SPDX-License-Identifier: GPL-3.0-or-later
"""The package as it is installed: against rational arithmetic, against the program, and under any input."""
import ast
import array
import copy
import ctypes
import inspect
import json
import math
import os
import pickle
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import types
import unittest
import unittest.mock
import warnings
import zlib
from fractions import Fraction

import depthprec
from depthprec import Camera, Error, _arrays, _core, _program
from oracle import AFFINE, FORMATS, Setup, binary32, generator, nudge, random_depth, random_setup, relative

try:
    import numpy
except ImportError:
    numpy = None

PROGRAM = os.environ.get("DEPTHPREC", "build/depthprec")
CASES = 300 if not os.environ.get("DEPTHPREC_FULL") else 5000
TIGHT = Fraction(1, 2 ** 49)


def camera_of(s):
    return Camera(s.near, s.far, s.format, s.mapping, ortho=s.ortho, rounding=s.rounding)


def program(*words, input=None):
    done = subprocess.run([PROGRAM, *words], input=input, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          check=False)
    return done.stdout


def png_samples(path):
    """Grey samples of 16 bits, of rows without a filter or with that of differences."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, bits, colours = struct.unpack_from(">IIBB", data, at + 8)
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    assert (bits, colours) == (16, 0)
    rows, found = zlib.decompress(packed), []
    for y in range(height):
        row = bytearray(rows[y * (2 * width + 1):(y + 1) * (2 * width + 1)])
        assert row[0] in (0, 1)
        for x in range(3, len(row) if row[0] else 0):
            row[x] = (row[x] + row[x - 2]) & 255
        found += struct.unpack(">%dH" % width, row[1:])
    return found


class Oracle(unittest.TestCase):
    """Numbers, each against an exact one."""

    def test_codes(self):
        r = generator("codes")
        for _ in range(CASES):
            s = random_setup(r)
            c = camera_of(s)
            z = array.array("d", [random_depth(r, s) for _ in range(20)])
            want = [s.encode(x) for x in z]
            self.assertEqual(list(c.encode(z)), want, repr(c))
            self.assertEqual([c.encode(x) for x in z], want)

    def test_cells(self):
        r = generator("cells")
        for _ in range(CASES):
            s = random_setup(r)
            c = camera_of(s)
            for code in [s.encode(random_depth(r, s)) for _ in range(5)]:
                z, lo, hi = c.decode(code, bounds=True)
                want = s.eye(s.value(code))
                if want is None:
                    self.assertEqual(z, math.inf)
                else:
                    size = max(abs(want), abs(s.n) if s.ortho else 0)
                    self.assertLessEqual(abs(Fraction(z) - want), TIGHT * size, (c, code))
                for got, end in zip((lo, hi), s.cell(code)):
                    if end is None:
                        self.assertEqual(got, math.inf)
                    else:
                        size = max(abs(end), abs(s.n) if s.ortho else 0)
                        self.assertLessEqual(abs(Fraction(got) - end), TIGHT * size, (c, code))

    def test_window_depths(self):
        r = generator("windows")
        for _ in range(CASES):
            s = random_setup(r)
            z = [random_depth(r, s) for _ in range(10)]
            for x, got in zip(z, camera_of(s).window_depth(array.array("d", z))):
                self.assertLessEqual(relative(got, s.window(x)), Fraction(1, 2 ** 50), (camera_of(s), x))

    def test_decoded_windows(self):
        """Window depths as a float buffer hands them out: the depth of the nearest code, in any rounding."""
        r = generator("decoded")
        for _ in range(CASES):
            s = random_setup(r)
            c, exact = camera_of(s), Setup(s.near, s.far, s.format, s.mapping, s.ortho)
            codes = [r.randint(0, s.max) for _ in range(10)]
            d = array.array("d", [float(s.value(code)) for code in codes])
            self.assertEqual(list(c.decode_window(d)), list(c.decode(codes)), repr(c))
            self.assertEqual([exact.code(Fraction(x)) for x in d], codes)

    def test_intervals(self):
        r = generator("intervals")
        for _ in range(CASES):
            s = random_setup(r)
            z = [random_depth(r, s) for _ in range(5)]
            for x, got in zip(z, camera_of(s).interval(array.array("d", z))):
                lo, hi = s.cell(s.encode(x))
                if hi is None:
                    self.assertEqual(got, math.inf)
                else:
                    self.assertLessEqual(relative(got, hi - lo), Fraction(1, 10 ** 12), (camera_of(s), x))

    def test_lattice(self):
        """A step of the format from z on; where it reaches across the end of a binade, of either."""
        r = generator("lattice")
        for _ in range(CASES):
            s = random_setup(r)
            z = [random_depth(r, s) for _ in range(5)]
            for x, got in zip(z, camera_of(s).lattice(array.array("d", z))):
                self.assertTrue(self.is_lattice(s, x, got), (camera_of(s), x, got))

    def is_lattice(self, s, x, got):
        d = s.window(x)
        code = Setup(s.near, s.far, s.format, s.mapping, s.ortho, "zero").code(d)
        steps = {s.value(k + 1) - s.value(k) for k in (code - 1, code, code + 1) if k >= 0}
        for step in sorted(steps, reverse=True):
            end = s.eye(d - step if s.reversed else d + step)
            beyond = end is None or (not s.ortho and s.mapping != "linear" and end < 0)
            if beyond and got == math.inf:
                return True
            if not beyond and end - Fraction(x) <= got and relative(got, end - Fraction(x)) < Fraction(1, 10 ** 11):
                return True
        return False

    def test_separations(self):
        """Two surfaces that far apart get codes in order from a pipeline of this test in binary32, near and far."""
        r = generator("separations")
        fought = 0
        for _ in range(CASES):
            near = 10 ** r.uniform(-2, 1)
            far = near * 10 ** r.uniform(1, 5)
            mapping, format = r.choice(["d3d", "reversed"]), r.choice(["fp32", "unorm24", "unorm16"])
            c, s = Camera(near, far, format, mapping), Setup(near, far, format, mapping)
            n, f = Fraction(near), Fraction(far)
            a, b = (f / (f - n), -f * n / (f - n)) if mapping == "d3d" else (-n / (f - n), f * n / (f - n))
            a, b = binary32(float(a)), binary32(float(b))

            def stored(z):
                z = binary32(z)
                d = binary32(binary32(binary32(a * z) + b) / z)
                return s.code(min(max(Fraction(d), 0), 1))

            for _ in range(10):
                z = near * (far / near) ** r.random()
                apart = c.separation(z)
                if math.isinf(apart) or z + apart > far:
                    continue
                before, behind = stored(z), stored(nudge(z + apart, 1))
                self.assertTrue(before > behind if mapping == "reversed" else before < behind, (c, z))
                self.assertGreaterEqual(apart, c.lattice(z))
                fought += stored(z) == stored(z + apart / 3)
        self.assertGreater(fought, CASES)

    def test_worst(self):
        r = generator("worst")
        for _ in range(CASES // 3):
            s = random_setup(r, infinite=False)
            c = camera_of(s)
            ends = sorted(random_depth(r, s) for _ in range(2))
            worst = c.worst(*ends)
            z = array.array("d", [r.uniform(*ends) for _ in range(50)])
            self.assertLessEqual(max(c.interval(z)), worst.interval * (1 + 1e-12))
            self.assertLessEqual(max(c.separation(z)), worst.separation)
            self.assertLessEqual(max(abs(a - b) for a, b in zip(c.decode(c.encode(z)), z)),
                                 worst.error + 1e-9 * worst.interval + 1e-14 * abs(c.far))
            lo, hi = s.cell(worst.interval_code)
            self.assertLessEqual(relative(worst.interval, hi - lo), Fraction(1, 10 ** 11))


class Program(unittest.TestCase):
    """The same bits as the program prints, in 1,000 random set-ups."""

    def test_tables(self):
        r = generator("tables")
        count, bounds = 0, 0
        while count < 1000:
            mappings = r.sample(AFFINE + ("linear", "log", "three-webgl", "three-webgpu", "cesium"), 3)
            formats = r.sample(sorted(FORMATS), 3)
            near, far = 10 ** r.uniform(-3, 2), 10 ** r.uniform(2.5, 6)
            ortho = r.random() < 0.2
            if ortho:
                mappings = [m for m in mappings if m in AFFINE] or ["d3d"]
            z = sorted(near * (far / near) ** r.random() for _ in range(8))
            rounding, arith = r.choice(["nearest", "even", "zero"]), r.choice(["ieee", "fused", "mesa"])
            words = ["table", "--json", "--near", repr(near), "--far", repr(far), "--format", ",".join(formats),
                     "--mapping", ",".join(mappings), "--at", ",".join(map(repr, z)), "--rounding", rounding, "--arith",
                     arith, "--range", "%r:%r" % (z[0], z[-1]), *(["--ortho"] if ortho else [])]
            for got in json.loads(program(*words))["setups"]:
                count += 1
                c = Camera(near, far, got["format"], got["mapping"], ortho=ortho, rounding=rounding, arith=arith,
                           model=got["model"])
                bounds += self.compare(c, got, z)
        self.assertGreater(bounds, 100)

    def compare(self, c, got, z):
        eye, lo, hi = c.decode(c.encode(z), bounds=True)
        columns = {"code": c.encode(z), "depth": c.window_depth(z), "z_stored": eye, "cell_lo": lo, "cell_hi": hi,
                   "interval": c.interval(z), "lattice": c.lattice(z), "guaranteed": c.separation(z)}
        for name, values in columns.items():
            want = [row[name] for row in got["rows"]]
            self.assertEqual([float(v) if math.isfinite(v) else None for v in values], want, (c, name))
        cells = c.worst(z[0], z[-1])._asdict()
        for name, want in (got["worst"] or {}).items():
            if name == "codes":
                self.assertEqual(want, abs(int(columns["code"][0]) - int(columns["code"][-1])) + 1)
                continue
            self.assertTrue(cells[name] == want or (want is None and not math.isfinite(cells[name])), (c, name))
        want = got.get("worst_separation")
        if want is not None:
            self.assertEqual([cells["separation"], cells["separation_z"]], [want["bound"] or math.inf, want["z"]], c)
        return want is not None

    def test_commands(self):
        """Every command, with options as words and as keywords, is that of the program."""
        c = Camera(0.2, 3000, "unorm24", "d3d", rounding="even")
        camera = ["--near=0.2", "--far=3000.0", "--format=unorm24", "--mapping=d3d", "--rounding=even"]
        wide = Camera(0.2, 3000, "unorm24", "d3d", viewport=(1920, 1080), slant=(0, 60))
        view = ["--viewport=1920x1080", "--slant=0:60"]
        pairs = [
            (depthprec.solve(c, near=None, separation=0.01, at=500.0),
             ["solve", *camera[1:], "--separation=0.01", "--at=500"]),
            (depthprec.solve(far="10km", format="d24", separation="1cm", at="5km"),
             ["solve", "--far=10km", "--format=d24", "--separation=1cm", "--at=5km"]),
            (depthprec.solve(wide, for_="separation", at=100.0),
             ["solve", *camera[:4], *view, "--for=separation", "--at=100"]),
            (depthprec.bias(c, api="vulkan", separation=0.02, at=300), ["bias", *camera, "--api=vulkan",
                                                                        "--separation=0.02", "--at=300"]),
            (depthprec.bias(wide, api="all", at=3), ["bias", *camera[:4], *view, "--api=all", "--at=3"]),
            (depthprec.check("tests/needs/engine.need"), ["check", "tests/needs/engine.need"]),
            (depthprec.run("list formats --json"), ["list", "formats"]),
            (depthprec.run(["world", "--json"]), ["world"]),
        ]
        for got, words in pairs:
            self.assertEqual(got, json.loads(program(*words, "--json")), words)
        for words in (["table", "-n", "0.3"], ["help"], ["list", "presets"], ["budget", "--csv"]):
            self.assertEqual(depthprec.run(words).encode(), program(*words))

    def test_each_key(self):
        """Each key of a camera off its default, by itself, is that of the program in every command that takes a camera."""
        usual = Camera.__init__.__kwdefaults__
        view = {"viewport": (1280, 720)}
        keys = [({}, []), ({"ortho": True}, ["--ortho"]), ({"rounding": "zero"}, ["--rounding=zero"]),
                ({"mapping": "cesium", "log_c": 2.0}, ["--mapping=cesium", "--log-c=2"]),
                ({"depth_range": (0, 0.125)}, ["--depth-range=0:.125"]), ({"depth_range": (1, 0.3)}, ["--depth-range=1:.3"]),
                *(({"arith": arith}, ["--arith=" + arith]) for arith in ("fused", "mesa", "nvidia")),
                (view, []), ({**view, "fov": 35.0}, ["--fov=35"]), ({**view, "subpixel": 4}, ["--subpixel=4"]),
                ({**view, "raster": "spec-gl"}, ["--raster=spec-gl"]), ({**view, "raster": "spec-d3d"}, ["--raster=spec-d3d"]),
                ({**view, "raster": "spec-vulkan", "subpixel": 6}, ["--raster=spec-vulkan", "--subpixel=6"]),
                ({**view, "slant": (10, 70)}, ["--slant=10:70"]),
                ({**view, "triangle_class": (3, 64, 8)}, ["--triangle-class=depth=3,pixels=64,slim=8"])]
        self.assertEqual(set(usual) - {"model"}, {key for given, _ in keys for key in given} - {"mapping"})
        commands = [(depthprec.bias, {"api": "vulkan", "separation": 0.5, "at": 300.0}, ["bias"]),
                    (depthprec.solve, {"for_": "separation", "at": 100.0}, ["solve"])]
        answers = []
        for call, asked, words in commands:
            words = [*words, *("--%s=%s" % (key.strip("_"), value) for key, value in asked.items())]
            for given, options in keys:
                mapping = given.get("mapping", "d3d")
                own = {key: value for key, value in given.items() if key != "mapping"}
                line = [*words, "--near=0.2", "--far=3000", "--format=unorm24", *options]
                line += ["--viewport=1280x720"] * ("viewport" in given) + ["--mapping=d3d"] * (mapping == "d3d")
                camera, want = Camera(0.2, 3000, "unorm24", mapping, **own), program(*line, "--json")
                if "error" in json.loads(want):
                    self.assertRaises(Error, call, camera, **asked)
                    continue
                got = call(camera, **asked)
                self.assertEqual(got, json.loads(want), line)
                answers.append(json.dumps(got, sort_keys=True))
        self.assertGreater(len(set(answers)), len(answers) - 4, "keys that change nothing")

    def test_check(self):
        fine = Camera(0.1, math.inf, "fp32", "reversed")
        needs = {"unit": "m", "cameras": {"world": fine, "web": {"near": "50 cm", "far": 2000, "format": "unorm24",
                                                                  "mapping": "d3d"}},
                 "requirements": {"decals": {"camera": "world", "range": [0.5, 50], "separation": "0.1 mm"},
                                  "props": {"camera": "web", "at": "1 km", "separation": "1 mm"}}}
        found = depthprec.check(needs)
        self.assertEqual([row["passed"] for row in found["requirements"]], [True, False])
        self.assertFalse(found["passed"])
        self.assertEqual(found["requirements"][0]["setup"]["far"], None)

    def test_presets(self):
        """The program's planes; of those whose planes it computes, from sizes, with the example that it gives."""
        computed = 0
        for row in depthprec.presets():
            name, more = row["name"], {}
            try:
                c = Camera.preset(name)
            except Error as error:
                if "unorm24 or fp32" in str(error):
                    more = {"format": "fp32"}
                else:
                    name, computed = re.search(r"^preset: needs .*: (%s:[^ ]+?)(,? |$)" % name, str(error)).group(1), computed + 1
                c = Camera.preset(name, **more)
            format = ["--format=fp32"] * len(more)
            want = json.loads(program("table", "--quiet", "--json", "--preset=" + name, *format))["setups"][0]
            self.assertEqual([c.near, c.far, c.mapping, c.format],
                             [want["near"], want["far"] or math.inf, want["mapping"], want["format"]])
            if not row["camera"].startswith("near and far computed"):
                self.assertIn("near %.15g, far %.15g, %s" % (c.near, c.far, c.mapping), row["camera"])
        self.assertGreater(computed, 5)

    def test_said(self):
        """What is refused is named as it was given, without hyphens."""
        c = Camera()
        for work, said in ((lambda: depthprec.solve(near=1, nera=3), "^unknown option 'nera'; did you mean 'near'"),
                           (lambda: depthprec.solve(far="10km", separation=1), "^at: must be given"),
                           (lambda: depthprec.bias(c, log_c=3, at=3), "^log_c: needs one"),
                           (lambda: depthprec.solve(c, for_="nothing", at=3), "^for_: must be"),
                           (lambda: depthprec.recognise("/none", metric="zz"), "^metric: must be"),
                           (lambda: depthprec.plot("errr"), "^plot: FIGURE must be"),
                           (lambda: Camera.preset("uniti"), "^preset: must be .*; did you mean 'unity'"),
                           (lambda: Camera.preset("unity", unit="parsec"), "^unit: must be"),
                           (lambda: depthprec.check({"cameras": {"a": {"nera": 1}}}), "^camera: has no key 'nera'"),
                           (lambda: depthprec.run("solve --nera 3"), "^unknown option '--nera'; did you mean '--near'")):
            with self.assertRaisesRegex(Error, said) as caught:
                work()
            self.assertGreater(caught.exception.status, 1)

    def test_keys(self):
        """What a camera says of itself to a command are options of it, all of its own but what the command is not about."""
        c = Camera(0.5, 60, "d24", "gl", rounding="even", model="staged", arith="fused", viewport=(640, 480), fov=30,
                   raster="spec-gl", subpixel=4, slant=(1, 2), triangle_class=(2, 4, 3))
        others = (Camera(0.5, 60, "d24", ortho=True), Camera(0.5, 60, "d24", "log", log_c=3),
                  Camera(0.5, 60, "d24", depth_range=(0.25, 1)))

        def told(command):
            return set().union(*(camera._options(command) for camera in (c, *others)))

        for command, left_out in (("solve", {"model"}), ("bias", {"model"}), ("plot", {"model"}), ("table", {"model"}),
                                  ("texture", {"model", "arith", "fov", "viewport"})):
            said = program(command, "--help=all").decode()
            options = {name.replace("-", "_") for name in re.findall(r"^ +(?:-\w, |plot \w+ +)?--([a-z-]+)", said, re.M)}
            self.assertEqual(told(command), (set(c._given) & options) - left_out, command)
        self.assertEqual(told("check"), set(c._given) - {"viewport", "fov", "raster", "subpixel", "slant", "triangle_class"})
        for camera in (c.replace(viewport=None, fov=60.0, raster=None, subpixel=None, slant=(0, 90), triangle_class=(2, 512, 16)),
                       *others):
            done = depthprec.check({"cameras": {"a": camera}, "requirements": {
                "b": {"camera": "a", "range": [1, 2], "separation": 1}}})
            self.assertEqual([row["name"] for row in done["requirements"]], ["b"])
            self.assertIn("<svg", depthprec.plot("error", camera))
        self.assertIn("<svg", depthprec.plot("interval", c))
        self.assertTrue(depthprec.bias(c, separation=1, at=5))

    def test_figures(self):
        c = Camera(0.2, 500, "unorm24")
        drawn = depthprec.plot("error", c)
        want = depthprec.run("plot error -n 0.2 -f 500 -F unorm24 -m d3d --type svg -o -")
        self.assertEqual(drawn.split("data: ")[1], want.split("data: ")[1])
        self.assertEqual([type(drawn._repr_svg_()), drawn._repr_svg_()], [str, drawn])
        path = os.path.join(tempfile.mkdtemp(), "error.svg")
        drawn.save(path)
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), drawn)
        self.assertIn("<svg", depthprec.plot("needs", file="tests/needs/engine.need"))

    def test_read(self):
        """Eye depths of an image, by the formula: codes of 16 bits, and millimetres."""
        codes = memoryview(array.array("H", [0, 1, 40000, 60000, 7, 65000])).cast("B").cast("H", (2, 3))
        eye = memoryview(depthprec.read(codes, Camera(0.5, 50, "unorm16")))
        self.assertEqual(eye.shape, (2, 3))
        for got, code in zip(sum(eye.tolist(), []), sum(codes.tolist(), [])):
            self.assertLess(relative(got, 1 / (2 - Fraction(code, 65535) * (2 - Fraction(1, 50)))), Fraction(1, 10 ** 6))
        metres = memoryview(depthprec.read(codes, metric="mm"))
        self.assertLess(abs(metres.tolist()[0][2] - 40), 1e-5)
        for wrong, said in (("/none.png", "/none.png"), ("-x", r"\./-x")):
            with self.assertRaisesRegex(Error, said):
                depthprec.read(wrong)

    def test_write(self):
        """What is written comes back within half a step, by a PNG reader of the test and by read(); files are whole or not."""
        r, folder = generator("write"), tempfile.mkdtemp()
        path = os.path.join(folder, "a.png")
        for k in range(20):
            height, width, step = r.randint(1, 9), r.randint(1, 9), (0.001, 1 / 256, 0.0002)[k % 3]
            flat = [binary32(r.uniform(step, 65534 * step)) for _ in range(height * width)]
            z = memoryview(array.array("f", flat)).cast("B").cast("f", (height, width))
            found = depthprec.write(path, z, metric=1, as_="even:%r" % step)
            self.assertEqual([found["scale"], found["offset"], found["type"]], [step, 0, "u2"])
            read = [x for row in memoryview(depthprec.read(path)).tolist() for x in row]
            for exact, sample, back in zip(flat, png_samples(path), read):
                self.assertLessEqual(abs(Fraction(exact) - sample * Fraction(step)), Fraction(step) / 2 + Fraction(exact) / 2 ** 22)
                self.assertLess(abs(back - sample * step), 1e-6 * back)
            most = max(flat)
            unit = depthprec.write(path, z, metric=1)["scale"]
            self.assertLess(abs(unit * 65535 / most - 1), 1e-6)
            for exact, sample in zip(flat, png_samples(path)):
                self.assertLessEqual(abs(exact - sample * unit), 0.501 * unit)
            for ending in (".npy", ".PFM"):
                depthprec.write(path + ending, z, metric=1)
                self.assertEqual(memoryview(depthprec.read(path + ending, metric=1)).tolist(), z.tolist())
        camera = Camera(0.5, 50, "unorm24", "reversed")
        depths = memoryview(array.array("d", [camera.window_depth(x) for x in (0.6, 7, 49, 1)])).cast("B").cast("d", (2, 2))
        packed = os.path.join(folder, "packed.png")
        self.assertEqual(depthprec.write(packed, depths, camera, "pack:rgb24"), {})
        for got, want in zip(memoryview(depthprec.read(packed)).tolist()[0], (0.6, 7)):
            self.assertLess(abs(got - want), 2 * camera.lattice(want) + 1e-6 * want)
        os.remove(packed)
        self.no_half_files(folder, path, z)

    def no_half_files(self, folder, path, z):
        with open(path, "rb") as file:
            before = file.read()
        os.chmod(path, 0o640)
        for to, options, said in ((path, {"as_": "even:1e-9"}, "^as_: .* a PNG holds 65534"), (path, {"product": "eyes"}, "^product"),
                                  (path, {"nera": 1}, "nera"), (os.path.join(folder, "none", "a.png"), {}, "none/a.png"),
                                  (folder + "/a.exr", {}, "must end in .png"), (folder, {}, "must end in .png"),
                                  ("", {}, "must end in .png"), (b"a.png", {}, "must end in .png"),
                                  (path, {"figure": path}, "figure|output")):
            with self.assertRaisesRegex(Error, said):
                depthprec.write(to, z, **{"metric": 1, **options})
        for wrong in (3, None):
            with self.assertRaises(TypeError):
                depthprec.write(wrong, z, metric=1)
            with self.assertRaises(TypeError):
                depthprec.write(path, wrong)
        if os.path.exists("/dev/full"):
            full = os.path.join(folder, "full.png")
            os.symlink("/dev/full", full)
            with self.assertRaisesRegex(Error, "full.png"):
                depthprec.write(full, z, metric=1)
            self.assertTrue(os.path.islink(full))
            os.remove(full)
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before)
        self.assertEqual(sorted(os.listdir(folder)), ["a.png", "a.png.PFM", "a.png.npy"])
        depthprec.write(path, z, metric=1)
        self.assertEqual(os.stat(path).st_mode & 0o777, 0o640)
        if os.geteuid() != 0:
            os.chmod(path, 0o440)
            self.assertRaises(Error, depthprec.write, path, z, metric=1)

    def test_keys_of_images(self):
        """Each key of a camera that images know, off its default, in read(), write() and recognise()."""
        codes = memoryview(array.array("H", [3, 1, 40000, 60000, 7, 65000])).cast("B").cast("H", (2, 3))
        folder, answers = tempfile.mkdtemp(), []
        source, made, own = (os.path.join(folder, name) for name in ("in.npy", "made.npy", "own.npy"))
        with open(source, "wb") as file:
            file.write(_program._npy(codes))
        for key, given, words in (({}, {}, []), ({"near": 0.7}, {}, []), ({"far": 90}, {}, []), ({"mapping": "reversed"}, {}, []),
                                  ({"ortho": True}, {}, ["--ortho"]), ({"rounding": "zero"}, {}, ["--rounding=zero"]),
                                  ({"mapping": "log", "log_c": 2.0}, {}, ["--log-c=2"]), ({}, {"sky": 0}, ["--sky=0"]),
                                  ({"depth_range": (0, 0.96)}, {}, ["--depth-range=0:.96"])):
            kept = {"near": 0.5, "far": 50, "format": "unorm16", "mapping": "gl", **key}
            line = ["--%s=%s" % (name, kept[name]) for name in ("near", "far", "format", "mapping")] + words
            program("texture", source, *line, "--product=eye", "-o", made, "--json", "-q")
            depthprec.write(own, codes, Camera(**kept), **given)
            with open(own, "rb") as first, open(made, "rb") as second:
                self.assertEqual(first.read(), second.read(), line)
            want = json.loads(program("texture", source, *line, "--json", "-q"))
            found = depthprec.recognise(source, Camera(**kept), **given)
            self.assertEqual([found["format"], found["reversed"]], [want["recognised"][name] for name in ("format", "reversed")])
            answers.append((memoryview(depthprec.read(source, Camera(**kept), **given)).tolist(), json.dumps(want)))
        self.assertEqual(len({text for _, text in answers}), len(answers))

    def test_lists(self):
        self.assertEqual(depthprec.presets(), json.loads(program("list", "presets", "--json"))["items"])
        self.assertEqual([row["name"] for row in depthprec.formats()][:1], ["fp16"])

    def test_recognised(self):
        r = generator("recognised")
        c = Camera(0.1, 1000, "unorm16", "reversed")
        z = array.array("f", [r.uniform(1, 90) for _ in range(64 * 48)])
        codes = memoryview(c.encode(z)).cast("B").cast("H", (48, 64))
        found = depthprec.recognise(codes)
        self.assertEqual([found["format"], found["width"], found["height"], found["type"]], ["unorm16", 64, 48, "u2"])
        d = memoryview(array.array("f", [code / 65535 for code in memoryview(codes).cast("B").cast("H")]))
        found = depthprec.recognise(d.cast("B").cast("f", (48, 64)))
        self.assertEqual([found["format"], found["certain"]], ["unorm16", True])
        with self.assertRaisesRegex(Error, "cannot be window depth"):
            depthprec.recognise(memoryview(z).cast("B").cast("f", (48, 64)))
        for wrong in (d, 3, None, memoryview(array.array("q", range(4)))):
            with self.assertRaises((Error, TypeError)):
                depthprec.recognise(wrong)
        metres = memoryview(z).cast("B").cast("f", (48, 64))
        found = depthprec.recognise(metres, metric="1m")
        self.assertEqual([found["metric"], found["format"], found["lattice"]["name"]], [1, None, "file"])
        path = os.path.join(tempfile.mkdtemp(), "z.npy")
        with open(path, "wb") as file:
            file.write(_program._npy(metres))
        self.assertEqual(depthprec.recognise(path, metric="1m"), found)
        self.assertIsNone(depthprec.recognise(codes)["lattice"])

    def test_masks(self):
        """Of masked arrays, numpy's or what stands in for them here, none is read or written that masks anything."""
        if numpy is not None:
            import numpy.ma as ma
        else:
            ma = types.ModuleType("numpy.ma")
            ma.MaskedArray = type("MaskedArray", (array.array,), {"mask": types.SimpleNamespace(any=lambda: True)})
            ma.array = lambda data, mask: ma.MaskedArray("f", data)
            self.addCleanup(sys.modules.pop, "numpy.ma", None)
            sys.modules["numpy.ma"] = ma
        masked, c = ma.array([1.0, 2.0, 3.0, 4.0], mask=[True, False, False, False]), Camera()
        for work in (lambda: c.encode(masked), lambda: c.decode(masked), lambda: c.separation(masked),
                     lambda: c.interval([1.0] * 4, out=masked), lambda: depthprec.recognise(masked, metric="1m"),
                     lambda: Camera.from_matrix(masked)):
            with self.assertRaisesRegex(ValueError, "must have no mask"):
                work()
        if numpy is not None:
            whole = ma.array([1.0, 2.0], mask=False)
            self.assertEqual(list(c.encode(whole)), list(c.encode([1.0, 2.0])))

    def test_order(self):
        """What a camera was asked for before, and in which types, is forgotten; so is what was refused in between."""
        z, stored = [0.5, 3.0, 70.0, 800.0], [65535, 9000, 12, 0]
        reals, whole = [array.array(code, z) for code in "fd"], [array.array(code, stored) for code in "HI"]
        shown = lambda got: [list(x) for x in got] if isinstance(got, depthprec.Decoded) and hasattr(got[0], "__len__") else \
            list(got) if hasattr(got, "__len__") else got
        calls = [lambda c: c.encode(3.0), lambda c: c.decode(9000), lambda c: c.decode(9000, bounds=True), lambda c: c.worst(1, 5),
                 lambda c: c.decode_window(0.5, bounds=True), lambda c: c.decode_window(array.array("f", [0.25, 1]))]
        calls += [lambda c, m=m: getattr(c, m)(3.0) for m in ("separation", "lattice", "interval", "window_depth")]
        calls += [lambda c, m=m, x=x: getattr(c, m)(x) for m in ("separation", "lattice", "interval", "window_depth") for x in reals]
        calls += [lambda c, x=x, o=o: c.encode(x, out=array.array(o, bytes(4 * array.array(o).itemsize))) for x in reals for o in "HI"]
        calls += [lambda c, x=x, o=o: c.decode(x, out=array.array(o, bytes(4 * array.array(o).itemsize))) for x in whole for o in "fd"]
        calls += [lambda c, x=x: c.decode(x, bounds=True) for x in whole]
        refused = [lambda c: c.encode("3"), lambda c: c.decode(-1), lambda c: c.separation(1e9), lambda c: c.decode(whole[0], out=whole[0]),
                   lambda c: c.separation(reals[0], out=reals[1]), lambda c: c.worst(5, 1), lambda c: c.decode_window(2.0)]
        fresh = lambda: Camera(0.5, 800, "unorm16", "reversed")
        want = [repr(shown(call(fresh()))) for call in calls]
        for first in calls + refused:
            c = fresh()
            if first in refused:
                self.assertRaises((ValueError, TypeError), first, c)
            else:
                first(c)
            for call, expected in zip(calls, want):
                self.assertEqual(repr(shown(call(c))), expected)
        c = fresh()
        for k in range(300):
            pick = generator("order%d" % k).randrange(len(calls))
            self.assertEqual(repr(shown(calls[pick](c))), want[pick], (k, pick))

    def test_refused(self):
        for words, said in (("tabl", "did you mean"), ("plot error --type pdf -o x.pdf", "rsvg-convert"),
                            ("plot error --type png -o -", "must be svg"), ("texture /none.png", "/none.png")):
            with self.assertRaisesRegex(Error, said) as caught:
                depthprec.run(words)
            self.assertFalse(str(caught.exception).startswith("depthprec:"))
        self.assertIn("<svg", depthprec.run("plot error -n 0.1 --type svg -o -"))
        with self.assertRaisesRegex(Error, "zero byte"):
            depthprec.run(["table", "a\0b"])
        with self.assertRaises(TypeError):
            depthprec.run([3])


class Matrix(unittest.TestCase):
    """Cameras back from matrices that are put together here, of each convention and either layout."""

    def matrix(self, n, f, mapping, ortho=False, backwards=False):
        n, f = Fraction(n), None if f == math.inf else Fraction(f)
        if ortho:
            c, e = 1 / (f - n), -n / (f - n)
        elif f is None:
            c, e = Fraction(1), -n
        else:
            c, e = f / (f - n), -f * n / (f - n)
        w = (Fraction(0), Fraction(1)) if ortho else (Fraction(1), Fraction(0))
        if "reversed" in mapping:
            c, e = w[0] - c, w[1] - e
        if "gl" in mapping:
            c, e = 2 * c - w[0], 2 * e - w[1]
        sign = -1 if backwards else 1
        rows = [[1.5, 0, 0, 0], [0, 2.5, 0, 0], [0, 0, sign * c, e], [0, 0, sign * w[0], w[1]]]
        return [[float(x) for x in row] for row in rows]

    def test_found(self):
        r = generator("matrices")
        for _ in range(CASES):
            near, far = 10 ** r.uniform(-3, 1), r.choice([math.inf, 10 ** r.uniform(1.5, 4)])
            mapping, backwards = r.choice(AFFINE), r.random() < 0.5
            ortho = far != math.inf and r.random() < 0.2
            m = self.matrix(near, far, mapping, ortho, backwards)
            turned = [list(row) for row in zip(*m)]
            for given in (m, turned, sum(m, []), memoryview(array.array("d", sum(turned, [])))):
                found = Camera.from_matrix(given, mapping)
                self.assertEqual([found.mapping, found.ortho], [mapping, ortho])
                self.close(found.near, near, 1e-14 * (far / near if ortho else 1))
                if far == math.inf:
                    self.assertEqual(found.far, math.inf)
                else:
                    self.close(found.far, far, 1e-14 * far / near)
            self.assertEqual(Camera.from_matrix(m, mapping, layout="rows"), found)
            self.assertEqual(Camera.from_matrix(turned, mapping, layout="columns"), found)
            if mapping == "reversed" and not ortho and far >= 2 * near:
                self.assertEqual(Camera.from_matrix(m, format="d24"), Camera.from_matrix(turned, mapping, format="d24"))
            else:
                with self.assertRaisesRegex(Error, "more than one convention.*: .*" + mapping + " by "):
                    Camera.from_matrix(m)
            if not ortho:
                other = {"d3d": "reversed", "gl": "gl-reversed", "reversed": "d3d", "gl-reversed": "gl"}[mapping]
                with self.assertRaisesRegex(Error, "with distance: the mapping must be"):
                    Camera.from_matrix(m, other)

    def close(self, got, want, bound):
        self.assertLessEqual(abs(got - want), bound * want)

    def test_floats(self):
        m = self.matrix(0.1, 1000, "reversed")
        narrow = Camera.from_matrix(array.array("f", sum(m, [])))
        self.assertNotEqual(narrow.near, 0.1)
        self.assertLess(abs(narrow.near - 0.1), 1e-8)
        self.assertEqual(narrow, Camera.from_matrix([binary32(x) for x in sum(m, [])]))

    def test_planes(self):
        """Of float32 entries: half a step of each, by fractions; a standard matrix of near 0.1 and far 100000."""
        n, f = Fraction(1, 10), 10 ** 5
        entries = array.array("f", sum(self.matrix(n, f, "d3d"), []))
        entries[0] = 1.1  # of more than 20 bits, which says that all were rounded
        c, e = (Fraction(entries[i]) for i in (10, 11))
        # Next to 1 the steps are 2^-23 above, next to -0.1 2^-27.
        at = [(x + k * Fraction(1, 2 ** 24), y + j * Fraction(1, 2 ** 28)) for x, y in ((c, e),) for k in (-1, 1)
              for j in (-1, 1)]
        far, near = [-y / (x - 1) for x, y in at], [-y / x for x, y in at]
        found = Camera.from_matrix(entries, "d3d")
        for got, want in ((found.far_least, min(far)), (found.far_most, max(far)), (found.near_least, min(near)),
                          (found.near_most, max(near))):
            self.close(got, float(want), 1e-9)
        self.assertTrue(found.near_least <= 0.1 <= found.near_most and found.far_least <= 1e5 <= found.far_most)
        self.assertEqual((found.near_digits, found.far_digits), (1, 1))
        self.assertIn("near 0.1 (0.09999999", repr(found))
        self.assertRegex(repr(found), r"far 100000\.0 \(98689\.\d+ to 111848\.\d+\)")
        again = pickle.loads(pickle.dumps(found))
        self.assertEqual((again, repr(again), again.far_most), (found, repr(found), found.far_most))
        typed = Camera.from_matrix([[1.5, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1.25, -0.5], [0, 0, 1, 0]], "d3d")
        self.assertEqual(repr(typed), "Camera(0.4, 2.0, 'fp32', 'd3d')")
        self.assertEqual((typed.far_least, typed.far_most, typed.far_digits), (2, 2, 17))
        plain = Camera(0.1, 7)
        self.assertEqual((plain.near_least, plain.far_most, plain.near_digits), (0.1, 7, 17))

    def test_layouts(self):
        """Near 1, far infinite: the transpose is a projection, too, of another camera."""
        m = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0, 1, 0]
        with self.assertRaisesRegex(Error, "d3d by rows near 1, far inf; .*; reversed by columns near 0.5, far 1;"):
            Camera.from_matrix(m)
        self.assertEqual(Camera.from_matrix(m, "d3d"), Camera(1, math.inf))
        self.assertEqual(Camera.from_matrix(m, "reversed"), Camera(0.5, 1, mapping="reversed"))
        with self.assertRaisesRegex(Error, "with distance"):
            Camera.from_matrix(m, "reversed", layout="rows")

    def test_refused(self):
        good = self.matrix(0.1, 1000, "d3d")
        oblique = copy.deepcopy(good)
        oblique[2][0] = 0.1
        for bad, said in ((oblique, "the same for every pixel"), ([[1, 0], [0, 1]], "16 numbers"),
                          ([0] * 16, "fourth row"),
                          ([math.nan] * 16, "finite"), ([1] * 16, "fourth row"), (list(range(16)), "fourth row"),
                          ([math.inf] + sum(good, [])[1:], "finite")):
            with self.assertRaisesRegex(Error, said):
                Camera.from_matrix(bad, "d3d")
        for bad in ("matrix", None, {}, [["a"] * 4] * 4, 3):
            with self.assertRaises((TypeError, ValueError)):
                Camera.from_matrix(bad)
        with self.assertRaisesRegex(Error, "mapping must be one of"):
            Camera.from_matrix(good, "log")
        with self.assertRaisesRegex(Error, "layout must be"):
            Camera.from_matrix(good, "d3d", layout="up")


class Memory(unittest.TestCase):
    """Arrays of any kind, and what is none."""

    camera = Camera(0.1, 1000, "unorm24", "d3d")
    depths = [0.1, 0.5, 1.0, 7.0, 999.0, 1000.0]

    def methods(self):
        c = self.camera
        return (c.encode, c.decode, c.decode_window, c.window_depth, c.separation, c.lattice, c.interval)

    def test_kinds(self):
        c = self.camera
        want = [c.encode(z) for z in self.depths]
        wide = array.array("d", self.depths)
        for given, kind in ((wide, array.array), (memoryview(wide), memoryview),
                            (memoryview(bytes(wide)).cast("d"), memoryview)):
            got = c.encode(given)
            self.assertIsInstance(got, kind)
            self.assertEqual(list(got), want)
        for given in (self.depths, tuple(self.depths)):
            self.assertEqual(list(c.encode(given)), want)
        shaped = memoryview(wide).cast("B").cast("d", (2, 3))
        got = c.separation(shaped)
        self.assertEqual([got.shape, got.format, got.tolist()[1][0]], [(2, 3), "d", c.separation(7.0)])
        narrow = c.interval(array.array("f", self.depths))
        self.assertEqual(narrow.typecode, "f")
        for got, z in zip(narrow[1:-1], self.depths[1:-1]):
            self.assertEqual(got, binary32(c.interval(binary32(z))))
        self.assertFalse(any(map(math.isnan, c.separation(array.array("f", [0.1, 1000.0])))))
        self.assertEqual(Camera(format="unorm16").encode(wide).typecode, "H")

    def test_codes(self):
        c = self.camera
        for code in "BHILQbhilq":
            self.assertEqual(list(c.decode(array.array(code, [0, 100]))), [c.decode(0), c.decode(100)])
        self.assertEqual(list(c.decode([2 ** 32 - 1])), [c.decode(c.code_max)])
        below = [array.array(code, [0, -1]) for code in "bhilq"]
        beyond = [array.array(code, [2 ** 32]) for code in "LQlq" if array.array(code).itemsize == 8]
        for wrong in (*below, *beyond, [-5, 3]):
            with self.assertRaisesRegex(ValueError, "codes must be from 0 to 4294967295, got (-[15]|4294967296)$"):
                c.decode(wrong)
        with self.assertRaises((TypeError, OverflowError)):
            c.decode([2 ** 70])
        out = array.array("f", bytes(8))
        self.assertIs(c.decode(array.array("I", [5, 100]), out=out), out)
        self.assertLess(abs(out[1] / c.decode(100) - 1), 1.85e-7)
        fp16 = Camera(format="fp16")
        self.assertEqual(list(fp16.decode(array.array("H", [0, 15360]))), list(fp16.decode([0, 15360])))

    def test_bounds(self):
        c = self.camera
        z, lo, hi = c.decode_window(array.array("f", [0.9, 0.99, math.nan]), bounds=True)
        self.assertTrue(all(a <= b <= d for a, b, d in zip(lo[:2], z, hi)) and math.isnan(z[2]) and math.isnan(hi[2]))
        exact = c.decode([16609443], bounds=True)
        self.assertEqual([x[0] for x in exact], list(c.decode(16609443, bounds=True)))
        outs = [array.array("d", [0]) for _ in range(3)]
        self.assertEqual(c.decode([16609443], bounds=True, out=outs), c.decode([16609443], bounds=True))

    def test_no_copies(self):
        wide = array.array("d", self.depths)
        for given in (wide, memoryview(wide), memoryview(wide).toreadonly()):
            read = _arrays.given(given, "x")
            self.assertEqual(_arrays.address(read), wide.buffer_info()[0])
        del read, given
        wide.append(1)  # nothing holds the memory any more
        self.assertNotIsInstance(_core.library, ctypes.PyDLL)  # other threads run in a call

    def test_out(self):
        c = self.camera
        out = array.array("d", bytes(48))
        self.assertIs(c.window_depth(array.array("d", self.depths), out=out), out)
        self.assertEqual(list(out), [c.window_depth(z) for z in self.depths])
        for wrong in (array.array("d", bytes(40)), array.array("f", bytes(24)), b"12345678" * 6, 3,
                      memoryview(array.array("d", bytes(96)))[::2]):
            with self.assertRaises((ValueError, TypeError)):
                c.window_depth(array.array("d", self.depths), out=wrong)

    def test_types(self):
        """float16 counts as float32, and the order of bytes changes nothing: packed by struct."""
        c, few = self.camera, [1, 2, 900]
        for code, kind, element, values in (("e", "f2", None, [0.5, 1, 7, 999]), ("f", "f4", ctypes.c_float, self.depths),
                                            ("d", "f8", ctypes.c_double, self.depths), ("H", "u2", ctypes.c_uint16, few),
                                            ("i", "i4", ctypes.c_int32, few), ("q", "i8", ctypes.c_int64, few)):
            for order in "<>":
                raw = struct.pack("%s%d%s" % (order, len(values), code), *values)
                given = [] if numpy is None else [numpy.frombuffer(raw, order + kind)]
                if element is not None:
                    ordered = getattr(element, "__ctype_be__" if order == ">" else "__ctype_le__")
                    given.append((ordered * len(values)).from_buffer_copy(raw))
                exact = [struct.unpack("<f", struct.pack("<f", x))[0] if code in "ef" else x for x in values]
                for memory in given:
                    self.assertEqual(list(c.encode(memory)), [c.encode(x) for x in exact], (code, order))
                    apart = memoryview(c.separation(memory))
                    self.assertEqual(apart.format, "f" if code in "ef" else "d")
                    if code in "Hiq":
                        self.assertEqual(list(c.decode(memory)), [c.decode(x) for x in values])
                    elif code == "d":
                        self.assertEqual(list(apart), [c.separation(x) for x in exact])

    def test_two_decodes(self):
        """Codes and window depths have functions of their own, and each refuses what is the other's."""
        c = self.camera
        self.assertEqual([c.decode(1), c.decode_window(1), c.decode_window(1.0)], [c.decode(1), 1000, 1000])
        self.assertLess(c.decode(1), 0.100001)
        self.assertEqual(list(c.decode_window([0, 1])), [0.1, 1000])
        for wrong in (1.0, 0.5, True, [0.5], array.array("f", [1]), array.array("d", [0.5])):
            with self.assertRaisesRegex(TypeError, "window depths are for decode_window"):
                c.decode(wrong)
        for wrong in (array.array("I", [1]), array.array("H", [0]), memoryview(array.array("q", [1]))):
            with self.assertRaisesRegex(TypeError, "codes are for decode"):
                c.decode_window(wrong)
        for wrong in (-0.1, 1.5, math.nan, 2):
            with self.assertRaises(Error):
                c.decode_window(wrong)

    def test_interrupt(self):
        """Ctrl-C is heard between blocks, and blocks change no bit, in place either."""
        c, z = self.camera, array.array("d", [0.1 + k * 3e-4 for k in range(600000)])
        codes = c.encode(z)
        for k in (0, (1 << 13) - 1, 1 << 13, (1 << 18) - 1, 1 << 18, 599999):
            self.assertEqual(codes[k], c.encode(z[k]))
        both = z[:20000]
        want = [c.separation(x) for x in both[8190:8195]]
        self.assertEqual(list(c.separation(both, out=both)[8190:8195]), want)
        z, out = array.array("d", [5.0]) * 10000000, array.array("d", bytes(80000000))
        with self.assertRaises(KeyboardInterrupt):
            threading.Timer(0.05, lambda: signal.raise_signal(signal.SIGINT)).start()
            c.separation(z, out=out)
        self.assertEqual([out[0], out[-1]], [c.separation(5.0), 0])  # begun, and not gone to the end

    def test_overlap(self):
        """In place where nothing that is still to be read is written."""
        c = self.camera
        both = array.array("d", self.depths)
        want = c.separation(both)
        self.assertIs(c.separation(both, out=both), both)
        self.assertEqual(both, want)
        codes = array.array("I", [1, 2, 3, 4])
        want = c.decode(codes, out=array.array("f", bytes(16)))
        self.assertEqual(c.decode(codes, out=memoryview(codes).cast("B").cast("f")).tolist(), want.tolist())
        shifted = memoryview(array.array("d", self.depths))
        for given, out, method in ((shifted[1:], shifted[:-1], c.separation), (shifted[:-1], shifted[1:], c.interval),
                                   (shifted, shifted, c.decode_window),
                                   (memoryview(codes)[:2], memoryview(codes).cast("B").cast("d"), c.decode)):
            with self.assertRaisesRegex(ValueError, "must not overlap"):
                method(given, out=out)
        outs = [array.array("f", bytes(16)), array.array("f", bytes(16)), memoryview(codes).cast("B").cast("f")]
        with self.assertRaisesRegex(ValueError, "must not overlap"):
            c.decode(codes, bounds=True, out=outs)
        self.assertEqual(bytes(outs[0]), bytes(16))  # refused before anything was written

    def test_strides(self):
        c = self.camera
        wide = memoryview(array.array("d", self.depths))
        self.assertEqual(list(c.encode(wide[::-2])), [c.encode(z) for z in self.depths[::-2]])

    def test_empty(self):
        for method in self.methods():
            for given in ([], (), array.array("d"), memoryview(array.array("f")), memoryview(b"").cast("d")):
                self.assertEqual(len(method(given)), 0)
            for kind in (ctypes.c_double, ctypes.c_float, ctypes.c_int16):  # of two dimensions, too
                self.assertEqual(len(method((kind * 5 * 0)())), 0)
        self.assertEqual(len(self.camera.decode(b"")), 0)

    def test_nonsense(self):
        c = self.camera
        bad = [None, "1.0", {}, set(), object(), int, 1j, [None], ["a"], [[1, 2], [3]], lambda: 3, True,
               memoryview(b"ab").cast("c"), memoryview(array.array("d", [1])).cast("B").cast("?"), iter([1.0])]
        for method in self.methods():
            for given in bad:
                with self.assertRaises((TypeError, ValueError), msg=(method, given)):
                    method(given)
            for number in (math.nan,) if method == c.encode else (math.nan, -1.0, math.inf):
                with self.assertRaises(TypeError if method == c.decode else ValueError):
                    method(number)
        odd = array.array("d", [math.nan, math.inf, -math.inf, -0.0, 5e-324, 1e308, -1e308, 0.1, 1000])
        self.assertEqual(list(map(math.isnan, c.separation(odd))), [True] * 7 + [False] * 2)
        self.assertEqual(list(c.encode(odd)), [0, c.code_max, 0, 0, 0, c.code_max, 0, 0, c.code_max])
        self.assertEqual(c.decode_window(array.array("d", [-1, 2]))[0], 0.1)
        self.assertEqual(c.encode(10 ** 400), c.code_max)

    def test_random_bytes(self):
        r = generator("bytes")
        for _ in range(CASES):
            s = random_setup(r)
            c = camera_of(s)
            raw = bytes(r.getrandbits(8) for _ in range(8 * 16))
            for code in "fdBHIQ":
                given = memoryview(raw).cast(code)
                for method in (c.encode, c.decode, c.decode_window, c.window_depth, c.separation, c.lattice, c.interval):
                    try:
                        method(given)
                    except ValueError:
                        self.assertEqual([code, method], ["Q", c.decode])
                    except TypeError:
                        self.assertEqual(method, c.decode if code in "fd" else c.decode_window)

    def test_large(self):
        c = self.camera
        count = 3000001
        z = array.array("f", [5.0]) * count
        codes = c.encode(z)
        self.assertEqual([len(codes), codes[0], codes[-1]], [count, c.encode(5.0), c.encode(5.0)])

    def test_threads(self):
        c = self.camera
        z = array.array("d", [0.1 + k * 0.001 for k in range(20000)])
        want, got = c.encode(z), [None] * 8

        def work(k):
            got[k] = c.encode(z)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(x == want for x in got))

    @unittest.skipIf(numpy is None, "numpy is not here")
    def test_numpy(self):
        c = self.camera
        for dtype in (numpy.float32, numpy.float64):
            z = numpy.linspace(0.2, 900, 600).astype(dtype).reshape(20, 30)
            want = numpy.array([[c.encode(float(x)) for x in row] for row in z])
            for given in (z, numpy.asfortranarray(z), numpy.flip(z, 0), z[::2, ::3], z.T):
                got = c.encode(given)
                self.assertEqual([type(got), got.dtype, got.shape], [numpy.ndarray, numpy.uint32, given.shape])
            self.assertTrue((c.encode(z) == want).all() and (c.encode(z.T) == want.T).all())
            for given in (z.T, numpy.asfortranarray(z), z.reshape(2, 10, 30).T):  # in Fortran's order, as they lie
                for method in (c.encode, c.window_depth, c.separation, c.lattice, c.interval):
                    got, straight = method(given), method(numpy.ascontiguousarray(given))
                    self.assertTrue(got.flags.fnc and got.dtype == straight.dtype and (got == straight).all())
                stored = c.encode(given)
                for got, straight in zip(c.decode(stored, bounds=True), c.decode(numpy.ascontiguousarray(stored), bounds=True)):
                    self.assertTrue(got.flags.fnc and (got == straight).all())
                out = numpy.empty(given.shape, numpy.uint32)
                self.assertTrue((c.encode(given, out=out) == stored).all() and out.flags.c_contiguous)
                with self.assertRaisesRegex(ValueError, "out must be contiguous"):
                    c.encode(given, out=numpy.asfortranarray(out))
            self.assertTrue((c.encode(z[::2, ::3]) == want[::2, ::3]).all())
            z.flags.writeable = False
            self.assertEqual(_arrays.address(_arrays.given(z, "z")), z.ctypes.data)
            self.assertEqual(c.separation(z).dtype, dtype)
        self.assertEqual(c.decode(numpy.array([1, 2, 3])).tolist(), [c.decode(k) for k in (1, 2, 3)])
        self.assertEqual(c.encode(numpy.float32(2)), c.encode(2.0))
        self.assertEqual(c.decode(numpy.uint16(2)), c.decode(2))
        for wrong in (numpy.array(["a"]), numpy.zeros(3, complex), numpy.array([None]), numpy.array(["2020-01-01"], "datetime64[D]"),
                      numpy.zeros(2, "f4,f4")):
            with self.assertRaises((TypeError, ValueError)):
                c.encode(wrong)
        self.assertEqual(c.separation(numpy.zeros((0, 5))).shape, (0, 5))
        m = numpy.array(Matrix().matrix(0.1, 1000, "reversed"), numpy.float32)
        self.assertEqual(Camera.from_matrix(m), Camera.from_matrix(m.T))


    @unittest.skipIf(numpy is None, "numpy is not here")
    def test_quick(self):
        """The table's separations are never below those of each depth, hardly above, and NaN where those are."""
        r, ratios = generator("quick"), []
        for k in range(CASES // 10):
            near = 10 ** r.uniform(-3, 2)
            far = math.inf if k % 7 == 0 else near * 10 ** r.uniform(0.1, 6)
            view = {"viewport": (640, 480)} if k % 5 == 0 else {}
            mapping = r.choice(["d3d", "gl", "reversed", "linear", "log"][:3 if view else 5])
            c = Camera(near, 1e5 * near if far == math.inf and mapping in ("linear", "log") else far,
                       r.choice(["unorm16", "unorm24", "fp32"]), mapping, **view)
            for dtype in (numpy.float32, numpy.float64):
                z = [near * min(c.far / near, 1e7) ** r.random() for _ in range(100)]
                edges = [near, c.far, near * (1 + 2 ** -12), 0.0, -1.0, math.nan, math.inf, 2.0 ** -5, 2.0 ** 9]
                z = numpy.array(z + [nudge(x, j) if math.isfinite(x) and x else x for x in edges for j in (-1, 0, 1)], dtype)
                for given in (z, z[::-1], z[::2].reshape(2, -1)):  # the second from the table alone
                    want, got = c.separation(given), c.separation(given, quick=True)
                    self.assertEqual([got.dtype, got.shape], [want.dtype, want.shape])
                    self.assertTrue((numpy.isnan(want) == numpy.isnan(got)).all(), (c, given[numpy.isnan(want) != numpy.isnan(got)]))
                    there = ~numpy.isnan(want)
                    self.assertTrue((got[there] >= want[there]).all(), c)
                    finite = numpy.isfinite(want) & (want > 0)
                    ratios += list(got[finite] / want[finite])
        self.assertLess(numpy.median(ratios), 1.001)
        self.assertLess(numpy.mean(numpy.array(ratios) > 1.01), 0.2)
        c = Camera()
        self.assertEqual(c.separation(5.0, quick=True), c.separation(5.0))
        for work in (lambda: c.separation(z, quick=True, out=z), lambda: Camera(-1, 5, ortho=True).separation(z, quick=True)):
            with self.assertRaisesRegex(Error, "quick needs"):
                work()


class Cameras(unittest.TestCase):
    """What a Camera is and refuses; what the stubs say."""

    def test_refused(self):
        for given, said in (({"near": -1}, "near must be"), ({"far": 0.01}, "far must be"),
                            ({"near": math.nan}, "near must be"),
                            ({"format": "d25x"}, "not a format"), ({"mapping": "up"}, "a mapping must be"),
                            ({"rounding": "up"}, "rounding must be"), ({"model": "fast"}, "model"),
                            ({"arith": "?"}, "binary32"),
                            ({"far": math.inf, "mapping": "log"}, "infinite"),
                            ({"log_c": 0, "mapping": "log"}, "C of the log"),
                            *(({"depth_range": ends}, "a depth range must") for ends in (
                                (0, 0), (0.5, 0.5), (0, 1e-7), (-0.1, 1), (0, 1.1), (0, math.nan), (0.5, 0.5 + 9e-7))),
                            ({"depth_range": (0, 0.5), "mapping": "log"}, "a depth range must"),
                            ({"depth_range": (0, 0.5, 1)}, "depth_range must be 2 numbers"),
                            ({"format": "depth24plus"}, "unorm24 or fp32"), ({"viewport": (0, 5)}, "viewport must"),
                            ({"viewport": (1, 2, 3)}, "viewport must be 2 numbers"),
                            *(({key: value}, key + " needs a viewport") for key, value in (
                                ("fov", 30), ("raster", "spec-gl"), ("subpixel", 4), ("slant", (0, 5)),
                                ("triangle_class", (2, 3, 4)))),
                            ({"viewport": (64, 48), "raster": "mesa"}, "raster must be spec-d3d"),
                            ({"viewport": (64, 48), "raster": "spec-gl", "subpixel": 3}, "subpixel must be at least 4"),
                            ({"viewport": (64, 48), "raster": "spec-d3d", "subpixel": 8}, "subpixel does not apply"),
                            ({"viewport": (2**32 + 1920, 1080)}, "viewport must have sides"),
                            ({"mapping": "log", "ortho": True}, "orthographic")):
            with self.subTest(given), self.assertRaisesRegex(Error, said):
                Camera(**given)
        for given in ({"near": "1"}, {"near": None}, {"format": 24}, {"mapping": None}, {"viewport": 3}, {"what": 1},
                      {"depth_range": "ab"}, {"depth_range": 1}):
            with self.assertRaises(TypeError):
                Camera(**given)
        with self.assertRaises(AttributeError):
            Camera().nothing
        with self.assertRaisesRegex(AttributeError, r"does not change: camera.replace\(near=3\) makes another"):
            Camera().near = 3
        with self.assertRaisesRegex(AttributeError, "no attribute 'nera'"):
            Camera().nera = 3
        with self.assertRaisesRegex(TypeError, "nera"):
            Camera().replace(nera=3)
        for lo, hi in ((5, 1), (0, 5), (1, math.inf), (math.nan, 5)):
            with self.assertRaisesRegex(Error, "a range must"):
                Camera().worst(lo, hi)

    def test_depth_range(self):
        """Codes and eye depths in a viewport's range, by hand in rationals: d = lo + (hi - lo) f/(f - n) (1 - n/z)."""
        from fractions import Fraction as Exact
        near, far, most = Exact(1, 4), Exact(64), 2**24 - 1
        for ends in ((0, 0.125), (0.5, 1), (1, 0.25)):
            c = Camera(float(near), float(far), "unorm24", "d3d", depth_range=ends)
            lo, hi = map(Exact, ends)
            for z in (Exact(1, 4), Exact(1), Exact(7, 2), Exact(63), far):
                code = math.floor((lo + (hi - lo) * far / (far - near) * (1 - near / z)) * most + Exact(1, 2))
                self.assertEqual(c.encode(float(z)), code)
                share = min(max((Exact(code, most) - lo) / (hi - lo), Exact(0)), Exact(1))  # beyond an end its plane
                want = near / (1 - share * (far - near) / far)
                for back in (c.decode(code), c.decode_window(code / most)):
                    self.assertLess(abs(Exact(back) / want - 1), Exact(1, 2**45))
            self.assertEqual([c.decode(code) for code in (0, most)], {0: [0.25, 64], 0.5: [0.25, 64], 1: [64, 0.25]}[ends[0]])
            self.assertEqual(c.replace(depth_range=(0, 1)), Camera(float(near), float(far), "unorm24", "d3d"))

    def test_values(self):
        c = Camera(0.25, 50, "D24", "GL", rounding="zero", log_c=2)
        self.assertEqual(repr(c), "Camera(0.25, 50.0, 'unorm24', 'gl', rounding='zero', log_c=2.0)")
        for same in (eval(repr(c)), copy.deepcopy(c), pickle.loads(pickle.dumps(c))):
            self.assertEqual([same, hash(same), same.encode(3)], [c, hash(c), c.encode(3)])
        self.assertNotEqual(c, Camera(0.25, 50, "D24", "GL"))
        self.assertIn("near", dir(c))
        for key, value in {"near": 0.5, "far": 60.0, "format": "fp32", "mapping": "log", "ortho": True, "rounding": "even",
                           "model": "staged", "arith": "fused", "log_c": 3.0, "depth_range": (1.0, 0.5), "viewport": (640, 480), "fov": 30.0,
                           "raster": "spec-gl", "subpixel": 4, "slant": (1, 2), "triangle_class": (2.0, 4.0, 3.0)}.items():
            own = c if key in ("ortho", "mapping") else c.replace(viewport=(320, 200))
            other = own.replace(**{key: value})
            self.assertEqual(other, Camera(**{**own._given, key: value}))
            self.assertNotEqual(other, own)
            self.assertEqual(other.replace(**{key: own._given[key]}), own)
        rounded = Camera.from_matrix(array.array("f", sum(Matrix().matrix(0.1, 1e5, "d3d"), [])), "d3d")
        moved = rounded.replace(near=0.25)
        self.assertEqual([moved.near_least, moved.near_digits, moved.far_least], [0.25, 17, rounded.far_least])
        self.assertRegex(repr(moved), r"^<Camera of a matrix: near 0\.25, far 100000\.0 \(98689\.\d+ to 111848\.\d+\), 'fp32', 'd3d'>$")
        self.assertRegex(repr(rounded.replace(far=7)), r"^<Camera of a matrix: near 0\.1 \(0\.09999999.* to .*\), far 7\.0, 'fp32', 'd3d'>$")
        self.assertEqual(repr(moved.replace(far=7)), "Camera(0.25, 7.0, 'fp32', 'd3d')")
        page = c._repr_html_()
        self.assertIn("%.3g" % c.separation(0.25 * 200 ** 0.5), page)
        self.assertIn("<td>", Camera(1, math.inf)._repr_html_())
        wide = Camera(viewport=(1920, 1080), slant=(0, 80))
        self.assertGreater(wide.separation(10.0), 5 * Camera().separation(10.0))
        self.assertEqual(wide.lattice(10.0), Camera().lattice(10.0))
        self.assertTrue(math.isnan(Camera(model="float").interval(10.0)))
        self.assertEqual(Camera(model="staged").lattice(10.0), Camera().lattice(10.0))

    def test_stubs(self):
        """The stubs name what there is, with the same parameters."""
        with open(os.path.join(os.path.dirname(depthprec.__file__), "__init__.pyi")) as file:
            tree = ast.parse(file.read())
        stubs, keys = [], ["near", "far", "format", "mapping", *Camera.__init__.__kwdefaults__]
        for node in tree.body:
            for inner in node.body if isinstance(node, ast.ClassDef) else [node]:
                if isinstance(inner, ast.FunctionDef):
                    owner = node.name + "." if inner is not node else ""
                    arguments = inner.args
                    stubs.append((owner + inner.name, [a.arg for a in arguments.args + arguments.kwonlyargs]))
        for name, parameters in stubs:
            thing = depthprec
            for part in name.split("."):
                thing = getattr(thing, part)
            if isinstance(inspect.getattr_static(Camera, name.split(".")[-1], None), property):
                continue
            taken = inspect.signature(thing).parameters.values()
            real = [p.name for p in taken if p.kind != p.VAR_KEYWORD and p.name != "self"]
            if name in ("Camera.replace", "Camera.preset", "Camera.from_matrix"):  # spelt out
                real += [key for key in keys if name != "Camera.from_matrix" or key not in ("near", "far", "mapping", "ortho")]
            self.assertEqual([p for p in parameters if p not in ("cls", "self")], real, name)
        methods = [m for m in vars(Camera) if not m.startswith("_") and m not in Camera.__slots__]
        self.assertEqual(sorted(set(methods) - {name.split(".")[-1] for name, _ in stubs}), [])
        for name in depthprec.__all__:
            self.assertTrue(getattr(depthprec, name).__doc__, name)

    def test_old_system(self):
        """Where the C library is older than the wheel, the library and the program say what to do."""
        folder = tempfile.mkdtemp()
        package = os.path.join(folder, "depthprec")
        shutil.copytree(os.path.dirname(depthprec.__file__), package, ignore=shutil.ignore_patterns("*.so.0"))
        with open(os.path.join(package, "libdepthprec.so.0"), "w") as file:
            file.write("none")
        done = subprocess.run([sys.executable, "-c", "import depthprec"], env={**os.environ, "PYTHONPATH": folder},
                              stderr=subprocess.PIPE, check=False)
        self.assertRegex(done.stderr.decode(), r"\nImportError: depthprec: its library cannot be loaded: .*tar\.gz' builds it")
        fake = os.path.join(folder, "old")
        with open(fake, "w") as file:
            file.write("#!/bin/sh\necho \"$0: /lib/libc.so.6: version 'GLIBC_2.34' not found (required by $0)\" >&2\nexit 1\n")
        os.chmod(fake, 0o755)
        with unittest.mock.patch.object(_program, "PATH", fake):
            for work in (depthprec.formats, lambda: depthprec.run("table")):
                with self.assertRaisesRegex(Error, "GLIBC_2.34' not found .*tar\\.gz' builds it"):
                    work()
        with unittest.mock.patch.object(_program, "PATH", os.path.join(folder, "none")):
            with self.assertRaisesRegex(Error, "cannot be run: No such file"):
                depthprec.run("table")

    def test_version(self):
        self.assertIn(depthprec.__version__, program("--version").decode())


def layout():
    """A C program that prints what the compiler says of each structure and enumerator, and what ctypes has."""
    lines = ["#include <stddef.h>", "#include <stdio.h>", '#include "depthprec/depthprec.h"', "int main(void) {"]
    want = []
    for structure in _core.STRUCTURES:
        name = structure.__name__
        lines.append('printf("%s %%zu\\n", sizeof(%s));' % (name, name))
        want.append("%s %d" % (name, ctypes.sizeof(structure)))
        for field, kind in structure._fields_:
            lines.append('printf("%s.%s %%zu %%zu\\n", offsetof(%s, %s), sizeof((%s){0}.%s));'
                         % ((name, field) * 3))
            want.append("%s.%s %d %d" % (name, field, getattr(structure, field).offset, ctypes.sizeof(kind)))
    numbers = {"DP_TASK_" + k.upper(): v for k, v in _core.TASK.items()}
    numbers.update({"DP_MODEL_" + k.upper(): v for v, k in enumerate(_core.MODELS)})
    numbers.update({"DP_ROUND_" + k.upper(): v for v, k in enumerate(_core.ROUNDINGS)})
    numbers.update({"DP_ERROR_" + k: v for v, k in enumerate(_core.STATUSES) if v})
    numbers.update({"DP_LAYOUT_" + (k or "found").upper(): v for k, v in _core.LAYOUTS.items()})
    numbers.update({"DP_REAL_FLOAT": 0, "DP_REAL_DOUBLE": 1, "DP_WORD_16": 0, "DP_WORD_32": 1,
                    "DP_MAPPING_COUNT": _core.MAPPING_FOUND, "DP_ANCHOR_COUNT": _core.ANCHORS, "DP_TASK_COUNT": len(_core.TASK),
                    "DP_STATUS_COUNT": len(_core.STATUSES), "DP_MODEL_COUNT": len(_core.MODELS),
                    "DP_BATCH_KEEP": _core.KEEP})
    for name, value in numbers.items():
        lines.append('printf("%s %%d\\n", (int)%s);' % (name, name))
        want.append("%s %d" % (name, value))
    return "\n".join(lines + ["return 0; }", ""]), "\n".join(want) + "\n"


if __name__ == "__main__":
    if sys.argv[1:2] == ["--layout"]:
        for path, text in zip(sys.argv[2:], layout()):
            with open(path, "w") as file:
                file.write(text)
    else:
        warnings.simplefilter("error")
        unittest.main()
