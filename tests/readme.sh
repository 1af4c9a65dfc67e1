#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# README.md keeps what it promises: its commands, its pages and links, its job for CI in somebody else's repository, and
# the numbers of its sentences. Its examples are run by examples.sh.
. tests/tap.sh
unset MAKEFLAGS MFLAGS MAKELEVEL

begins() { # within 12 lines a picture, a question, what it runs on and needs
    head -n 12 README.md >"$scratch/head" || return
    for words in '^| !\[.*](plots/house.png)' '?$' 'Runs on Linux' 'Needs make'; do
        grep -q -e "$words" "$scratch/head" || { echo "not in the first 12 lines: $words" && return 1; }
    done
}
missing_links() { # the files that links and pictures name and that are not there
    grep -oE '\]\([^)#]+\)' README.md | tr -d '])(' >"$scratch/links" && [ "$(wc -l <"$scratch/links")" -ge 6 ] || return
    while read -r file; do [ -e "$file" ] || echo "$file"; done <"$scratch/links"
}
missing_pages() { # the manual pages that it names and that are not made
    grep -oE 'man ([1-9] )?depthprec(-[a-z]+)?' README.md | sort -u >"$scratch/named" && [ -s "$scratch/named" ] || return
    while read -r man section name; do
        [ -n "$name" ] || { name=$section && section='[1-9]'; }
        ls "man/$name".$section >"$scratch/found" 2>&1 || echo "$man $name"
    done <"$scratch/named"
}
one_command_each() { # the second command is what .ci/run calls
    sed -n 's/^    \([a-z][^#]*[^# ]\) *#.*/\1/p' README.md >"$scratch/commands" || return
    printf 'make demo\nmake check\nsudo make install\n' | diff - "$scratch/commands" && grep -q '^make check ' .ci/run
}
check "a picture, what it is about, what it runs on: at once" begins
check "what links name is there" empty missing_links
check "the pages are there" empty missing_pages
check "one command builds, one tests, and CI calls it" one_command_each
check "no word that only its authors know" empty lines -in -e certified README.md

# ---- The job for CI, in a repository that has this one as a folder ----

theirs=$scratch/theirs
mkdir "$theirs" && ln -s "$PWD" "$theirs/depthprec"
sed -n '/^# game\.need$/,/^```/p' README.md | sed '$d' >"$theirs/game.need"
sed -n '/^# \.github/,/^```/s/^ *- run: //p' README.md >"$theirs/job"
job() { # job STATUS: the runs of the job, as a shell of theirs does them, end with this status
    [ "$(wc -l <"$theirs/job")" -eq 2 ] || return
    (cd "$theirs" && sh -e ./job)
    [ $? -eq "$1" ]
}
check "the job for CI passes" job 0
check "its report" grep -q 'testcase .*name="decals' "$theirs/depth.xml"
sed -i 's/0.1 mm/0.001 mm/' "$theirs/game.need"
check "it fails when the camera does not do" job 1

# ---- Numbers in sentences ----

cell() { # cell ROW COLUMN ARGUMENTS...: of the comparison at 5 km
    row=$1 column=$2
    shift 2
    "$DEPTHPREC" table -n 0.1 -f 10km -F d24,fp32 -m d3d,reversed --at 5km "$@" >"$scratch/table" || return
    awk -v row="$row" -v column="$column" 'index($0, row " ") == 1 { print $column; exit }' "$scratch/table"
}
says() { # says WORDS ROW VALUE ARGUMENTS...: README has the words, whose value the program prints
    grep -q -e "$1" README.md || { echo "not in README.md: $1" && return 1; }
    row=$2 value=$3
    shift 3
    cell "$row" 3 "$@" >"$scratch/cell" && cat "$scratch/cell" && [ "$(cat "$scratch/cell")" = "$value" ]
}
check "half a millimetre" says 'resolves half a millimetre' 'fp32 reversed' 4.9e-4
check "standard D24" says 'standard D24 31 m' 'unorm24 d3d' 31
check "reversed D24" says 'reversed D24 stays at 15 m' 'unorm24 reversed' 15
check "standard fp32" says 'standard fp32 at 31 m' 'fp32 d3d' 31
check "at a slant" says '86 mm at 5 km' 'fp32 reversed' 0.086 --viewport 1920x1080
# The table of models: each number is the one that the program has for it, in three digits.
models() {
    sed -n 's/^| `\(exact\|staged\|float\|--viewport\)` | [^|]* | \([0-9.]*\) mm | \([0-9.]*\) m | \([0-9.]*\) m .*/\1 \2 \3 \4/p' README.md >"$scratch/models"
    [ "$(wc -l <"$scratch/models")" -eq 4 ] || return
    while read -r model fp32 reversed standard; do
        case $model in --viewport) set -- "guarantee_slanted [scene]" --viewport 1920x1080 ;; *) set -- "separation [scene]" --model "$model" ;; esac
        column=$1
        shift
        "$DEPTHPREC" table -n 0.1 -f 10000 -F d24,fp32 -m d3d,reversed --at 5000 --csv "$@" 2>/dev/null |
            awk -F, -v column="$column" -v want="$fp32 $reversed $standard" '
                NR == 1 { for (i = 1; i <= NF; i++) if ($i == column) at = i; next }
                { got[$5 $4] = $at }
                END {
                    line = sprintf("%.3g %.3g %.3g", 1000 * got["fp32reversed"], got["unorm24reversed"], got["unorm24d3d"])
                    split(line, a, " "); split(want, b, " ")
                    for (i = 1; i <= 3; i++) if (a[i] == 0 || (a[i] - b[i]) / a[i] > 0.003 || (b[i] - a[i]) / a[i] > 0.003) { print line, "not", want; exit 1 }
                }' || return
    done <"$scratch/models"
}
check "the table of models" models
half_of_floats() { # the codes of 1e-19 and of 1, which are window depths near/z
    grep -q 'half of those$' README.md && grep -q 'below 1e-19' README.md || return
    "$DEPTHPREC" table -n 1e-12 -f inf -F fp32 -m reversed --at 1e-12,1e7 --csv >"$scratch/csv" || return
    cut -d , -f 9 "$scratch/csv" | tr '\n' ' ' | awk '
        { print; found = $1 == "code" && $2 > 0 && $3 / $2 > 0.5 && $3 / $2 < 0.51 }
        END { exit !found }'
}
check "half of all floats" half_of_floats
levels() { # of the sensor in its picture, as draw.sh makes the file
    grep -q '78 values.*20 at 1 m.*from 5.7 m on' README.md && cd "$scratch" &&
        "$DEPTHPREC" texture --synthetic plane --parameter distance=2,turn=45 --size 640x480 --product eye \
            --as stereo:575.816,0.075,0.125 -q -o z.npy &&
        "$DEPTHPREC" texture z.npy --metric 1m --product eye --as even:0.001 -q -o camera.npy &&
        "$DEPTHPREC" texture camera.npy --metric 1m -q --histogram levels.svg --csv >csv || return
    tr -d '\r' <csv | awk -F , '
        !($2 in first) { first[$2] = $4; print }
        $2 == "samples of the file" { of_78 += $4 == 78 ? 1 : -1 }
        $2 == "levels available" && $4 == 0 && !none { none = $3; print }
        END { exit !(of_78 > 0 && first["levels available"] == 20 && none > 5.6 && none < 5.7) }'
}
check "levels of a sensor" levels
finish
