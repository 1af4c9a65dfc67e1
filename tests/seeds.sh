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
        NR == 1 { for (i = 1; i <= NF; i++) { name[i] = \$i; sub(/ [[].*/, \"\", name[i]) } next }
        {
            for (i = 1; i <= NF; i++) a[name[i]] = \$i
            $formulas
            for (c in want) {
                seen++
                if (!close_to(a[c] + 0, want[c], want[c] * 1e-6 + 1e-12)) { print c, a[c], want[c]; bad = 1 }
            }
        }
        END { exit bad || !seen }"
}

# ---- Depth of DepthNormals beside depth buffers ----

check "rg: its codes are those of EncodeFloatRG, depths those of DecodeFloatRG" rows '
    want["code"] = rg(a["z"] / 1000)
    want["z_stored"] = 1000 * want["code"] / 65025
    want["interval"] = want["code"] < 65025 ? 1000 / 65025 : 500 / 65025' \
    depthprec table -n .3 -f 1000 -F rg --at .5,1,3.14159,10,99.99,123.456,500,999.9,1000
check "rg: beside D16, D24 and D32F it is of the mapping linear" says \
    'rg linear 0.016 0.016 0.016 0.016' depthprec table -F rg,d16,d24,d32f -m d3d --at 1,10,100,1000
check "rg: the far plane itself reads as the camera" says 'frac makes it 0, which shaders read as the camera' \
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
