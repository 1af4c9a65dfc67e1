#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Each public header compiles alone and twice over, as C11 and as C++17, with the strictest warnings.
. tests/tap.sh

strict="-Iinclude -pedantic -Wall -Wextra -Wconversion -Werror -fsyntax-only"

alone() { # alone HEADER COMPILER...
    header=$1
    shift
    printf '#include "depthprec/%s"\n#include "depthprec/%s"\n' "$header" "$header" | "$@" $strict -
}

for path in include/depthprec/*.h; do
    header=${path##*/}
    check "$header as C11 ($CC)" alone "$header" $CC -std=c11 -x c
    for cxx in g++ clang++; do
        ! command -v $cxx >/dev/null 2>&1 || check "$header as C++17 ($cxx)" alone "$header" $cxx -std=c++17 -x c++
    done
done
command -v g++ >/dev/null 2>&1 || command -v clang++ >/dev/null 2>&1 || skip "as C++17" "no C++ compiler"
finish
