#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Completes a manual page with what the program says of itself:  fill.sh PROGRAM SOURCE >PAGE
# In the source a line  .\" head COMMAND  stands for its title, NAME and SYNOPSIS,  .\" options COMMAND  for its options as
# `help COMMAND` has them, and  .\" list WHAT  for the names, notes and other spellings that `list WHAT` has.  .\" list  stands for the
# names of the lists,  .\" questions  for what people ask, and  .\" margin  before examples makes them as wide as a terminal.
set -eu

said=$(mktemp)
page=$(mktemp)
trap 'rm -f "$said" "$page"' EXIT

words='
    function text(line) { # a hyphen that is a dash of an option or a sign, and no line that looks like a macro
        gsub(/\\/, "\\e", line)
        gsub(/-/, "\\-", line)
        while (match(line, /\. [A-Z]/)) # a sentence begins a line
            line = substr(line, 1, RSTART) "\n" substr(line, RSTART + 2)
        print (line ~ /^[.'\'']/ ? "\\&" : "") line
    }'

head() {
    awk "$words"'
        NR == 1 {
            command = $2
            sub(/:$/, "", command)
            summary = $0
            sub(/^[^:]*: /, "", summary)
            print ".Dt DEPTHPREC-" toupper(command) " 1\n.Os\n.Sh NAME\n.Nm depthprec-" command
            printf ".Nd "
            text(summary)
        }
        /^Usage: / { # words in brackets are optional, those in capitals stand for others
            print ".Sh SYNOPSIS\n.Nm depthprec\n.Cm " command
            for (i = 4; i <= NF; i++)
                print $i ~ /^\[/ ? ".Op Ar " tolower(substr($i, 2, length($i) - 2)) : ".Ar " tolower($i)
        }'
}

# A heading starts its line, an option or a word is two blanks off or more, and what is said of it goes on in column 31.
options() {
    awk "$words"'
        function flags(label,    n, word, i, out) { # "-n, --near Z" as macros
            if (label !~ /^ *-/) { sub(/^ */, "", label); return " Cm " label }
            n = split(label, word, " ")
            for (i = 1; i <= n; i++)
                if (word[i] ~ /^-.,$/) out = out " Fl " substr(word[i], 2, 1) " ,"
                else if (word[i] ~ /^--/) out = out " Fl -" substr(word[i], 3)
                else out = out " Ar " word[i]
            return out
        }
        /^Usage: / { options = 1; print ".Sh OPTIONS"; next }
        !options || /^$/ || /^'\''/ { next }
        /^[^ ]/ { if (begun) print ".El"; print ".Ss " $0 "\n.Bl -tag -width Ds"; begun = 1; next }
        substr($0, 1, 30) ~ /[^ ]/ {
            both = substr($0, 30, 1) == " " # else what is said of it begins on the next line
            print ".It" flags(both ? substr($0, 1, 30) : $0)
            if (both) text(substr($0, 31))
            next
        }
        { sub(/^ */, ""); text($0) }
        END { if (begun) print ".El" }'
}

# A name stands in the first column, a label in the third, what is said in the fifteenth.
list() {
    awk "$words"'
        BEGIN { print ".Bl -tag -width 13n" }
        /^$/ { next }
        /^[^ ]/ { gsub(/, /, " , "); print ".It Cm " $0; label = ""; next }
        /^  [^ ]/ { label = $1 }
        label == "source" || label == "bound" { next }
        label != "" && /^  [^ ]/ { print ".br"; printf "%s: ", label }
        { text(substr($0, 15)) }
        END { print ".El" }'
}

# A question begins its line, commands are two blanks off and go on four blanks off.
questions() {
    awk "$words"'
        function show() { if (asked != "") text(asked); asked = "" }
        BEGIN { print ".Bl -enum" }
        /^$/ { next }
        /^[^ ]/ { if (literal) print ".Ed"; literal = 0; print ".It"; asked = $0; next }
        asked != "" && !/^  depthprec / { sub(/^ */, ""); asked = asked " " $0; next }
        # Typed on a page that is indented: narrower than the program breaks them.
        function command(line,    cut) {
            while (length(line) > 66) {
                for (cut = 64; cut > 0 && substr(line, cut, 1) != " "; cut--)
                    ;
                if (cut < 12) break
                typed(substr(line, 1, cut) "\\")
                line = "    " substr(line, cut + 1)
            }
            typed(line)
        }
        function typed(line) {
            gsub(/\\/, "\\e", line)
            gsub(/'"'"'/, "\\(aq", line)
            print line
        }
        {
            show()
            if (!literal++) print ".Bd -literal"
            sub(/^  depthprec /, "depthprec ")
            sub(/^ */, "")
            whole = whole $0
            if (sub(/ *\\$/, " ", whole)) next
            command(whole)
            whole = ""
        }
        END { print ".Ed\n.El" }'
}

while IFS= read -r line; do
    case $line in
    '.\" head '* | '.\" options '*)
        "$1" help "${line##* }" >"$said"
        [ -s "$said" ]
        what=${line#????}
        ${what%% *} <"$said"
        ;;
    '.\" list')
        "$1" list >"$said"
        sed '1d; s/^  \([a-z][a-z]*\) */\1\n              /' "$said" | list
        ;;
    '.\" list '*)
        "$1" list "${line##* }" >"$said"
        list <"$said"
        ;;
    '.\" questions')
        "$1" list questions >"$said"
        questions <"$said"
        ;;
    '.\" margin')
        # Examples begin in the first column, so that they fit 80. groff has no negative offsets: there the whole
        # section does.
        printf '.ds margin -5n\n.if \\n(.x \\{\\\n.ds margin left\n.in 0\n.\\}\n'
        ;;
    *) printf '%s\n' "$line" ;;
    esac
done <"$2" >"$page"
cat "$page"
