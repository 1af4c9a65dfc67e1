# SPDX-License-Identifier: GPL-3.0-or-later
"""What walk.c prints, by the Python package:  python3 walk.py <SETUPS"""
import array
import math
import struct
import sys

from depthprec import Camera, Error


def shown(values):
    return ["nan" if math.isnan(x) else struct.pack(">d", x).hex() for x in values]


def depths(c, z):
    codes = c.encode(z)
    outs = [array.array(z.typecode, z) for _ in range(3)]
    columns = (c.window_depth(z), c.separation(z), c.lattice(z), c.interval(z), *c.decode(codes, bounds=True, out=outs))
    return [*map(str, codes), *(word for column in columns for word in shown(column))]


def answer(near, far, format, mapping, ortho, rounding, model, arith, *numbers):
    z = array.array("d", map(float, numbers))
    c = Camera(float(near), float(far), format, mapping, ortho=ortho == "1", rounding=rounding, model=model, arith=arith)
    decoded = c.decode_window(c.window_depth(z), bounds=True)
    try:
        worst = shown(c.worst(z[0], z[-1]))
    except Error as error:
        worst = [str(error)]
    return " ".join(["", *depths(c, z), *depths(c, array.array("f", z)), *(w for x in decoded for w in shown(x)), *worst])


for line in sys.stdin:
    try:
        print(answer(*line.split()))
    except Error as error:
        print(error)
