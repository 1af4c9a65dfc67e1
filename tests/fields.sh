#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# depthprec.5 documents every field of each command's JSON, as .It Fa in that command's section, in that of a set-up or in
# the common one; a word of prose documents nothing.
. tests/tap.sh

section() { # section NAME: its lines that name fields, a word a line
    awk -v name="$1" '
        /^\.S[sh] / { inside = ($0 == ".Ss " name || $0 == ".Ss A set-up" || $0 == ".Sh JSON FIELDS") }
        inside && /^\.It Fa / { sub(/^\.It Fa /, ""); gsub(/ , /, "\n"); print }' man/depthprec.5
}

fields() { # fields COMMAND ARGUMENTS...: prints the fields that the page does not name
    section "$1" | sort -u >"$scratch/known" || return
    "$DEPTHPREC" "$@" --json >"$scratch/json"
    [ $? -le "$worst" ] || return
    jq -r '[.. | objects | keys[]] | unique[]' "$scratch/json" >"$scratch/keys" || return
    sort -u "$scratch/keys" >"$scratch/used" && grep -qx schema "$scratch/used" || return
    comm -23 "$scratch/used" "$scratch/known"
}

worst=0     # the exit status up to which a command has done its work
all_named() { # all_named COMMAND ARGUMENTS...
    check "depthprec.5: $*" empty fields "$@"
}

all_named table --at 10 -m d3d,log -F unorm24
all_named table --at 10 --model auto
all_named table --at 10 --depth-range 0:.1
all_named table --at 10 --depth-range 0:.1,.1:1
all_named table --at 10 --model float
all_named table --at 10 --tolerance 1%
all_named list methods --tolerance 1%
all_named plot interval
all_named plot map -F unorm24
all_named plot budget -F unorm24
all_named plot needs tests/needs/village.need
for what in formats mappings presets platforms apis engines rasterizers programs upscalers schemes encodings packings constants traps lattices sensors products effects synthetic positions normals figures reads writes limits remedies filters; do all_named list $what; done
all_named zfight -n 1 -f 1.5 -F unorm16
all_named zfight -n 1 -f 1.5 -F unorm16 --sample 100 --separation 0.01
all_named zfight -n 1 -f 1.5 -F unorm16 -m d3d --rasterize --sample 10
all_named shadow --light-box 9x9x9 --size 256 --rasterize
all_named prepass --against fma --sample 100
all_named prepass --prepass-format d16
all_named convert unorm10 fp32 unorm10
all_named convert unorm10 fp32 unorm10 --code 1,5
"$DEPTHPREC" judge --pairs-for 20 | awk 'NR > 1 { print $1 "," 1 / (20 - 10 * $1) }' >"$scratch/pairs.csv"
all_named judge --pairs "$scratch/pairs.csv" -n 0.05 -f 0.1
all_named code
all_named code -m log --what position
all_named scene tests/models/street.obj --separation 0.02 --eye 0,2,10 --look 0,0,0
all_named zfight -n 1 -f 1.5 -F unorm16 -m d3d --viewport 640x480
all_named scene tests/models/street.obj --separation 0.02 --viewport 640x480
all_named budget --at 10
all_named budget -m three-webgl --at 10
all_named budget --at 10 --viewport 640x480
all_named table --at 10 --viewport 640x480
all_named table --at 10 --constants -m gl
all_named table -m log --at 10 --viewport 640x480
worst=1 all_named check tests/needs/village.need
worst=1 all_named check tests/needs/slopes.need
cat >"$scratch/measured.need" <<END
cameras = { a = { near = 0.1; far = 9; mapping = "d3d"; format = "fp32"; arith = "$PWD/tests/profiles/lavapipe.json"; }; };
requirements = { r = { camera = "a"; at = 5; separation = 1; }; };
END
all_named check "$scratch/measured.need"
all_named solve -f 1000 -F unorm24 -m d3d --separation 0.01 --at 100
all_named solve -f 1000 -F unorm24 -m d3d --error 0.01 --at 100
all_named solve --for distance -n 0.1 -f 1000 -F unorm24 -m d3d --separation 0.01
all_named solve --for frusta -n 0.1 -f 1000 -F unorm24 -m d3d --separation 0.001
all_named solve --for distance -n 0.1 -f 1000 -F unorm24 -m d3d --separation 0.01 --viewport 640x480
all_named solve --for distance -n 0.1 -f 1000 -F fp16 -m reversed --separation 0.01
all_named table --at 10 --range 5:50
all_named table --depth 0.5
all_named bias -F unorm24 -m d3d --at 10 --remedy ray:0.1 --slope 0.1
all_named world
all_named world --from-origin 1km,1e6m
all_named budget --at 10 --from-origin 1e5 --scheme split
verdicts() { # verdicts COUNT COMMAND ARGUMENTS...: those that the text does not have, and how many there are if not COUNT
    count=$1
    shift
    "$DEPTHPREC" "$@" | tr -s ' \n' ' ' >"$scratch/text"
    "$DEPTHPREC" "$@" --json | jq -r '.. | objects | .verdict? // empty' >"$scratch/verdicts"
    while read -r verdict; do
        grep -qF -e "$verdict" "$scratch/text" || echo "$verdict"
    done <"$scratch/verdicts"
    [ "$(wc -l <"$scratch/verdicts")" -eq "$count" ] || echo "$(wc -l <"$scratch/verdicts") verdicts, not $count"
}
for words in '1 solve -f 1000 -F unorm24 -m d3d --separation 1cm --at 100m' '1 solve --for frusta -n 0.1 -f 1e6 -F d24 -m d3d --separation 1' \
    '2 zfight -n 1 -f 1.5 -F unorm16 -m d3d,reversed --sample 100 --separation 0.01' '1 zfight -n 1 -f 1.5 -F unorm16 -m d3d --rasterize --sample 10' \
    '2 prepass -F unorm16,fp32 -m d3d --sample 1000' '1 scene tests/models/street.obj --separation 0.02' '7 check tests/needs/village.need'; do
    check "JSON has the verdicts of the text: $words" empty verdicts $words
done
section probe | sort -u >"$scratch/known_probe"
profile_fields() { # what of a profile is not in the page, or that it is none
    jq -r '[.. | objects | keys[]] | unique[]' "$1" | sort -u >"$scratch/keys"
    "$DEPTHPREC" table --arith "$1" --json | grep -q '"measured"' && [ -s "$scratch/keys" ] || echo "no profile"
    comm -23 "$scratch/keys" "$scratch/known_probe"
}
for profile in tests/profiles/*.json; do
    check "depthprec.5: ${profile##*/}" empty profile_fields "$profile"
done
all_named solve --preset maplibre:height=800 --separation 1m
all_named bias --at 10 --units 1
all_named bias --range 1:10 --separation 0.01
all_named bias --at 10 --viewport 640x480
all_named bias --api all --at 10 --viewport 640x480
all_named bias --api all --at 10
all_named bias --api all --range 1:10
all_named shadow -f 50 --api all
all_named shadow --light-box 5x5x5 --range 1:4
all_named plot shadow
all_named methods worst --tolerance 0.1
all_named methods
all_named texture --synthetic decals --size 64x36
all_named texture --synthetic decals --size 64x36 --pixel 1,2
all_named texture --product effect:intersection --at 10
all_named texture --product effect:shadow --at 10
all_named texture --synthetic plane --size 64x36 --product effect:fog --pixel 1,2
"$DEPTHPREC" texture --synthetic plane --size 64x36 -F unorm16 -m d3d -o "$scratch/depth.npy"
all_named texture "$scratch/depth.npy"
"$DEPTHPREC" texture --synthetic plane --size 64x36 -F fp32 -m reversed --product eye -o "$scratch/metres.npy"
all_named texture "$scratch/metres.npy" --metric 1
all_named texture "$scratch/metres.npy" --stereo 700,0.1
all_named table --lattice kinect1
all_named texture --synthetic plane --product eye -o "$scratch/eye.png"
all_named texture --synthetic plane --product eye -o "$scratch/eye.png" --error-map="$scratch/map.png"
all_named texture --synthetic plane --size 64x36 --histogram "$scratch/histogram.svg"
"$DEPTHPREC" texture --synthetic plane --size 64x36 --product pack:rg -o "$scratch/packed.png"
all_named texture "$scratch/packed.png"
finish
