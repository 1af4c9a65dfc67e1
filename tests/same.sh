#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bytes elsewhere: with one thread and with three, under a locale that writes 0,5, with the C library's
# functions for processors without FMA, and on another processor (emulated: its reciprocal estimate is another one).
. tests/tap.sh

everything() { # everything PROGRAM...: what commands print that use threads, estimates, kernels or the C library's curves
    while read -r arguments; do
        echo "$arguments"
        # shellcheck disable=SC2086
        "$@" $arguments </dev/null || echo "exit status $?"
    done <<END
plot stability linearize --csv
table --at 0.5,10 -m d3d,reversed,log --csv
zfight -n 1 -f 1.5 -F unorm16 --sample 2000 --separation 0.0001
zfight -n 1 -f 1.5 -F unorm16 -m d3d --sample 60000 --json
zfight --rasterize -F fp32 -m d3d,reversed --range 1:9 --sample 20 --json
plot fight --csv
budget -n 0.3 --at 17.25 --json
solve -f 1000 -F unorm24 -m d3d --separation 0.01 --at 100
bias --range 1:10 --separation 0.01
texture --synthetic sphere --size 96x54 -F unorm16 -m d3d --json
plot map -F unorm24 --figure-size 320x240 -o $scratch/map.svg
plot share -F unorm24 -m d3d,log -o $scratch/share.svg
END
    cat "$scratch/share.svg" "$scratch/map.svg" && rm "$scratch/share.svg" "$scratch/map.svg"
}

everything "$DEPTHPREC" >"$scratch/here" 2>&1
check "the commands run here" sh -c '! grep "^exit status" "$1" && [ "$(wc -l <"$1")" -gt 500 ]' - "$scratch/here"

same() { # same VARIABLE=VALUE... PROGRAM...
    everything env "$@" >"$scratch/there" 2>&1
    cmp "$scratch/here" "$scratch/there" || diff "$scratch/here" "$scratch/there" | head -n 20
    cmp -s "$scratch/here" "$scratch/there"
}

check "with one thread" same OMP_NUM_THREADS=1 "$DEPTHPREC"
check "with three threads" same OMP_NUM_THREADS=3 OMP_DYNAMIC=false "$DEPTHPREC"

mkdir "$scratch/locales"
if localedef -i de_DE -f UTF-8 "$scratch/locales/de_DE.UTF-8" >"$scratch/log" 2>&1; then
    comma() { # the locale is one that has a comma
        [ "$(LOCPATH=$scratch/locales LC_ALL=de_DE.UTF-8 locale decimal_point)" = , ]
    }
    check "the locale writes a comma" comma
    check "in de_DE.UTF-8" same LOCPATH="$scratch/locales" LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 "$DEPTHPREC"
else
    skip "in de_DE.UTF-8" "localedef makes no de_DE here"
fi

check "the C library without FMA" same GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 "$DEPTHPREC"
if [ "${B##*/}" = build ] && command -v qemu-x86_64 >"$scratch/log" && [ "$(uname -m)" = x86_64 ]; then
    check "on a Nehalem, emulated" same OMP_NUM_THREADS=2 qemu-x86_64 -cpu Nehalem "$DEPTHPREC"
else
    skip "on another processor" "qemu-x86_64 is not installed"
fi
finish
