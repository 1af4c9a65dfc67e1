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
. tests/tap.sh

root=$PWD
mkdir "$scratch/bin"
ln -s "$DEPTHPREC" "$scratch/bin/depthprec"
PATH=$scratch/bin:$PATH
unset NO_COLOR LANGUAGE LANG POSIXLY_CORRECT
export TERM=dumb

start_case() {
    rm -rf "$scratch/case"
    mkdir -p "$scratch/case/work"
    : >"$scratch/case/command"
    : >"$scratch/case/stdout"
    : >"$scratch/case/stderr"
    title='' tool=''
}

run_case() { # leaves got.stdout, got.stderr, got.status in the case's folder
    (cd "$scratch/case/work" && sh ../command >../got.stdout 2>../got.stderr </dev/null)
    status=$?
    # What a shell says about itself names a path that is new in every run.
    sed "s|$scratch/case/work|.|g" "$scratch/case/got.stderr" >"$scratch/case/got.stderr.plain"
}

compare() { # compare EXPECTED_STATUS
    if [ "$status" != "$1" ]; then
        echo "exit status $status, expected $1"
        cat "$scratch/case/got.stderr.plain"
        return 1
    fi
    empty too_wide "$scratch/case/command" "$scratch/case/got.stdout" || return
    diff "$scratch/case/stdout" "$scratch/case/got.stdout" && diff "$scratch/case/stderr" "$scratch/case/got.stderr.plain"
}

record() {
    [ -z "$tool" ] || echo "? $tool"
    sed 's/^/$ /' "$scratch/case/command"
    sed 's/^/| /; s/ $//' "$scratch/case/got.stdout"
    sed 's/^/! /' "$scratch/case/got.stderr.plain"
    echo "= $status"
}

end_case() { # end_case EXPECTED_STATUS
    if [ -n "$tool" ] && ! command -v "$tool" >/dev/null; then
        skip "$title" "$tool is not installed"
    else
        run_case
        check "$title" compare "$1"
    fi
    [ -z "${RECORD-}" ] || record >>"$scratch/record"
    start_case
}

[ $# -gt 0 ] || set -- tests/cli/*.txt
for file; do
    start_case
    : >"$scratch/record"
    while IFS= read -r line; do
        case $line in
        '# '*) title=${line#??} ;;
        '? '*) tool=${line#??} ;;
        '$ '*) printf '%s\n' "${line#??}" >>"$scratch/case/command" ;;
        '| '*) printf '%s\n' "${line#??}" >>"$scratch/case/stdout" ;;
        '|') echo >>"$scratch/case/stdout" ;;
        '! '*) printf '%s\n' "${line#??}" >>"$scratch/case/stderr" ;;
        '= '*) end_case "${line#??}" ;;
        esac
        case $line in
        '? '* | '$ '* | '|'* | '! '* | '= '*) ;;
        *) printf '%s\n' "$line" >>"$scratch/record" ;;
        esac
    done <"$file"
    [ -z "${RECORD-}" ] || cp "$scratch/record" "$root/$file"
done
finish
