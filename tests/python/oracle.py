# SPDX-License-Identifier: GPL-3.0-or-later
"""Depth buffers in rational arithmetic: every number here is exact, and none of it is of the library's making."""
import math
import random
import struct
from fractions import Fraction

FORMATS = {"unorm16": (16, None), "unorm24": (24, None), "unorm10": (10, None), "unorm32": (32, None),
           "fp16": (10, 15), "fp32": (23, 127), "float3.3b5": (3, 5)}
AFFINE = ("d3d", "gl", "reversed", "gl-reversed")


class Setup:
    """A camera whose mapping is a rational function."""

    def __init__(self, near, far, format, mapping, ortho=False, rounding="nearest"):
        self.near, self.far = near, far
        self.n, self.f = Fraction(near), None if far == math.inf else Fraction(far)
        self.mapping, self.ortho, self.rounding, self.format = mapping, ortho, rounding, format
        self.reversed = "reversed" in mapping
        self.bits, self.bias = FORMATS[format]
        self.max = 2 ** self.bits - 1 if self.bias is None else self.bias << self.bits

    def window(self, z):
        n, f = self.n, self.f
        if z == math.inf:
            return Fraction(not self.reversed)
        z = Fraction(z)
        if self.mapping == "linear":
            return z / f
        if self.ortho:
            d = (z - n) / (f - n)
        else:
            d = (1 - n / z) / (1 - (n / f if f else 0))
        return 1 - d if self.reversed else d

    def eye(self, d):
        """The inverse; None at and beyond infinity."""
        n, f = self.n, self.f
        if self.mapping == "linear":
            return d * f
        q = 1 - d
        if self.reversed:
            d, q = q, d
        if self.ortho:
            return n * q + f * d
        inverse = q / n + (d / f if f else 0)
        return 1 / inverse if inverse > 0 else None

    def value(self, code):
        if self.bias is None:
            return Fraction(code, self.max)
        field, rest = code >> self.bits, code & (2 ** self.bits - 1)
        exponent = max(field, 1) - self.bias - self.bits
        return Fraction(rest + (2 ** self.bits if field else 0)) * Fraction(2) ** exponent

    def boundary(self, code):
        """Where, along d, `code` begins."""
        if self.rounding == "zero":
            return self.value(code)
        return (self.value(code) + self.value(code - 1)) / 2

    def code(self, d):
        """The correctly rounded code of a window depth."""
        lo, hi = 0, self.max
        while lo < hi:  # the last code whose value is not above d
            middle = (lo + hi + 1) // 2
            lo, hi = (middle, hi) if self.value(middle) <= d else (lo, middle - 1)
        if lo == self.max or self.rounding == "zero":
            return lo
        middle = self.boundary(lo + 1)
        ties_up = self.bias is None and self.rounding == "nearest"
        up = d > middle or (d == middle and (ties_up or lo % 2 == 1))
        return lo + up

    def encode(self, z):
        z = min(max(z, self.near), self.far)
        return self.code(self.window(z))

    def cell(self, code):
        """Nearest and farthest depth, within the planes; None: infinite."""
        ends = []
        for at in (code, code + 1):
            end = None if at == 0 or at > self.max else self.boundary(at)
            if end is None:
                end = Fraction(at > self.max)
            ends.append(self.eye(end))
        lo, hi = reversed(ends) if self.reversed else ends
        lo = self.n if lo is not None and lo < self.n else lo
        hi = self.f if self.f is not None and (hi is None or hi > self.f) else hi
        if hi is not None and hi < self.n:
            hi = self.n
        return lo, hi


def random_setup(r, infinite=True):
    mapping = r.choice(AFFINE + ("linear",))
    ortho = mapping != "linear" and r.random() < 0.2
    near = 10 ** r.uniform(-3, 2)
    far = near * 10 ** r.uniform(0.1, 5)
    if infinite and not ortho and mapping != "linear" and r.random() < 0.2:
        far = math.inf
    if ortho and r.random() < 0.5:
        near = r.choice([0.0, -near])
    return Setup(near, far, r.choice(sorted(FORMATS)), mapping, ortho, r.choice(["nearest", "even", "zero"]))


def random_depth(r, s):
    """Anywhere, or at the boundary of a code, as near as a double can be, or beside it."""
    far = s.far if s.far != math.inf else abs(s.near) * 1e6
    if r.random() < 0.5 or s.max < 2:
        return r.uniform(s.near, far) if s.near <= 0 or r.random() < 0.3 else s.near * (far / s.near) ** r.random()
    for _ in range(20):
        z = s.eye(s.boundary(r.randint(1, s.max)))
        if z is not None and s.n <= z <= Fraction(far):
            z = float(z)
            return min(max(nudge(z, r.randint(-1, 1)), s.near), s.far)
    return s.near


def nudge(x, steps):
    if x == 0 or steps == 0:
        return x
    bits = struct.unpack("=q", struct.pack("=d", x))[0]
    return struct.unpack("=d", struct.pack("=q", bits + (steps if x > 0 else -steps)))[0]


def binary32(x):
    return struct.unpack("=f", struct.pack("=f", x))[0]


def relative(got, want):
    """How far a double is from a rational, as a share of it."""
    return abs(Fraction(got) - want) / abs(want) if want else abs(Fraction(got))


def generator(name):
    return random.Random("depthprec " + name)
