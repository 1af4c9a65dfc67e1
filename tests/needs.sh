#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The project's own requirement file: the regression test of the error bounds, as a project's CI would run it.
. tests/tap.sh
export DEPTHPREC

check "the example's requirements are met" "$DEPTHPREC" check tests/needs/engine.need
check "as JSON, all passed" sh -c '
    "$DEPTHPREC" check tests/needs/engine.need --json >"$1" && [ -s "$1" ] && jq -e ".passed and (.requirements | length) == 7" "$1"' - "$scratch/json"
check "as JUnit, well-formed" sh -c '
    "$DEPTHPREC" check --report junit tests/needs/*.need >"$1"
    [ $? -le 1 ] && xmllint --noout "$1" && grep -q "<testcase" "$1"' - "$scratch/junit"
finish
