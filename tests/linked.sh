#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the first example of depthprec(3) as it says, against the library that pkg-config finds, runs it, and compares what
# it prints:  linked.sh FOLDER
set -eu
cd "$(dirname "$0")/.."
folder=$1

awk -v folder="$folder" '
    /^\.\\" file: example\.c/ { found = 1 }
    !found { next }
    /^\.(Bd|Ed)/ { ends++; next }
    ends == 4 { exit }
    { gsub(/\\e/, "\\") }
    ends == 1 { print >(folder "/example.c") }
    ends == 3 && /^[$>] / { print substr($0, 3) >(folder "/command"); next }
    ends == 3 { print >(folder "/want") }' man/depthprec.3
grep -q 'pkg-config --cflags --libs depthprec' "$folder/command"
cd "$folder"
sed "s|^cc |${CC:-cc} |" command >run
sh -e run >got
cat got
diff want got
