#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The command line, to the byte. A case of tests/cli/*.txt is
#     # what it shows           its name
#     ? TOOL                    skipped where TOOL is not installed (optional)
#     $ shell command           one line or several; `depthprec` is the program, the folder is new and empty
#     | line of stdout
#     ! line of stderr
#     = exit status             ends the case
# cli.sh FILE... runs these files alone. RECORD=1 sh tests/cli.sh writes what came out into the files instead: judge that
# with git diff.
#
# A case costs a shell and what it runs, no more: one awk takes the files apart, one diff compares all that came out.
# Case N is run in run/N/work; want/N and got/N hold its stdout, stderr and status, run/N/wrong what is wrong with it.
. tests/tap.sh

mkdir "$scratch/bin" "$scratch/run" "$scratch/want" "$scratch/got"
ln -s "$DEPTHPREC" "$scratch/bin/depthprec"
PATH=$scratch/bin:$PATH
unset NO_COLOR LANGUAGE LANG POSIXLY_CORRECT
export TERM=dumb

take_apart() { # take_apart FILE...: writes command, stdout, stderr and status of each case; prints number, tool or -, name
    awk -v at="$scratch" '
        function clear() { title = command = out = err = ""; tool = "-" }
        function put(text, file) { printf "%s", text >file; close(file) }
        FNR == 1 { clear() }
        { rest = substr($0, 3) "\n" }
        /^# / { title = substr($0, 3) }
        /^\? / { tool = substr($0, 3) }
        /^\$ / { command = command rest }
        /^\| / || $0 == "|" { out = out rest }
        /^! / { err = err rest }
        /^= / {
            number++
            put(command, at "/run/" number "/command")
            put(out, at "/want/" number "/stdout")
            put(err, at "/want/" number "/stderr")
            put(rest, at "/want/" number "/status")
            print number, tool, title
            clear()
        }' "$@"
}

run_cases() {
    while read -r number tool title; do
        if [ "$tool" != - ] && ! command -v "$tool" >/dev/null; then
            cp "$scratch/want/$number"/* "$scratch/got/$number"
            continue
        fi
        (cd "$scratch/run/$number/work" &&
            exec sh ../command >"$scratch/got/$number/stdout" 2>"$scratch/got/$number/stderr" </dev/null)
        echo $? >"$scratch/got/$number/status"
        [ ! -s "$broken" ] || { cp "$broken" "$scratch/run/$number/wrong" && : >"$broken"; }
    done <"$scratch/cases"
    # What a shell says about itself names a path that is new in every run.
    for file in $(lines -lF "$scratch/run/" "$scratch"/got/*/stderr); do
        sed "s|$scratch/run/[0-9]*/work|.|g" "$file" >"$scratch/plain" && mv "$scratch/plain" "$file"
    done
}

compare() { # adds to what is wrong with each case what differs, and lines that are too wide
    (cd "$scratch" && diff -r want got) >"$scratch/apart"
    awk -v at="$scratch" '
        match($0, /^(diff -r|Binary files|Only in) (want|got)\/[0-9]+/) { split(substr($0, 1, RLENGTH), part, "/") }
        { print >(at "/run/" part[2] "/wrong") }' "$scratch/apart"
    # shellcheck disable=SC2046
    (cd "$scratch" && too_wide $(awk '{ print "run/" $1 "/command", "got/" $1 "/stdout" }' cases)) >"$scratch/wide"
    while IFS= read -r line; do
        number=${line#got/}
        printf 'too wide: %s\n' "$line" >>"$scratch/run/${number%%/*}/wrong"
    done <"$scratch/wide"
}

fine() { # fine NUMBER
    [ ! -e "$scratch/run/$1/wrong" ] || { cat "$scratch/run/$1/wrong" && return 1; }
}

record() { # record FILE NUMBER: prints the file with what came out of its cases, the first of which has that number
    awk -v at="$scratch" -v number="$2" '
        function show(sign, file,    line) {
            while ((getline line <file) > 0) print sign == "| " && line == "" ? "|" : sign line
            close(file)
        }
        /^[$!] / || /^\|/ { next }
        /^= / {
            show("$ ", at "/run/" number "/command")
            show("| ", at "/got/" number "/stdout")
            show("! ", at "/got/" number "/stderr")
            show("= ", at "/got/" number++ "/status")
            next
        }
        { print }' "$1"
}

[ $# -gt 0 ] || set -- tests/cli/*.txt
count=$(cat "$@" | lines -c '^= ')
seq 0 "$count" | (cd "$scratch" && sed 's|.*|run/&/work want/& got/&|' | xargs mkdir -p)
echo "what differs" >"$scratch/want/0/status" # case 0: it must be noticed
take_apart "$@" >"$scratch/cases"
run_cases
compare

[ -s "$scratch/run/0/wrong" ] || check "what differs is noticed" false
[ "$(wc -l <"$scratch/cases")" -eq "$count" ] || check "all $count cases are run" false
while read -r number tool title; do
    if [ "$tool" != - ] && ! command -v "$tool" >/dev/null; then
        skip "$title" "$tool is not installed"
    else
        check "$title" fine "$number"
    fi
done <"$scratch/cases"

number=1
for file in ${RECORD:+"$@"}; do
    record "$file" $number >"$scratch/recorded" && cp "$scratch/recorded" "$file"
    number=$((number + $(lines -c '^= ' "$file")))
done
finish
