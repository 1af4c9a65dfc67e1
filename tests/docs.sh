#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages as HTML (make check-web, after page.sh, which fetches the driver of the browser): formulas are read as they are
# typed, and in Chromium each link leads to a place that is there, nothing is wider than a phone, search finds what people
# look for, and a command opens in the page.
. tests/tap.sh

formulas() { # formulas TYPED MATHML
    python3 -B -c '
import re, sys
sys.path.insert(0, "man")
import formulas
got = re.sub(r"</?(math|mspace)[^>]*>", "", formulas.cell(sys.argv[1]) or "none")
if got != sys.argv[2]: sys.exit(f"{sys.argv[1]}\n{got}\n{sys.argv[2]}")' "$1" "$2"
}
check "a slash without blanks divides factors" formulas 'n/z f/(f - n)' \
    '<mrow><mfrac><mi>n</mi><mi>z</mi></mfrac><mfrac><mi>f</mi><mrow><mi>f</mi><mo>−</mo><mi>n</mi></mrow></mfrac></mrow>'
check "one between blanks divides products" formulas 'n f / 2 S' \
    '<mfrac><mrow><mi>n</mi><mi>f</mi></mrow><mrow><mn>2</mn><mi>S</mi></mrow></mfrac>'
check "an exponent ends before a blank" formulas '2^-24 k' \
    '<mrow><msup><mn>2</mn><mrow><mo>−</mo><mn>24</mn></mrow></msup><mi>k</mi></mrow>'
check "bars, roots, Greek and indices" formulas '|z_p - z1| <= kappa sqrt(3)' \
    '<mrow><mrow><mo>|</mo><mrow><msub><mi>z</mi><mi>p</mi></msub><mo>−</mo><msub><mi>z</mi><mn>1</mn></msub></mrow><mo>|</mo></mrow><mo>≤</mo><mrow><mi>κ</mi><msqrt><mn>3</mn></msqrt></mrow></mrow>'
check "a sentence is none" formulas 'd = z, or its complement' none

if [ ! -d "$B/web/node_modules/playwright-core" ] || ! command -v chromium >"$scratch/log"; then
    skip "the pages in a browser" "no browser, or no driver for it: make check-web fetches them"
else
    node --no-warnings tests/web/docs.mjs || failures=$((failures + 1))
fi
finish
