#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds for another processor, or Windows, and runs there, emulated:  cross.sh aarch64|s390x|windows
# aarch64 has an unsigned char, a long double of 113 bits and fuses what it may; s390x stores the highest byte first, too.
# The tests below run with few cases, and what the commands print there is compared, byte by byte, with what they print
# here. The libraries are Debian's, unpacked beside the objects: nothing but the compilers and qemu is installed.
# For Windows, whose C library has other functions and another long, tests/windows.sh runs in place of those tests.
set -u
LC_ALL=C
export LC_ALL

machine=$1
triplet=$machine-linux-gnu
case $machine in
aarch64) debian=arm64 ;;
*) debian=$machine ;;
esac
B=build/$machine
root=$PWD/$B/root

# Those that an instruction, a byte order or a C library could break, and that an emulator ends within a minute.
tests='batch elementary code depth format mapping setup model separation quotient published rasterizers estimate bias
decode effect effects_pixels image image_damage image_depths image_raw normal position recognise synthetic number report requirement options'

# ---- The other machine's libraries -------------------------------------------------------------------------------

packages() { # packages APT_ARGUMENTS...: apt-get for the other machine, with lists of its own
    apt-get -q -o APT::Architecture=$debian -o APT::Architectures=$debian -o APT::Sandbox::User=root \
        -o Dir::State::lists="$root.apt/lists" -o Dir::State::status="$root.apt/status" -o Dir::Cache="$root.apt" "$@"
}

libraries() {
    command -v apt-get >/dev/null || { echo "depthprec: make cross needs Debian's apt-get" >&2 && return 1; }
    echo "  GET     $root"
    rm -rf "$root" "$root.apt" && mkdir -p "$root.apt/lists/partial" "$root.apt/archives/partial" && : >"$root.apt/status"
    names="libgomp1 $(sh src/packages.sh --libraries check)"
    if ! packages update >"$root.log" 2>&1 ||
        ! packages install -y --download-only --no-install-recommends $names >>"$root.log" 2>&1; then
        tail -n 5 "$root.log" >&2
        echo "depthprec: could not be fetched for $debian: $names" >&2
        return 1
    fi
    for package in "$root.apt/archives"/*.deb; do dpkg-deb -x "$package" "$root" || return; done
    find "$root" -type l -lname '/*' -printf '%p %l\n' | while read -r link to; do ln -sfn "$root$to" "$link" || exit 1; done
    rm -rf "$root.apt" && : >"$root.done"
}

[ $machine = windows ] || [ -e "$root.done" ] || libraries || exit 1

# ---- Build ---------------------------------------------------------------------------------------------------------

here=build/depthprec there=$PWD/$B/depthprec emulator="qemu-$machine -L $root" programs=
if [ $machine = windows ]; then
    make --no-print-directory windows build/plain/depthprec || exit 1
    here=build/plain/depthprec there=$there.exe emulator=wine programs=tests/windows.sh tests=
    export LC_ALL=C.UTF-8 WINEPREFIX="$PWD/$B/wine" WINEDEBUG=-all
    wine "$there" --version >/dev/null 2>&1 || { echo "depthprec: wine cannot run $there" >&2 && exit 1; }
fi
for test in $tests; do programs="$programs $B/tests/test_$test"; done
pkgconfig=$root/usr/lib/$triplet/pkgconfig:$root/usr/share/pkgconfig
[ $machine = windows ] || PKG_CONFIG_SYSROOT_DIR=$root PKG_CONFIG_LIBDIR=$pkgconfig PKG_CONFIG_PATH='' \
    make --no-print-directory --output-sync=target -j"${JOBS:-$(nproc)}" B=$B AR=$triplet-ar \
    CC="${CCACHE:+$CCACHE }$triplet-gcc --sysroot=$root" all $programs || exit 1
make --no-print-directory --output-sync=target -j"${JOBS:-$(nproc)}" all || exit 1

# ---- The same bytes ----------------------------------------------------------------------------------------------

# One command a line. With `each KIND` before it, it is run with each name that `depthprec list KIND` has.
every='-m d3d,gl,reversed,gl-reversed'
synthetic='--size 96x54 --synthetic'
commands="
table --at 0.1:1000:log:2500 -F fp16,fp32,unorm16,unorm24,float5.10,unorm20 $every,linear,log --csv --full
table --at 0.1:1000:lin:500 -F all $every,linear,log --rounding zero --ortho --csv
table --at 0.1:1000:lin:500 -F all $every,linear,log --rounding even --csv
table -f inf --at 0.1:1e6:log:500 -F all -m d3d,reversed --model staged --csv
each arithmetic table --at 0.1:1000:log:100 -F all $every --model float --csv --arith
each transforms budget -n 0.3 -F all $every --at 17.25 --from-origin 1000 --csv --composition
list encodings --json
list methods --json
list presets --json
plot stability linearize --csv
plot stability interval --csv
zfight -n 1 -f 1.2 -F unorm16 -m d3d,reversed --csv
zfight -n 1 -f 1.5 -F fp16 --sample 2000 --separation 0.0001 --json
solve -f 1000 -F all $every --separation 0.01 --at 100 --json
solve --for distance -n 0.1 -F unorm24 -m d3d --separation 0.01 --json
bias --range 1:10 --separation 0.01 --csv
check village.need --csv
each synthetic texture -F unorm16 -m d3d --json $synthetic
each synthetic texture -F fp32 -m reversed --json $synthetic
each positions texture -o product.npy $synthetic sphere --product position:
each positions texture -o product.pfm $synthetic steps --error-map --product position:
each normals texture -o product.pfm $synthetic sphere --product normal:
each normals texture -o product.npy $synthetic sphere --error-map --product normal:
each effects texture -o product.png $synthetic steps --product effect:
each effects texture -o product.png $synthetic steps --parameter reference=10 --product effect:
texture -o product.png $synthetic steps --product effect:motion-blur --last-eye 1,0.5,-1 --last-look 2,0.5,18
texture -o product.npy $synthetic steps --product effect:motion-vector --last-eye 1,0.5,-1 --error-map=product.pfm
texture -o depth.png -F unorm16 $synthetic decals
texture depth.png --product normal:projective -o product.npy --error-map=product.pfm
texture depth.png --product linear01 -o product.npy --error-map=product.pfm
texture depth.png --product raw -o product.npy --error-map=product.pfm
texture depth.png --product eye -o eye.npy
texture depth.png --json
texture eye.npy --metric 1 --json
"
[ $machine != windows ] || commands="$commands
$(printf 'plot %s -o product.svg\n' distribution share error interval budget map stability normals world shadow fight)
plot needs engine.need -o product.svg
plot scene house.gltf -o product.svg
scene house.gltf -F d24 -m d3d --camera street --within 60
scene house.gltf -F d24 -m d3d --camera street --within 60 --render product.png --json
scene street.obj -F d24 -m d3d --within 60 --csv
shadow --json
prepass -F all -m d3d,reversed --json
world --at 10 --json
completions bash
bias --api all -F d24 --separation 2cm --at 300m
"

everything() { # everything FOLDER PROGRAM...: what the commands print and write, in that folder
    mkdir "$1" && cp tests/needs/*.need tests/models/*.* "$1" && cd "$1" || return
    shift
    echo "$commands" | while read -r word arguments; do
        names=
        case $word in
        '') continue ;;
        each)
            names=$(sed 1d "$scratch/${arguments%% *}" | cut -d, -f1)
            arguments=${arguments#* }
            ;;
        *) arguments="$word $arguments" ;;
        esac
        for name in ${names:-''}; do
            [ "$name" != "''" ] || name=
            case $arguments in *:) line=$arguments$name ;; *) line="$arguments $name" ;; esac
            echo "$line"
            "$@" $line </dev/null || echo "exit status $?"
            cksum depth.* eye.* product.* 2>/dev/null
            rm -f product.*
        done
    done
}

# ---- Run ----------------------------------------------------------------------------------------------------------

scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"; [ $machine != windows ] || wine wineboot -k >"$B/end" 2>&1' EXIT
for kind in $(echo "$commands" | sed -n 's/^each \([a-z]*\) .*/\1/p' | sort -u); do
    "$here" list $kind --csv >"$scratch/$kind" || exit 1
done
EMULATOR=$emulator OMP_NUM_THREADS=1 DEPTHPREC_QUICK=1
export EMULATOR OMP_NUM_THREADS DEPTHPREC_QUICK
# The method f16c is an instruction of x86-64, absent elsewhere.
(everything "$scratch/here" "$PWD/$here") 2>&1 | sed '/^encode,f16c,/d' >"$scratch/here.txt"
(everything "$scratch/there" $EMULATOR "$there") >"$scratch/there.txt" 2>&1 &
failed=0
sh tests/run.sh $programs || failed=1
wait # not at the end of a pipe, which Wine's services hold open
sed -i '/^encode,f16c,/d' "$scratch/there.txt"

# A refusal here must be one there, too, but a command that does not run at all proves nothing.
lines=$(wc -l <"$scratch/here.txt")
if grep '^exit status 1[0-9][0-9]' "$scratch/here.txt" || [ "$lines" -lt 100000 ]; then
    echo "  FAILED  the commands do not run here ($lines lines)"
    failed=1
elif cmp "$scratch/here.txt" "$scratch/there.txt"; then
    echo "  ok      what is printed and written: $lines lines are the same on $machine"
else
    diff "$scratch/here.txt" "$scratch/there.txt" | head -n 20
    echo "  FAILED  what is printed or written differs on $machine"
    failed=1
fi
exit $failed
