#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The questions of depthprec-questions.7: each command stands there and works as typed, and the number in its answer agrees
# with a formula that awk computes. Then the words of the text: those that the glossary of depthprec.7 replaced are gone.
. tests/tap.sh

mkdir "$scratch/bin" "$scratch/work"
ln -s "$DEPTHPREC" "$scratch/bin/depthprec"
PATH=$scratch/bin:$PATH
unset NO_COLOR LANGUAGE LANG POSIXLY_CORRECT
export TERM=dumb

# ---- The files that the questions are about ----

depthprec texture --synthetic plane --size 64x36 -F d24 -m d3d --product eye --as even:0.001 -o "$scratch/work/mm.png" -q
depthprec texture --synthetic plane --size 64x36 -F d24 -m d3d --product pack:rgb24 -o "$scratch/work/rgb.png" -q
cp tests/models/house.gltf "$scratch/work"
cat >"$scratch/work/game.need" <<'END'
unit = "m";
cameras = { game = { near = 0.1; far = 1000; mapping = "d3d"; format = "d24"; }; };
requirements = { walls = { camera = "game"; at = "50 m"; separation = "1 mm"; }; };
END

: >"$scratch/answered"

# The commands of `help questions`, of which the page is made; those that go on in the next line put together.
depthprec help questions >"$scratch/questions"
sed -e ':more' -e '/ \\$/{' -e 'N' -e 's/ *\\\n */ /' -e 'b more' -e '}' -e 's/^  //' "$scratch/questions" >"$scratch/commands"

answers() { # answers STATUS COMMAND WORDS: the page has the command, which exits so and prints a line with these words
    grep -qxF -e "$2" "$scratch/commands" || { echo "not in depthprec-questions.7: $2" && return 1; }
    (cd "$scratch/work" && sh -c "$2" >"$scratch/answer" 2>"$scratch/errors" </dev/null)
    status=$?
    cat "$scratch/errors" "$scratch/answer"
    [ $status -eq "$1" ] && { [ -z "$3" ] || grep -qF -e "$3" "$scratch/answer"; } && echo "$2" >>"$scratch/answered"
}

agrees() { # agrees PATTERN LEAST MOST: the number behind the pattern in the answer lies between two formulas of awk
    tr -s ' \n' '  ' <"$scratch/answer" | awk -v pattern="$1" "
        # window depth of a standard mapping with near n and far f, its eye depth, and the width of a step h there
        function eye(d, n, f) { return n * f / (f - d * (f - n)) }
        function width(z, n, f, h) { return z * z * (1 / n - (f ? 1 / f : 0)) * h }
        { text = text \$0 } # a single line, or nothing
        END {
            d24 = 1 / (2 ^ 24 - 1)
            least = $2
            most = $3
            number = match(text, pattern \" *-?[0-9][0-9.e+-]*\") ? substr(text, RSTART, RLENGTH) : \"\"
            sub(pattern \" *\", \"\", number)
            printf \"%.9g <= %s <= %.9g\n\", least, number, most
            exit !(number != \"\" && least <= number + 0 && number + 0 <= most)
        }"
}

# Surfaces fight where one step is as wide as the gap, at the latest, and never where two fit into it.
check "1. walls 1 cm apart in D24" answers 0 \
    'depthprec zfight -n 0.1 -f 1000 -F d24 -m gl --separation 0.01' 'first z-fight at z = 100.347'
check "1. within the lattice" agrees 'at z =' 'sqrt(0.01 / width(1, 0.1, 1000, 2 * d24))' \
    'sqrt(0.01 / width(1, 0.1, 1000, d24))'
# Around z = 83,000 a step of n/z, which is about 2^-20 there, is 2^-43.
check "2. the same in fp32, reversed, infinite" answers 0 \
    'depthprec zfight -n 0.1 -f inf -F fp32 -m reversed --range 1:1e5 --separation 0.01' 'first z-fight at z = 82908.5'
check "2. within the lattice" agrees 'at z =' 'sqrt(0.01 / width(1, 0.1, 0, 2 ^ -42))' \
    'sqrt(0.01 / width(1, 0.1, 0, 2 ^ -43))'
check "3. the cheapest format for 5 mm at 2 km" answers 0 \
    'depthprec solve --for format -n 0.05 --separation 5mm --at 2km' 'fp32 reversed, near 0.05'
check "3. two steps of binary32 at 2000 m, in mm" agrees 'separation' '1000 * 2 ^ -12 - 1e-6' '1000 * 2 ^ -12 + 1e-6'
# Where 1/10 - 1/10.0001 is (1/n - 1/f) steps.
check "4. CAD: the near plane for 0.1 mm at 10 m" answers 0 \
    'depthprec solve --for near --far 2km -F d24 -m gl --separation 0.1mm --at 10m' '0.138909 m'
check "4. the lattice's" agrees 'needs only near' '1 / ((1 / 10 - 1 / 10.0001) / d24 + 1 / 2000) - 1e-7' \
    '1 / ((1 / 10 - 1 / 10.0001) / d24 + 1 / 2000) + 1e-7'
check "4. at least that of the lattice" agrees 'Near' '1 / (1e-6 / d24 + 1 / 2000)' '3 / (1e-6 / d24 + 1 / 2000)'
check "5. the bias for a decal, in every API" answers 0 \
    'depthprec bias --api all -F d24 --separation 2cm --at 300m' 'glPolygonOffset'
check "5. so many steps in d3d11" agrees 'd3d11' '-1 - 0.02 / width(300, 0.1, 1000, d24) - 1' \
    '-0.02 / width(300, 0.1, 1000, d24)'
check "6. pyrender's 0.99" answers 0 'depthprec table --preset pyrender:scale=2 --depth 0.99' '4.7641734'
check "6. near 0.05 and far 100, by the formula, within half a step" agrees '16609443' \
    'eye(0.99, 0.05, 100) - width(4.8, 0.05, 100, d24) / 2' 'eye(0.99, 0.05, 100) + width(4.8, 0.05, 100, d24) / 2'
check "6. half of all depths" answers 0 'depthprec table -F d24 -m d3d -n 0.1 -f inf --depth 0.5' '8388608'
check "6. n/(1 - d) of the code" agrees '8388608' '0.1 / (1 - 8388608 * d24) - 2e-8' '0.1 / (1 - 8388608 * d24) + 1e-9'
check "7. a pixel in millimetres" answers 0 'depthprec texture mm.png --metric mm --pixel 3,3' 'eye depth 10 m'
# Rounded or cut, 10,000 mm are from half of one below to one above.
check "7. its least depth" agrees 'may be' '10000.0 / 1000 - 0.0005 - 1e-8' '10000.0 / 1000 - 0.0005 + 1e-8'
check "7. and how wide" agrees 'an interval of' '0.0015 - 1e-8' '0.0015 + 1e-6'

figure='depthprec plot error -F d16,d24,fp32 -m reversed --theme dark -o error.svg'
to_file() { answers 0 "$figure" '' && grep -q '</svg>' "$scratch/work/error.svg"; }
check "8. a dark figure, to a file" to_file
check "8. to the standard output, the same" answers 0 \
    'depthprec plot error -F d16,d24,fp32 -m reversed --theme dark --type svg -o -' '</svg>'
three() { # the figure has a curve of each, and both outputs are alike but for the command that they name
    sed '/^command: /d' "$scratch/answer" >"$scratch/piped" && grep -q '</svg>' "$scratch/piped" || return
    sed '/^command: /d' "$scratch/work/error.svg" | cmp "$scratch/piped" - || return
    for format in unorm16 unorm24 fp32; do grep -q "$format" "$scratch/answer" || return; done
}
check "8. three formats" three

check "9. a job that fails below 1 mm at 50 m" answers 1 'depthprec check game.need' 'FAIL'
check "9. by the formula" agrees 'separation' 'width(50, 0.1, 1000, d24) - 1e-7' 'width(50, 0.1, 1000, d24) + 1e-7'
check "10. a near plane for a script" answers 0 \
    'depthprec solve --for near -f 1km -F d24 -m d3d --separation 5mm --at 200m --json | jq .answer.near' '1.36001'
check "10. at least that of the lattice" agrees '^' '1 / (0.005 / 200 ^ 2 / d24 + 1 / 1000)' \
    '3 / (0.005 / 200 ^ 2 / d24 + 1 / 1000)'
check "11. the step of an orthographic camera" answers 0 'depthprec table --ortho -n 0 -f 500 -F d16 -m d3d' \
    'worst interval'
check "11. by the formula" agrees 'worst interval' '500 / 65535 - 1e-8' '500 / 65535 + 1e-8'
check "12. which linearization" answers 0 'depthprec methods linearize -F fp32 -m reversed' 'complement'
check "12. the exact one, rounded once, is off by half an ulp" agrees ' double [^ ]* [^ ]* ' '2 ^ -24 * 0.99' \
    '2 ^ -24 * 1.01'
check "13. must float arithmetic be modelled" answers 0 'depthprec table -F d24 -m d3d --at 100' \
    '--model staged captures'
check "13. by so much more than the lattice" agrees 'makes the guarantee' \
    "$(awk '/16762114/ { print $NF }' "$scratch/answer") / width(100, 0.1, 1000, d24)" \
    "$(awk '/16762114/ { print $NF }' "$scratch/answer") / width(100, 0.1, 1000, d24) + 0.01"
check "14. URP at 40 m" answers 0 'depthprec table --preset unity-urp --at 40m' 'fp32 reversed, near 0.3, far 1000'
# 40 m in binary32 are in steps of 2^-18; depth 0.0072 in steps of 2^-31.
check "14. a step of the format" agrees '1005322266 [0-9.e-]* [0-9.e-]*' \
    '0.98 * width(40, 0.3, 1000, 2 ^ -31)' '1.02 * width(40, 0.3, 1000, 2 ^ -31)'
check "14. one to four steps of binary32" agrees '1005322266 [0-9.e-]* [0-9.e-]* [0-9.e-]* [0-9.e-]*' \
    '2 ^ -18 - 1e-12' '4 * 2 ^ -18'
check "14. Unreal at 1 km" answers 0 'depthprec table --preset unreal --at 1km' 'lengths in cm'
# Window depth 10/100000 is in [2^-14, 2^-13), its code is that of 1.6384 2^-14.
check "14. the code of 0.0001" agrees ' 100000' '(113 + 0.6384) * 2 ^ 23 - 1' '(113 + 0.6384) * 2 ^ 23 + 1'
check "14. and its step, in cm" agrees '953267991 0.0001 [0-9.e-]*' '0.99 * width(1e5, 10, 0, 2 ^ -37)' \
    '1.01 * width(1e5, 10, 0, 2 ^ -37)'
# A texel at depth 1 is 2 tan(30)/1024 wide; the filter reads up to 1.5 of them away on each axis, on a slope of tan 75; on
# the axis, at the near plane, depth grows by n f/(f - n)/n^2, off it by little more.
check "15. the bias of a spot light" answers 0 \
    'depthprec shadow --spot 60 -n 0.5 -f 50 --size 1024 -F d16 --api vulkan' 'spot light, 60 degrees'
check "15. its texel" agrees 'far 50, texel' '2 * 0.57735 / 1024 - 1e-6' '2 * 0.57735 / 1024 + 1e-6'
check "15. slope times filter radius, and little more" agrees 'constant depthBiasConstantFactor =' \
    '65536 * 1.5 * sqrt(2) * 2 * 0.57735 / 1024 * 0.5 * 3.732 * 0.5 * 50 / 49.5 / 0.25' \
    '1.05 * 65536 * 1.5 * sqrt(2) * 2 * 0.57735 / 1024 * 0.5 * 3.732 * 0.5 * 50 / 49.5 / 0.25'
check "15. the bias of a point light" answers 0 \
    'depthprec shadow --point -n 0.1 -f 25 --size 1024 -F d32f --api gl' 'point light, six faces of 90 degrees'
check "15. a face is 2 wide at depth 1" agrees 'texel' '2 / 1024 - 1e-6' '2 / 1024 + 1e-6'
check "15. a normal offset of the filter's diagonal" agrees 'normal offset' '1.5 * sqrt(2)' '1.03 * 1.5 * sqrt(2)'

# Snapping alone costs 2 sqrt(2) of half a step of the grid in both surfaces, a pixel being 2 tan(30)/1080 wide at z = 1.
check "16. what is resolved at any slant" answers 0 \
    'depthprec table -n 0.1 -f inf -F fp32 -m reversed --at 5km --viewport 1920x1080' 'at any slant: 1 mm up to'
check "16. less far than snapping alone allows" agrees 'at any slant: 1 mm up to z =' \
    '0.1 * 0.001 * 512 * 1080 / (4 * sqrt(2) * 0.57735)' '0.001 * 512 * 1080 / (4 * sqrt(2) * 0.57735)'
# Twice two vertices on two axes, half a step each, and the set-up.
check "17. the bias of decals on any slope" answers 0 \
    'depthprec bias -n 0.1 -F d24 -m d3d --viewport 1920x1080' 'SlopeScaledDepthBias = -0.0224609375'
check "17. the slope's is at least that of snapping" agrees 'SlopeScaledDepthBias =' '-4 / 128' '-4 / 512'
check "18. the constants of a camera in Unity" answers 0 \
    'depthprec table --constants --preset unity --at 10' 'reversed, near 0.3, far 1000'
check "18. x of _ZBufferParams" agrees '_ZBufferParams' '1000 / 0.3 - 1 - 1e-3' '1000 / 0.3 - 1 + 1e-3'
check "18. eye depth and Linear01Depth" agrees ' 10 0.297089 10 0.0297089 0.0297089 10' '0.01 - 1e-8' '0.01 + 1e-8'
# The depth 2 d - 1 in place of d.
check "19. a formula that is wrong" answers 0 'depthprec table --constants -n 0.1 -f 1000 -m gl --at 10' 'ndc-as-depth'
check "19. what it reads" agrees 'go on with it; right: LinearEyeDepth.d. z reads off by % 10' \
    '0.99999 * eye(2 * 9.9 / 10 / 0.9999 - 1, 0.1, 1000)' '1.00001 * eye(2 * 9.9 / 10 / 0.9999 - 1, 0.1, 1000)'
# 0.1 is 6502.5 steps of 1/65025, of which binary32 has a little more.
check "20. depth in DepthNormals" answers 0 \
    'depthprec table --constants -n 0.3 -f 1000 -m d3d --at 100,500' 'DepthNormals'
check "20. the nearest of 65026 depths" agrees 'DepthNormals 100 [0-9.]* [0-9.]* [0-9.]*' \
    '0.999999 * 6503 / 65.025' '1.000001 * 6503 / 65.025'
stairs() { # stairs PRODUCT: a picture of it
    answers 0 "depthprec texture --synthetic steps --parameter even=1 -F d24 -m d3d -n 0.3 --product $1 -q --figure $1.png" '' &&
        [ -s "$scratch/work/$1.png" ]
}
check "21. stairs at equal distances as window depth" stairs raw
check "21. and as Linear01Depth" stairs linear01

check "18. three.js, with its own words" answers 0 \
    'depthprec table --at 1000 --preset three -m gl,logarithmicDepthBuffer,reversedDepthBuffer' \
    'Cost of three-webgl: the fragment shader writes depth, so no early z.'
check "18. between one step and three of standard D24" agrees 'unorm24 gl' 'width(1000, 0.1, 2000, d24)' \
    '3 * width(1000, 0.1, 2000, d24)'
# log2(1 + w)/log2(1 + far): a step is (1 + w) ln(1 + far) wide; float arithmetic adds its share.
check "18. at least a step of the logarithm" agrees 'unorm24 three-webgl' '1001 * log(2001) * d24' \
    '20 * 1001 * log(2001) * d24'
check "19. polygonOffset in React Three Fiber" answers 0 'depthprec bias --preset r3f --units -4 --factor -1 --at 30' \
    'enough from 30 to 30'
check "19. four steps of 2^-24" agrees '29.9978546' '-1.001 * width(30, 0.1, 1000, 4 * 2 ^ -24)' \
    '-0.999 * width(30, 0.1, 1000, 4 * 2 ^ -24)'
check "20. bands of an intersection highlight" answers 0 \
    'depthprec texture --product effect:intersection -F d24 -m d3d --parameter half-width=0.5' '1/255: what 8 bits hold'
# A band begins where the next depth is stored, a step away; over the half-width that is a level.
check "20. a step is a level" agrees 'Up to z =' '0.99 * sqrt(0.5 / 255 / width(1, 0.1, 1000, d24))' \
    '1.01 * sqrt(0.5 / 255 / width(1, 0.1, 1000, d24))'
check "20. the last step is none" agrees 'half-width from' '0.99 * 255 * width(1000, 0.1, 1000, d24)' \
    '1.01 * 255 * width(1000, 0.1, 1000, d24)'
check "21. the bias of a shadow map in two APIs" answers 0 \
    'depthprec shadow --light-box 40mx40mx100m -F d16 --api d3d12,vulkan' \
    'D3D12_RASTERIZER_DESC.DepthBias = U, SlopeScaledDepthBias = F'
check "21. slope times filter radius, and little more" agrees 'vulkan' \
    '1.5 * sqrt(2) * 40 / 2048 * 3.732 / 100 * 65536' '1.03 * 1.5 * sqrt(2) * 40 / 2048 * 3.732 / 100 * 65536 + 1'
check "22. what flickers in a glTF model" answers 1 \
    'depthprec scene house.gltf -F d24 -m d3d --camera street --within 60' "'road' (tar)"
check "22. in metres, at least a step there" agrees 'lie within' 'width(60, 0.05, 1000, d24)' \
    '20 * width(60, 0.05, 1000, d24)'
check "23. on a slope of 60 degrees" answers 0 \
    'depthprec table -F d24 -m d3d --viewport 1920x1080 --slant 60:60' 'at 60 degrees: 0.001 up to'
check "23. less far than facing the camera" agrees '60 degrees: 0.001 up to z =' 1 \
    '0.5 * sqrt(0.001 / width(1, 0.1, 1000, d24))'
check "24. the bits of 5 m" answers 0 'depthprec table -n 0.1 -f inf -F fp32 -m reversed --at 5' '1017370378'
check "24. sign 0, exponent of [2^-6, 2^-5), mantissa of 0.02" agrees ' 5 ' \
    '121 * 2 ^ 23 + (0.02 * 2 ^ 6 - 1) * 2 ^ 23 - 0.51' '121 * 2 ^ 23 + (0.02 * 2 ^ 6 - 1) * 2 ^ 23 + 0.51'
check "25. OpenXR at 2 m" answers 0 'depthprec table --preset openxr --at 2m' 'near 0.05, far 100'
# Window depth 0.975 in steps of 2^-24.
check "25. a step" agrees '0.9754877 [0-9.e-]*' '0.999 * width(2, 0.05, 100, 2 ^ -24)' \
    '1.001 * width(2, 0.05, 100, 2 ^ -24)'
check "26. window depth 0.7 in MuJoCo" answers 0 'depthprec table --preset mujoco:extent=2 --depth 0.7' \
    'near 0.02, far 100'
check "26. reversed, by the formula" agrees '1060320051' 'eye(1 - 0.7, 0.02, 100) - 1e-8' \
    'eye(1 - 0.7, 0.02, 100) + 1e-8'
check "27. 0.4 in D16" answers 0 'depthprec table -F d16 -m d3d --code 26214' ' 0.4 '
check "27. it is that code exactly" agrees ' 0.4' '0.4 * 65535 - 1e-9' '0.4 * 65535 + 1e-9'
check "27. its eye depth" agrees ' 26214' 'eye(0.4, 0.1, 1000) - 1e-8' 'eye(0.4, 0.1, 1000) + 1e-8'
check "28. vertices 100 km away" answers 0 'depthprec world --from-origin 100km --separation 1cm --at 10m' 'suffices'
check "28. a few halves of a step of binary32 there" agrees ' absolute' '2 ^ -8' '16 * 2 ^ -8'
check "29. world coordinates in the separation" answers 0 \
    'depthprec budget -F fp32 -m reversed -f inf --from-origin 5km --at 10m' 'composition'
check "29. a few steps of binary32 at 5 km" agrees ' 10 ' '2 ^ -11' '16 * 2 ^ -11'
check "30. packed into colours" answers 0 'depthprec texture rgb.png --packing rgb24 -m d3d --pixel 3,3' \
    'eye depth 10.0000024'
check "30. a plane 10 away, within its step" agrees 'eye depth' '10 - width(10, 0.1, 1000, d24)' \
    '10 + width(10, 0.1, 1000, d24)'
check "31. Blender's viewport" answers 0 'depthprec table --preset blender-viewport -n 0.001 --at 100' \
    'fp32 gl, near 0.001, far 1000'
# The next to last binade of depths: steps of 2^-24.
check "31. a step" agrees '1065353065 [0-9.]* [0-9.-]*' '0.99 * width(100, 0.001, 1000, 2 ^ -24)' \
    '1.01 * width(100, 0.001, 1000, 2 ^ -24)'
check "31. posters in Godot" answers 0 'depthprec solve --for distance --preset godot-forward --separation 1mm' \
    'up to z = 4000 m'
check "31. two steps of binary32 at 4000 m, in mm" agrees ' separation' '1000 * 2 ^ -11 - 1e-6' '1000 * 2 ^ -11 + 2e-6'
check "31. A-Frame across a room" answers 0 'depthprec table --preset aframe --at 20m' 'near 0.005, far 10000'
check "31. a step" agrees '16773029 [0-9.]* [0-9.-]*' '0.999 * width(20, 0.005, 10000, d24)' \
    '1.001 * width(20, 0.005, 10000, d24)'
check "32. names of D24" answers 0 'depthprec list D24_UNORM_S8_UINT' 'DEPTH24_STENCIL8'
check "32. half a step" agrees '<=' 'd24 / 2 - 1e-16' 'd24 / 2 + 1e-16'
check "33. EQUAL behind another order" answers 0 \
    'depthprec prepass -F d24 -m d3d --program once --against separate --sample 100000' 'EQUAL'
check "33. not safe: most vertices differ, by more than a code" agrees ' separate' 50 100
check "33. a prepass in D16" answers 0 'depthprec prepass --prepass-format d16 -F fp32 -m reversed --range 0.1:100' \
    'GEQUAL is safe if'
# Half a code of D16, and where a binary32 number is no middle of two codes up to a step more.
check "33. half a code" agrees 'the camera by' '1 / 131070 - 2 ^ -25' '1 / 131070 + 2 ^ -24'
check "33. samples resolved" answers 0 'depthprec prepass --resolve min:4 -F d24 -m d3d' 'LEQUAL is safe if'
# The farthest of four samples is (2, 6)/16 from the centre.
check "33. half a pixel" agrees 'changes over' '8 / 16' '8 / 16'
check "33. half the resolution" answers 0 'depthprec prepass --half centre,one -F d24 -m d3d' 'LEQUAL is safe if'
check "33. two pixels" agrees 'changes over' 2 2
check "33. a copy of D24 read back by 2^24" answers 0 'depthprec convert d24 d32f d24 --write cut:2^24' \
    'EQUAL     fails'
# c + c/(2^24 - 1), in floats 2^-24 apart from 2^23 on: each of that half is rounded up.
check "33. half of its codes" agrees 'changed' '2 ^ 23 - 0.5' '2 ^ 23 + 0.5'
survive() { # codes of D16 that rounding to D24 and back changes, as whole numbers
    awk 'BEGIN { for (c = 0; c < 65536; c++) bad += int(int(c * 16777215 / 65535 + 0.5) * 65535 / 16777215 + 0.5) != c; print bad + 0 }'
}
check "33. D16 in D24" answers 0 'depthprec convert d16 d24 d16' 'EQUAL     holds'
check "33. none is changed, code by code" agrees 'changed' "$(survive)" "$(survive)"
check "33. a float of 24 bits in D24" answers 0 'depthprec convert 20e4 d24' 'become one code'
# Fifteen binades of 2^20 numbers below 1, subnormals among them, and 1.
check "33. so many numbers" agrees 'rounded [0-9]* of' '15 * 2 ^ 20 + 1' '15 * 2 ^ 20 + 1'
check "33. layers of a map" answers 0 'depthprec solve --preset maplibre-globe:height=800 --separation 100m' 'from zoom'
# A pixel is 40030230/(512 2^zoom) m, near half of one, the middle 1200 away: a step of D24 there is 1200^2/(0.5 2^24) of one.
check "33. the lattice, and at most 4 times as much" agrees 'from zoom' \
    'log(width(1200, 0.5, 0, d24) * 40030230 / 51200) / log(2)' \
    'log(width(1200, 0.5, 0, d24) * 40030230 / 51200) / log(2) + 2'
# A pixel is 40030229/(512 2^zoom) m, and near a fiftieth of the height.
check "33. planes of a map" answers 0 'depthprec table --preset maplibre:zoom=10,height=900 --at 5km' 'unorm24 gl'
check "33. near" agrees 'near' '40030228.8 / (512 * 2 ^ 10) * 900 / 50 - 1e-3' \
    '40030228.9 / (512 * 2 ^ 10) * 900 / 50 + 1e-3'
check "34. glPolygonOffset(1, 1)" answers 0 'depthprec bias --api gl -F d24 --units 1 --factor 1 --at 20m' \
    'it has the wrong sign'
check "34. a unit of 2^-24, away" agrees '20.0002384' '0.999 * width(20, 0.1, 1000, 2 ^ -24)' \
    '1.001 * width(20, 0.1, 1000, 2 ^ -24)'

# near = e/(c + 1) and far = e/(c - 1) of the third row, whose entries may be half of their last digit away.
check "35. a camera from its matrix" answers 0 \
    "depthprec table --matrix '1,0,0,0,0,1.8,0,0,0,0,-1.00020,-1,0,0,-0.200020,0' -F d24 -m gl --at 10" 'unorm24 gl, near 0.1'
check "35. what far may be, at least" agrees 'to 0.1000005, far' 0.2000195/0.000205-0.01 0.2000195/0.000205
check "35. its code at 10" agrees ' 10 ' '(1 - 0.1 / 10) / (1 - 0.1 / 1000.1) * (2 ^ 24 - 1) - 0.6' \
    '(1 - 0.1 / 10) / (1 - 0.1 / 1000.1) * (2 ^ 24 - 1) + 0.6'
# Its pixels are 2.1/2064 wide, which is more than high; the wider half reaches to 1.2.
check "36. the eye of a headset" answers 0 \
    'depthprec table --matrix=-1.2,0.9,1.1,-1 -n 0.1 -f inf -F fp32 -m reversed --viewport 2064x2208 --at 5' 'holds the one of --matrix'
check "36. the view that holds it" agrees 'viewport' '2 * 1.2 / (2.1 / 2064)' '2 * 1.2 / (2.1 / 2064) + 1'
check "36. its angle" agrees 'fov' '114.5915 * atan2(1.1, 1)' '114.5915 * atan2(1.1 + 2.1 / 2064, 1) + 0.01'
check "37. codes between two depths" answers 0 'depthprec table -F d24 -m d3d --range 1:7 --at 7' 'codes'
check "37. by the formula" agrees 'codes' '(1 - 1 / 7) / width(1, 0.1, 1000, d24) - 1' \
    '(1 - 1 / 7) / width(1, 0.1, 1000, d24) + 2'
check "38. the first codes" answers 0 'depthprec table -F d24 -m d3d --code 0:3' '0.10000001'
check "38. a step each: window depth of the last" agrees '0.1000000149 5.96e-09' 2.9/16777215 3.1/16777215
# Half of 1280 pixels see 43.5 degrees, 50 mm apart, in 1/32 of a pixel: the next level behind 3 m.
check "39. a RealSense" answers 0 'depthprec table --lattice d435 --at 3m' 'step'
check "39. by the formula" agrees ' 3 ' '1 / (1 / 3 - sin(0.759218) / cos(0.759218) / (640 * 0.05 * 32)) - 3 - 1e-5' \
    '1 / (1 / 3 - sin(0.759218) / cos(0.759218) / (640 * 0.05 * 32)) - 3 + 1e-5'
# Its calibration has 44.85728 and -339.5242 for both cameras, focal length times place; 1/256 of a pixel.
check "39. KITTI" answers 0 'depthprec table --lattice kitti-stereo --at 50m' 'step'
check "39. by the formula" agrees ' 50 ' '1 / (1 / 50 - 1 / 256 / 384.38148) - 50 - 1e-5' \
    '1 / (1 / 50 - 1 / 256 / 384.38148) - 50 + 1e-5'
# Depth 0.2857 is in [2^-2, 2^-1).
check "40. r of a float buffer" answers 0 'depthprec bias --api vulkan -F d32f -m d3d --units 1 --at 0.14' 'r is up to'
check "40. r" agrees ' 0.14' '2 ^ -25 * 0.99999' '2 ^ -25 * 1.00001'
check "40. and what it moves" agrees '0.1400000058' '0.99 * width(0.14, 0.1, 1000, 2 ^ -25)' \
    '1.01 * width(0.14, 0.1, 1000, 2 ^ -25)'
check "41. why frusta" answers 0 'depthprec solve --for frusta -n 0.1 -f 100m -F d16 -m d3d --separation 1m' \
    'the lattice alone forbids'
check "41. at least the last step before far" agrees 'it resolves' '100 - eye(1 - 1 / 65535, 0.1, 100)' \
    '1.6 * (100 - eye(1 - 1 / 65535, 0.1, 100))'

unanswered() { # commands of the page that no line above has found right
    grep '^depthprec ' "$scratch/commands" | grep -vxF -f "$scratch/answered"
    [ "$(grep -c '^[^ ]' "$scratch/questions")" -ge 30 ] || echo "fewer than 30 questions"
}
check "each command of the page is answered, of at least 30 questions" empty unanswered

# ---- Words and widths ----

everything() { # the text of README.md and the pages, of help and of every list, to the folder text
    manual "$scratch/text" && cp README.md "$scratch/text" || return
    depthprec help >"$scratch/text/help" || return
    for verb in $(sed -n '/^Commands/,/^$/s/^  \([a-z]*\) .*/\1/p' "$scratch/text/help"); do
        depthprec help "$verb" >"$scratch/text/help.$verb" || return
    done
    depthprec list >"$scratch/text/list" || return
    for what in $(sed -n 's/^  \([a-z]*\) .*/\1/p' "$scratch/text/list"); do
        depthprec list "$what" >"$scratch/text/list.$what" || return
    done
    [ "$(find "$scratch/text" -size +0 | wc -l)" -ge 30 ]
}

# Words for which the glossary has better ones. A list by hand, because words like "one" are retired in one sense only.
retired='to be had|drawn from|a limit is|an element|different codes|stands for|stand for|too much:|arithmetic adds
|nothing is monotone|ariths|to us|hangs on|an octave of|ought to|in spite of|has no meaning'

free_of() { # free_of WORDS: no text has them, wherever its lines break
    [ -s "$scratch/lines/list" ] && lines -lF -e "$1" -r "$scratch/lines" >"$scratch/having" || return
    while read -r file; do
        grep -oE -e ".{0,30}$1.{0,20}" "$file" | sed "s|^|${file##*/}: |"
    done <"$scratch/having"
}

narrow() { # help and lists are at most 80 columns wide
    [ -s "$scratch/text/list" ] || return
    awk 'length > 80 { print FILENAME ": " $0 }' "$scratch"/text/help* "$scratch"/text/list*
}

check "the text of the pages, of help and of lists" everything
mkdir "$scratch/lines" && for file in "$scratch"/text/*; do
    tr -s ' \n' '  ' <"$file" >"$scratch/lines/${file##*/}"
done
echo "$retired" | tr '|' '\n' >"$scratch/retired"
while read -r words; do
    [ -z "$words" ] || check "no text says \"$words\"" empty free_of "$words"
done <"$scratch/retired"
check "help and lists: 80 columns" empty narrow
finish
