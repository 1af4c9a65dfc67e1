#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What articles on depth textures of Unity say, item by item: the program shows it, and its numbers agree with formulas
# that awk computes. Other tests hold the same more closely; README.md of this folder names them.
. tests/tap.sh

unset NO_COLOR LANGUAGE LANG POSIXLY_CORRECT
export TERM=dumb
depthprec() { "$DEPTHPREC" "$@"; }

says() { # says WORDS COMMAND...: it exits 0 and prints these words, however the lines break
    words=$1
    shift
    "$@" >"$scratch/answer" 2>"$scratch/errors" </dev/null || { cat "$scratch/errors" && return 1; }
    cat "$scratch/answer" "$scratch/errors"
    cat "$scratch/answer" "$scratch/errors" | tr -s ' \n' '  ' | grep -qF -e "$words"
}

# rows FORMULAS COMMAND...: the columns of --csv are what awk says: assignments to want["column"], of the columns a["z"]...
rows() {
    formulas=$1
    shift
    "$@" --csv >"$scratch/rows" 2>/dev/null </dev/null || return 1
    tr -d '\r' <"$scratch/rows" | awk -F, "
        function close_to(x, y, least) { return x - y <= least && y - x <= least }
        # the shader's two channels, of 8 bits each, as one number
        function rg(v) { y = 255 * v; k = int(y); return 255 * k + int(255 * (y - k) + 0.5) }
        # names may have commas within quotes
        /\"/ { n = split(\$0, part, /\"/); \$0 = \"\"; for (i = 1; i <= n; i++) { if (i % 2 == 0) gsub(/,/, \";\", part[i]); \$0 = \$0 part[i] } }
        NR == 1 { for (i = 1; i <= NF; i++) { name[i] = \$i; sub(/ [[].*/, \"\", name[i]); gsub(/;/, \",\", name[i]) } next }
        {
            for (i = 1; i <= NF; i++) a[name[i]] = \$i
            least = 1e-12
            $formulas
            for (c in want) {
                seen++
                if (!close_to(a[c] + 0, want[c], want[c] * 1e-6 + least) && bad++ < 9) print c, a[c], want[c]
            }
        }
        END { exit bad > 0 || !seen }"
}

# ---- The words of articles, in depthprec-texture(1) ----

mkdir "$scratch/work"
awk '/^\.Ss Words of articles/ { on = 1 }
    /^\.Ed/ { on = 0 }
    on && !/^[.A].* .*:$|^\./ { line = $0; more = sub(/ *\\e$/, " ", line); printf "%s%s", line, more ? "" : "\n" }' \
    man/depthprec-texture.1 >"$scratch/words"
runs() { # runs COMMAND: as it stands there, one after the other in a folder
    # Words without quotes or patterns.
    # shellcheck disable=SC2086
    (cd "$scratch/work" && depthprec $1 </dev/null)
}
count=0
while read -r word command; do
    count=$((count + 1))
    check "$word is known to help" depthprec help "$word"
    check "$word: depthprec $command" runs "$command"
done <"$scratch/words"
check "the table of words has all its lines" [ $count -ge 24 ]

# ---- Pictures ----

check "raw and Linear01: the curves over z" rows '
    want["window depth, d3d"] = 20 / 19 * (1 - 1 / a["z"])
    want["Linear01Depth, z/far"] = a["z"] / 20
    want["Linear01DepthFromNear"] = (a["z"] - 1) / 19' depthprec plot linear01 -n 1 -f 20 -m d3d
check "raw and Linear01: several far planes" rows '
    f = a["series"]
    sub(/.*far /, "", f)
    f += 0
    want["share"] = a["series"] ~ /window/ ? f / (f - 1) * (1 - 1 / a["z"]) : a["series"] ~ /FromNear/ ? (a["z"] - 1) / (f - 1) \
                                                                                              : a["z"] / f' \
    depthprec plot linear01 -n 1 -f 10,20,50 -m d3d
ends() { # each curve ends at its own far plane, at 1
    depthprec plot linear01 -n 1 -f 50,10,20 -m d3d --csv | tr -d '\r' | awk -F, '
        NR > 1 { z[$2] = $(NF - 1); y[$2] = $NF }
        END {
            for (curve in z) {
                far = curve
                sub(/:.*/, "", far)
                gsub(/[^0-9]/, "", far)
                seen++
                bad += far + 0 != z[curve] + 0 || y[curve] < 0.999999 || y[curve] > 1
            }
            exit bad || seen != 9
        }'
}
check "raw and Linear01: each curve ends at its far plane" ends
check "nine tenths of the codes lie in the first ten units" rows '
    least = 100 / 2 ^ 24
    want["unorm24 d3d"] = 100 * (1 - 1000 / 999 * (1 - 1 / a["z"]))' \
    depthprec plot share -n 1 -f 1000 -F d24 -m d3d

# ---- Depth of DepthNormals beside depth buffers ----

check "rg: its codes are those of EncodeFloatRG, depths those of DecodeFloatRG" rows '
    want["code"] = rg(a["z"] / 1000)
    want["z_stored"] = 1000 * want["code"] / 65025
    want["interval"] = want["code"] < 65025 ? 1000 / 65025 : 500 / 65025' \
    depthprec table -n .3 -f 1000 -F rg --at .5,1,3.14159,10,99.99,123.456,500,999.9,1000
check "rg: beside D16, D24 and D32F it is of the mapping linear" says \
    'rg linear 0.016 0.016 0.016 0.016' depthprec table -F rg,d16,d24,d32f -m d3d --at 1,10,100,1000
check "rg: the far plane itself reads as the camera" says 'Far itself becomes 0 by frac, and reads as the camera.' \
    depthprec table -F rg
unlike() { # unlike COMMAND...: rg is refused, and where it belongs is said
    "$@" -F rg -o "$scratch/refused.svg" >"$scratch/errors" 2>&1
    [ $? -eq 2 ] && grep -F 'rg is no depth buffer' "$scratch/errors"
}
check "rg: is no depth buffer of a shadow map" unlike depthprec shadow
check "rg: is no depth buffer of an image" unlike depthprec texture --synthetic plane
check "rg: is no depth buffer of a model's figure" unlike depthprec plot scene tests/models/house.gltf
as_packed() { # the bytes that texture packs are the codes that table prints
    depthprec texture --synthetic steps --parameter even=1 --size 16x1 -f 1000 -F fp32 -m linear --product pack:rg \
        -o "$scratch/rg.npy" -q || return 1
    od -An -v -tu1 -w2 -j128 "$scratch/rg.npy" | awk '{ print 255 * $1 + $2 }' >"$scratch/packed"
    at=$(awk 'BEGIN { for (i = 0; i < 16; i++) printf "%s%.17g", i ? "," : "", 1 + 299 * i / 15 }')
    depthprec table -f 1000 -F rg --at "$at" --json | tr ',' '\n' | sed -n 's/"code"://p' >"$scratch/codes"
    paste "$scratch/packed" "$scratch/codes"
    [ "$(grep -c . "$scratch/codes")" -eq 16 ] && cmp "$scratch/packed" "$scratch/codes"
}
check "rg: its codes are the bytes that texture packs" as_packed

finish
