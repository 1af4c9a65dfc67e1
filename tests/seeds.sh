#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What articles on depth textures of Unity say, item by item: the program shows it, and its numbers agree with formulas
# that awk computes. The README.md of this folder names the tests that hold the same more closely.
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
            split(\"\", want)
            $formulas
            for (c in want) {
                seen++
                if (!close_to(a[c] + 0, want[c], want[c] * 1e-6 + least) && bad++ < 9) print c, a[c], want[c]
            }
        }
        END { exit bad > 0 || !seen }"
}

# ---- The words of articles ----

mkdir "$scratch/work"
depthprec list words | grep '^[^ ]' >"$scratch/words"
runs() { # runs COMMAND: as it stands there, one after the other in a folder
    # Words without quotes or patterns.
    # shellcheck disable=SC2086
    (cd "$scratch/work" && depthprec $1 </dev/null)
}
while read -r word; do
    depthprec help "$word" | sed -n 's/^  depthprec //p' >"$scratch/commands"
    while read -r command; do
        check "$word: depthprec $command" runs "$command"
    done <"$scratch/commands"
    check "$word has a command" test -s "$scratch/commands"
done <"$scratch/words"
check "there are words" [ "$(wc -l <"$scratch/words")" -ge 45 ]
# Those of the articles, however they are written there: a member, a call, a file, two words, with blanks or hyphens.
while read -r word; do
    # shellcheck disable=SC2086
    check "help $word: four lines at most" sh -c '"$1" help $2 >"$3" && [ "$(wc -l <"$3")" -le 4 ] && grep -q "^  depthprec " "$3"' - \
        "$DEPTHPREC" "$word" "$scratch/entry"
done <<EOF
LinearEyeDepth
LinearEyeDepth()
COMPUTE_EYEDEPTH
LinearViewDepth
LinearizeDepth
Linear01Depth
Linear01DepthFromNear
LinearDepthToEyeDepth
_ZBufferParams
_ZBufferParams.z
_ProjectionParams
_ProjectionParams.w
_ProjectionParams2.x
_CameraViewTopLeftCorner
_CameraViewXExtent
_CameraViewYExtent
_CameraViewZExtent
UNITY_NEAR_CLIP_VALUE
UNITY_REVERSED_Z
_CameraDepthTexture
SampleSceneDepth
LoadSceneDepth
SAMPLE_DEPTH_TEXTURE
SAMPLE_DEPTH_TEXTURE_PROJ
SAMPLE_DEPTH_TEXTURE_LOD
UNITY_SAMPLE_DEPTH
UNITY_PROJ_COORD
ComputeScreenPos
_ScaledScreenParams
_SourceSize.zw
positionCS.z
depthTextureMode
DepthOnly
SampleDepth
CheckBounds
_CameraDepthNormalsTexture
DepthNormals
EncodeDepthNormal
DecodeDepthNormal
Internal-DepthNormalsTexture.shader
EncodeViewNormalStereo
DecodeViewNormalStereo
kScale
EncodeFloatRG
DecodeFloatRG
_CameraNormalsTexture
SampleSceneNormals
PackNormalOctRectEncode
normalWS
half3
frustumDir
interpolatedRay
_FrustumCornersRay
UNITY_MATRIX_I_VP
_CurrentInverseVP
_LastVP
ComputeWorldSpacePosition
NonLinearDepth
ScreenSpaceShadowMap
ShadowCaster
SSAO
ambient occlusion
ambient-occlusion
ray marching
raymarching
soft particles
soft-particles
radial fog
height fog
Hi-Z
W-buffer
reversed-z
Reversed Z
ReconstructNormal
_SOURCE_DEPTH_LOW
_SOURCE_DEPTH_MEDIUM
_SOURCE_DEPTH_HIGH
ReconstructViewPos
_FogColor
VerticalFog
ScanLine
_LineColor
WaterLine
WaterFlooded
ForceField
_MainColor
IntersectionHighlight
_IntersectionColor
EdgeDetection
DepthOfField
_BlurTex
MotionBlur
Translucency
_CurValue
EOF
check "of the glossary, each" sh -c 'sed -n "/^\.Sh GLOSSARY/,/^\.El/s/^\.It //p" man/depthprec.7 | while read -r term; do
    "$1" help ${term%%,*} >/dev/null || exit 1; done' - "$DEPTHPREC"
unknown() { # unknown WORD ANSWER
    ! depthprec help "$1" 2>"$scratch/errors" && [ "$(wc -l <"$scratch/errors")" -eq 1 ] && grep -q -e "$2" "$scratch/errors"
}
check "of the topics of list, each" sh -c '"$1" list | sed -n "s/^  \([a-z][a-z-]*\) .*/\1/p" >"$2" && [ "$(wc -l <"$2")" -ge 15 ] &&
    while read -r topic; do "$1" help "$topic" >/dev/null || exit 1; done <"$2"' - "$DEPTHPREC" "$scratch/topics"
check "list finds a function's packing beside its word" says "packings: rg" depthprec list EncodeFloatRG
check "a word that is nearly known" unknown Linear01Dept "nothing is called 'Linear01Dept'; did you mean .*'Linear01Depth'"
check "three that are near" unknown LinearEyeDept "did you mean '[^']*', '[^']*' or '[^']*'?\$"
check "one that is not" unknown xyzzyq "'depthprec help' lists the commands, 'depthprec list words' the words"

# ---- Constants, and what articles say of them that is wrong ----

# of FORMULAS ARGUMENT...: what table --constants says of a camera of near .3 and a depth z of 10, in the first set-up:
# assignments to want["key"], with the camera's n and f and the window depth d; "reads NAME" is what a trap reads
of() {
    formulas=$1
    shift
    depthprec table --constants -n .3 --at 10 --json "$@" >"$scratch/constants" || return 1
    tr ',' '\n' <"$scratch/constants" | awk "
        /^\"[a-z_]*\":[{]/ { parent = \$0; gsub(/^\"|\":.*/, \"\", parent); parent = parent \".\"; sub(/^[^{]*/, \"\") }
        {
            text = \$0
            gsub(/[][{}]/, \"\", text)
            key = value = text
            gsub(/^\"|\":.*/, \"\", key)
            sub(/^\"[^\"]*\":/, \"\", value)
            gsub(/\"/, \"\", value)
            if (key == \"name\") named = value
            if (key == \"reads\") key = \"reads \" named
            if (key == \"x\" && parent == \"\") key = named \" x\"
            if (!(parent key in a)) a[parent key] = value
            if (/}/) parent = \"\"
        }
        END {
            n = 0.3; f = 1000; z = 10
            d = f / (f - n) * (1 - n / z)
            $formulas
            for (k in want) {
                seen++
                off = a[k] - want[k]
                if (!(k in a) || off * off > 1e-10 * want[k] * want[k]) { print k, a[k], want[k]; bad++ }
            }
            exit bad > 0 || !seen
        }"
}
check "_ZBufferParams, d3d" of 'want["zbuffer_params.x"] = 1 - f / n; want["zbuffer_params.y"] = f / n
    want["zbuffer_params.z"] = (1 - f / n) / f; want["zbuffer_params.w"] = 1 / n' -m d3d
check "_ZBufferParams, reversed" of 'want["zbuffer_params.x"] = f / n - 1; want["zbuffer_params.y"] = 1
    want["zbuffer_params.z"] = (f / n - 1) / f; want["zbuffer_params.w"] = 1 / f' -m reversed
check "_ZBufferParams of an infinite far plane" of 'want["zbuffer_params.z"] = 1 / n; want["zbuffer_params.w"] = 0' \
    -m reversed -f inf
check "_ProjectionParams" of 'want["projection_params.y"] = n; want["projection_params.z"] = f
    want["projection_params.w"] = 1 / f' -m d3d
check "UNITY_NEAR_CLIP_VALUE: 0, reversed 1, OpenGL -1" of 'want["near_clip_value"] = 0' -m d3d
check "UNITY_NEAR_CLIP_VALUE, reversed" of 'want["near_clip_value"] = 1' -m reversed
check "UNITY_NEAR_CLIP_VALUE, OpenGL" of 'want["near_clip_value"] = -1' -m gl
check "clip z and w, NDC, window and eye depth, both Linear01" of 'want["clip_z"] = d * z; want["clip_w"] = z
    want["ndc"] = want["window"] = d; want["eye"] = z; want["linear01"] = z / f; want["from_near"] = (z - n) / (f - n)' -m d3d
check "NDC of OpenGL" of 'want["clip_z"] = (2 * d - 1) * z; want["ndc"] = 2 * d - 1; want["window"] = d' -m gl
check "corner vectors and rays" of 'top = sin(0.5235987755982988) / cos(0.5235987755982988)
    want["to_top"] = n * top; want["to_right"] = n * top * 16 / 9; want["top left x"] = -top * 16 / 9' -m d3d
corners() { # the four vectors from the camera to the near plane's corners, as articles add them up
    depthprec table --constants -n .3 --at 10 -m d3d --fov 60 | sed -n 's/.* \(top\|bottom\) \(left\|right\) (\(.*\), \(.*\), \(.*\))/\1 \2 \3 \4 \5/p' |
        awk '{ top = 0.3 * sin(atan2(1, 1) * 2 / 3) / cos(atan2(1, 1) * 2 / 3); right = top * 16 / 9
            x = $3 * ($2 == "left" ? -1 : 1) / right; y = $4 * ($1 == "bottom" ? -1 : 1) / top
            if (x < 0.99999 || x > 1.00001 || y < 0.99999 || y > 1.00001 || $5 != 0.3) { print; bad = 1 } }
            END { exit bad || NR != 4 }'
}
check "the four corner vectors" corners
last() { # LinearEyeDepth of the last binary32 number below 1, which is not printed as 1
    depthprec table --constants -n .3 --at 1000 -m d3d | awk '
        $1 == 1000 && NF == 8 { seen = 1; bad = !($4 < 1 && $5 < 1 && $5 > 0.9999998 && $6 == 999.834) }
        END { exit bad || !seen }'
}
check "a depth of 1 - 2^-24 is not printed as 1" last
check "trap: x is no 1 - near/far" of 'want["reads inverted-x"] = 1 / (((1 - n / f) * d + f / n) / f)' -m d3d
check "trap: f n, not 2 f n" of 'want["reads doubled-product"] = 2 * z' -m d3d
check "trap: lerp(-1, 1, d) is no depth of Linear01Depth" of '
    want["reads ndc-as-depth"] = 1 / ((1 / f - 1 / n) * (2 * d - 1) + 1 / n)' -m gl
check "trap: reversed mixed up" of 'want["reads other-direction"] = 1 / ((1 / f - 1 / n) * (1 - d) + 1 / n)' -m d3d
check "trap: LinearEyeDepth of an orthographic depth" of '
    want["reads perspective-of-ortho"] = 1 / ((1 / f - 1 / n) * (z - n) / (f - n) + 1 / n)' -m d3d --ortho
check "trap: LinearEyeDepth of an oblique near plane" says perspective-of-oblique depthprec list traps
check "trap: near gives 1, far 0" of 'want["reads near-is-one"] = 1 / ((1 / n - 1 / f) * d + 1 / f)' -m d3d
check "trap: 4 bits" of 'want["reads four-bits"] = 1 / (1 / n + (1 / f - 1 / n) * int(15 * d + 0.5) / 15)' -m d3d
check "trap: from near shrinks by far - near" of 'want["reads shrunk-by-far"] = n + f * (z - n) / (f - n)' -m d3d
# EncodeViewNormalStereo of sqrt(3)/2 (sin 45, cos 45), read back: 2 atan(x/(1 + z)) in place of 45.
turned() {
    depthprec list traps | tr -s ' \n' '  ' | sed -n 's/.*a normal turned by \([^ ]*\) degrees, 45 off.*/\1/p' | awk '
        { side = sqrt(3) / 2 * sqrt(0.5); off = 45 - 2 * atan2(side, 1 + side) * 45 / atan2(1, 1) - $1 }
        END { exit NR != 1 || off * off > 0.005 ^ 2 }'
}
check "trap: an interpolated normal that nobody normalizes" turned
doubled() { # as window depth and read back; eye depths from near to far
    awk -v back=$1 'BEGIN { n = 0.3; f = 1000; OFMT = CONVFMT = "%.9g"
        for (i = 0; i <= 20; i++) {
            z = n * exp(i / 20 * log(f / n))
            print back ? f / (f - n) * (1 - n / z) " " 2 * z : z " " f / (f - n) - 2 * f * n / ((f - n) * z)
        }
    }' >"$scratch/pairs"
    says 'doubled-product, as' depthprec judge --pairs "$scratch/pairs" -n 0.3 -f 1000 -m d3d
}
check "trap: judge names a doubled product" doubled 0
check "trap: and where it is read back" doubled 1
check "trap: the normal is in xy, depth in zw" says normal-as-depth depthprec list traps

# ---- Textures ----

# A census of all depths of binary32 finds 327,950 codes there, and a few are between depths.
check "reversed depth whose NDC is of [-1, 1] keeps 1.3 % of its codes beyond 10" rows '
    least = 0.02
    if (a["z"] == 10) want["fp32 gl-reversed"] = 100 * 327950 / 25165824' \
    depthprec plot share -F fp32 -m reversed,gl-reversed --range 10:1000 --model float
cleared() { # a target that was cleared to black is sky, or holes
    depthprec texture --synthetic plane --size 16x16 --product pack:depth-normals -o "$scratch/dn.npy" -q || return 1
    { head -c 128 "$scratch/dn.npy" && head -c 1024 /dev/zero; } >"$scratch/black.npy"
    says "sky 256 pixels, 100 %" depthprec texture "$scratch/black.npy" --packing depth-normals &&
        says "256 pixels hold 0, a clear to black or the far plane after frac" \
            depthprec texture "$scratch/black.npy" --packing depth-normals
}
check "DepthNormals cleared to black" cleared
no_normal() { # --sky or not
    for sky in 0.0001 none; do
        depthprec texture "$scratch/black.npy" --packing depth-normals --product packed-normal --sky $sky -q -o "$scratch/n.npy" || return 1
        od -An -v -tf4 -w12 -j128 "$scratch/n.npy" | awk '$1 == $1 + 0 && $1 !~ /nan/ { bad = 1 } END { exit bad || NR != 256 }' || return 1
    done
}
check "a cleared pixel of DepthNormals has no normal" no_normal
# d of z in [0, 1]: Linear01 of .99999 is 1 - d = n (f - z)/((f - n) z).
check "CheckBounds: Linear01 of .99999 is far" says "are within 3e-09 of far" \
    depthprec texture --synthetic plane -n .3 -f 1000 -F d32f -m d3d --sky 3e-9
radial() { # fog by distance: at the corner of a wall at 30, sqrt(x^2 + y^2 + z^2)/far
    depthprec texture --synthetic plane --parameter distance=30 -n .3 -f 60 --fov 90 --size 8x8 -F d32f -m d3d \
        --product effect:radial-fog --parameter density=1.1 -o "$scratch/fog.npy" -q || return 1
    od -An -v -tf4 -w4 -j128 "$scratch/fog.npy" | awk '
        { x = (NR - 1) % 8 / 4 - 0.875; y = int((NR - 1) / 8) / 4 - 0.875; want = 1.1 * 30 * sqrt(1 + x * x + y * y) / 60; off = $1 - want }
        off * off > 1e-10 { print $1, want; bad = 1 }
        END { exit bad || NR != 64 }'
}
check "radial fog" radial
at_far() { # at far the channels are 255, 0 and not the 0, 0 of frac, which is said
    says "EncodeFloatRG writes 0, 0" depthprec texture --synthetic plane --parameter distance=1000 --size 4x1 -F fp32 \
        --product pack:rg -o "$scratch/far.npy" && od -An -v -tu1 -w2 -j128 "$scratch/far.npy" | awk '
        $1 != 255 || $2 != 0 { bad = 1 } END { exit bad || NR != 4 }'
}
check "EncodeFloatRG of the far plane" at_far
grey() { # five walls at equal distances: window depth is above .97 from the second on, Linear01 even
    for product in raw linear01; do
        depthprec texture --synthetic steps --parameter even=1,count=5,to=17 -n .3 -f 20 --size 5x1 \
            -F d24 -m d3d --product $product -o "$scratch/$product.npy" -q || return 1
        od -An -v -tf4 -w4 -j128 "$scratch/$product.npy" | awk -v product=$product '
            { z = 1 + 4 * (NR - 1); want = product == "raw" ? 20 / 19.7 * (1 - 0.3 / z) : z / 20; off = $1 - want }
            off * off > 4e-12 || (product == "raw" && NR > 1 && $1 < 0.95) { print $1, want; bad = 1 }
            END { exit bad || NR != 5 }' || return 1
    done
}
check "raw is nearly white, Linear01 even" grey
check "_CurValue and _FocusDistance are the second depth of their effects" says "second depth of an effect" depthprec help _CurValue
check "medium normals take the sky" says "sky at far before all others" depthprec list normals

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

# NDC z is linear on the screen, z is not: between vertices at z/2 and 2 z it is (k - 1)^2/k z too far, k = 2.
per_vertex() {
    depthprec table -F d16 -m linear --viewport 1920x1080 --at 10 --json | tr ',' '\n' | sed -n 's/^"per_vertex":\([0-9.]*\).*/\1/p' |
        awk '{ most = $1 } END { exit !(most > 5 && most < 5.001) }'
}
check "W-buffer: depth by vertex is wrong between them" per_vertex

# ---- Depths ----

check "NDC z, window depth: one metre near and far" rows '
    n = 0.3; f = 1000; least = 1e-7
    want["depth"] = f / (f - n) * (1 - n / a["z"])
    if (a["z"] == 3) bad += (a["depth"] - last - 0.05) ^ 2 > 1e-8
    if (a["z"] == 201) bad += (a["depth"] - last - 7.465e-6) ^ 2 > 1e-14
    last = a["depth"]' depthprec table -n .3 -f 1000 -m d3d -F fp32 --at 2,3,200,201
check "orthographic depth is linear, and read so" rows '
    want["depth"] = (a["z"] - 0.3) / 999.7; least = 1e-7' depthprec table -n .3 -f 1000 -m d3d -F fp32 --ortho --at 1,10,100,999
check "a reversed depth of 0.0001 is 750, and not sky" rows '
    want["z"] = 0.3 * 1000 / (0.3 + 0.0001 * 999.7)' depthprec table -n .3 -f 1000 -m reversed -F fp32 --depth 0.0001
named() { # named NAME FORMULA ARGUMENT...: what judge calls the function of d whose values awk computes
    name=$1 formula=$2
    shift 2
    awk "BEGIN { n = 0.3; f = 1000; OFMT = CONVFMT = \"%.9g\"
        for (i = 0; i <= 20; i++) { d = i / 20; z = n * f / (f - d * (f - n)); print d \" \" $formula } }" >"$scratch/named"
    says "called $name of Unity" depthprec judge --pairs "$scratch/named" -n .3 -f 1000 -m d3d "$@"
}
check "judge names LinearDepthToEyeDepth" named LinearDepthToEyeDepth 'n + d * (f - n)' --ortho
check "judge names LinearEyeDepth over far" named Linear01Depth 'z / f'
check "judge names Linear01DepthFromNear" named Linear01DepthFromNear '(z - n) / (f - n)'

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

# ---- Places, normals and effects, whose numbers awk computes ----

walls() { # walls ARGUMENT...: five walls at 1, 5, 9, 13 and 17, two pixels high each, of a camera of near .3 and far 20; a number a line
    depthprec texture --synthetic steps --parameter even=1,count=5,to=17 -n .3 -f 20 --size 5x2 -F fp32 -m d3d "$@" \
        -o "$scratch/walls.npy" -q && od -An -v -tf4 -w4 -j128 "$scratch/walls.npy" >"$scratch/walls"
}
each() { # each N FORMULA: N numbers a pixel; want[0], want[1], ... of column, row (0 is the upper) and depth z
    awk -v each="$1" "function saturate(x) { return x < 0 ? 0 : x > 1 ? 1 : x } function abs(x) { return x < 0 ? -x : x }
        { at = int((NR - 1) / each); k = (NR - 1) % each; column = at % 5; row = int(at / 5); z = 1 + 4 * column
          tangent = sin(atan2(0, -1) / 6) / cos(atan2(0, -1) / 6); aspect = 2.5; u = (2 * column - 4) / 5; v = (1 - 2 * row) / 2
          $2
          if (abs(\$1 - want[k]) > 1e-5 * (1 + abs(want[k]))) { print NR, \$1, want[k]; bad = 1 } }
        END { exit bad || NR != 10 * each }" "$scratch/walls"
}
# The picture is 2.5 times as wide as high; x n/z is the place on the near plane. The upper row is that of y > 0.
places() { # places METHOD ARGUMENT...
    method=$1
    shift
    walls --product "position:$method" "$@" && each 3 'want[0] = u * tangent * aspect * z; want[1] = v * tangent * z; want[2] = z'
}
check "places by the inverse view-projection" places matrix
check "places by rays through the corners" places rays
check "places by the top left corner and the extents" places extents
straight() { walls --product position:extents --ortho=5 && each 3 'want[0] = u * 5 * aspect; want[1] = v * 5; want[2] = z'; }
check "places of an orthographic camera" straight
half() { # what half3 returns has 11 bits, and no fewer: the places of binary32 have more
    walls --product position:extents-half && awk '
        { x = $1 < 0 ? -$1 : $1; if (x == 0) next; while (x < 1024) x *= 2; while (x >= 2048) x /= 2; if ((x - int(x + 0.5)) ^ 2 > 1e-8) { print; bad = 1 } }
        END { exit bad || NR != 30 }' "$scratch/walls"
}
check "places that half3 returns" half
image_effect() { # image_effect NAME PARAMETERS FORMULA
    walls --product "effect:$1" --parameter "$2" && each 1 "want[0] = $3"
}
check "intersection highlight" image_effect intersection reference=6,half-width=5 'saturate(abs(6 - z) / 5)'
check "force field" image_effect force-field reference=6,power=.2,facing=.75,rim-power=.5 \
    '(1 - (z - 6)) * .2 > 1 - .75 * .5 ? (1 - (z - 6)) * .2 : 1 - .75 * .5'
check "global fog" image_effect fog density=1.5 'saturate(z / 20 * 1.5)'
check "scan line" image_effect scan-line reference01=.3,half-width=.4 'saturate(abs(.3 - z / 20) / .4)'
check "flooding" image_effect water-line level=2 '(v * tangent * z < 2)'
check "vertical fog" image_effect height-fog start=-5,end=5,density=1.2 'saturate((v * tangent * z + 5) / 10 * 1.2)'
check "a soft particle" image_effect soft-particles reference=4,fade-distance=6 'saturate((z - 4) / 6)'
bands() { # z^2 (f - n)/(n f 2^24), a step of depth, is .5/255, half-width .5 over the levels of 8 bits; then half a step is
    depthprec texture --product effect:intersection -F d24 -m d3d -n .1 -f 1000 --parameter half-width=.5 |
        sed -n 's/^Up to z = \([0-9.]*\).*/\1/p' | awk '
        { n = 0.1; f = 1000; z = sqrt(NR * 0.5 / 255 * n * f / (f - n) * 16777216); bad += $1 < 0.999 * z || $1 > 1.001 * z }
        END { exit bad || NR != 2 }'
}
check "from where on an intersection highlight shows bands" bands
# Five walls that face the camera, seven pixels wide. low is wrong in the quads of 2 x 2 pixels in which an edge lies, after 7
# and 21 columns; medium, which takes the farther of the pixels two apart, in the two columns before each edge; high nowhere.
wrong() { # wrong METHOD COLUMNS: where its normals turn, from 0
    depthprec texture --synthetic steps --parameter even=1,count=5,to=17 -n .3 -f 20 --size 35x20 -F fp32 -m d3d \
        --product "normal:$1" -o "$scratch/normals.npy" -q || return 1
    od -An -v -tf4 -w12 -j128 "$scratch/normals.npy" |
        awk '$3 * $3 < 0.9998 { wrong[(NR - 1) % 35]++ } END { for (i = 0; i < 35; i++) if (wrong[i]) printf "%d ", i }' >"$scratch/columns"
    cat "$scratch/columns"
    [ "$(cat "$scratch/columns")" = "$2" ]
}
check "low is wrong in the quads of an edge" wrong low "6 7 20 21 "
check "medium looks at pixels two apart" wrong medium "5 6 12 13 19 20 26 27 "
check "high is right at edges" wrong high ""
# At the outline of a sphere the mean error falls from each to the next.
outline() {
    depthprec plot normals --csv >"$scratch/csv" && tr -d '\r' <"$scratch/csv" | awk -F, '
        /sphere/ { low += $3; medium += $4; high += $5; n++ } END { exit !(n > 9 && low > 2 * medium && medium > 2 * high) }'
}
check "at an outline medium is better than low, and high than medium" outline
timed() { # timed FAMILY METHOD...: each has a time, which no test judges, and an error
    depthprec methods "$1" --full --json >"$scratch/timed" || return 1
    shift
    for method; do
        tr '{' '\n' <"$scratch/timed" | grep -qE "^\"name\":\"$method\",\"ns\":[0-9.e+-]+,.*\"relative\":[0-9.e+-]+," || return 1
    done
}
check "what low, medium and high cost" timed normal low medium high
check "what rays and the matrix cost" timed position rays matrix
codes() { # rounded to 65535 and 16777215 steps
    rows 'n = 0.3; f = 1000; steps = a["format"] == "unorm16" ? 65535 : 16777215
        want["code"] = int(steps * f / (f - n) * (1 - n / a["z"]) + 0.5)' depthprec table -n .3 -f 1000 -m d3d -F d16,d24 --at 1,10,100,500
}
check "codes of 16 and of 24 bits" codes
check "orthographic NDC and window depth" of 'want["ndc"] = want["window"] = (z - n) / (f - n); want["eye"] = z' -m d3d --ortho
check "orthographic, reversed" of 'want["ndc"] = want["window"] = (f - z) / (f - n); want["eye"] = z' -m reversed --ortho
check "orthographic NDC of OpenGL" of 'want["ndc"] = 2 * (z - n) / (f - n) - 1; want["window"] = (z - n) / (f - n)' -m gl --ortho
packed() { # the depths of walls, and the normal of a plane that tilts by 30 degrees, n/(n.z + 1)/1.7777
    walls --product pack:depth-normals && od -An -v -tu1 -w4 -j128 "$scratch/walls.npy" | awk '
        { z = (1 + 4 * ((NR - 1) % 5)) / 20; k = int(255 * z); code = 255 * k + int(255 * (255 * z - k) + 0.5)
          if ((255 * $3 + $4 - code) ^ 2 > 1) { print; bad = 1 } } END { exit bad || NR != 10 }' &&
        depthprec texture --synthetic plane --parameter tilt=30 --size 2x2 -F fp32 -m d3d --product pack:depth-normals \
            -o "$scratch/tilted.npy" -q && od -An -v -tu1 -w4 -j128 "$scratch/tilted.npy" | awk '
        { up = int(255 * (0.5 + 0.5 * 0.5 / (1 + sqrt(0.75)) / 1.7777) + 0.5); if ($1 != 128 || $2 != up) { print $2, up; bad = 1 } }
        END { exit bad || NR != 4 }'
}
check "EncodeDepthNormal: EncodeViewNormalStereo in xy, EncodeFloatRG in zw" packed
unpacked() { # read back: 2 p/(1 + p p), of which a byte leaves 1.13 degrees
    depthprec texture "$scratch/tilted.npy" --packing depth-normals --product packed-normal -o "$scratch/read.npy" -q &&
        od -An -v -tf4 -w12 -j128 "$scratch/read.npy" | awk '
        { x = (2 * 128 / 255 - 1) * 1.7777; y = (2 * 147 / 255 - 1) * 1.7777; g = 2 / (1 + x * x + y * y)
          if (($1 - g * x) ^ 2 + ($2 - g * y) ^ 2 + ($3 * $3 - (g - 1) ^ 2) ^ 2 > 1e-11) { print; bad = 1 } } END { exit bad || NR != 4 }'
}
check "DecodeViewNormalStereo" unpacked

# ---- All of them ----

shown() { # each statement of the articles has its test: a word or a check of this file, or a test of a program
    while IFS='|' read -r statement file name; do
        case $file in
        seeds.sh) grep -qxF -e "$name" tests/seeds.sh || grep -qF -e "check \"$name\"" tests/seeds.sh ;;
        *) grep -q "^TEST($name)" "tests/$file" ;;
        esac || { echo "$statement: no '$name' in tests/$file" && return 1; }
    done <tests/seeds.txt
}
check "each statement has its test" shown
check "99 statements, each once" [ "$(cut -d '|' -f 1 tests/seeds.txt | sort -u | wc -l)" -eq 99 ]

finish
