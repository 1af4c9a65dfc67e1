#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One camera, four doors: the command line, a requirement file, Python and npm take the cameras of camera/cameras.txt, and
# refuse what is wrong with them by the same key, or answer with the same bits. npm where make npm has made it.
. tests/tap.sh

if ! command -v python3 >/dev/null 2>&1; then
    skip "cameras through four doors" "there is no python3"
    finish
    exit
fi
export PYTHONDONTWRITEBYTECODE=1 table=tests/camera/cameras.txt

# Random cameras, too: what all doors make of them is alike.
seed=${DEPTHPREC_SEED:-20150707}
cat $table >"$scratch/table" && python3 tests/camera/walk.py "$seed" 120 >>"$scratch/table"
echo "# seed $seed"

# The key that a sentence of the library is about: its first word, but for these.
by_key() { # by_key FIELD
    awk -F '\t' -v OFS='\t' -v at="$1" '{
        key = $at
        if (key ~ / /) {
            if (key ~ /^raster must be spec-/) key = "-"
            sub(/^(an?|the) /, "", key)
            if (key ~ /^infinite far/) key = "far"
            if (key ~ /^orthographic/) key = "ortho"
            sub(/^triangleClass/, "triangle", key)
            if (key ~ /^constant C/ || key ~ /^logC/) key = "log_c"
            if (key ~ /^not a format/) key = "format"
            if (key ~ /^this set-up does not have that model/) key = "model"
            if (key ~ /^not a variant of binary32/) key = "arith"
            if (key ~ /^triangles need a perspective/) key = "viewport"
            if (key ~ /^triangle/) key = "triangle"
            sub(/[: ].*/, "", key)
            $at = key
        }
        print
    }'
}
# Where a door says another key than the table, another number than the command line, or nothing at all.
judge() { # judge FIRST_DOOR FIELDS
    awk -F '\t' -v first="$1" -v fields="$2" '{
        for (i = first; i <= fields && $2 == "alike"; i++) # the library does not see what was said in vain
            if ($i != $3 && (i == 4 || ($i != "-" && $3 ~ /^[0-9a-f]+$/ && length($3) == 16))) print
        for (i = first; i <= fields && $2 != "alike"; i++)
            if ($i != "-" && ($2 == "right" ? $i !~ /^[0-9a-f]+$/ || length($i) != 16 || $i != $3 : $i != $2)) print
    } END { if (NR < 270) print "only " NR " cameras" }' "$scratch/said" >"$scratch/wrong"
    cat "$scratch/wrong"
    [ ! -s "$scratch/wrong" ]
}
say() {
    mkdir "$scratch/python" && cp -r src/python/depthprec "$scratch/python" && cp "$B/libdepthprec.so.0" "$scratch/python/depthprec" &&
        mkdir "$scratch/python/depthprec/bin" && ln -s "$DEPTHPREC" "$scratch/python/depthprec/bin/depthprec" &&
        PYTHONPATH=$scratch/python python3 tests/camera/doors.py "$DEPTHPREC" "$scratch/table" | by_key 5 >"$scratch/said"
}
say_npm() {
    mkdir "$scratch/npm" && cp src/npm/*.js src/web/engine.js src/web/command.js "$B"/npm/*.data.js "$scratch/npm" &&
        printf 'export default "%s";\n' "$(base64 -w0 "$B/npm/core.wasm")" >"$scratch/npm/core.data.js" &&
        echo '{"type": "module"}' >"$scratch/npm/package.json" && cp tests/camera/doors.mjs "$scratch/npm" &&
        node "$scratch/npm/doors.mjs" "$scratch/npm/index.js" "$scratch/table" | by_key 2 >"$scratch/by_npm" &&
        paste "$scratch/said" "$scratch/by_npm" | awk -F '\t' -v OFS='\t' '$1 == $6 { print $1, $2, $3, $4, $5, $7 }' >"$scratch/all" &&
        mv "$scratch/all" "$scratch/said"
}

check "each camera is said" say
check "by the command line, a requirement file and Python alike" judge 3 5
if command -v node >/dev/null 2>&1 && [ -e "$B/npm/core.wasm" ]; then
    check "each camera is said by npm" say_npm
    check "by npm alike" judge 6 6
else
    skip "cameras by npm" "there is no node, or make npm has not made it"
fi
finish
