#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Code to take away, as others take it: glslangValidator and spirv-val, python3 with numpy, Gappa, where they are
# installed; naga, which make check-full fetches. MSL is looked at by its structure alone: nothing here compiles it.
. tests/tap.sh

methods='magic unity complement-unity linear-01 linear-01-near textbook complement fused double phi-double floor:unorm16 rint:unorm24 floor-double:unorm24'
cameras='d3d:0.1:1000 gl-reversed:0.3:inf' least=20
[ -z "${DEPTHPREC_FULL-}" ] || cameras="$cameras reversed:0.1:1000 gl:3:500 gl-reversed:0.25:64 d3d:0.3:inf" least=60

code() { "$DEPTHPREC" code "$@"; }

# Lines of options: channels, and cameras whose depth is linear or logarithmic.
more() {
    for packing in rg rgba rgba-r166 rgb24 linear01; do echo "$packing --what pack"; done
    for normals in stereo-8 oct-8 oct-888 xyz-8; do echo "$normals --what normal"; done
    for mapping in log cesium three-webgpu linear; do printf -- "-m $mapping%s\n" '' ' --what encode --uniforms'; done
    echo '-m gl -f inf'
    printf -- '--ortho -m %s\n' d3d 'reversed --uniforms'
    printf -- '--depth-range %s\n' '0.1:1 -m d3d' '0:0.1 unity -m gl --uniforms' '0.1:1 -m reversed -f inf' '1:0.2 -m gl'
}

# Every function of a language for every camera, and the matrix: in $scratch/all. What a language lacks is refused.
each() { # each LANGUAGE COMMAND: runs COMMAND FILE for each
    language=$1 count=0
    shift
    more >"$scratch/more"
    while read -r line; do
        code $line --language $language >"$scratch/code" 2>"$scratch/refused" || {
            grep -qE "^depthprec: --(language|uniforms): " "$scratch/refused" && continue
            cat "$scratch/refused" && return 1
        }
        count=$((count + 1))
        "$@" || { echo "$line" && cat "$scratch/code" && return 1; }
    done <"$scratch/more"
    for camera in $cameras; do
        mapping="-m ${camera%%:*} --language $language" planes="-n $(echo "$camera" | cut -d: -f2) -f ${camera##*:}"
        for method in $methods; do
            case $method in # codes of a window depth have no planes
            *:*) at="$mapping --what encode -F ${method#*:}" ;;
            *) at="$mapping $planes" ;;
            esac
            for uniforms in '' --uniforms; do
                code "${method%:*}" $at $uniforms >"$scratch/code" 2>"$scratch/refused" || {
                    [ $? -eq 2 ] && grep -qE "is not in $language: it |--uniforms: conflicts" "$scratch/refused" && continue
                    cat "$scratch/refused"
                    return 1
                }
                count=$((count + 1))
                "$@" || { echo "$at $method $uniforms" && cat "$scratch/code" && return 1; }
            done
        done
    done
    [ $count -ge $least ] || { echo "only $count" && return 1; }
}

called() { { sed -n 's/.*\(depth_code\|eye_depth\|window_depth\)(.*/\1/p' "$scratch/code" && echo float; } | head -n 1; }

arguments() { # the uniforms' numbers, as the comments have them
    sed -n 's/^[/#]* [A-Za-z] = .* = \(.*\)$/, \1/p' "$scratch/code" | tr -d '\n'
}

glsl() {
    { echo '#version 450
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Values { float values[]; };'
        cat "$scratch/code"
        code --what projection --language glsl
        echo "void main() { vec4 clip = projection * vec4(1.0); values[0] = $(called)(values[1]$(arguments)) + clip.w; }"
    } >"$scratch/code.comp"
    glslangValidator -V -o "$scratch/code.spv" "$scratch/code.comp" && spirv_val
}

hlsl() {
    { echo 'RWStructuredBuffer<float> values;'
        cat "$scratch/code"
        code --what projection --language hlsl
        echo "[numthreads(1, 1, 1)] void main() {
            values[0] = $(called)(values[1]$(arguments)) + mul(projection, float4(1, 1, 1, 1)).w; }"
    } >"$scratch/code.hlsl"
    glslangValidator -D -V -S comp -e main -o "$scratch/code.spv" "$scratch/code.hlsl" && spirv_val
}

spirv_val() { ! command -v spirv-val >/dev/null || spirv-val "$scratch/code.spv"; }

if command -v glslangValidator >/dev/null; then
    check "glslangValidator takes every GLSL" each glsl glsl
    check "glslangValidator takes every HLSL" each hlsl hlsl
    command -v spirv-val >/dev/null || skip "spirv-val" "no spirv-val here"
else
    skip "GLSL and HLSL" "no glslangValidator here"
fi

# Parentheses and braces close, names are bound before they are used, and literals have the language's form.
structure() {
    awk -v language="$language" '
        /^ *(\/\/|;)/ { next }
        { sub(/ \/\/.*/, "")
          for (i = 1; i <= length($0); i++) {
              c = substr($0, i, 1)
              depth += c ~ /[({]/ ? 1 : c ~ /[)}]/ ? -1 : 0
              if (depth < 0) exit bad = 1
          }
          if (language == "wgsl" && /[0-9]\.[0-9]+[^0-9ef]/) exit bad = 1
          if (language == "wgsl" && !/^$|^fn [a-z_]+\([a-z]: f32(, [A-Za-z]: f32)*\) -> ([fu]32|vec[234]<f32>) \{$|^    (let|const) [A-Za-z] = .*;$|^    return .*;$|^}$/) exit bad = 1
          if (language == "msl" && !/^$|^(float[234]?|uint) [a-z_]+\(float [a-z](, float [A-Za-z])*\) \{$|^    const float [A-Za-z] = .*;$|^    return .*;$|^}$/) exit bad = 1
          all = all $0 }
        END { exit bad || depth != 0 || all == "" }' "$scratch/code"
}
check "every WGSL has its structure" each wgsl structure
check "every MSL has its structure" each msl structure
least=$((least / 2))
check "every FPCore has its structure" each fpcore structure

gather() { mkdir -p "$scratch/$language" && cp "$scratch/code" "$scratch/$language/$count.$language"; }
meaning() { each fpcore gather && python3 tests/code/fpcore.py "$scratch/fpcore"; }
if command -v python3 >/dev/null; then
    check "every FPCore specifies the eye depth, and its operations stay within their bound" meaning
else
    skip "what FPCores mean" "no python3 here"
fi
naga() {
    each wgsl gather && code --what projection --language wgsl >"$scratch/wgsl/matrix.wgsl" &&
        code --what position --language wgsl >"$scratch/wgsl/places.wgsl" &&
        echo 'fn f(d: f32) -> f32 { return e; }' >"$scratch/wgsl/wrong.wgsl" && cat >"$scratch/naga.mjs" <<'END'
import { parseWgsl, validate } from "naga-wasm";
import { readFileSync, readdirSync } from "node:fs";
const wrong = readdirSync("wgsl").filter((name) => {
    const text = readFileSync("wgsl/" + name, "utf8");
    try { validate(parseWgsl(text)); } catch (error) { console.log(name, String(error), text); return true; }
});
process.exitCode = wrong.join() === "wrong.wgsl" ? 0 : 1;
END
    (cd "$scratch" && node naga.mjs)
}
if [ -n "${DEPTHPREC_FULL-}" ] && (cd "$scratch" && npm install --no-audit --no-fund --ignore-scripts naga-wasm@30.1.0) >"$scratch/log" 2>&1; then
    check "naga takes every WGSL" naga
else
    skip "naga" "make check-full fetches it by npm, where there is a network"
fi

# What Gappa proves of the script is what the comment of it says.
proof() {
    said=$(sed -n 's/.*off by at most \([^ ]*\) of.*/\1/p' "$scratch/code")
    grep -q z_exact "$scratch/code" || return
    [ -n "$said" ] || return 0
    gappa "$scratch/code" 2>&1 | awk -F'[{,]' -v said="$said" '/z -\/? z_exact in \[/ {
        lo = -$2; for (i = 3; i <= NF; i++) if ($i ~ /^-?[0-9.]+(e-?[0-9]+)?$/) hi = $i
        proven = lo > hi ? lo : hi; found = 1 }
        END { if (!found || !(said <= 1.6 * proven) || !(proven <= 1.5 * said)) { print proven, said; exit 1 } }'
}
if command -v gappa >/dev/null; then
    check "Gappa proves what its scripts say" each gappa proof
else
    skip "what Gappa proves" "no gappa here"
fi

# The same numbers as C gives, whose bits test_languages has looked at.
same_numbers() {
    code "$1" -m "$2" --language c | { echo '#include <math.h>
#include <stdint.h>
#include <stdio.h>'
        cat
        printf '%s\n' 'int main(void) { for (int i = 0; i <= 64; i++)
            printf("%.9g\n", (double)eye_depth(i / 64.0f)); return 0; }'
    } >"$scratch/c.c"
    $CC -ffp-contract=off -o "$scratch/c" "$scratch/c.c" -lm && "$scratch/c" >"$scratch/by-c" || return
    { code "$1" -m "$2" --language numpy
        echo 'for x in eye_depth(np.arange(65, dtype=np.float32) / np.float32(64)): print("%.9g" % x)'
    } >"$scratch/printed.py"
    python3 "$scratch/printed.py" >"$scratch/by-numpy" &&
        diff "$scratch/by-c" "$scratch/by-numpy"
}
# Every function runs on arrays, and what is packed comes back.
numpy() {
    each numpy gather && python3 - "$scratch/numpy" <<'END'
import glob, inspect, sys
import numpy as np
d = np.linspace(0, 1, 65, dtype=np.float32)
n = np.array([[3, -4, 12], [-2, 1, 2], [0, 0, 1], [6, 2, 3]], np.float32)
n = (n / np.linalg.norm(n, axis=1, keepdims=True)).T
for name in glob.glob(sys.argv[1] + "/*"):
    made = {}
    exec(open(name).read(), made)
    if "pack_depth" in made:
        channels = made["pack_depth"](d).T
        back = made["unpack_depth"](*channels) if channels.ndim > 1 else made["unpack_depth"](channels)
        assert abs(back - d).max() < 0.002, name
    elif "pack_normal" in made:
        back = made["unpack_normal"](*made["pack_normal"](*n).T).T
        assert (np.sum(back * n, 0) > 1 - 1e-5).all(), name
    else:
        f = made[next(k for k in made if k in ("eye_depth", "window_depth", "depth_code"))]
        assert len(f(d, *[np.float32(1)] * (len(inspect.signature(f).parameters) - 1))) == 65, name
END
}
if python3 -c 'import numpy' 2>/dev/null; then
    check "numpy runs every function" numpy
    for method in magic unity linear-01-near complement double; do
        for mapping in d3d reversed; do
            check "numpy has the bits of C: $method, $mapping" same_numbers $method $mapping
        done
    done
else
    skip "numpy" "no numpy here"
fi

# With uniforms it is the same function of the numbers that its comments say.
main='int main(void) { for (int i = 0; i <= 999; i++) printf("%a\\n", (double)CALL); return 0; }'
same_uniforms() {
    for method in $methods; do
        case $method in *:*) of="--what encode -F ${method#*:}" ;; *) of='-n 0.3 -f 77' ;; esac
        for uniforms in '' --uniforms; do
            code "${method%:*}" -m d3d --language c $uniforms $of >"$scratch/code" || return
            [ -n "$(called)" ] || return
            { printf '#include <math.h>\n#include <stdint.h>\n#include <stdio.h>\n'
                cat "$scratch/code"
                echo "$main" | sed "s/CALL/$(called)(i \/ 999.0f$(arguments))/"
            } >"$scratch/c.c"
            $CC -ffp-contract=off -o "$scratch/c" "$scratch/c.c" -lm && "$scratch/c" >"$scratch/of$uniforms" || return
        done
        cmp "$scratch/of" "$scratch/of--uniforms" || return
    done
}
check "uniforms make the same function" same_uniforms

# Matrices by hand: near 1, far 3, 90 degrees, so that all entries are short. A: f/(f - n) = 1.5, n/(f - n) = 0.5.
matrix() { # matrix OPTIONS ROWS: rows, then what a constructor by columns has
    code --what projection --language "$1" -m "$2" -n 1 -f "$3" --fov 90 --viewport 100x100 >"$scratch/matrix" || return
    awk '/^(\/\/|#)  / { print $2 + 0, $3 + 0, $4 + 0, $5 + 0 }' "$scratch/matrix" | paste -sd, - >"$scratch/comment"
    awk '/^    / { gsub(/[,f]/, ""); print $1 + 0, $2 + 0, $3 + 0, $4 + 0 }' "$scratch/matrix" | paste -sd, - >"$scratch/built"
    [ "$4" = "$(cat "$scratch/comment")" ] && [ "$5" = "$(cat "$scratch/built")" ] && return
    cat "$scratch/matrix"
    return 1
}
rows() { echo "1 0 0 0,0 1 0 0,0 0 $1 $2,0 0 -1 0"; }
columns() { echo "1 0 0 0,0 1 0 0,0 0 $1 -1,0 0 $2 0"; }
by_hand() { # by_hand LANGUAGE...: all of them
    while read -r mapping far a b; do
        for language; do
            case $language in
            hlsl | numpy) matrix $language $mapping $far "$(columns $a $b)" "$(rows $a $b)" || return ;;
            *) matrix $language $mapping $far "$(rows $a $b)" "$(columns $a $b)" || return ;;
            esac
        done
    done <<END
d3d 3 -1.5 -1.5
reversed 3 0.5 1.5
gl 3 -2 -3
gl-reversed 3 2 3
reversed inf 0 1
d3d inf -1 -1
gl inf -1 -2
END
}
check "matrices by hand, in both orders" by_hand glsl hlsl wgsl msl c numpy

# Orthographic, 2 wide and high to both sides, z from 1 to 3: near - z maps to (z - 1)/2, or (3 - z)/2.
orthographic() {
    code --what projection --language c --ortho=2 -m "$1" -n 1 -f 3 --viewport 100x100 | sed -n 's/^\/\/  //p' >"$scratch/comment"
    printf '%s\n' '0.5 0.0 0.0 0.0' '0.0 0.5 0.0 0.0' "$2" '0.0 0.0 0.0 1.0' | diff - "$scratch/comment"
}
check "an orthographic matrix by hand" orthographic d3d '0.0 0.0 -0.5 -0.5'
check "that of reversed depth" orthographic reversed '0.0 0.0 0.5 1.5'

# 90 degrees, 200 x 100 pixels: the centre of the last pixel of the first row is at 1.99 and 0.99 of the depth, of a
# tenth of the picture at 0.2.
place() {
    code --what position "$@" --fov 90 --viewport 200x100 --language c >"$scratch/code" || return
    { printf '#include <math.h>\n#include <stdint.h>\n#include <stdio.h>\n'
        cat "$scratch/code"
        echo 'static void say(float x, float y) { printf("%.4f %.4f ", (double)x, (double)y); }
            int main(void) { const float z = eye_depth(0.25f);
                say(view_x(199.5f, z) / z, view_y(0.5f, z) / z);
                say(view_x(110, z) / z, view_y(60, z) / z);
                printf("%.3f", (double)z); return 0; }'
    } >"$scratch/c.c"
    $CC -o "$scratch/c" "$scratch/c.c" -lm && [ "$("$scratch/c")" = '1.9900 0.9900 0.2000 -0.2000 4.000' ] || "$scratch/c"
}
check "places by hand" empty place -n 1 -f inf
places() { # places LANGUAGE COMMAND: each language takes both functions
    language=$1
    code --what position --language "$1" >"$scratch/code" && sed -i 's/^.*eye_depth(d):.*$//' "$scratch/code" && "$2"
}
if command -v glslangValidator >/dev/null; then
    check "GLSL of places" places glsl glsl
    check "HLSL of places" places hlsl hlsl
fi

best() { code --what "$1" | grep -q "^// $2: "; }
check "the best packing has the finest steps" best pack rgba
check "the best normals have the least angle" best normal xyz-12

# Where exp2 and log2 have whole numbers: log2(C (far - near) + 1) or log2(far/near) is 2, and d a half.
curve() { # curve D Z OPTIONS: an eye depth, and of a mapping that a shader writes the way back
    d=$1 z=$2
    shift 2
    code "$@" --language c >"$scratch/code" && { [ "$1" = --ortho ] || code "$@" --what encode --language c >>"$scratch/code"; } &&
        { printf '#include <math.h>\n#include <stdint.h>\n#include <stdio.h>\n'
            cat "$scratch/code"
            [ "$1" != --ortho ] || echo "#define window_depth(z) ((float)($d))"
            echo "int main(void) { printf(\"%g %g\", (double)eye_depth($d), (double)window_depth($z)); return 0; }"
        } >"$scratch/c.c" && $CC -o "$scratch/c" "$scratch/c.c" -lm && [ "$("$scratch/c")" = "$z $d" ] || "$scratch/c"
}
check "log by hand" empty curve 0.5 2 -m log --log-c 0.5 -f 6
check "cesium by hand" empty curve 0.5 4 -m cesium --log-c 0.5 -n 2 -f 8
check "three-webgpu by hand" empty curve 0.5 6 -m three-webgpu -n 3 -f 12
check "linear by hand" empty curve 0.25 2 -m linear -f 8
check "orthographic by hand" empty curve 0.25 1.75 --ortho -m d3d -n 1 -f 4
check "that of reversed depth by hand" empty curve 0.25 2 --ortho -m reversed -n -1 -f 3

# A range that binary32 has: of d3d a quarter of the way from 1/2 to 1 is as 1/4 from 0 to 1.
undone() { # undone METHOD D OPTIONS: 1.5 of near 1 and far 3
    code "$1" --language c --what linearize -n 1 -f 3 $3 >"$scratch/code" && {
        printf '#include <math.h>\n#include <stdio.h>\n'
        cat "$scratch/code"
        echo "int main(void) { printf(\"%.5f\", (double)eye_depth($2)); return 0; }"
    } >"$scratch/c.c" && $CC -o "$scratch/c" "$scratch/c.c" -lm && [ "$("$scratch/c")" = 1.50000 ] || "$scratch/c"
}
for method in unity complement-unity; do
    check "a range by hand, $method" empty undone $method 0.75f '-m d3d --depth-range 0.5:1'
    check "one that falls, $method" empty undone $method 0.25f '-m gl --depth-range 0.5:0'
    check "a reversed one, $method" empty undone $method 0.375f '-m reversed --depth-range 0.25:0.5'
    check "both ways, $method" empty undone $method 0.375f '-m gl-reversed --depth-range 0.5:0.25'
done

cleared() { code "$@" | grep -qE "^(//|#) Clear depth to $clear; nearer is $compare\.$"; }
clear=0 compare=GREATER
check "reversed depth is cleared to 0 and compared by GREATER" cleared -m reversed
check "so is its matrix" cleared -m gl-reversed --what projection --language numpy
clear=1 compare=LESS
check "standard depth is cleared to 1 and compared by LESS" cleared -m d3d

# One object: its code is what is printed without, and its bounds what that says.
json() {
    code "$@" >"$scratch/plain" && code "$@" --json >"$scratch/json" && python3 - "$scratch/plain" "$scratch/json" <<'END'
import json, re, sys
plain, said = open(sys.argv[1]).read(), json.load(open(sys.argv[2]))
print(said)
told = [float(n) for n in re.findall(r"(?:off|and \w+) by at most ([0-9.e-]*[0-9])", plain.replace("\n// ", " "))]
assert len(told) == len(said["bounds"]) > 0, told # each is rounded up
assert all(c["bound"] <= n <= 1.005 * c["bound"] for n, c in zip(told, said["bounds"])), told
assert said["code"] == plain and f'Clear depth to {said["clear"]};' in plain.replace("\n// ", " ") or said["what"] in ("pack", "normal")
assert said["rules"] + "." in plain.replace("\n// ", " ") or said["what"] == "projection"
assert said["comparison"] == ("greater" if said["clear"] == 0 else "less") and said["source"]
for claim in said["bounds"]:
    assert claim["function"].split(",")[0] in plain and (claim["nearest"] or 0) <= claim["bound"] and claim["of"]
assert (said["method"] is None) == (said["method_source"] is None)
END
}
check "JSON of a method" json -m d3d --language hlsl
check "JSON of places" json -m d3d --what position
check "JSON of a matrix" json --what projection
check "JSON of channels" json rg --what pack --language wgsl
check "JSON of a logarithm" json -m log --what encode

refused() { # refused WORDS OPTIONS
    words=$1
    shift
    code "$@" >"$scratch/out" 2>"$scratch/refused"
    [ $? -eq 2 ] && [ ! -s "$scratch/out" ] && grep -q -e "$words" "$scratch/refused" || { cat "$scratch/refused" && return 1; }
}
check "what a language lacks is refused with what it has" \
    refused 'fused is not in hlsl: it .*; there are magic, unity,' fused --language hlsl
check "so is binary64" refused 'double is not in wgsl: it computes in binary64; there are' double --language wgsl
check "and a table" refused 'table-linear is not in c: it is no formula' table-linear --language c
check "and what needs a far plane" refused 'textbook is not in glsl: it needs a finite far' textbook -f inf
check "a method that is none" refused "METHOD must be one of magic, .*, got 'foo'" foo
check "a matrix of a script" refused '--language: must be glsl, hlsl' --what projection --language gappa
check "uniforms of a matrix" refused '--uniforms: conflicts' --what projection --uniforms
check "uniforms of a proof" refused '--uniforms: conflicts with gappa' --uniforms --language gappa
check "codes of floats" refused '--format: must be unormN' --what encode -F fp32
check "codes by an instruction" refused 'f16c is not in glsl' f16c --what encode -F d16
check "a mapping without a matrix" refused '--mapping: must be one of' -m log --what projection
check "a method of a logarithm" refused 'one way for --mapping log, and no METHOD' -m log unity
check "a logarithm in a script" refused '--language: must be glsl, hlsl' -m log --language fpcore
check "channels in a script" refused '--language: must be glsl, hlsl' --what pack --language gappa
check "uniforms of channels" refused '--uniforms: conflicts with --what normal' --what normal --uniforms
check "channels that are none" refused "METHOD must be one of depth-normals, .*, got 'camera-normals'" camera-normals --what pack
check "normals that are none" refused "METHOD must be one of stereo-8, .*, got 'rg-depth'" rg-depth --what normal
check "several cameras" refused 'must be one' -m d3d,reversed
check "a method of a matrix" refused 'has no METHOD' unity --what projection
# What stands beside a constant is what it is: each formula evaluated, of near 0.5, far 800 and C 3.
formulas() {
    for what in linearize encode; do
        for line in '-m d3d' '-m reversed' '-m gl' '-m gl-reversed' '-m log --log-c 3' '-m cesium --log-c 3' '-m three-webgpu' \
            '--ortho -m d3d' '--ortho -m reversed' 'textbook -m d3d' 'unity -m d3d' 'linear-01 -m reversed' 'complement -m reversed'; do
            code $line --what $what -n 0.5 -f 800 2>/dev/null | sed -n 's|^ *const float \([A-Z]\) = \([^;]*\); // \(.*\)$|\1 \2 \3|p' |
                sed 's/ of the mapping$//'
        done
    done | sort -u >"$scratch/constants"
    {
        echo 'function log2(x) { return log(x)/log(2) }'
        echo 'function judge(name, is, want, said) { n++; if (is - want > 1e-6*a(want) || want - is > 1e-6*a(want)) print name, is, "is not", said }'
        echo 'function a(x) { return x < 0 ? -x : x }'
        echo 'BEGIN { near = 0.5; far = 800'
        while read -r constant value formula; do
            # C is 3 where it is asked for; of three-webgpu it is 1/near, which its formulas do not name.
            echo "C = 3; judge(\"$constant\", $value, $formula, \"$formula\")"
        done <"$scratch/constants"
        echo 'if (n < 12) print "only", n, "constants" }'
    } >"$scratch/constants.awk"
    awk -f "$scratch/constants.awk"
}
check "the formula beside each constant gives it" empty formulas


# The depth of infinity, 0 or 1, is in no domain; that of a finite far plane is.
domain() { "$DEPTHPREC" code --language fpcore -f "$1" -m "$2" | grep -cF ":pre ($3 0 d 1)" | grep -qx 1; }
for mapping in d3d reversed; do
    check "FPCore's domain of $mapping, far 1000" domain 1000 $mapping '<='
    check "FPCore's domain of $mapping, no far plane" domain inf $mapping '<'
done
finish
