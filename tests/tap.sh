# SPDX-License-Identifier: GPL-3.0-or-later
# For shell tests:  . tests/tap.sh
# They run in the project's root; make hands them the program in DEPTHPREC, the build folder in B, the compiler in CC.

: "${B:=build}" "${CC:=cc}" "${DEPTHPREC:=$PWD/$B/depthprec}"
export LC_ALL=C
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
tests=0 failures=0

check() { # check NAME COMMAND...: one test, passed when the command exits 0; what it printed is shown when it fails
    name=$1
    shift
    tests=$((tests + 1))
    if "$@" >"$scratch/log" 2>&1; then
        echo "ok $tests - $name"
    else
        echo "not ok $tests - $name"
        sed 's/^/# /' "$scratch/log"
        failures=$((failures + 1))
    fi
}

skip() { # skip NAME REASON
    tests=$((tests + 1))
    echo "ok $tests - $1 # SKIP $2"
}

empty() { # empty COMMAND...: succeeds when the command prints nothing
    "$@" >"$scratch/empty"
    ! grep . "$scratch/empty"
}

finish() {
    echo "1..$tests"
    [ $failures -eq 0 ]
}
