# SPDX-License-Identifier: GPL-3.0-or-later
# For shell tests:  . tests/tap.sh
# They run in the project's root; make hands them the program in DEPTHPREC, the build folder in B, the compiler in CC.
# FIRST_FAILURE=1 ends them at the first test that fails.

: "${B:=build}" "${CC:=cc}" "${DEPTHPREC:=$PWD/$B/depthprec}"
export LC_ALL=C
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
tests=0 failures=0

# A pipe hides the exit status of all its programs but the last. So these stand behind a wrapper that notes a status that
# is neither 0 nor that of a reader who had enough; a test in whose time something was noted has failed.
broken=$scratch/broken
: >"$broken"
mkdir "$scratch/tools"
for tool in awk comm cut jq nm objdump readelf sed sort tr; do
    real=$(command -v $tool) || continue
    printf '#!/bin/sh\n%s "$@"\ns=$?\n[ $s -eq 0 ] || [ $s -eq 141 ] || echo "%s: exit status $s" >>"%s"\nexit $s\n' \
        "$real" $tool "$broken" >"$scratch/tools/$tool"
done
chmod +x "$scratch/tools"/*
PATH=$scratch/tools:$PATH

check() { # check NAME COMMAND...: one test, passed when the command exits 0; what it printed is shown when it fails
    name=$1
    shift
    tests=$((tests + 1))
    if "$@" >"$scratch/log" 2>&1 && [ ! -s "$broken" ]; then
        echo "ok $tests - $name"
    else
        echo "not ok $tests - $name"
        cat "$scratch/log" "$broken" | while IFS= read -r line; do printf '# %s\n' "$line"; done
        : >"$broken"
        failures=$((failures + 1))
        [ -z "${FIRST_FAILURE-}" ] || finish || exit # of one that wants no more
    fi
}

manual() { # manual FOLDER: the manual pages there, completed by the program
    mkdir -p "$1" && for source in man/*.[1-9]; do
        sh man/fill.sh "$DEPTHPREC" "$source" >"$1/${source##*/}" || return
    done
}

skip() { # skip NAME REASON
    tests=$((tests + 1))
    echo "ok $tests - $1 # SKIP $2"
}

empty() { # empty COMMAND...: succeeds when the command does and prints nothing
    "$@" >"$scratch/empty" || { echo "exit status $? of $1" && return 1; }
    ! grep . "$scratch/empty"
}

lines() { # lines GREP_ARGUMENTS...: grep for which it is fine to find nothing, but not to go wrong
    grep "$@" || [ $? -eq 1 ]
}

# Text is 80 columns wide. Wider by design are JSON, CSV, JUnit, --full, colours, what a shell reads, links, and messages,
# a line each.
too_wide() { # too_wide COMMANDS TEXT [COMMANDS TEXT]...: prints the lines of texts that are too wide for what their commands ask for
    awk 'BEGIN {
        for (i = 1; i < ARGC; i += 2) {
            free = 0
            while ((more = (getline line <ARGV[i])) > 0) free = free || line ~ /--(json|csv|full|report|color|link)|completions/
            if (more < 0) print ARGV[i] ": cannot be read"
            while ((more = (getline line <ARGV[i + 1])) > 0)
                if (!free && length(line) > 80 && line !~ /^depthprec: /) print ARGV[i + 1] ": " line
            if (more < 0) print ARGV[i + 1] ": cannot be read"
            close(ARGV[i]); close(ARGV[i + 1])
        }
    }' "$@"
}

finish() {
    [ ! -s "$broken" ] || check "the tools work to the end" true
    echo "1..$tests"
    [ $failures -eq 0 ]
}
