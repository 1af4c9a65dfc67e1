#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Depth functions of three.js, CesiumJS, Babylon.js and PlayCanvas, taken out of what npm ships, are judged for the cameras
# that these engines make themselves. What is true of each stands in engines/cases.txt and is checked by engines/judge.mjs,
# which knows nothing of src. Of `make check-full`, which fetches 250 MB; ENGINES=FOLDER names a folder that has them installed.
. tests/tap.sh

cases=tests/engines/cases.txt
packages() { lines -E '^@?[a-z/-]+@[0-9.]+$' $cases; }
fetched() { # by the versions that the list names
    site=${ENGINES:-$scratch/site}
    [ ! -d "$site/node_modules" ] || return 0
    # shellcheck disable=SC2046
    mkdir -p "$site" &&
        timeout 600 npm install --prefix "$site" --no-audit --no-fund --ignore-scripts $(packages) >"$scratch/log" 2>&1
}
true_of_engines() {
    mkdir -p "$scratch/shaders" && cp tests/engines/judge.mjs "$site/depthprec-judge.mjs" &&
        node "$site/depthprec-judge.mjs" $cases "$scratch/shaders" && [ "$(wc -l <"$scratch/shaders/list")" -ge 40 ]
    status=$?
    rm "$site/depthprec-judge.mjs"
    return $status
}

# A line each: verdict, what it should be, what is true, what is named, what should be, which function.
judge_all() {
    while IFS='	' read -r want computes from truth which operand; do
        # shellcheck disable=SC2086
        "$DEPTHPREC" judge $operand --json </dev/null >"$scratch/json" || return
        jq -r --arg want "$want" --arg truth "$truth" --arg named "$computes from $from" --arg which "$which" \
            '[.verdict, $want, $truth, "\(.fits[0].computes) from \(.fits[0].from)", $named, $which] | @tsv' "$scratch/json"
    done <"$scratch/shaders/list" >"$scratch/judged"
}
as_listed() { awk -F '\t' '$1 != $2 || ($1 != "unknown" && $4 != $5)' "$scratch/judged" | empty cat; }
enough() {
    awk -F '\t' '
        { split($6, word, " "); functions[word[1] " " word[2] " " word[3]] }
        $3 == "right" && ($1 == "wrong" || $1 == "another set-up") { print "accused: " $6; accused++ }
        $1 != "unknown" && $4 == $5 { named++ }
        END {
            for (f in functions) all++
            print NR, "cases,", all, "functions,", named + 0, "cases named,", accused + 0, "right ones accused"
            exit !(all >= 25 && named >= 40 && accused == 0)
        }' "$scratch/judged"
}

what="what is listed of depth functions is true of their engines' own matrices"
if [ -z "${DEPTHPREC_FULL-}" ]; then
    skip "$what" "make check-full fetches the engines"
elif ! command -v node >"$scratch/log" || ! fetched; then
    skip "$what" "node or npm is not there, or npm does not fetch them"
else
    check "$what" true_of_engines
    # shellcheck disable=SC2046
    if "$DEPTHPREC" judge $(awk -F '\t' '$6 ~ /glsl:/ { print $6; exit }' "$scratch/shaders/list") 2>&1 | grep -E "^depthprec: .*(Debian's package|device)" >"$scratch/log"; then
        skip "all of them are judged" "$(cat "$scratch/log")"
    else
        check "all of them are judged" judge_all
        check "each as the list says" as_listed
        check "25 functions and more, none that is right accused" enough
    fi
fi
finish
