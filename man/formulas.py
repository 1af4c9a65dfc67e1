# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas of depthprec(7) as MathML.

A displayed block becomes a table, a cell for what two blanks part. A cell all of whose words are known to the notation of
that page is a formula; any other stays as it is typed. A slash without blanks takes the factors beside it, one between
blanks the products: n/z f/(f - n) is (n/z) (f/(f - n)), and n f / (f S + n T) has n f on top.
"""

import html
import re

LETTERS = {"kappa": "κ", "phi": "φ", "tau": "τ", "eps": "ε", "pi": "π"}
FUNCTIONS = "log log2 log1p exp expm1 sin cos tan atan sqrt fl hypot floor ulp min max".split()
VARIABLES = "num den clip ndc window slope hi start end dz dh dv".split()
TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?(?:e-?\d+)?)|((?:log1p|expm1|[A-Za-z]+\d*(?:_[A-Za-z0-9]+)?)['*]?)|(<=|>=|\.\.\.|[-+/^=<>,()|]))")
RELATIONS = {"=": "=", "<": "&lt;", ">": "&gt;", "<=": "≤", ">=": "≥"}


class Unknown(Exception):
    pass


def row(*parts):
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>"


class Part(str):
    """MathML, and the same without the parentheses around it, if that is all that it is."""

    inner = None

    @property
    def bare(self):
        return self.inner or self


def fraction(over, under):
    return Part(f"<mfrac>{over.bare}{under.bare}</mfrac>")


class Parser:
    """From sums down to names; each of a token is its kind, its text, and whether a blank stands before and behind it."""

    def __init__(self, text):
        self.tokens, self.at, self.bars, at = [], 0, 0, 0
        while text[at:].strip():
            m = TOKEN.match(text, at)
            if m is None:
                raise Unknown(text[at:])
            kind = ("number", "name", "mark")[m.lastindex - 1]
            self.tokens.append((kind, m[m.lastindex], m.start(m.lastindex) > at, text[m.end() : m.end() + 1] == " "))
            at = m.end()

    def peek(self, *marks):
        kind, text, _, _ = self.tokens[self.at] if self.at < len(self.tokens) else ("end", "", False, False)
        return kind == "mark" and text in marks

    def take(self, mark=None):
        if self.at == len(self.tokens) or (mark and not self.peek(mark)):
            raise Unknown(mark)
        self.at += 1
        return self.tokens[self.at - 1]

    def tight(self):
        return not self.tokens[self.at][2]

    def whole(self):
        out = self.list()
        if self.at < len(self.tokens):
            raise Unknown(self.tokens[self.at][1])
        return out

    def list(self):
        out = [self.relation()]
        while self.peek(","):
            self.take()
            out.append("<mo>,</mo>")
            if self.at < len(self.tokens):  # a line that ends with a comma goes on
                out.append(self.relation())
        return row(*out)

    def relation(self):
        out = [] if self.peek(*RELATIONS) else [self.sum()]
        while self.peek(*RELATIONS):
            out += [f"<mo>{RELATIONS[self.take()[1]]}</mo>", self.sum()]
        return row(*out)

    def sum(self):
        out = [] if self.peek("+", "-") else [self.quotient()]
        while self.peek("+", "-"):
            out.append(f"<mo>{'−' if self.take()[1] == '-' else '+'}</mo>")
            out.append(self.quotient())
        return row(*out)

    def quotient(self):
        out = self.product()
        while self.peek("/"):
            self.take()
            out = fraction(out, self.product())
        return out

    def product(self):
        out = [self.factor()]
        while self.starts():
            out += ["<mspace width='.17em'/>", self.factor()]
        return out[0] if len(out) == 1 else Part(row(*out))

    def starts(self):
        """Whether a factor begins here: a bar does, unless one is open."""
        kind = self.tokens[self.at][0] if self.at < len(self.tokens) else "end"
        return kind in ("number", "name") or self.peek("(", "...") or (self.peek("|") and not self.bars)

    def factor(self):
        out = self.power()
        while self.peek("/") and self.tight() and not self.tokens[self.at][3]:
            self.take()
            out = fraction(out, self.power())
        return out

    def power(self):
        out = self.atom()
        if self.peek("^"):
            self.take()
            sign = "<mo>−</mo>" if self.peek("-") else ""
            if sign:
                self.take()
            out = Part(f"<msup>{out}{row(*filter(None, [sign, self.atom().bare]))}</msup>")
        return out

    def atom(self):
        kind, text, _, _ = self.take()
        if kind == "number":
            return Part(f"<mn>{text}</mn>")
        if kind == "name":
            return self.name(text)
        if text == "...":
            return Part("<mo>…</mo>")
        if text == "(":
            bars, self.bars = self.bars, 0
            inner = self.list()
            self.bars = bars
            self.take(")")
            out = Part(f"<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>")
            out.inner = inner
            return out
        if text == "|":
            self.bars += 1
            inner = self.sum()
            self.bars -= 1
            self.take("|")
            return Part(f"<mrow><mo>|</mo>{inner}<mo>|</mo></mrow>")
        raise Unknown(text)

    def name(self, text):
        base, mark = (text[:-1], text[-1]) if text[-1] in "'*" else (text, "")
        if base in FUNCTIONS:
            if not (self.peek("(") and self.tight()):
                raise Unknown(text)
            given = self.atom()
            return Part(f"<msqrt>{given.inner}</msqrt>" if base == "sqrt" else row(f"<mi>{base}</mi>", given))
        m = re.fullmatch(r"([A-Za-z])(?:_?(\w|\d+)|_(\w+))", base)
        if base in LETTERS or base in VARIABLES or len(base) == 1:
            out = f"<mi>{LETTERS.get(base, base)}</mi>"
        elif m and (m[3] or m[2].isdigit() or m[2] in "xyzwp" or "_" in base):
            low = m[2] or m[3]
            out = f"<msub><mi>{m[1]}</mi><{'mn' if low.isdigit() else 'mi'}>{low}</{'mn' if low.isdigit() else 'mi'}></msub>"
        else:
            raise Unknown(text)
        if mark:
            out = f"<msup>{out}<mo>{'′' if mark == chr(39) else '∗'}</mo></msup>"
        if self.peek("(") and self.tight() and len(base) == 1:  # a value of a function, as z(t)
            return Part(row(out, self.atom()))
        return Part(out)


def cell(text):
    """A formula as MathML, or None."""
    try:
        return f'<math displaystyle="true">{Parser(text).whole()}</math>'
    except Unknown:
        return None


def block(text):
    """A displayed block as a table, or None where it holds no formula that has an operator."""
    lines = [[(m.start(), m[0]) for m in re.finditer(r"\S+(?: \S+)*", line)] for line in text.split("\n")]
    if not any(re.search(r"[=^/]", t) and cell(t) for line in lines for _, t in line):
        return None
    starts = sorted({at for line in lines for at, _ in line})
    rows = []
    for line in lines:
        held, out = dict(line), []
        for start in starts:
            said = held.get(start, "")
            out.append(f"<td>{cell(said) or html.escape(said)}</td>")
        rows.append(f"<tr>{''.join(out)}</tr>")
    return f'<table class="formulas">{"".join(rows)}</table>'
