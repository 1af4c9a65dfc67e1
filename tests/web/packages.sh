#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches what tests/web/package-lock.json names into $B/web, unless it is there: the browser's driver, axe-core and the
# TypeScript that judges types. Nothing of it is run on install. Says why it could not, and fails then.
command -v npm >/dev/null || { echo "there is no npm" && exit 1; }
cmp -s tests/web/package-lock.json "$B/web/package-lock.json" && [ -d "$B/web/node_modules/typescript" ] && exit
mkdir -p "$B/web" && cp tests/web/package.json tests/web/package-lock.json "$B/web"
(cd "$B/web" && npm ci --ignore-scripts --no-audit --no-fund) >"$B/web/npm.log" 2>&1 ||
    { rm -f "$B/web/package-lock.json" && echo "npm ci could not fetch playwright-core, axe-core and typescript" && exit 1; }
