#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The page in a browser (make check-web): Chromium without a window, driven by playwright-core, judged by axe-core.
# Both are npm's packages, pinned by version and digest in tests/web/package-lock.json; nothing of them is run on install.
# It takes a minute, all with DEPTHPREC_FULL: then what is seen of the page is left in $B/web/shots.
# ONLY=agrees,figures,redraw,controls,gpu,image,people,bad,shots,walks,states takes a part.
. tests/tap.sh
addresses=100000
[ -z "${DEPTHPREC_FULL-}" ] || addresses=1000000

# prints why there is no browser, or no driver for it
lacking() {
    sh src/packages.sh browser >"$scratch/log" 2>&1 || { tail -n 1 "$scratch/log" && return; }
    B=$B sh tests/web/packages.sh || return
    chromium --version >"$scratch/log" 2>&1 || echo "chromium does not start here"
}

# Nothing in the file names another: what it links to, imports or calls.
alone() {
    ! grep -oE '(src|href)="[^"]{1,80}|@import|url\([^)]{1,80}' "$B/depthprec.html"
}

small() {
    [ "$(gzip -9c "$B/depthprec.html" | wc -c)" -le 307200 ]
}

check "the page names no other file" alone
check "the page has at most 300 KiB as servers send it, by gzip" small

cp src/web/command.js "$scratch/command.mjs"
node --no-warnings tests/web/fuzz.mjs "$scratch/command.mjs" $addresses || failures=$((failures + 1))

why=$(lacking)
if [ -n "$why" ]; then
    skip "the page in a browser" "no browser can be installed: $why"
else
    mkdir -p "$B/web/shots"
    node --no-warnings tests/web/page.mjs || failures=$((failures + 1))
fi
finish
