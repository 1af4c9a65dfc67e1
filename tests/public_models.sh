#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Models of others in which hardly anything fights: the 82 controllers of the npm package @webxr-input-profiles/assets,
# 98 MB, which `make check-full` fetches. WEBXR=FOLDER names it unpacked.
. tests/tap.sh

package=@webxr-input-profiles/assets version=1.0.20

fetched() { # fetched: unpacks the package; fails where there is no network
    [ -z "${WEBXR:-}" ] || { models=$WEBXR && return; }
    models=$scratch/package
    timeout 300 npm pack --silent --pack-destination "$scratch" $package@$version >"$scratch/log" 2>&1 &&
        tar -xzf "$scratch"/*.tgz -C "$scratch"
}

searched() { # searched OPTION...: a line of each model: how many findings, the largest area, square metres, its name
    find "$models" -name '*.glb' | sort | while IFS= read -r glb; do
        timeout 60 "$DEPTHPREC" scene --quiet --json "$@" "$glb" >"$scratch/json" &&
            jq -r --arg name "$glb" '"\(.findings | length) \([.findings[].area, 0] | max) \($name)"' "$scratch/json"
    done
}

nothing_in_one_plane() {
    searched --separation 0 >"$scratch/found"
    awk '$1 > 0 { print } { all++ } END { if (all != 82) print all, "of 82 models were read" }' "$scratch/found" |
        empty cat
}

# What is left are corners where planes cross at less than a degree, and triangles of a mesh that is folded.
hardly_anything() {
    searched >"$scratch/found"
    awk '$1 > 1 || $2 > 1e-6 { print } { all++; some += $1 > 0 }
        END { if (all != 82 || some > 8) print some, "of", all, "models have findings" }' "$scratch/found" | empty cat
}

none="82 models of controllers have nothing in one plane"
some="where as much is asked as is not told apart, at most 8 have a finding, none above a square millimetre"
if [ -z "${DEPTHPREC_FULL:-}" ]; then
    skip "$none" "make check-full fetches them"
elif ! fetched; then
    skip "$none" "npm is not there, or does not fetch them"
else
    check "$none" nothing_in_one_plane
    check "$some" hardly_anything
fi
finish
