# SPDX-License-Identifier: MIT
"""A table of certified separations over pieces of binades, by numpy. The bounds are the library's."""
import ctypes

from . import _core

PIECES = 12  # bits of a mantissa by which pieces are told
LAYOUTS = {4: ("u4", 23, 127), 8: ("u8", 52, 1023)}  # by the size of a number: its bits, those of the mantissa, bias


class Table:
    """Piece number p holds the depths from the double whose upper bits are p on, to the next piece."""

    def __init__(self, numpy, setup):
        self.numpy, self.setup = numpy, setup
        self.first = self._pieces(numpy.array([setup.spec.znear]))[0]
        self.bounds = {kind: numpy.zeros(0, kind) for kind in ("f4", "f8")}

    def _pieces(self, z):
        bits, mantissa, bias = LAYOUTS[z.itemsize]
        return (z.view(bits) >> (mantissa - PIECES)).astype("i8") - ((bias - 1023) << PIECES)

    def at(self, z):
        """The bounds at depths, of their type; NaN outside [near, far], but for floats next to the planes."""
        numpy, spec = self.numpy, self.setup.spec
        kind = "f%d" % z.itemsize
        if z.size == 0:
            return z.copy()
        inside = (z >= z.dtype.type(spec.znear)) & (z <= z.dtype.type(spec.zfar))
        kept = z if inside.all() else numpy.where(inside, z, z.dtype.type(spec.znear))
        endless = numpy.isinf(kept)
        kept = numpy.where(endless, z.dtype.type(spec.znear), kept) if endless.any() else kept
        index = self._pieces(kept)
        index -= self.first
        numpy.maximum(index, 0, out=index)
        self._grow(int(index.max()) + 1)
        found = self.bounds[kind][index]
        if numpy.isnan(found).any():
            self._fill(numpy.unique(index[numpy.isnan(found)]))
            found = self.bounds[kind][index]
        if kept is not z:
            found[endless] = numpy.inf
            found[~inside] = numpy.nan
        return found

    def _grow(self, size):
        for kind, old in self.bounds.items():
            if size > len(old):
                self.bounds[kind] = self.numpy.full(size, self.numpy.nan, kind)
                self.bounds[kind][:len(old)] = old

    def _fill(self, missing):
        numpy, spec = self.numpy, self.setup.spec
        shift = 52 - PIECES
        lo = ((missing + self.first) << shift).view("f8")
        hi = numpy.nextafter(((missing + self.first + 1) << shift).view("f8"), 0)
        lo, hi = numpy.clip(lo, spec.znear, spec.zfar), numpy.clip(hi, spec.znear, spec.zfar)
        made = numpy.empty(len(missing))
        _core.demand(_core.separation_runs(self.setup, *(x.ctypes.data_as(ctypes.c_void_p) for x in (lo, hi, made)),
                                           len(missing)))
        self.bounds["f8"][missing] = made
        with numpy.errstate(over="ignore"):
            narrow = made.astype("f4")
            self.bounds["f4"][missing] = numpy.where(narrow < made, numpy.nextafter(narrow, numpy.float32("inf")), narrow)
