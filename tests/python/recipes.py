# SPDX-License-Identifier: GPL-3.0-or-later
"""RECIPES.md as it stands: its files are made here, by the definitions of their formats, and its examples run:

    python3 recipes.py RECIPES.md

Needs numpy, as the recipes do.
"""
import doctest
import os
import struct
import sys
import tempfile
import zlib

import numpy


def png(path, pixels):
    """uint8 (height, width, 3), or uint16 (height, width)."""
    height, width = pixels.shape[:2]
    depth, colour = (8, 2) if pixels.dtype == numpy.uint8 else (16, 0)
    rows = pixels.astype(pixels.dtype.newbyteorder(">")).reshape(height, -1)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row.tobytes() for row in rows))) + chunk(b"IEND", b""))


def main():
    page = os.path.abspath(sys.argv[1])
    os.chdir(tempfile.mkdtemp())
    metres = numpy.linspace(1, 9, 12 * 16).reshape(12, 16)
    metres[0, 0] = 0  # a hole
    for name, unit in (("kitti.png", 256), ("scannet.png", 1000), ("tum.png", 5000)):
        png(name, numpy.rint(metres * unit).astype(numpy.uint16))
    code = numpy.rint(metres / 1000 * (256 ** 3 - 1)).astype(numpy.uint32)
    png("carla.png", numpy.stack([code & 255, code >> 8 & 255, code >> 16], axis=-1).astype(numpy.uint8))
    failed, tried = doctest.testfile(page, module_relative=False, optionflags=doctest.NORMALIZE_WHITESPACE)
    return 1 if failed or tried < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
