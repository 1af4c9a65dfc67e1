#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the options of depthprec.1, what stands between its first list of them and FORMATS, from the program's own rows.
#   sh man/options.sh build/depthprec man/depthprec.1
set -eu

rows=$(mktemp)
list=$(mktemp)
page=$(mktemp)
trap 'rm -f "$rows" "$list" "$page"' EXIT

# A heading starts its line, an option is two blanks off or six, and what is said of it goes on far from the margin.
"$1" help options >"$rows" # a program that is not there ends this, and the page stays
awk '
    function text(line) { # a hyphen that is a dash of an option or a sign, and no line that looks like a macro
        gsub(/-/, "\\-", line)
        while (match(line, /\. [A-Z]/)) # a sentence begins a line
            line = substr(line, 1, RSTART) "\n" substr(line, RSTART + 2)
        print (line ~ /^[.'\'']/ ? "\\&" : "") line
    }
    function flags(label,    n, word, i, out) { # "-n, --near Z" as macros
        n = split(label, word, " ")
        for (i = 1; i <= n; i++)
            if (word[i] ~ /^-.,$/) out = out " Fl " substr(word[i], 2, 1) " ,"
            else if (word[i] ~ /^--/) out = out " Fl -" substr(word[i], 3)
            else out = out " Ar " word[i]
        return out
    }
    NR == 1 || /^$/ { next }
    /^[^ ]/ { if (begun) print ".El"; print ".Ss " $0; print ".Bl -tag -width Ds"; begun = 1; next }
    /^  (-|    --)/ {
        both = substr($0, 30, 1) == " " # what is said of it begins in column 31, or on the next line
        print ".It" flags(both ? substr($0, 1, 30) : $0)
        if (both) text(substr($0, 31))
        next
    }
    { sub(/^ */, "") }
    /^Taken by/ { print ".br" }
    { text($0) }
    END { print ".El" }' "$rows" >"$list"
[ -s "$list" ]
awk -v list="$list" '
    /^\.Sh FORMATS/ { while ((getline line <list) > 0) print line; print; skip = 0; inside = 0; next }
    /^\.Sh OPTIONS/ { inside = 1 }
    inside && /^\.Ss / { skip = 1 }
    !skip' "$2" >"$page"
cat "$page" >"$2"
