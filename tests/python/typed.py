# SPDX-License-Identifier: GPL-3.0-or-later
"""What the stubs say of types: mypy agrees with the table below, and so does what is computed.

    typed.py FILE    runs each expression, and writes a program for mypy in which each is asserted, the wrong ones refused
"""
import re
import sys
import typing
from array import array

import numpy as np

import depthprec
from depthprec import Camera

PLANE, SPACE = "np.ndarray[tuple[int, int], np.dtype[%s]]", "np.ndarray[tuple[int, int, int], np.dtype[%s]]"
F4, F8, CODES = "np.float32", "np.float64", "np.uint16 | np.uint32"
GIVEN = {  # name: its type, its value
    "camera": ("Camera", "Camera()"),
    "few": ("Camera", "Camera(format='unorm16')"),
    "half": (PLANE % "np.float16", "np.full((2, 3), 5, np.float16)"),
    "narrow": (SPACE % F4, "np.full((2, 3, 4), 5, np.float32)"),
    "wide": (PLANE % F8, "np.full((2, 3), 0.5)"),
    "whole": (PLANE % "np.int64", "np.full((2, 3), 7)"),
    "codes": (PLANE % "np.uint16", "np.full((2, 3), 7, np.uint16)"),
    "listed": ("list[float]", "[1.0, 2.0]"),
    "path": ("str", "sys.argv[1] + '.png'"),
    "kept": ("array[float]", "array('d', [0.5])"),
}
RIGHT = [
    ("camera.near", "float"), ("camera.viewport", "tuple[int, int] | None"), ("camera.code_max", "int"),
    ("camera.encode(5)", "int"), ("camera.encode(np.float32(5))", "int"), ("camera.encode(listed)", "np.ndarray[typing.Any, np.dtype[%s]]" % CODES),
    ("camera.encode(kept)", "array[typing.Any]"), ("camera.encode(memoryview(kept))", "memoryview"),
    ("camera.encode(wide, out=codes.astype('u4'))", "np.ndarray[typing.Any, np.dtype[typing.Any]]"),
    ("camera.decode(5)", "float"), ("camera.decode(np.uint16(5))", "float"), ("camera.decode([1, 2])", "np.ndarray[typing.Any, np.dtype[%s]]" % F8),
    ("camera.decode(codes, out=half.astype('f4'))", "np.ndarray[typing.Any, np.dtype[typing.Any]]"),
    ("camera.decode(codes, bounds=True)", "depthprec.Decoded[%s]" % (PLANE % F8)),
    ("camera.decode(5, bounds=True)", "depthprec.Decoded[float]"),
    ("camera.decode(5, bounds=True).lo", "float"),
    ("camera.decode_window(half, bounds=True).hi", PLANE % F4),
    ("camera.decode_window(0.5, bounds=True)", "depthprec.Decoded[float]"),
    ("camera.decode_window(narrow)", SPACE % F4),
    ("camera.decode_window(wide)", PLANE % F8), ("camera.decode_window(listed)", "np.ndarray[typing.Any, np.dtype[%s]]" % F8),
    ("camera.separation(wide, quick=True)", PLANE % F8),
    ("camera.worst(1, 5).separation", "float"), ("camera.worst().error_code", "int"),
    ("camera.replace(near=1, viewport=(640, 480)).far", "float"), ("Camera.preset('unity', unit='cm', far=5e4).format", "str"),
    ("Camera.from_matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -1], [0, 0, -1, 0]], 'd3d', format='d24')", "Camera"),
    ("depthprec.read(codes, few)", "np.ndarray[typing.Any, np.dtype[np.float32 | np.float64]]"),
    ("depthprec.write(path, wide, product='eye', metric=1)", "dict[str, typing.Any]"),
    ("depthprec.recognise(codes)", "dict[str, typing.Any]"), ("depthprec.presets()", "list[dict[str, typing.Any]]"),
    ("depthprec.run('version', text=True)", "str | bytes"), ("depthprec.plot('error', camera)", "depthprec.Figure"),
    *(("%s.encode(%s)" % (camera, z), (shape % CODES)) for camera in ("camera", "few")
      for z, shape in (("half", PLANE), ("narrow", SPACE), ("wide", PLANE), ("whole", PLANE))),
    *(("camera.%s(%s)" % (name, z), kind) for name in ("window_depth", "separation", "lattice", "interval")
      for z, kind in (("half", PLANE % F4), ("narrow", SPACE % F4), ("wide", PLANE % F8), ("whole", PLANE % F8),
                      ("5", "float"), ("np.float32(5)", "float"), ("listed", "np.ndarray[typing.Any, np.dtype[%s]]" % F8),
                      ("kept", "array[typing.Any]"), ("kept, out=kept", "array[float]"))),
]
WRONG = ["camera.near = 5", "camera.decode(wide)", "camera.decode(0.5)", "camera.decode_window(codes)", "camera.encode('5')",
         "camera.separation({})", "camera.replace(nera=1)", "Camera(rounding='up')", "Camera(mapping=3)", "Camera.preset(3)",
         "camera.window_depth(wide, quick=True)", "Camera.preset('unity', layout='rows')", "depthprec.read(5)",
         "Camera.from_matrix(wide, near=3)", "camera.nera", "camera.worst('1')"]


def has(value, kind):
    """Whether a value has a type of the table, its elements and dimensions included."""
    outer, _, inner = kind.partition("[")
    if outer == "depthprec.Decoded":
        return isinstance(value, depthprec.Decoded) and all(has(each, inner[:-1]) for each in value)
    if outer != "np.ndarray":
        names = re.sub(r"\[[^][]*\]", "", re.sub(r"\[[^][]*\]", "", kind)).split(" | ")
        return any(value is None if name == "None" else isinstance(value, eval(name)) for name in names)
    shape, elements = inner[:-2].split(", np.dtype[")
    return isinstance(value, np.ndarray) and shape in ("typing.Any", "tuple[%s]" % ", ".join(["int"] * value.ndim)) and \
        any(element == "typing.Any" or issubclass(value.dtype.type, eval(element)) for element in elements.split(" | "))


def main(path):
    names = {}
    lines = ["import sys", "import typing", "from array import array", "import numpy as np", "import depthprec", "from depthprec import Camera"]
    for name, (kind, value) in GIVEN.items():
        names[name] = eval(value, {**globals(), **names})
        lines.append("%s: %s = %s" % (name, kind, value))
    for expression, kind in RIGHT:
        value = eval(expression, {**globals(), **names})
        if not has(value, kind):
            sys.exit("%s is no %s: %r" % (expression, kind, value))
        lines.append("typing.assert_type(%s, %s)" % (expression, kind))
    lines += ["%s  # type: ignore" % line for line in WRONG]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


main(sys.argv[1])
