#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The lines that the tests reached, per file, after `make CONF=coverage check`:  coverage.sh BUILD_FOLDER
set -eu
find "$1/obj/src" -name '*.gcno' | sort | xargs gcov -n 2>/dev/null |
    awk '/^File / { file = $2; gsub("\047", "", file); next }
         /^Lines executed:/ && file ~ /^(src|include)\// {
             split($0, part, /[:% ]+/)
             if (!(file in lines)) order[++files] = file
             share = part[3]; count = $NF
             if (share * count > reached[file]) reached[file] = share * count
             lines[file] = count; file = ""
         }
         END {
             for (i = 1; i <= files; i++) {
                 f = order[i]; all += lines[f]; hit += reached[f]
                 printf "%7.2f%% of %5d  %s\n", reached[f] / lines[f], lines[f], f
             }
             if (all) printf "%7.2f%% of %5d  in all\n", hit / all, all
         }'
