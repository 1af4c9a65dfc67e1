#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every function of one depth that `code` prints in C, for cameras of all kinds, is compiled, run at exactly the depths of
# `judge --pairs-for`, and judged right.
. tests/tap.sh

cameras='
-n 0.1 -f 1000 -m d3d
-n 0.1 -f 1000 -m reversed
-n 0.1 -f 10 -m gl
-n 1 -f 20000 -m gl-reversed
-n 0.01 -f 1e6 -m d3d
-n 0.01 -f 1e6 -m reversed
-n 0.3 -f inf -m d3d
-n 0.3 -f inf -m reversed
-n 1 -f inf -m gl-reversed
-n 0.001 -f inf -m gl
-n 5 -f 6 -m gl
'
curves='
-n 0.1 -f 1000 -m linear
-n 0.5 -f 1 -m linear
-n 0.1 -f 1000 -m log
-n 0.1 -f 1000 -m log --log-c 0.01
-n 1 -f 1e9 -m three-webgl
-n 0.1 -f 1000 -m three-webgpu
-n 1 -f 1000 -m three-webgpu
-n 0.1 -f 1e8 -m cesium
-n 1 -f 1000 -m cesium
-n 0.5 -f 60000 -m osgearth
'
ortho='
-n 0.1 -f 1000 -m d3d --ortho
-n 0.1 -f 10 -m gl-reversed --ortho
-n 0 -f 100 -m reversed --ortho
-n -50 -f 50 -m d3d --ortho
-n 0.5 -f 20 -m gl --ortho
'
count=0
: >"$scratch/cases"
: >"$scratch/all.c"
add() { # add JUDGED CODE...: a function, and how it is judged
    judged=$1
    shift
    "$DEPTHPREC" code --language c "$@" >"$scratch/code.c" 2>"$scratch/refused" || {
        grep -qE 'is not in c: it |METHOD must be one of' "$scratch/refused" && return
        cat "$scratch/refused"
        exit 1
    }
    count=$((count + 1))
    name=$(sed -n "s/^static inline [a-z0-9_]* \([a-z_]*\)(.*/\1/p" "$scratch/code.c")
    cp "$scratch/code.c" "$scratch/$count.c"
    printf '#define %s f%d\n#include "%d.c"\n#undef %s\n' "$name" $count $count "$name" >>"$scratch/all.c"
    printf '%s\t%s\n' "$judged" "$*" >>"$scratch/cases"
}

methods=$("$DEPTHPREC" methods linearize --csv --sample 1 2>/dev/null | awk -F, 'NR > 1 { print $1 }' | sort -u)
[ "$(echo "$methods" | wc -l)" -ge 8 ] || methods='magic unity complement-unity linear-01 linear-01-near textbook complement fused double phi-double'
echo "$cameras" | grep . >"$scratch/cameras"
while read -r camera; do
    for method in $methods; do add "$camera" "$method" $camera; done
done <"$scratch/cameras"
echo "$curves$ortho" | grep . >"$scratch/cameras"
while read -r camera; do
    add "$camera" $camera
    case $camera in *--ortho) ;; *) add "$camera" $camera --what encode ;; esac
done <"$scratch/cameras"
for format in unorm8 unorm16 unorm20 unorm24; do
    for method in floor rint floor-double rint-double; do
        for camera in '-m d3d' '-m reversed -f inf' '-m gl --ortho'; do
            add "$camera -F $format" "$method" --what encode -F $format ${camera%% -[f-]*}
        done
    done
done

"$DEPTHPREC" judge --pairs-for 64 -o "$scratch/depths"
{
    printf '#include <math.h>\n#include <stdint.h>\n#include <stdio.h>\n#include <stdlib.h>\n'
    cat "$scratch/all.c"
    cat <<'END'
static float depth[64];
#define RUN(f)                                                                                                         \
    do {                                                                                                               \
        FILE *out = fopen(#f ".csv", "w");                                                                             \
        for (int i = 0; i < 64; i++)                                                                                   \
            fprintf(out, "%.9g,%.10g\n", (double)depth[i], (double)f(depth[i]));                                       \
        fclose(out);                                                                                                   \
    } while (0)
int main(void) {
    char line[64];
    FILE *in = fopen("depths", "r");
    for (int n = -1; n < 64 && fgets(line, sizeof line, in) != NULL; n++)
        if (n >= 0)
            depth[n] = strtof(line, NULL);
END
    for i in $(seq $count); do echo "    RUN(f$i);"; done
    echo '}'
} >"$scratch/main.c"

compiled() {
    cd "$scratch" && $CC -std=c11 -O1 -ffp-contract=off -o run main.c -lm && ./run
}
right() { # prints what is not judged right
    i=0
    while IFS='	' read -r judged code; do
        i=$((i + 1))
        "$DEPTHPREC" judge --pairs "$scratch/f$i.csv" $judged >"$scratch/verdict"
        grep -q '^right: ' "$scratch/verdict" || { echo "$code" && head -n 3 "$scratch/verdict"; }
    done <"$scratch/cases"
}
check "$count functions are compiled and run" compiled
check "there are enough of them" [ $count -ge 140 ]
check "each is judged right" empty right
finish
