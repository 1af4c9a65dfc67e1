#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The rules of the house: an include goes down only, one file knows cairo, the core needs nothing but libm, no two files
# need each other, no line and no function is too long.
. tests/tap.sh

# room | the rooms that what it computes may include. Files figure*.c and folders cmd* of a room are not of it: figures
# may include all that is computed, plot and draw; commands and options all but the doors.
layers='
include/depthprec | depthprec
src/core          | depthprec core
src/bias          | depthprec core raster bias
src/camera        | depthprec core system raster bias camera
src/world         | depthprec core world
src/quantity      | depthprec core quantity
src/zfight        | depthprec core zfight
src/convert       | depthprec core convert
src/raster        | depthprec core raster
src/shadow        | depthprec core bias image raster shader shadow
src/windows       | system windows
src/system        | windows system
src/probe         | depthprec core system raster probe
src/image         | depthprec core system image
src/shader        | depthprec core image shader
src/texture       | depthprec core image shader texture
src/judge         | depthprec core system image shader texture judge
src/method        | depthprec core shader zfight method
src/code          | depthprec core image shader zfight method system report code
src/solve         | depthprec core system bias camera quantity raster world solve
src/model         | core system model
src/scene         | depthprec core system quantity raster world model bias camera solve scene
src/report        | depthprec core system report
src/draw          | core system draw
src/plot          | depthprec core zfight quantity raster shader method draw plot
'
computed=$(echo "$layers" | sed -n 's,^src/\([a-z]*\) .*,\1,p' | grep -vE '^(windows|report|draw|plot)$')

# Quoted includes of the files that come in, NUL between, but for those of these rooms' own headers.
strangers() { # strangers LAYER...
    xargs -0 grep -Hn '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' >"$scratch/includes"
    [ -s "$scratch/includes" ] || return
    lines -vE "\"($(echo "$*" | tr ' ' '|'))/[a-z0-9_]+\.h\"" "$scratch/includes" >"$scratch/strange"
    cat "$scratch/strange"
    [ "${figures-}" ] || lines -E '"[a-z]+/figure[a-z0-9_]*\.h"' "$scratch/includes"
}
of_room() { # of_room FOLDER LAYER...
    folder=$1
    shift
    find "$folder" -maxdepth 1 -name '*.[ch]' ! -name 'figure*' -print0 | figures=$([ "$folder" = src/plot ] && echo 1) strangers "$@"
}
of_figures() {
    find src -path 'src/*/figure*.[ch]' ! -path 'src/plot/*' ! -path '*/cmd*' -print0 | figures=1 strangers "$@"
}
# Commands, and what lies in src/cli, may not include the doors that stand on them.
of_commands() {
    find src/cli src/*/cmd* -name '*.[ch]' >"$scratch/commands" && grep -q '^src/bias/cmd_bias/command.c$' "$scratch/commands" || return
    xargs cat <"$scratch/commands" | lines -E '^#include "(web|npm)/'
}

includes() { # includes WHAT FOLDER...: prints the includes of <WHAT...>
    what=$1
    shift
    lines -rn "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]$what" "$@"
}

cairo_elsewhere() {
    includes cairo include src >"$scratch/cairo" && grep -q '^src/draw/canvas\.c:' "$scratch/cairo" || return
    lines -v '^src/draw/canvas\.c:' "$scratch/cairo"
}

# What is opened to be read is remembered there, so that no output is written over it. Of the system's own files none is.
read_elsewhere() {
    lines -rnE '\<(fopen|fopen64|freopen|json_load_file|config_read_file|gzopen)\(' src >"$scratch/read"
    grep -q '^src/system/input\.c:' "$scratch/read" || return
    lines -vE '^src/(system/input\.c|windows/posix\.h):|"/proc/' "$scratch/read"
}

core_inside() {
    includes core/ src >"$scratch/core" && grep -q '^src/core/' "$scratch/core" || return
    lines -vE '^src/core/|"core/(append|bits|clones|curve|elementary|engine|expansion|named|outward|reading|recognise_lattice|search)\.h"' "$scratch/core"
}

objects() { # those of the program: stand-ins (src/web, src/npm, src/windows) have the names of what they stand in for
    for source in src/*/*.c src/*/*/*.c; do echo "$B/obj/${source%.c}.o"; done | grep -vE '/obj/src/(web|npm|windows)/'
}

echo "$layers" >"$scratch/layers"
while IFS='|' read -r folder allowed; do
    folder=${folder%% *}
    [ -d "$folder" ] || continue
    check "what $folder computes includes only: ${allowed# }" empty of_room "$folder" $allowed
done <"$scratch/layers"
check "figures include what is computed, plot and draw" empty of_figures depthprec $computed draw plot
check "commands include no door" empty of_commands
# src/python is no room: it has no C. src/quantity, src/cli and the doors compute nothing.
check "every room that computes has its row" empty sh -c 'for d in src/*/; do
    case $d in src/python/ | src/cli/ | src/web/ | src/npm/) continue ;; esac
    ls "$d"*.c 2>/dev/null | grep -qv /figure || continue
    grep -q "^${d%/} " "$1" || echo "$d"; done' - "$scratch/layers"
check "of the core's own headers other rooms include none but those of src/README.md" empty core_inside
check "cairo is included in src/draw/canvas.c alone" empty cairo_elsewhere
web_elsewhere() {
    lines -rnE '__(wasm|wasi|EMSCRIPTEN)' include src >"$scratch/web"
    grep -q '^src/web/page\.h:' "$scratch/web" || return
    lines -v '^src/web/page\.h:' "$scratch/web"
}
check "what is otherwise in WebAssembly stands in src/web/page.h alone" empty web_elsewhere
check "files are opened to be read in src/system/input.c alone" empty read_elsewhere
check "GSL is not in the library" empty includes gsl/ include src/core

check "a degree is DP_DEGREE of core/elementary.h alone" empty \
    lines -rnE --include='*.[ch]' 'M_PI\)? */ *\(?180|180(\.0)? */ *M_PI|/ *180\.0|57\.29|0\.0174' src

# The functions of libm that have one answer; for the others there is core/elementary.h.
exact='(sqrt|fabs|floor|ceil|trunc|rint|nearbyint|l?lrint|l?l?round|fma|fmin|fmax|fmod|remainder|modf|frexp|ldexp)f?'
exact="$exact|(scalbn|ilogb|logb|nextafter|copysign)f?"
inexact() {
    libm=$(${CC:-cc} -print-file-name=libm.so.6)
    nm -D --defined-only "$libm" >"$scratch/symbols" && grep -q ' log1p' "$scratch/symbols" || return
    sed 's/^.* //; s/@.*//' "$scratch/symbols" | sort -u >"$scratch/libm"
    objects >"$scratch/objects"
    xargs nm -A -u <"$scratch/objects" >"$scratch/open" && grep -q ' fmax$' "$scratch/open" || return
    awk 'NR == FNR { libm[$1] = 1; next } $NF in libm { sub(/:.*/, "", $1); print $NF, $1 }' "$scratch/libm" "$scratch/open" |
        lines -vE "^($exact) "
}
check "of libm only functions whose every bit is given: none that differs between C libraries" empty inexact

# The library may take this from outside itself: the C library's memory and string functions, these, and what compilers
# add by themselves.
outside='mem(cpy|move|set|cmp|chr)|str(len|n?cmp|n?cpy|n?cat|r?chr|spn|cspn|pbrk|str|tod|toull?|toll?)'
outside="$outside|$exact|fe[gs]etround"
outside="$outside|__stack_chk_fail|__cpu_model|__cpu_indicator_init|__(popcount|clz|ctz)[a-z0-9]*"
outside="$outside|__cxa_finalize|__gmon_start__|_ITM_(de)?registerTMCloneTable"
foreign() {
    nm -D --undefined-only "$B/libdepthprec.so.0" | sed 's/^.* //; s/@.*//' >"$scratch/undefined"
    grep -q '^mem' "$scratch/undefined" || return # what surely is among them
    lines -vxE "$outside" "$scratch/undefined"
}
check "the library needs only memory, strings and libm: no allocation, no output" empty foreign

# Constant tables of pointers lie in .data.rel.ro, read-only once loaded; anything else in .data or .bss could change.
mutable() {
    objdump -t "$B/libdepthprec.a" >"$scratch/symbols" && grep -q ' dp_setup_init$' "$scratch/symbols" || return
    awk -F '\t' '
        { name = $2; section = $1; sub(/.* /, "", name); sub(/.* /, "", section) }
        section ~ /^(\.t?data|\.t?bss|\*COM\*)/ && section !~ /^\.data\.rel\.ro/ && name != section { print name }' "$scratch/symbols"
}
check "the library keeps no state between calls" empty mutable
global() {
    nm -g --defined-only "$B/libdepthprec.a" >"$scratch/symbols" && grep -q ' dp_setup_init$' "$scratch/symbols" || return
    awk 'NF == 3 && $3 !~ /^dp_/ { print $3 }' "$scratch/symbols"
}
check "every global name of the library begins with dp_" empty global

# ---- Files -------------------------------------------------------------------------------------------------------

# Who needs whom, as the linker sees it: "user used", from what each object defines and what it leaves open.
uses() {
    objects >"$scratch/objects"
    xargs nm -A -g --defined-only <"$scratch/objects" >"$scratch/defined" || return
    xargs nm -A -u <"$scratch/objects" >"$scratch/open" || return
    awk '{ split($1, file, ":"); sub(/^.*\/obj\/src\//, "", file[1]); sub(/\.o$/, "", file[1]) }
        NR == FNR { home[$NF] = file[1]; next }
        ($NF in home) && home[$NF] != file[1] { print file[1], home[$NF] }' "$scratch/defined" "$scratch/open"
}
circles() {
    uses >"$scratch/uses" && grep -q '^cli/main ' "$scratch/uses" || return
    tsort "$scratch/uses" 2>"$scratch/circles" >"$scratch/order"
    cat "$scratch/circles"
}
header_circles() {
    find src include -name '*.h' -exec grep -Hn '^#include "' {} + >"$scratch/headers" || return
    sed -E 's,^(src|include)/([^:]*):.*"(.*)".*,\2 \3,' "$scratch/headers" >"$scratch/uses"
    tsort "$scratch/uses" 2>"$scratch/circles" >"$scratch/order"
    cat "$scratch/circles"
}
check "no circle between files" empty circles
check "no circle between headers" empty header_circles

# A comment names files as they are called: a header itself, and whatever else ends in .c or .h.
misnamed() {
    find src include tests -name '*.[ch]' >"$scratch/files" && grep -q '^src/cli/main.c$' "$scratch/files" || return
    xargs awk '
        FILENAME == ARGV[1] && FNR == 1 { for (i = 1; i < ARGC; i++) { name = ARGV[i]; sub(/.*\//, "", name); known[name] } }
        / @file / { name = FILENAME; sub(/.*\//, "", name)
            if (index($0, "@file " name " ") == 0) print FILENAME ":" FNR ": " $0 }
        !/^ ?\*|\/\*/ || /#include/ { next }
        { for (rest = $0; match(rest, /[a-z][a-z0-9_\/]*\.[ch]/); rest = substr(rest, at)) {
            at = RSTART + RLENGTH; name = substr(rest, RSTART, RLENGTH); sub(/.*\//, "", name)
            before = substr(rest, RSTART - 1, RSTART > 1); after = substr(rest, at, 1)
            if (length(name) > 5 && before !~ /[A-Za-z0-9_.>-]/ && after !~ /[a-z0-9_]/ && !(name in known) && name != "math.h")
                print FILENAME ":" FNR ": " name } }' <"$scratch/files"
}
check "comments name files as they are called" empty misnamed

# An option is known by its name: one that no row has is never given.
unnamed_options() {
    find src/cli src/web src/*/cmd* -name '*.[ch]' | xargs grep -hoE '^ *\{"[a-z0-9-]+", (0|'"'.'"'),' | grep -oE '[a-z0-9-]{2,}' |
        sort -u >"$scratch/named" && grep -q '^near$' "$scratch/named" || return
    find src/cli src/web src/*/cmd* -name '*.[ch]' |
        xargs grep -hoE '\<(option_(given|text|error|give|unit|word|set|find|written)\([^,()"]*,? *|TAKE\(|OWN\(|NEEDS\(|CONFLICTS\()"[a-z0-9-]+"' |
        sed 's/.*"\(.*\)"/\1/' | sort -u | comm -23 - "$scratch/named"
}
check "options are named as their rows are" empty unnamed_options

# A sentence names values by the keys of columns, behind those of the parts that they are in.
unnamed_values() {
    find src -name '*.c' >"$scratch/files"
    xargs grep -hoE '(FIELD|PART|GROUP|LIST)\([^()"]*"[a-z0-9_]+"|(WORD|LENGTH|NUMBER)\([a-z_]+, [a-z0-9_]+' <"$scratch/files" |
        sed 's/"$//; s/.*[" ]//' | sort -u >"$scratch/named" && grep -q '^near$' "$scratch/named" || return
    xargs grep -lF '#include "report/sentence.h"' src/*/cmd*/*.h <"$scratch/files" | xargs grep -hE '"[^"]*\{[a-z]' |
        grep -oE '\{[a-z][a-z0-9_.]*[:}]' | tr -d '{}:' | tr . '\n' | sort -u | comm -23 - "$scratch/named"
}
check "sentences name columns" empty unnamed_values

# ---- Lines and functions -----------------------------------------------------------------------------------------

long_lines() { lines -rnE --include='*.[ch]' '^.{121,}' src include tests; }

# A function begins with a line that starts in the first column and ends with "{", maybe some lines on. Its reason to be
# long stands in the comment right above it, behind the word "Long:".
long_functions() {
    find src include tests -name '*.[ch]' >"$scratch/files" && grep -q '^src/cli/main.c$' "$scratch/files" || return
    xargs awk '
        FNR == 1 { inside = reason = 0 }
        !inside && /^([a-z]|TEST).*[({,]$/ && !/=/ { start = FNR; name = $0 }
        !inside && start && /\) \{$/ { inside = 1; body = FNR }
        !inside && /Long: / { reason = 1 }
        !inside && /^$/ { reason = 0 }
        /^}/ {
            if (inside && FNR - body - 1 > 60 && !reason)
                print FILENAME ":" start ": " FNR - body - 1 " lines: " name
            inside = start = reason = 0
        }' <"$scratch/files"
}
check "no line is longer than 120 columns" empty long_lines
check "no function is longer than 60 lines without a reason beside it" empty long_functions
finish
