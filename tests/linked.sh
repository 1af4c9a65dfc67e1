#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the README's example as the README says, against the library that pkg-config finds, runs it, and compares what
# it prints:  linked.sh FOLDER
set -eu
cd "$(dirname "$0")/.."
folder=$1

awk -v folder="$folder" '
    /^<!-- file: ten\.c -->/ { found = 1 }
    !found { next }
    /^```/ { fences++; next }
    fences == 1 { print >(folder "/ten.c") }
    fences == 3 && /^\$ / { print substr($0, 3) >(folder "/command"); next }
    fences == 3 { print >(folder "/want") }
    fences == 4 { exit }' README.md
grep -q 'pkg-config --cflags --libs depthprec' "$folder/command"
cd "$folder"
sed "s|^cc |${CC:-cc} |" command >run
sh -e run >got
cat got
diff want got
