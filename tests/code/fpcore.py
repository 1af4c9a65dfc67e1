# SPDX-License-Identifier: GPL-3.0-or-later
"""What the FPCores in a folder mean: the specification is the eye depth of the mapping, and the operations, each
rounded as the core says, stay within the bound that its comment names. By rational numbers.  fpcore.py FOLDER"""

import operator
import pathlib
import random
import re
import struct
import sys
from fractions import Fraction

SPAN = {"binary32": (24, -149), "binary64": (53, -1074)}  # bits, and the exponent of the least number


def to_nearest(x, precision):
    bits, least = SPAN[precision]
    if x == 0:
        return x
    exponent = x.numerator.bit_length() - x.denominator.bit_length()
    exponent -= abs(x) < Fraction(2) ** exponent
    unit = Fraction(2) ** max(exponent - bits + 1, least)
    return round(x / unit) * unit  # ties to even


def parsed(text):
    words, stack = re.findall(r"[()]|[^\s()]+", text), [[]]
    for word in words:
        if word == "(":
            stack.append([])
        elif word == ")":
            last = stack.pop()
            stack[-1].append(last)
        else:
            stack[-1].append(word)
    return stack[0]


def value(e, names, precision):
    """An expression; without a precision in exact arithmetic."""
    rounded = (lambda x: to_nearest(x, precision)) if precision else (lambda x: x)
    if isinstance(e, str):
        return names[e] if e in names else rounded(Fraction(e))
    if e[0] == "!":
        assert e[1] == ":precision"
        return value(e[3], names, e[2])
    if e[0] in ("let", "let*"):
        inner = dict(names)
        for name, bound in e[1]:
            inner[name] = value(bound, inner, precision)
        return value(e[2], inner, precision)
    args = [value(a, names, precision) for a in e[1:]]
    if e[0] == "-" and len(args) == 1:
        return -args[0]
    if e[0] == "fma":
        return rounded(args[0] * args[1] + args[2])
    if e[0] == "cast":
        return rounded(args[0])
    return rounded({"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}[e[0]](*args))


def eye_depth(mapping, ortho, near, far, d):
    """Where the projection puts d: linear in d, or in its reciprocal, between the two planes."""
    s = d if "reversed" in mapping else 1 - d  # 1 at near
    if mapping == "linear":
        return far * d
    if ortho:
        return far + (near - far) * s
    inverse = (1 / near) * s + ((1 / far) * (1 - s) if far else 0)
    return 1 / inverse


def judge(text):
    mapping = re.search(r"^; Eye depth of a window depth: ([^,\n]*), ", text)[1]
    ortho = ", orthographic," in text
    near, far = re.search(r"near ([^,\s]*), far (\S*)", text).groups()
    near, far = Fraction(near), None if far == "inf" else Fraction(far)
    said = re.search(r"off by at most (\S*) of (the depth|a scene unit)", text)
    assert said or "; No bound: " in text
    core = parsed("".join(line + "\n" for line in text.splitlines() if not line.startswith(";")))[0]
    assert core[0] == "FPCore" and core[1] == "eye_depth", core[:2]
    fields = {core[i]: core[i + 1] for i in range(3, len(core) - 1, 2)}
    assert far or fields[":pre"] == ["<", "0", "d", "1"], fields[":pre"]
    rng, worst = random.Random(len(text)), 0
    octaves = [2.0 ** -rng.uniform(1, 22) for _ in range(20)]
    depths = [rng.random() for _ in range(40)] + octaves + [1 - d for d in octaves] + ([0, 1] if far else [])
    for d in (Fraction(struct.unpack("f", struct.pack("f", d))[0]) for d in depths):
        exact = value(fields[":spec"], {"d": d}, None)
        assert exact == eye_depth(mapping, ortho, near, far, d), f"at {float(d)} the specification is {float(exact)}"
        if said:
            off = abs(value(core[-1], {"d": d}, fields[":precision"]) - exact)
            off /= exact if said[2] == "the depth" else 1
            assert off <= Fraction(said[1]), f"at {float(d)} off by {float(off)}, and said: {said[0]}"
            worst = max(worst, off / Fraction(said[1]))
    return float(worst)


if __name__ == "__main__":
    shares = [judge(path.read_text()) for path in sorted(pathlib.Path(sys.argv[1]).iterdir())]
    print(f"{len(shares)} FPCores, off by up to {max(shares):.2f} of what is said")
    assert len(shares) > 10 and max(shares) > 0.5
