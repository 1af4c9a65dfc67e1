#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Figures: the drawn gallery still says what the program computes; files, formats, errors, same bytes twice.
. tests/tap.sh
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"

facts() { sed -n '/^<title /p; /^<desc /p; /^<metadata>/,/^<.metadata>/p' "$1"; } # what an SVG says of itself, the command, the digest of its numbers
recipes() { sed -n '/^[a-z][^ ]*  *render /!s/^\([a-z][^ ]*\) .*/\1/p' plots/recipes; } # figures; pictures are in test_values_house.c
same_facts() { facts "$1" >"$scratch/a" && grep -q '^data: ' "$scratch/a" && facts "$2" | diff "$scratch/a" -; }
processor() { sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | sed q; } # nothing where the kernel does not say
names_where() { # names_where FIGURE WORDS: in the description's sentence of the camera
    sed -n '/^<desc id="desc">.*near 0.1, far 1000; [^.]*, 20[0-9][0-9]-[01][0-9]-[0-3][0-9]\./p' "$1" >"$scratch/desc"
    grep -F -e "$2" "$scratch/desc"
}
refuses() { # refuses STATUS WORDS ARGUMENT...: the exit status, and words of the one line on stderr
    status=$1 words=$2
    shift 2
    got=0
    "$DEPTHPREC" plot "$@" >"$scratch/out" 2>"$scratch/err" || got=$?
    cat "$scratch/err"
    [ $got -eq "$status" ] && [ "$(wc -l <"$scratch/err")" -eq 1 ] && grep -q -e "$words" "$scratch/err"
}

mkdir "$scratch/drawn"
check "every recipe draws" sh plots/draw.sh "$DEPTHPREC" "$scratch/drawn"
for drawn in $(recipes); do
    case $drawn in
    pareto-*) # times are of one machine and day, which the figure must name: the one drawn now, this machine and today
        check "$drawn names this machine and today" names_where "$scratch/drawn/$drawn.svg" "$(processor), $(date -u +%F)."
        check "plots/$drawn.svg names its machine and day" names_where "plots/$drawn.svg" "" ;;
    *)
        check "plots/$drawn.svg shows the words and numbers of today" same_facts "plots/$drawn.svg" "$scratch/drawn/$drawn.svg" ;;
    esac
    check "plots/README.md shows $drawn" grep -q "]($drawn.svg)" plots/README.md
done
for drawn in $(sed -n 's/^\([a-z][^ ]*\)  *render .*/\1/p' plots/recipes); do
    check "plots/README.md shows $drawn" grep -q "]($drawn.png)" plots/README.md
done
has_recipe() { recipes | grep -qx "$1"; }
for drawn in plots/*.svg; do
    check "$drawn has a recipe" has_recipe "$(basename "$drawn" .svg)"
done

# The comparison above can fail: another near plane, one part in a million away, is noticed.
"$DEPTHPREC" plot error -o "$scratch/a.svg" && "$DEPTHPREC" plot error -n 0.1000001 -o "$scratch/b.svg"
digest() { sed -n 's/^data: //p' "$1"; }
check "a changed number changes the digest" [ "$(digest "$scratch/a.svg")" != "$(digest "$scratch/b.svg")" ]

for figure in distribution share error interval budget map normals; do
    for ending in svg pdf png; do
        "$DEPTHPREC" plot $figure -F unorm24,fp32 -m reversed -o "$scratch/1.$ending"
        [ $ending = svg ] || [ -n "${DEPTHPREC_FULL-}" ] || continue
        "$DEPTHPREC" plot $figure -F unorm24,fp32 -m reversed -o "$scratch/2.$ending"
        check "$figure.$ending: the same bytes twice" cmp "$scratch/1.$ending" "$scratch/2.$ending"
    done
    check "$figure.svg: title, description, command" sh -c '
        grep -q "^<title id=\"title\">." "$1" && grep -q "^<desc id=\"desc\">.*near 0.1, far 1000" "$1" &&
        grep -qx "command: depthprec plot '$figure' -F unorm24,fp32 -m reversed" "$1"' - "$scratch/1.svg"
    check "$figure.pdf is a PDF without a date" sh -c 'head -c 5 "$1" | grep -q "%PDF-" && ! grep -aq CreationDate "$1"' - "$scratch/1.pdf"
    check "$figure.png: the command" sh -c 'head -c 4096 "$1" | tr "\0" " " | grep -aq "iTXtSource *depthprec plot '$figure' -F"' - "$scratch/1.png"
    check "$figure: as CSV" sh -c '
        "$1" plot '$figure' --csv -F unorm16 >"$2" && head -n 1 "$2" | grep -Eq "^(panel,)?(series,)?(z|near) \[."' - "$DEPTHPREC" "$scratch/csv"
    check "$figure: as JSON" sh -c '
        "$1" plot '$figure' --json -F unorm16 >"$2" && [ -s "$2" ] && jq -e ".figure == \"'$figure'\" and (.panels | length) > 0" "$2"
        ' - "$DEPTHPREC" "$scratch/json"
done
check "SOURCE_DATE_EPOCH dates a PDF" sh -c '
    SOURCE_DATE_EPOCH=86400 "$1" plot share -o "$2" && grep -aq "CreationDate (.*19700102000000" "$2"' - "$DEPTHPREC" "$scratch/dated.pdf"
if command -v xmllint >"$scratch/log" 2>&1; then
    check "SVG is well-formed, whatever the title" sh -c '
        "$1" plot share --title "a < b & \"c\" $(printf "\377\001") ü" -o "$2" && xmllint --noout "$2"' - "$DEPTHPREC" "$scratch/odd.svg"
fi

check "an unknown figure" refuses 2 "must be distribution, .*got 'eror'.*error" eror -o "$scratch/x.svg"
check "an unknown ending" refuses 2 "--output: must end in .svg, .pdf or .png, or --type say which, got" error -o "$scratch/x.gif"
check "no -o" refuses 2 "needs -o FILE" error
check "a folder that is not there" refuses 3 "" error -o "$scratch/none/x.svg"
check "a width too small" refuses 2 "--figure-size: must be .*from 320 to 8192" error --figure-size 100 -o "$scratch/x.svg"
check "a range outside the planes" refuses 2 "--range: " error --range 1:2000 -o "$scratch/x.svg"
check "--at where it has no meaning" refuses 2 "--at: " error --at 3 -o "$scratch/x.svg"
check "--at with two depths" refuses 2 "--at: must be one depth" map -F fp32 --at 3,4 -o "$scratch/x.svg"
check "too many set-ups for maps" refuses 2 "at most 8 set-ups, got" map -m d3d,gl,reversed -o "$scratch/x.svg"
check "distribution in the model float" refuses 2 "--model: float has no cells for the figure distribution" distribution --model float -o "$scratch/x.svg"
in_float() { # in the model float the error is what is guaranteed, as by default
    "$DEPTHPREC" plot error -F d24 --csv >"$scratch/default.csv" && "$DEPTHPREC" plot error -F d24 --model float --csv >"$scratch/float.csv" &&
        cmp "$scratch/default.csv" "$scratch/float.csv" && [ "$(wc -l <"$scratch/float.csv")" -gt 100 ]
}
check "error in the model float is what is drawn by default" in_float
check "map where auto chooses fp32" refuses 2 "--model: float has no cells for the figure map" map --model auto -F unorm24 -m d3d -o "$scratch/x.svg"
check "budget in another model" refuses 2 "--model: must be float in the figure budget, got 'staged'" budget --model staged -o "$scratch/x.svg"
check "budget of linear" refuses 2 "--mapping: a budget needs one of" budget -m linear -o "$scratch/x.svg"
check "--from-origin where it has no meaning" refuses 2 "--from-origin: does not apply to the figure share" share --from-origin 3 -o "$scratch/x.svg"
check "--tolerance without auto" refuses 2 "--tolerance: needs --model auto in the figure share" share --tolerance 1% -o "$scratch/x.svg"
check "too many budgets" refuses 2 "at most 8 set-ups" budget -m d3d,gl,reversed -o "$scratch/x.svg"
check "too many normals" refuses 2 "at most 4 set-ups, got 6" normals -F unorm16,unorm24,fp32 -m d3d,reversed -o "$scratch/x.svg"
within_bound() { # every point of projective on a plane has its bound above it
    "$DEPTHPREC" plot normals -F unorm16,unorm24,fp32 -m d3d --csv >"$scratch/csv" || return
    tr -d '\r' <"$scratch/csv" | awk -F, '
        NR > 1 && $7 != "" { points++; if (!($6 > 0 && $6 <= $7)) { print; passed++ } }
        END { exit !(points == 150 && !passed) }'
}
check "normals on a plane stay below their bound" within_bound
check "too many staircases" refuses 2 "at most 8 set-ups" distribution -F unorm2,unorm3,unorm4 -m d3d,gl,reversed -o "$scratch/x.svg"
check "nothing was left behind by the refused ones" [ ! -e "$scratch/x.svg" ]

counted() { # counted FIGURE ARGUMENT...: fewer evaluations than a third of the pixel columns
    "$DEPTHPREC" plot "$@" --full -o "$scratch/counted.svg" 2>&1 >"$scratch/log" | sed -n 's/.*: \([0-9]*\) evaluations.*would be \([0-9]*\)).*/\1 \2/p' >"$scratch/counts"
    read -r spent full <"$scratch/counts" && [ "$spent" -gt 0 ] && [ $((3 * spent)) -lt "$full" ]
}
for figure in distribution share error "interval --model exact"; do
    # shellcheck disable=SC2086 # words
    check "$figure: far fewer evaluations than pixel columns" counted $figure
done
method_of() { # of all series, or none
    "$DEPTHPREC" plot interval --json "$@" >"$scratch/json" &&
        jq -r '[.panels[].series[].method // empty] | unique | if . == [] then "none" else .[] end' "$scratch/json"
}
check "an interval that a pixel cannot show need not be exact" [ "$(method_of -F unorm24 -m d3d)" = rule-of-thumb ]
check "--tolerance 0 keeps to the cells" [ "$(method_of -F unorm24 -m d3d --tolerance 0)" = none ]
check "no method is claimed for other formats" [ "$(method_of -F unorm8 -m d3d --tolerance 50%)" = none ]
below_the_guarantee() { # every point of the census lies at or below the line that the guarantee is drawn as
    "$DEPTHPREC" plot interval --model float -n 1 -f 100 -F unorm24 -m d3d --csv >"$scratch/csv" || return
    tr -d '\r"' <"$scratch/csv" | awk -F , '
        NR > 1 && $2 != "" { x[++m] = $1; s[m] = $2 }
        NR > 1 && $3 != "" { z[++n] = $1; y[n] = $3 }
        END {
            for (i = 1; i <= n; i++)
                for (k = 1; k < m; k++)
                    if (x[k] <= z[i] && z[i] <= x[k + 1])
                        good += y[i] <= (s[k] > s[k + 1] ? s[k] : s[k + 1])
            exit !(n >= 6 && good >= n)
        }'
}
check "a census in the model float, no point of it above the guarantee" below_the_guarantee

pareto() { # pareto WANTED ARGUMENT...: all but the spread of the times, as "panel: series: label error" without digits
    wanted=$1
    shift
    "$DEPTHPREC" plot pareto "$@" --csv >"$scratch/csv" || return
    tr -d '\r' <"$scratch/csv" | sed 's/"\([^",]*\),\([^"]*\)"/\1\2/' |
        awk -F , 'NR > 1 && $2 !~ /spread/ { print $1 ": " $2 ": " $5 " " $4 }' >"$scratch/rows"
    cat "$scratch/rows"
    grep -qx -e "$wanted" "$scratch/rows"
}
check "an error without bound is no height of a panel" pareto ": dominated: floor inf" encode -F unorm24
check "nor is none a place on its axis" pareto ": on the Pareto front: same 0" encode -F fp32
check "what moving the bytes takes is no error" pareto ": moving the same bytes:  " encode -F fp32
check "of an orthographic camera" pareto "fp32 reversed: on the Pareto front: ortho-complement .*" linearize --ortho
check "a family is shown where a method keeps its claim" pareto "normal fp32 reversed: radians: on the Pareto front: medium .*"
check "each family" [ "$(sed -n 's/^\([a-z]*\) .*on the Pareto front.*/\1/p' "$scratch/rows" | sort -u | wc -l)" -eq 6 ]

ends_at() { # ends_at FAR WRITTEN: the coarsest cascade
    "$DEPTHPREC" plot shadow -f "$1" --json >"$scratch/json" && jq -r '.panels[-1].title' "$scratch/json" | grep -E "^Cascade 4: [0-9.]+ to $2, texel"
}
check "a cascade ends at 1000, not at 1e+03" ends_at 1000 1000
check "at 25000" ends_at 25000 25000

check "auto chooses the model of each curve" sh -c '
    "$1" plot interval --model auto -F unorm16,unorm24 -m d3d,log --json >"$2" &&
        jq -r ".panels[].series[].name" "$2" | sort -u | tr "\n" ";" | grep -qx "unorm16 d3d, exact;unorm16 log, exact;unorm24 d3d, float;unorm24 d3d, float, census;unorm24 d3d, float, lattice;unorm24 log, staged;"
    ' - "$DEPTHPREC" "$scratch/csv"

# A library that cannot be opened: who draws nothing does without, and is not kept waiting for it.
mkdir "$scratch/no-cairo"
: >"$scratch/no-cairo/libcairo.so.2"
without_cairo() { LD_LIBRARY_PATH=$scratch/no-cairo "$@"; }
check "a table needs no cairo" without_cairo "$DEPTHPREC" table -o "$scratch/table"
check "a figure's numbers need none" without_cairo "$DEPTHPREC" plot interval --csv -o "$scratch/table"
for type in svg pdf png; do
    check "$type needs cairo, and says so" without_cairo refuses 2 "a figure needs a library that is not there, libcairo.so.2: Debian's package libcairo2 has it" \
        interval -o "$scratch/drawn.$type"
done

# A failed run leaves the old figure as it was.
echo old >"$scratch/kept.svg"
"$DEPTHPREC" plot distribution -F unorm2,unorm3,unorm4 -m d3d,gl,reversed -o "$scratch/kept.svg" 2>"$scratch/log"
check "a failed run fails" [ $? -eq 2 ]
check "a failed run leaves the old file" grep -qx old "$scratch/kept.svg"
finish
