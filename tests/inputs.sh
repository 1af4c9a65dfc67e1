#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What a run reads is not overwritten: each way to name an input, with each option that writes a file, by the file's own
# name, a symbolic link and a hard one. The inputs' bytes are compared with copies; that such a line works, but for its
# output, is shown by the same line with a file of its own.
. tests/tap.sh

mkdir "$scratch/work" "$scratch/work/folder"
profiles=$PWD/tests/profiles models=$PWD/tests/models
cd "$scratch/work" || exit 1

cp "$profiles/llvmpipe.json" gpu.json
cp "$models/house.gltf" "$models/street.obj" .
printf '1.5 0 0 0\n0 2 0 0\n0 0 1.001 -0.1001\n0 0 1 0\n' >m.npy
cp m.npy m.txt
printf '0 2 30 0 2 0\n' >eyes.txt
echo 'cameras = { a = { near = 0.1; far = 1000; format = "fp32"; mapping = "reversed"; arith = "gpu.json"; }; };
requirements = { b = { camera = "a"; range = [1.0, 10.0]; separation = 1.0; }; };' >a.need
cp gpu.json folder
sed 's|gpu.json|folder/gpu.json|' a.need >b.need
"$DEPTHPREC" texture --synthetic plane -F unorm16 -m d3d -n 0.1 -f 10 --size 8x8 --product raw -o depth.png 2>/dev/null
cp depth.png depth.img
jq -r '.buffers[0].uri' house.gltf | sed 's/^[^,]*,//' | base64 -d >folder/house.bin
jq -c '.buffers[0].uri = "house.bin"' house.gltf >folder/house.gltf
printf 'newmtl a\nd 1\n' >folder/a.mtl
{ echo 'mtllib a.mtl'; cat street.obj; } >folder/a.obj

# input | command line, @ the output
cat >"$scratch/lines" <<'END'
gpu.json | table --arith gpu.json -F fp32 -m reversed -o @
gpu.json | budget --arith gpu.json -F fp32 -m reversed -o @
gpu.json | bias --viewport 640x480 --raster gpu.json -F fp32 -m reversed --at 5 -o @
gpu.json | plot error --arith gpu.json -F fp32 -m reversed --type svg -o @
gpu.json | zfight --arith gpu.json -F d16 -m d3d -f 10 -o @
gpu.json | scene house.gltf --arith gpu.json --emit-need @
gpu.json | check a.need -o @
folder/gpu.json | check b.need -o @
folder/gpu.json | check b.need --report junit -o @
gpu.json | plot needs a.need --type svg -o @
a.need | check a.need -o @
a.need | check - -o @ <a.need
a.need | plot needs a.need --type svg -o @
m.npy | texture depth.png -F unorm16 --matrix m.npy --product eye -o @
m.txt | texture depth.png -F unorm16 --matrix m.txt --json -o @
m.npy | texture depth.png -F unorm16 --matrix m.npy --type svg --figure @
m.npy | texture depth.png -F unorm16 --matrix m.npy --type svg --histogram @
depth.img | texture depth.img -n 0.1 -f 10 -F unorm16 -m d3d --json -o @
depth.img | texture - -n 0.1 -f 10 -F unorm16 -m d3d --json -o @ <depth.img
depth.png | texture depth.png -n 0.1 -f 10 -F unorm16 -m d3d --figure @
depth.png | texture depth.png -n 0.1 -f 10 -F unorm16 -m d3d --histogram @
depth.png | texture depth.png -n 0.1 -f 10 -F unorm16 -m d3d --product eye -o new.npy --error-map=@
eyes.txt | scene house.gltf --path eyes.txt -o @
eyes.txt | scene house.gltf --path eyes.txt --emit-need @
house.gltf | scene house.gltf -o @
house.gltf | scene house.gltf --emit-need @
house.gltf | scene house.gltf --report json -o @
house.gltf | plot scene house.gltf --type svg -o @
house.gltf | plot scene - --type svg -o @ <house.gltf
folder/house.bin | scene folder/house.gltf -o @
folder/house.bin | plot scene folder/house.gltf --type svg -o @
street.obj | scene street.obj --emit-need @
folder/a.mtl | scene folder/a.obj -o @
folder/a.mtl | scene folder/a.obj --emit-need @
END

run() { # run LINE OUTPUT
    eval "\"\$DEPTHPREC\" $(printf '%s' "$1" | sed "s|@|$2|g")" >out 2>err
}
works() { # works LINE: with a file of its own it is written, so that nothing else is what is refused
    rm -f "own$end"
    run "$1" "own$end"
    [ -s "own$end" ] || { cat err && return 1; }
}
left_alone() { # left_alone INPUT LINE
    cp "$1" before
    rm -f "soft$end" "hard$end"
    ln -s "$1" "soft$end"
    ln "$1" "hard$end"
    for written in "$1" "./$1" "soft$end" "hard$end"; do
        run "$2" "$written"
        status=$?
        [ $status -eq 2 ] || echo "$written: exit status $status"
        cmp -s before "$1" && cmp -s before "soft$end" && cmp -s before "hard$end" || echo "$written: overwritten"
        [ "$(grep -c 'file that is read' err)" = 1 ] && [ "$(wc -l <err)" -eq 1 ] || { echo "$written: said:" && cat err; }
        find . -name '.depthprec*'
        cp before "$1" && ln -f "$1" "hard$end" && ln -sf "$1" "soft$end"
    done
}
# "-" is stdout, also beside a file of that name, which is a file by any other spelling.
to_stdout() {
    for made in 'scene house.gltf -o - --emit-need @' 'scene house.gltf -o @ --emit-need -'; do
        rm -f ./- own
        run "$made" own && mv out alone && [ -s own ] && [ -s alone ] || { cat err && return 1; }
        for there in 1 2; do # not yet there, then written anew
            run "$made" ./- && cmp out alone && cmp ./- own || { echo "$made, $there:" && cat err && return 1; }
        done
    done
    cp house.gltf ./-
    run 'scene ./- -o -' && [ -s out ] && cmp ./- house.gltf || { cat err && return 1; }
    rm ./-
}
check "an output to stdout is no file, whatever is named -" to_stdout
while IFS='|' read -r input made; do
    input=${input% } made=${made# }
    case $input in *.npy | *.png) end=.${input##*.} ;; *) end= ;; esac
    check "works: $made" works "$made"
    check "$input is left alone: $made" empty left_alone "$input" "$made"
done <"$scratch/lines"
finish
