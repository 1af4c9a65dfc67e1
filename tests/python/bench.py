# SPDX-License-Identifier: GPL-3.0-or-later
"""The speed of the Python door beside the C loop and, where numpy is here, beside its textbook formula:

    B=build CC=cc python3 tests/python/bench.py

Unpacks the wheel of $B/dist into an empty folder. Times are the best of many, C and Python in turn.
"""
import array
import functools
import glob
import importlib
import os
import random
import shlex
import subprocess
import sys
import tempfile
import time
import zipfile

BUILD = os.environ.get("B", "build")
AIM = 1.2


def best(work, repeats):
    least = 1e300
    for _ in range(repeats):
        begun = time.perf_counter_ns()
        work()
        least = min(least, time.perf_counter_ns() - begun)
    return least


def memory(code, values):
    """numpy's where it is here, as users have it."""
    made = array.array(code, values)
    return numpy.frombuffer(made, code) if numpy else made


def note(met, what, ratio):
    if os.environ.get("DEPTHPREC_AIMS"):
        with open(os.environ["DEPTHPREC_AIMS"], "a") as file:
            file.write("%s\t%s\t%.2f\n" % ("met" if met else "missed", what, ratio))


def measure(loop, name, camera, task, real, word, method, given, result):
    """Prints a line, and the aim of arrays that are as large as the page says."""
    for count in (1000, 100000, 1000000):
        repeats = max(20, 20000000 // count)
        some, out = given[:count], result[:count]
        raw = memoryview(some).tobytes()
        words = [loop, camera.format, camera.mapping, str(task), str(real), str(word), str(count), str(repeats)]
        in_c, in_python, fresh = 1e300, 1e300, 1e300
        for _ in range(3):
            in_c = min(in_c, float(subprocess.run(words, input=raw, stdout=subprocess.PIPE, check=True).stdout))
            in_python = min(in_python, best(lambda: method(some, out=out), repeats) / count)
            fresh = min(fresh, best(lambda: method(some), max(5, repeats // 10)) / count)
        ratio = in_python / in_c
        print("%-34s %8d  %8.3f ns  %8.3f ns  %5.2f  %8.3f ns" % (name, count, in_c, in_python, ratio, fresh))
        if count >= 100000:
            note(ratio <= AIM, "python: %s, %d" % (name, count), ratio)


def textbook(camera, z, codes):
    """numpy's own, in binary32: how fast, and how wrong."""
    near, far, top = numpy.float32(camera.near), numpy.float32(camera.far), numpy.float32(camera.code_max)

    def encode():
        return numpy.rint((far / (far - near)) * (1 - near / z) * top).astype(numpy.uint32)

    def decode():
        return near * far / (far - codes.astype(numpy.float32) / top * (far - near))

    exact = camera.decode(codes)
    for name, work, wrong in (("encode", encode, lambda got: "%.3g %% of codes wrong"
                               % (100 * numpy.mean(got != camera.encode(z)))),
                              ("decode", decode, lambda got: "up to %.3g of the depth wrong"
                               % numpy.max(numpy.abs(got / exact - 1)))):
        print("numpy's textbook %s, %d: %.3f ns, %s" % (name, len(z), best(work, 20) / len(z), wrong(work())))


def floats(depthprec, z):
    """A float buffer's codes beside numpy's formula for them, in turn: its bits, some of them wrong."""
    near, far = numpy.float32(0.1), numpy.float32(1000)
    for mapping, formula in (("d3d", lambda some: far / (far - near) * (1 - near / some)),
                             ("reversed", lambda some: near / (far - near) * (far / some - 1))):
        encode = depthprec.Camera(0.1, 1000, "fp32", mapping).encode
        for count in (100000, len(z)):
            some, least = z[:count], [1e300, 1e300]
            for _ in range(max(20, 20000000 // count)):
                least = [min(x, best(work, 1)) for x, work in zip(least, (
                    lambda: encode(some), lambda: formula(some).view(numpy.uint32)))]
            ratio = least[0] / least[1]
            print("%-34s %8d  %8.3f ns, numpy's formula %.3f ns  %5.2f" % (
                "encode float32, fp32 " + mapping, count, least[0] / count, least[1] / count, ratio))
            note(ratio <= AIM, "python: encode of numpy's formula, fp32 %s, %d" % (mapping, count), ratio)


def main():
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(sorted(glob.glob(BUILD + "/dist/depthprec-*.whl"))[-1]).extractall(folder)
        sys.path.insert(0, folder)
        depthprec = importlib.import_module("depthprec")
        loop = os.path.join(folder, "loop")
        subprocess.run([*shlex.split(os.environ.get("CC", "cc")), "-O2", "-Iinclude", "-o", loop, "tests/python/loop.c",
                        BUILD + "/libdepthprec.so.0", "-Wl,-rpath," + os.path.abspath(BUILD)], check=True)
        r, most = random.Random(31), 1000000
        camera = depthprec.Camera(0.1, 1000, "unorm24", "d3d")
        z = memory("f", [0.1 * 10 ** (4 * r.random()) for _ in range(most)])
        wide = memory("d", z)
        codes = camera.encode(z)
        print("%-34s %8s  %11s  %11s  %5s  %11s" % ("an element", "count", "C", "Python", "ratio", "without out"))
        u, f, d = (memory(code, [0]) for code in "Ifd")
        u, f, d = (numpy.repeat(x, most) if numpy else x * most for x in (u, f, d))
        measure(loop, "encode float32", camera, 0, 0, 1, camera.encode, z, u)
        measure(loop, "encode float64", camera, 0, 1, 1, camera.encode, wide, u)
        measure(loop, "decode to float32", camera, 1, 0, 1, camera.decode, codes, f)
        measure(loop, "decode to float64", camera, 1, 1, 1, camera.decode, codes, d)
        measure(loop, "decode window depths float32", camera, "windows", 0, 1, camera.decode_window, camera.window_depth(z), f)
        measure(loop, "window depth float32", camera, 7, 0, 1, camera.window_depth, z, f)
        if numpy:
            textbook(camera, z, codes)
            floats(depthprec, z)
            for name, count in (("separation", 10000), ("lattice", 10000), ("interval", 10000), ("quick", 100000), ("quick", most)):
                some = z[:count]
                quick = {"quick": True} if name == "quick" else {}
                work = functools.partial(getattr(camera, "separation" if quick else name), some, **quick)
                print("%-34s %8d  %24.2f ns" % (name, count, best(work, 20) / count))
        else:
            print("numpy is not here: its textbook formula is left out")


if __name__ == "__main__":
    try:
        import numpy
    except ImportError:
        numpy = None
    main()
