#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The shell tests can fail: each is run with a tool, or with the program itself, that does nothing and pretends to be fine
# (exit 0) or, in make check-full, says so (exit 1). It must report at least so many failures; `all` but the skipped ones
# is as many as it has.
. tests/tap.sh

# test | what does nothing | its exit status | failures at least
cases='
fields.sh                    | jq        | 0 | all
fields.sh                    | depthprec | 0 | all
inputs.sh                    | depthprec | 0 | all
inputs.sh                    | jq        | 1 | 1
layers.sh                    | nm        | 0 | 2
layers.sh                    | objdump   | 0 | 1
needs.sh                     | jq        | 1 | 1
needs.sh                     | xmllint   | 1 | 1
needs.sh                     | depthprec | 0 | 2
headers.sh                   | cc        | 1 | 10
examples.sh                  | depthprec | 0 | 31
readme.sh                    | depthprec | 0 | 6
questions.sh                 | depthprec | 0 | all
plots.sh                     | depthprec | 0 | 110
same.sh                      | depthprec | 0 | 1
python.sh                    | python3   | 0 | 2
gappa.sh                     | depthprec | 1 | all
code.sh                      | depthprec | 0 | 20
judge_code.sh                | depthprec | 0 | 2
gappa.sh                     | gappa     | 0 | all
cli.sh tests/cli/help.txt    | depthprec | 0 | all
cli.sh tests/cli/solve.txt   | jq        | 1 | 1
cli.sh tests/cli/help.txt    | awk       | 1 | all
cli.sh tests/cli/help.txt    | diff      | 0 | 1
'
[ -z "${DEPTHPREC_FULL-}" ] || cases="$cases
fields.sh                    | jq        | 1 | all
fields.sh                    | comm      | 1 | all
fields.sh                    | depthprec | 1 | all
inputs.sh                    | depthprec | 1 | all
layers.sh                    | nm        | 1 | 2
layers.sh                    | objdump   | 1 | 1
needs.sh                     | depthprec | 1 | all
examples.sh                  | depthprec | 1 | 33
questions.sh                 | depthprec | 1 | all
plots.sh                     | depthprec | 1 | 110
python.sh                    | depthprec | 0 | 2
same.sh                      | depthprec | 1 | 1
cli.sh tests/cli/help.txt    | depthprec | 1 | all
install.sh                   | readelf nm | 0 | 4
install.sh                   | readelf   | 1 | 3
install.sh                   | nm        | 1 | 1
"

idle() { # idle STATUS NAME...: a folder with programs of these names that do nothing
    ends=$1
    shift
    folder=$scratch/idle/$(echo "$@" "$ends" | tr ' ' -)
    mkdir -p "$folder"
    for tool; do
        printf '#!/bin/sh\nexit %s\n' "$ends" >"$folder/$tool"
        chmod +x "$folder/$tool"
    done
}

bites() { # bites FAILURES TEST ARGUMENT...: exits non-zero, and so many tests fail
    least=$1
    shift
    ! sh "tests/$@" >"$scratch/out" 2>&1 || { echo "it passes" && return 1; }
    failed=$(grep -c '^not ok' "$scratch/out")
    passed=$(lines '^ok' "$scratch/out" | lines -vc '# SKIP')
    echo "$failed failed, $passed passed"
    case $least in
    all) [ "$failed" -gt 0 ] && [ "$passed" -eq 0 ] ;;
    *) [ "$failed" -ge "$least" ] ;;
    esac
}

untouched=$DEPTHPREC
path=${PATH#"$scratch/tools:"} compiler=$CC # the tests bring wrappers of their own
echo "$cases" >"$scratch/cases"
while IFS='|' read -r test name status least; do
    [ -n "$name" ] || continue
    name=$(echo $name) status=$(echo $status)
    # shellcheck disable=SC2086
    idle $status $name
    PATH=$folder:$path
    export DEPTHPREC="$untouched" CC="$compiler"
    [ "$name" != depthprec ] || DEPTHPREC=$folder/depthprec
    [ "$name" != cc ] || CC=$folder/cc
    # shellcheck disable=SC2086
    check "$(echo $test) with $name doing nothing, exit status $status" bites ${least# } $test
    PATH=$path
done <"$scratch/cases"
finish
