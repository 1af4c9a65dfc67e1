#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A model and a depth image with --platform: what is said is what is said with the options that the platform stands for.
. tests/tap.sh

model="scene tests/models/house.gltf --camera street --within 60 --unit m --viewport 960x540"

alike() { # alike PLATFORM OPTIONS -- COMMAND...: with --platform as with the options
    platform=$1 options=
    shift
    while [ "$1" != -- ]; do options="$options $1" && shift; done
    shift
    "$DEPTHPREC" "$@" --platform "$platform" | sed 's/ assumed$/ given/' >"$scratch/by_platform"
    "$DEPTHPREC" "$@" $options >"$scratch/by_options"
    [ -s "$scratch/by_platform" ] && diff "$scratch/by_platform" "$scratch/by_options"
}
refuses() { # refuses WORDS COMMAND...
    words=$1
    shift
    "$DEPTHPREC" "$@" >"$scratch/out" 2>"$scratch/said"
    [ $? -eq 2 ] && [ ! -s "$scratch/out" ] && cat "$scratch/said" && grep -qF -- "$words" "$scratch/said"
}
found() { # found FILE PLATFORM FORMAT: the format of the two that the image has
    "$DEPTHPREC" texture "$1" --platform "$2" >"$scratch/found" && cat "$scratch/found" && grep -q "^  format  *$3" "$scratch/found"
}

while IFS='|' read -r platform options; do
    platform=$(echo $platform)
    check "scene: $platform" alike "$platform" $options -- $model
    check "texture: $platform" alike "$platform" $(echo "$options" | sed 's/--arith.*//') -- texture --synthetic decals --size 160x90
done <<'END'
safari      | -F fp32 -m d3d --arith ieee --raster spec-vulkan --api webgpu
chrome-d3d  | -F fp32 -m d3d --arith ieee --raster spec-d3d --api webgpu
webgl-d3d   | -F unorm24 -m gl --arith ieee-remap --raster spec-d3d --api gl
webgl-metal | -F fp32 -m gl --arith ieee-remap --raster spec-vulkan --api gl
END

# What the browser does to the constant of a bias is counted: ANGLE on OpenGL halves it.
halved() {
    "$DEPTHPREC" $model --platform webgl-gl -F d24 | tr '\n' ' ' | tr -s ' ' >"$scratch/halved"
    "$DEPTHPREC" $model -F d24 -m gl --arith ieee --raster spec-gl --api gl | tr '\n' ' ' | tr -s ' ' >"$scratch/whole"
    units='s/.*glPolygonOffset([^,]*, \(-*[0-9]*\)).*/\1/'
    echo "$(sed "$units" "$scratch/halved") for $(sed "$units" "$scratch/whole")"
    whole=$((2 * $(sed "$units" "$scratch/whole"))) half=$(sed "$units" "$scratch/halved") # both whole numbers, away from 0
    [ "$half" -eq $whole ] || [ "$half" -eq $((whole + 1)) ]
}
check "scene: a bias that the browser halves is doubled" halved

either="stores unorm24 or fp32 on firefox-vulkan, as the device has it: -F says for which"
check "scene: of two formats one is asked for" refuses "$either" $model --platform firefox-vulkan
check "texture: so it is" refuses "$either" texture --synthetic decals --platform firefox-vulkan
# The constant is that of the API below WebGPU, where one unit tells two depths apart by definition.
named() {
    "$DEPTHPREC" $model --platform firefox-vulkan -F d24 | sed 's/depthBias:/depthBiasConstantFactor =/' >"$scratch/by_platform"
    "$DEPTHPREC" $model -F d24 -m d3d --raster spec-vulkan --api vulkan >"$scratch/by_options"
    for by in platform options; do
        tr '\n' ' ' <"$scratch/by_$by" | tr -s ' ' | sed 's/, *depthBiasSlope[^;]*;/;/' >"$scratch/line_$by"
    done
    diff "$scratch/line_platform" "$scratch/line_options"
}
check "scene: one of them" named
"$DEPTHPREC" texture --synthetic decals -F fp32 -m reversed --product raw -o "$scratch/told.npy" >"$scratch/out" 2>&1
"$DEPTHPREC" texture --synthetic decals -F unorm24 -m d3d --product raw -o "$scratch/open.npy" >"$scratch/out" 2>&1
check "texture: of two formats an image has one" found "$scratch/told.npy" firefox-vulkan fp32
check "texture: where an image does not tell, one is asked for" refuses "$either" texture "$scratch/open.npy" --platform firefox-vulkan

# ---- What a rasterizer brings ------------------------------------------------------------------------------------

# Every command that takes --raster counts with the arithmetic that 'depthprec list arithmetic' has beside its name, says
# so, and does not where another one is given. The camera is one whose signed NDC tells two arithmetics apart.
bent="-F fp32 -m gl-reversed -n 0.333 -f inf --viewport 3047x492 --fov 87.12"
counts() { # counts WORD ARITH OTHER COMMAND...: WORD is the option, a rasterizer or a profile of one
    option=$1 own=$2 other=$3
    shift 3
    "$DEPTHPREC" "$@" $option >"$scratch/alone" && "$DEPTHPREC" "$@" $option --arith "$own" >"$scratch/spelled" &&
        "$DEPTHPREC" "$@" $option --arith "$other" >"$scratch/otherwise" || return
    tr '\n' ' ' <"$scratch/alone" | tr -s ' ' | grep -Eq ", (arithmetic )?$own\>" || return
    diff "$scratch/alone" "$scratch/spelled" && ! cmp -s "$scratch/alone" "$scratch/otherwise"
}
while IFS='|' read -r command; do
    for raster in llvmpipe tests/profiles/lavapipe.json; do
        check "$raster brings mesa: $(echo ${command%% -*})" counts "--raster $raster" mesa ieee $command
    done
done <<END
table $bent --at 447
budget $bent --at 447
bias $bent --api vulkan-float --triangle-class depth=2,pixels=14,slim=16 --at 447
zfight $bent --range 447:449
solve --for distance $bent --separation 1
scene tests/models/house.gltf $bent
shadow --light-box 40x40x200 -F fp32
END
check "softpipe brings its own" counts "--raster softpipe" softpipe ieee budget -F fp32 -m d3d --viewport 640x480 --at 10
# A profile brings its own, not that of the rasterizer's row.
sed 's/"arith":"mesa"/"arith":"softpipe"/' tests/profiles/lavapipe.json >"$scratch/other.json"
check "a profile brings its own" counts "--raster $scratch/other.json" softpipe mesa budget -F fp32 -m d3d --viewport 640x480 --at 10
# Where two presets are compared each has its view, and all the one rasterizer.
compared() {
    "$DEPTHPREC" table --preset unity,godot-forward --viewport 640x480 --raster llvmpipe --at 10 >"$scratch/alone" &&
        "$DEPTHPREC" table --preset unity,godot-forward --viewport 640x480 --raster llvmpipe --arith mesa --at 10 |
        diff "$scratch/alone" -
}
check "so it is of two presets" compared
# The curves of a figure, and the requirements of a file.
drawn() {
    "$DEPTHPREC" plot interval $bent --model float --raster llvmpipe --csv >"$scratch/alone" &&
        "$DEPTHPREC" plot interval $bent --model float --raster llvmpipe --arith mesa --csv | grep -v '^#' >"$scratch/spelled" &&
        grep -v '^#' "$scratch/alone" | diff - "$scratch/spelled"
}
check "figures" drawn
needed() { # needed KEYS: the separations that check finds
    cat >"$scratch/bent.need" <<END
cameras = { a = { near = 0.333; far = "inf"; mapping = "gl-reversed"; format = "fp32"; viewport = [3047, 492]; fov = 87.12; $1 }; };
requirements = { r = { camera = "a"; at = 447.5; separation = 1; }; };
END
    "$DEPTHPREC" check "$scratch/bent.need" --json | jq -c '[.. | .value? // empty]'
}
alike_needs() {
    other=$(needed 'raster = "llvmpipe"; arith = "ieee";')
    for keys in 'raster = "llvmpipe";' 'raster = "llvmpipe"; arith = "mesa";' "raster = \"$PWD/tests/profiles/llvmpipe.json\";"; do
        [ "${first=$(needed "$keys")}" = "$(needed "$keys")" ] && [ "$first" != "$other" ] || return
    done
    echo "$first, with ieee $other"
}
check "requirement files" alike_needs

# ---- What the users of an engine write ---------------------------------------------------------------------------

# With a preset the bias is written as its users write it, by bias and scene alike, unless --api names another.
writes() { # writes PRESET WORDS
    "$DEPTHPREC" bias --preset "$1" --at 10 >"$scratch/bias" && grep -F "$2" "$scratch/bias" || return
    "$DEPTHPREC" scene tests/models/street.obj --preset "$1" --unit m -m d3d -n 1 -f 500 -F d24 --viewport 960x540 --separation 0.02 >"$scratch/scene"
    tr '\n' ' ' <"$scratch/scene" | tr -s ' ' | grep -F "drawn second: $2" || return
    "$DEPTHPREC" bias --preset "$1" --at 10 --api d3d9 | grep -F D3DRS_DEPTHBIAS
}
while IFS='|' read -r preset words; do
    check "a bias of $preset" writes $preset "$words"
done <<'END'
three|polygonOffsetFactor =
three-webgpu|depthBias:
cesium|glPolygonOffset(
unity|D3D11_RASTERIZER_DESC.DepthBias =
godot-forward|depthBiasConstantFactor =
bevy|depthBias:
END
finish
