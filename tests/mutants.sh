#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Changes of our own source that a user would see: tests/mutants.txt.
#   mutants.sh          a test of the table itself: no row is stale, no room is forgotten
#   mutants.sh --run    makes each change in a copy of the tree and says whether the tests notice it; `make mutants`
# TABLE is another table than that, ROOM=core and ONLY=regex choose rows, JOBS says how many copies work side by side (2), TEST_SECONDS how long one test
# may take (600). First come the tests that the row or the room names, then, unless NEAR=1, all others; the first that
# fails ends the row.
set -u

table=${TABLE-tests/mutants.txt}
mark=$(printf '\001') # between the fields of a row, which may hold anything that a line of C may hold

rows() { # rows: number, room, file, tests, old text, new text, what is seen, line of the table
    awk -v OFS="$mark" '
        function complain(what) { print "stale", "", $0, "", "", "", what, NR }
        /^#/ || /^$/ { next }
        /^[a-z]+: / { room = $1; sub(/:$/, "", room); near[room] = $0; sub(/^[a-z]+: */, "", near[room]); next }
        /^(src|include)\// {
            if (part != 0 && part != 4) complain("the row above is cut short")
            split($0, field, / *\| */)
            file = field[1]; tests = field[2]; line = NR; part = 1
            split(file, folder, "/")
            room = folder[1] == "include" ? "core" : folder[2]
            next
        }
        part == 1 && /^- ./ { old = substr($0, 3); part = 2; next }
        part == 2 && /^\+( |$)/ { new = substr($0, 3); part = 3; next }
        part == 3 && /^= ./ {
            part = 4
            print ++number, room, file, tests != "" ? tests : near[room], old, new, substr($0, 3), line
            next
        }
        { complain("neither file, -, + nor = where one is due") }
        END { if (part != 0 && part != 4) complain("the last row is cut short") }' "$table"
}

stale() { # stale: the rows whose old text is not there exactly once, and what else is wrong with the table
    rows | awk -F "$mark" -v table="$table" '
        function wrong(what) { print table ":" $8 ": " $3 ": " what }
        function times(file, text,    line, n, at) {
            while ((getline line <file) > 0)
                while ((at = index(line, text)) > 0) { n++; line = substr(line, at + 1) }
            close(file)
            return n + 0
        }
        $1 == "stale" { wrong($7); next }
        { n = times($3, $5) }
        n != 1 { wrong(n " times in the file: " $5) }
        $5 == $6 { wrong("changes nothing") }
        seen[$3, $5, $6]++ { wrong("there is such a row already") }
        {
            if (split($4, tests, " ") == 0) wrong("no test is near it")
            for (i in tests) {
                if (!(tests[i] in there)) {
                    find = "ls " (tests[i] ~ /^test_/ ? "tests/*/" tests[i] ".c" : "tests/" tests[i] ".sh") " 2>/dev/null"
                    there[tests[i]] = (find | getline line) > 0
                    close(find)
                }
                if (!there[tests[i]]) wrong("there is no " tests[i])
            }
        }'
}

# ---- The test of the table ---------------------------------------------------------------------------------------

if [ "${1-}" != --run ]; then
    . tests/tap.sh
    enough() { rows | wc -l | awk '{ print $1 " rows" } $1 < 150 { few = 1 } END { exit few }'; }
    forgotten() {
        rows | cut -d "$mark" -f 2 | sort -u >"$scratch/rooms"
        for room in src/*/; do
            grep -qx "$(basename "$room")" "$scratch/rooms" || echo "$room"
        done
    }
    check "each row of the table of changes finds its text once, and its tests" empty stale
    check "it has at least 150 rows" enough
    check "every room of src is among them" empty forgotten
    finish
    exit
fi

# ---- The run -----------------------------------------------------------------------------------------------------

unset MAKEFLAGS MAKELEVEL MFLAGS DEPTHPREC_FULL DEPTHPREC_QUICK
: "${CC:=cc}" "${TEST_SECONDS:=600}"
# The first failure ends a test: scripts', and cmocka's.
export CC TEST_SECONDS LC_ALL=C B=build FIRST_FAILURE=1 CMOCKA_TEST_ABORT=1

stale >&2
[ -z "$(stale)" ] || exit 1
make -j"${JOBS:-2}" --no-print-directory all check-programs npm web >&2 || exit 1

mkdir -p build/mutants
folder=$(mktemp -d "$PWD/build/mutants/XXXXXX") || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'trap "" INT TERM; kill 0; wait; exit 130' INT TERM

rows | ROOM=${ROOM-} ONLY=${ONLY-} awk -F "$mark" -v table="$table" '
    { text = table ":" $8 ": " $3 " | " $4 "\n- " $5 "\n+ " $6 "\n= " $7 }
    (ENVIRON["ROOM"] == "" || $2 == ENVIRON["ROOM"]) &&
    (ENVIRON["ONLY"] == "" || text ~ ENVIRON["ONLY"])' >"$folder/rows"
count=$(wc -l <"$folder/rows")
[ "$count" -gt 0 ] || { echo "no such row in $table" >&2 && exit 1; }

copy() { # copy TREE: what git and make know of the working tree, and its build, no older or newer than there
    mkdir -p "$1/build"
    for part in Makefile *.md LICENSE* .clang-format .ci include src tests man plots; do
        cp -a "$part" "$1"
    done
    for part in obj web npm dist tests depthprec depthprec.html libdepthprec.a libdepthprec.so.0 librooms.a libsupport.a \
        build.cflags build.libs check.cflags check.libs; do
        cp -a "build/$part" "$1/build"
    done
}

paths() { # paths TEST...: as run.sh and make want them
    for test; do
        case $test in
        test_*) echo "build/tests/$test" ;;
        *) echo "tests/$test.sh" ;;
        esac
    done
}

passes() { # passes TREE PATH EFFORT: whether that test passes there; EFFORT is 1 for the quick part of it
    (cd "$1" && export DEPTHPREC="$1/build/depthprec" DEPTHPREC_QUICK="$3" JOBS=1 &&
        sh tests/run.sh "$2" >mutants.log 2>&1 </dev/null)
}

# A test that fails without any change notices nothing.
sound() { # sound PATH EFFORT
    flag=$folder/sound.$(basename "$1")$2
    [ ! -e "$flag" ] || return 0
    passes "$folder/untouched" "$1" "$2" && : >"$flag"
}

# Quickly first and thoroughly then, the tests near by first and all then: most changes are noticed in seconds.
judge() { # judge TREE TEST...: prints what came of it
    tree=$1
    shift
    near=$(paths "$@")
    # shellcheck disable=SC2046
    make -C "$tree" all $(echo "$near" | sed -n '/^build/p; s|^tests/page.sh|web|p') >"$tree/mutants.log" 2>&1 ||
        { echo "error: it does not compile: $(grep -m 1 -i error "$tree/mutants.log" | cut -c 1-120)" && return; }
    tests=$near how=
    for round in 1 2 3 4; do
        if [ $round = 3 ]; then
            [ -z "${NEAR-}" ] || break
            make -C "$tree" check-programs >"$tree/mutants.log" 2>&1 ||
                { echo "error: the tests do not compile" && return; }
            tests=$(cd "$tree" && ls tests/*/test_*.c tests/*.sh |
                sed -n 's|^tests/[a-z]*/\(test_.*\)\.c$|build/tests/\1|p; /\.sh$/p')
            tests=$(echo "$tests" | grep -vxE "tests/(run|tap|coverage|cross|linked|page|bench|windows|dist|mutants)\.sh|$(echo "$near" | tr '\n' '|')-")
            how=', which is not named'
        fi
        quick=$((round % 2)) && quick=${quick#0}
        for test in $tests; do
            case $quick$test in
            1*.sh) continue ;; # there is no quick part of it
            esac
            passes "$tree" "$test" "$quick" && continue
            sound "$test" "$quick" || { echo "error: $test fails without any change" && return; }
            echo "noticed by $(basename "$test" .sh)$how"
            return
        done
    done
    echo "UNNOTICED"
}

change() { # change FILE OLD NEW
    old=$2 new=$3 awk '
        BEGIN { old = ENVIRON["old"]; new = ENVIRON["new"] }
        (at = index($0, old)) > 0 { $0 = substr($0, 1, at - 1) new substr($0, at + length(old)) }
        { print }' "$1" >"$1.new" && mv "$1.new" "$1"
}

work() { # work TREE: takes the next row that nobody has taken, until none is left
    copy "$1"
    while IFS=$mark read -r number room file tests old new seen line; do
        mkdir "$folder/taken.$number" 2>/dev/null || continue
        started=$(date +%s)
        cp "$1/$file" "$1/kept"
        change "$1/$file" "$old" "$new"
        # shellcheck disable=SC2086
        verdict=$(judge "$1" $tests)
        cp "$1/kept" "$1/$file" # newer than what was made of the change, so make makes it again
        printf '%s\n' "$room$mark$verdict$mark$table:$line: $file$mark$old$mark$new$mark$seen" \
            >"$folder/verdict.$number" # echo would take the backslashes
        printf '  %3d of %d  %3d s  %-48s %s\n' "$(find "$folder" -maxdepth 1 -name 'verdict.*' | wc -l)" "$count" \
            $(($(date +%s) - started)) "$file:$line" "$verdict" >&2
    done <"$folder/rows"
}

copy "$folder/untouched"
workers=
for number in $(seq "${JOBS:-2}"); do
    work "$folder/$number" &
    workers="$workers $!"
done
# shellcheck disable=SC2086
wait $workers

cat "$folder"/verdict.* | awk -F "$mark" -v count="$count" '
    { rooms[$1]; all++ }
    $2 ~ /^noticed/ { noticed[$1]++; next }
    { $2 ~ /^error/ ? wrong[$1]++ : unnoticed[$1]++; print $3 ": " $2 "\n- " $4 "\n+ " $5 "\n= " $6 "\n" }
    END {
        for (room in rooms) {
            printf "%-9s %3d noticed, %d unnoticed, %d in error\n", room, noticed[room], unnoticed[room], wrong[room] | \
                "sort"
            bad += unnoticed[room] + wrong[room]
        }
        close("sort")
        print all - bad " of " count " changes noticed"
        exit all != count || bad > 0
    }'
