#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What `make bench` ends with: one line that counts the aims and names those that are missed; and that the benchmarks
# judge none by themselves. Programs that stand for benchmarks note aims as tests/aims.c does.
. "${0%/*}/tap.sh"

stub() { # stub NAME STATUS LINE...: a benchmark that notes these aims
    name=$scratch/$1
    printf '#!/bin/sh\necho "a table of %s"\n' "$1" >"$name"
    status=$2
    shift 2
    for line; do printf "printf '%s\\\\n' >>\"\$DEPTHPREC_AIMS\"\n" "$line" >>"$name"; done
    echo "exit $status" >>"$name"
    chmod +x "$name"
}
stub quick 0 'met\ttable\t7 x, aim <= 8' 'met\tmap\t0.5 s, aim <= 1'
stub slow 0 'missed\tcensus\t1.07 x, aim >= 10' \
    'met\tarray\t1 L, aim <= 1.1' 'missed\ttable at any slant\t10 x, aim <= 8'
stub torn 3

last() { # last STATUS LINE NAMES...: the last line and the exit status of benchmarks
    want=$1 line=$2
    shift 2
    status=0
    (cd "$scratch" && sh "$root/tests/bench.sh" "$@") >"$scratch/said" || status=$?
    tail -n 1 "$scratch/said"
    [ $status -eq "$want" ] && [ "$(tail -n 1 "$scratch/said")" = "$line" ]
}
root=$PWD
check "all are met" last 0 '2 aims met, 0 missed' ./quick
check "those that are missed are named" last 0 \
    '3 aims met, 2 missed: census (1.07 x, aim >= 10); table at any slant (10 x, aim <= 8)' ./quick ./slow
stub bare 0 'met\ttable\t7 x, aim <= 8' 'unmeasured\tjudge\tthere is no driver'
check "what was not measured is named, with what is missing" last 0 \
    '1 aims met, 0 missed; 1 not measured: judge (there is no driver)' ./bare
check "a benchmark that fails is named, the others run" last 1 '2 aims met, 0 missed; failed: ./torn' ./torn ./quick
check "what a benchmark prints is shown" grep -q 'a table of quick' "$scratch/said"

runs() {
    make -n --no-print-directory bench B="$B" 2>/dev/null | sed -n ':a;/\\$/{N;s/\\\n//;ba};$p' >"$scratch/recipe" &&
        grep -q '^sh tests/bench.sh ' "$scratch/recipe" && grep -q "draw.sh $B/depthprec $B/bench pareto" "$scratch/recipe"
}
check "make bench ends with it" runs
each() { # every benchmark is in the recipe
    for f in tests/bench_*.c; do
        [ "$f" = tests/bench_empty.c ] || grep -q "${f%.c} " "$scratch/recipe" || { echo "$f" && return 1; }
    done
}
check "every benchmark is run" each
check "no benchmark judges an aim of its own" empty lines -nE '"(met|missed)"|<= %|>= %' tests/bench_*.c

# The library of the tests is there when they have been built.
judge() {
    printf '%s\n' '#include "aims.h"' '#include <math.h>' 'int main(void) {' 'aim_judge(AIM_TABLE, "", 8);' \
        'aim_judge(AIM_TABLE, "a", 8.01);' 'aim_judge(AIM_CENSUS, "b", 10);' 'aim_judge(AIM_CENSUS, "c", 9.99);' \
        'aim_judge(AIM_CENSUS, "d", (double)NAN);' 'return 0; }' >"$scratch/judge.c"
    # shellcheck disable=SC2086
    $CC -Itests -o "$scratch/judge" "$scratch/judge.c" tests/aims.c -lm || return 1
    DEPTHPREC_AIMS=$scratch/noted "$scratch/judge" >"$scratch/shown" || return 1
    cut -f 1,2 "$scratch/noted" | tr '\t' ' ' >"$scratch/judged"
    printf '%s\n' 'met table' 'missed table a' 'met census b' 'missed census c' 'missed census d' |
        cmp - "$scratch/judged"
}
check "an aim is met up to its limit; what was not measured is missed" judge
shown() {
    table='   <= 8 empty programs' census='   >= 10 times plain C'
    [ "$(cat "$scratch/shown")" = "$table  met$table  missed$census  met$census  missed$census  missed" ]
}
check "what is shown beside it" shown
finish
