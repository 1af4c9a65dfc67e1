#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Presets against their engines: presets/ask.mjs asks the functions that npm ships for random cameras, and has nothing of
# src. Of `make check-full`, which fetches them; ENGINES=FOLDER has them installed, with esbuild, which makes a module of
# MapLibre's sources.
. tests/tap.sh

packages='maplibre-gl@6.17.0 @deck.gl/core@9.4.0 @cesium/engine@24.0.0 @babylonjs/core@9.35.0 three@0.187.0
    @kitware/vtk.js@37.4.3 x3dom@1.8.3 esbuild@0.25.0'
fetched() {
    site=${ENGINES:-$scratch/site}
    # shellcheck disable=SC2086
    [ -d "$site/node_modules" ] ||
        { mkdir -p "$site" && timeout 600 npm install --prefix "$site" --no-audit --no-fund --ignore-scripts \
            --legacy-peer-deps $packages >"$scratch/log" 2>&1; }
}
asked() {
    mkdir -p "$scratch/ask" && ln -s "$(cd "$site" && pwd)/node_modules" "$scratch/ask/node_modules" &&
        cp -r "$site/node_modules/maplibre-gl/src" "$scratch/ask/maplibre" && cp tests/presets/ask.mjs "$scratch/ask" &&
        "$site/node_modules/.bin/esbuild" "$scratch/ask/ask.mjs" --bundle --platform=node --format=esm --log-level=error \
            --outfile="$scratch/ask/out.mjs" && node "$scratch/ask/out.mjs" "${DEPTHPREC_SEED:-1}" "$scratch/ask/node_modules" >"$scratch/printed" &&
        lines -v '^BJS' "$scratch/printed" >"$scratch/asked" &&
        [ "$(wc -l <"$scratch/asked")" -ge 100 ]
}

# A line each: the preset, near and far by the engine, in scene units of the preset; far may be told from a matrix.
same() {
    while read -r preset near far; do
        "$DEPTHPREC" table --preset "$preset" --json --quiet >"$scratch/json" ||
            { echo "$preset is refused" >&2 && return 1; }
        jq -r --arg preset "$preset" --argjson near "$near" --argjson far "$far" \
            '.setups[0] | select((.near / $near - 1 | fabs) > 1e-9 or
                                 (.far / $far - 1 | fabs) > 1e-9 + 1e-15 * $far / $near) |
                "\($preset): near \(.near), far \(.far), not \($near), \($far)"' "$scratch/json" || return
    done <"$scratch/asked" >"$scratch/apart" && [ -s "$scratch/asked" ] && empty cat "$scratch/apart"
}

what="presets compute the planes that their engines do"
if [ -z "${DEPTHPREC_FULL-}" ]; then
    skip "$what" "make check-full fetches the engines"
elif ! command -v node >"$scratch/log" || ! fetched; then
    skip "$what" "node or npm is not there, or npm does not fetch them"
else
    check "engines are asked for random cameras" asked
    check "$what" same
fi
finish
