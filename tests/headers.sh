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
# Who reads one line about a function in an editor reads its first sentence: it says what, of what, by itself.
unreadable() { # functions without a comment of their own, or one that begins by leaning on what stands above it
    for path in include/depthprec/*.h; do
        awk -v path="$path" '
            /^\/\*\*/ { text = "" }
            /^(\/\*\*| \*)/ { text = text " " $0 }
            /^$/ { text = "" }
            /^DP_API/ {
                gsub(/\/\*\*| \*\/?/, " ", text)
                gsub(/  */, " ", text)
                first = substr(text, 2)
                if (first !~ /^[A-Z][a-z-]* [a-z`]/ || first ~ /^(The same|That of|Those of|Everything above|It|This|Its) /)
                    print path ": " $0 ": \"" substr(first, 1, 60) "\""
                text = ""
            }' "$path"
    done
}
check "the first sentence about each function can be read alone" empty unreadable

command -v g++ >/dev/null 2>&1 || command -v clang++ >/dev/null 2>&1 || skip "as C++17" "no C++ compiler"
finish
