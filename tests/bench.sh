#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs benchmarks, PROGRAM [ARGUMENT] each, and counts their aims: the last line is "N aims met, N missed: which; N not
# measured: which, and why". Fails where a benchmark does, not where it is slow.
#
#     sh tests/bench.sh COMMAND...
DEPTHPREC_AIMS=$(mktemp) || exit 2
export DEPTHPREC_AIMS
trap 'rm -f "$DEPTHPREC_AIMS"' EXIT
failed=
for command; do
    sh -c "$command" || failed="$failed${failed:+, }$command"
done
echo
awk -F '\t' -v failed="$failed" '
    $1 == "met" { met++ }
    $1 == "missed" { which = which (missed++ ? "; " : ": ") $2 " (" $3 ")" }
    $1 == "unmeasured" { other = other (unmeasured++ ? "; " : ": ") $2 " (" $3 ")" }
    END {
        printf "%d aims met, %d missed%s", met, missed, which
        if (unmeasured) printf "; %d not measured%s", unmeasured, other
        print failed != "" ? "; failed: " failed : ""
    }
' "$DEPTHPREC_AIMS"
test -z "$failed"
