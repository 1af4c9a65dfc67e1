#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs tests side by side and tells of them in the order given:  run.sh TEST...
# A test is a program or a .sh that prints TAP lines. One that crashes, prints none, or stops before its plan counts
# as failed. JOBS and TEST_SECONDS change how many run at once and how long one may take (600 s; 3600 s in full).
set -u
LC_ALL=C CMOCKA_MESSAGE_OUTPUT=TAP
# A thread that waits takes no time of the test beside it.
OMP_WAIT_POLICY=${OMP_WAIT_POLICY-passive}
export LC_ALL CMOCKA_MESSAGE_OUTPUT OMP_WAIT_POLICY

if [ "${1-}" = --one ]; then # run.sh --one FOLDER NUMBER TEST
    folder=$2/$3
    test=$4
    started=$(date +%s.%N)
    case $test in
    *.sh) set -- sh "$test" ;;
    /*) set -- ${EMULATOR-} "$test" ;;
    *) set -- ${EMULATOR-} "./$test" ;;
    esac
    timeout "${TEST_SECONDS:-${DEPTHPREC_FULL:+3}600}" "$@" >"$folder.out" 2>&1 </dev/null
    status=$?
    awk -v status=$status -v started="$started" -v ended="$(date +%s.%N)" '
        /^(not )?ok .*# SKIP/ { skipped++; next }
        /^ok / { passed++ }
        /^not ok / { failed++ }
        /^1\.\.[0-9]+/ { planned += substr($1, 4) }
        END {
            seen = passed + failed + skipped
            if (status == 124) why = "took too long"
            else if (status > 128) why = "killed by signal " status - 128
            else if (seen == 0) why = "printed no test"
            else if (status != 0 && !failed) why = "exit status " status
            else if (planned > seen) why = "stopped after " seen " of " planned
            print passed + 0, failed + (why != ""), skipped + 0, ended - started, why
        }' "$folder.out" >"$folder.sum"
    mv "$folder.sum" "$folder.done"
    exit 0
fi

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'trap "" INT TERM; kill 0; exit 130' INT TERM
number=0
for test; do
    number=$((number + 1))
    echo "$number $test"
done | xargs -P "${JOBS:-$(nproc 2>/dev/null || echo 1)}" -L 1 sh "$0" --one "$folder" &
pool=$!

number=0 passed=0 failed=0 skipped=0
for test; do
    number=$((number + 1))
    until [ -e "$folder/$number.done" ]; do
        kill -0 $pool 2>/dev/null || [ -e "$folder/$number.done" ] || echo "0 1 0 0 not run" >"$folder/$number.done"
        sleep 0.05
    done
    read -r ok bad skip seconds why <"$folder/$number.done"
    passed=$((passed + ok)) failed=$((failed + bad)) skipped=$((skipped + skip))
    word=ok
    [ "$bad" -eq 0 ] || word=FAILED
    name=${test##*/}
    printf '  %-7s %-24s %5d passed' "$word" "${name%.sh}" "$ok"
    [ "$bad" -eq 0 ] || printf ', %d failed' "$bad"
    [ "$skip" -eq 0 ] || printf ', %d skipped' "$skip"
    printf ', %.1f s%s\n' "$seconds" "${why:+ ($why)}"
    [ "$bad" -eq 0 ] || sed '/^ok /d; s/^/      /' "$folder/$number.out"
    [ "$skip" -eq 0 ] || sed -n 's/^\(not \)*ok.*# SKIP/          skipped:/p' "$folder/$number.out"
done

total="$passed passed, $failed failed"
[ "$skipped" -eq 0 ] || total="$total, $skipped skipped"
echo "$total"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
