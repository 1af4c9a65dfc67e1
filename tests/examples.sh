#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example of README.md and the manual pages runs, and must print what the page says, to the byte (but for the
# carriage returns of CSV). An example is a block with lines that begin with "$ ": a command, "> " lines that go on with
# it, then its output. A C block behind a comment "file: NAME" is written to NAME first. Then the pages themselves, as
# they are installed: one for each command, of limited length, found by `man -k depth`; each option, format, mapping and
# public function must be in them.
# RECORD=1 sh tests/examples.sh writes what came out into the pages instead: judge that, and the words beside it, with git
# diff.
. tests/tap.sh

root=$PWD
mkdir "$scratch/bin" "$scratch/run"
ln -s "$DEPTHPREC" "$scratch/bin/depthprec"

# `cc` of the examples: finds the library where it was built, and what instrumented objects need.
case $B in
*asan) extra='-fsanitize=address,undefined' ;;
*coverage) extra=--coverage ;;
*) extra= ;;
esac
compiler=$(command -v "${CC%% *}") # its path, because the name may be cc
case $CC in *' '*) compiler="$compiler ${CC#* }" ;; esac
# With the PATH of now, where this one is not: ccache, called as cc, runs the next cc that it finds there.
printf '#!/bin/sh\nPATH="%s" exec %s %s -I"%s/include" "$@" -L"%s/%s" -lm\n' \
    "$PATH" "$compiler" "$extra" "$root" "$root" "$B" >"$scratch/bin/cc"
chmod +x "$scratch/bin/cc"
sed -e "s|@libdir@|$root/$B|; s|@includedir@|$root/include|" src/depthprec.pc.in >"$scratch/depthprec.pc"
export PKG_CONFIG_PATH="$scratch"

# split PAGE: NUMBER.sh, NUMBER.want and NUMBER.name of each example, and the files, into $scratch/run
split() {
    awk -v to="$scratch/run" -v man="${1##*.}" '
        function plain(s) {
            if (man != "md") {
                gsub(/\\-/, "-", s); gsub(/\\\(aq/, "\047", s); gsub(/\\&/, "", s); gsub(/\\e/, "\\", s)
            }
            return s
        }
        man == "md" ? /^```/ : /^\.(Bd|Ed)/ {
            inside = man == "md" ? !inside : /^\.Bd/
            part = ""
            if (inside && file) part = to "/" file
            if (part) printf "" >part
            file = ""
            next
        }
        !inside && /file: [a-z]+\.c/ { file = $0; sub(/.*file: /, "", file); sub(/[^a-z.].*/, "", file); next }
        !inside { next }
        part && part !~ /\.(sh|want)$/ { print plain($0) >part; next }
        /^\$ / {
            number++
            part = to "/" number ".want"
            printf "" >part
            print plain(substr($0, 3)) >(to "/" number ".sh")
            print plain(substr($0, 3)) >(to "/" number ".name")
            next
        }
        /^> / && number { print plain(substr($0, 3)) >(to "/" number ".sh"); next }
        part { print plain($0) >part }' "$1"
}

same() { # same NUMBER: runs an example and compares
    (cd "$scratch/run" && PATH=$scratch/bin:$PATH sh "$1.sh" </dev/null >"$scratch/raw" 2>&1)
    status=$?
    [ -s "$scratch/run/$1.want" ] || [ $status -eq 0 ] || return # what prints nothing must at least be fine
    tr -d '\r' <"$scratch/raw" >"$scratch/got"
    diff "$scratch/run/$1.want" "$scratch/got" && return
    cp "$scratch/got" "$scratch/run/$1.new" && return 1
}

record() { # record PAGE: with what its examples printed where that differs
    awk -v from="$scratch/run" -v man="${1##*.}" '
        function roff(s) {
            if (man != "md") {
                gsub(/\\/, "\\e", s)
                if (s ~ /^[.\047]/) s = "\\&" s
            }
            return s
        }
        function output(file) {
            file = from "/" number ".new"
            while ((getline new <file) > 0) {
                print roff(new)
                instead = 1
            }
            close(file)
        }
        man == "md" ? /^```/ : /^\.(Bd|Ed)/ { if (pending) output(); pending = instead = 0; shell = 0 }
        /^\$ / { if (pending) output(); number++; pending = shell = 1; instead = 0; print; next }
        shell && pending && !/^> / { output(); pending = 0 }
        !instead { print }' "$1" >"$scratch/page" && cp "$scratch/page" "$1"
}

# ---- 80 columns ----

wide() { # the lines of the examples' output that are too wide
    for want in "$scratch"/run/*.want; do
        too_wide "${want%want}sh" "$want"
    done
}

mandoc_page() { # mandoc_page PAGE
    mandoc -T ascii -O width=80 "$1"
}

groff_page() { # groff_page PAGE
    groff -T ascii -P -c -mdoc -r LL=80n "$1"
}

rendered() { # rendered TOOL PAGE: its lines that are too wide on a terminal of 80 columns
    "$1_page" "$2" >"$scratch/rendered" && [ -s "$scratch/rendered" ] || return
    col -bx <"$scratch/rendered" | awk 'length > 80 && !/^depthprec: /'
}

manual "$scratch/man"
for page in README.md man/*.[0-9]; do
    rm -rf "$scratch/run" && mkdir "$scratch/run" && ln -s "$PWD/tests" "$scratch/run/tests" # models that examples read
    split "$page"
    number=1
    while [ -e "$scratch/run/$number.sh" ]; do
        check "$page: $(cut -c 1-90 "$scratch/run/$number.name")" same $number
        number=$((number + 1))
    done
    [ -z "${RECORD-}" ] || record "$page"
    [ ! -e "$scratch/run/1.want" ] || check "$page: output of 80 columns" empty wide
    case $page in
    *.md) ;;
    *) for tool in mandoc groff; do
        if command -v $tool >/dev/null && command -v col >/dev/null; then
            check "$page: 80 columns by $tool" empty rendered $tool "$scratch/$page"
        else
            skip "$page: 80 columns by $tool" "$tool or col is not installed"
        fi
    done ;;
    esac
    case $page in
    README.md | *.[13]) check "$page: has examples" [ $number -gt 1 ] ;;
    esac
done

# ---- The pages name what there is ----

page() { # the text of a page without its macros
    sed -e 's/^\.[A-Z][a-z] //' -e 's/\\-/-/g' "$scratch/man/depthprec$1" | tr -s ' ,' '\n\n'
}

names_in() { # names_in PAGE: prints the names on stdin that the page does not have
    page "$1" >"$scratch/words"
    while read -r word; do
        grep -qxF -e "$word" -e "$word." "$scratch/words" || echo "not in depthprec$1: $word"
    done
}

verbs() { "$DEPTHPREC" help >"$scratch/help" && sed -n '/^Commands/,/^$/s/^  \([a-z]*\) .*/\1/p' "$scratch/help"; }
pages_of_verbs() { verbs | sed 's/^/depthprec-/'; }

complete() { # complete COMMAND: its page, which `help COMMAND` names, has each option of its help
    [ -s "$scratch/man/depthprec-$1.1" ] && "$DEPTHPREC" help "$1" >"$scratch/help" || return
    grep -q "man depthprec-$1'" "$scratch/help" || return
    sed -n 's/^  ....\(--[a-z0-9-]*\).*/\1/p' "$scratch/help" >"$scratch/options" && [ -s "$scratch/options" ] || return
    sed -n 's/^\.It.* Fl -\([a-z0-9-]*\).*/--\1/p' "$scratch/man/depthprec-$1.1" | diff "$scratch/options" -
}

unknown_options() { # the options that README.md and the pages name and that no command has
    "$DEPTHPREC" help options >"$scratch/help" && sed -n 's/^  ....\(--[a-z0-9-]*\).*/\1/p' "$scratch/help" |
        sort -u >"$scratch/options" && [ -s "$scratch/options" ] || return
    sed -e 's/\\-/-/g' -e 's/Fl -\([a-z]\)/Fl --\1/g' README.md "$scratch"/man/*.[157] |
        grep -oE -e '(^|[^a-z-])--[a-z][a-z0-9-]*' | sed 's/^[^-]*//' | sort -u | comm -13 "$scratch/options" -
}

# Options of plot depend on the figure: help lists those of some.
takers() { # where `help options` and the help of a command part over whether it takes an option; none takes --help
    "$DEPTHPREC" help options | awk '
        /^  ....--/ { name = $0; sub(/^  ..../, "", name); sub(/[ =[].*/, "", name); takes = 0 }
        /^ +Taken by/ { takes = 1; sub(/Taken by/, "") }
        takes { ends = /[.]$/; gsub(/[.,]/, " "); if (NF == 0) print name, "nobody"; for (i = 1; i <= NF; i++) print name, $i; takes = !ends }' |
        grep -v ' plot$' | sort >"$scratch/said"
    verbs | grep -vx plot >"$scratch/verbs" && while read -r verb; do
        "$DEPTHPREC" help "$verb" | sed -n "s/^  ....\\(--[a-z0-9-]*\\).*/\\1 $verb/p"
    done <"$scratch/verbs" | grep -vE -e '^--(help|version) ' | sort >"$scratch/taken" && [ -s "$scratch/taken" ] || return
    comm -3 "$scratch/said" "$scratch/taken"
}

found() { # what of the pages `man -k depth` does not find, by the tools of mandoc
    rm -rf "$scratch/share"
    for page in "$scratch"/man/*.[0-9]; do
        mkdir -p "$scratch/share/man${page##*.}" && cp "$page" "$scratch/share/man${page##*.}" || return
    done
    makewhatis "$scratch/share" && "$apropos" -M "$scratch/share" depth >"$scratch/known" || return
    for page in "$scratch"/man/*.[0-9]; do
        name=$(basename "$page")
        grep -q "^${name%.*}(${name##*.}) - ..*" "$scratch/known" || echo "not found: $name"
    done
}

# The lengths of what is written by hand, in lines of the source.
short() { # short MOST FILE
    [ "$(wc -l <"$2")" -le "$1" ] || { wc -l "$2" && return 1; }
}

aliases() { # names and aliases of a table
    "$DEPTHPREC" list "$1" --csv >"$scratch/csv" || return
    tr -d '\r"' <"$scratch/csv" | sed 1d | cut -d, -f 1,2 | tr ', ' '\n\n' | grep .
}

functions() {
    cat include/depthprec/*.h | sed -n 's/^DP_API .*[ *]\(dp_[a-z0-9_]*\)(.*/\1/p'
}

statuses() {
    sed -n 's/^ *\(DP_\(OK\|ERROR_[A-Z_]*\)\)[, ].*/\1/p' include/depthprec/status.h
}

documented() { # documented SECTION LIST...: no name of a list that is not empty is missing
    section=$1
    shift
    "$@" >"$scratch/names" && [ -s "$scratch/names" ] || return 1
    empty names_in "$section" <"$scratch/names"
}

check "depthprec(1): the page of every command" documented .1 pages_of_verbs
for verb in $(verbs); do
    check "depthprec-$verb(1): every option" complete "$verb"
done
check "the pages name no option that no command has" empty unknown_options
check "help says of each option which commands take it" empty takers
PATH=$PATH:/usr/sbin
apropos=$(command -v mapropos || command -v apropos) # Debian's name for that of mandoc
if command -v makewhatis >/dev/null; then
    check "man -k depth finds the pages" empty found
else
    skip "man -k depth finds the pages" "makewhatis is not installed"
fi
check "README.md: at most 200 lines" short 200 README.md
check "depthprec(1): at most 300 lines" short 300 man/depthprec.1
check "depthprec(7): at most 2210 lines" short 2210 man/depthprec.7
for page in man/depthprec-*.[17]; do
    check "$page: at most 500 lines" short 500 "$page"
done
for what in formats mappings presets platforms models arithmetic; do
    check "depthprec-camera(7): every name of $what" documented -camera.7 aliases $what
done
check "depthprec-plot(1): every figure" documented -plot.1 aliases figures
check "depthprec-bias(1): every API" documented -bias.1 aliases apis
check "depthprec-budget(1): every cause" documented -budget.1 aliases causes
check "depthprec-budget(1): every composition" documented -budget.1 aliases transforms
check "depthprec.3: every function" documented .3 functions
check "depthprec.3: every status" documented .3 statuses
check "tests/README.md: every test it names exists" sh -c '
    grep -oE "\btest_[a-z_]+[a-z]\b[*]?" tests/README.md | grep -v "[*]" | sort -u >"$1" && [ -s "$1" ] && while read -r name; do
        ls tests/*/"$name.c" >/dev/null 2>&1 || { echo "$name" && exit 1; }
    done <"$1"' - "$scratch/named"
finish
