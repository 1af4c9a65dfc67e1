#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The program for Windows under Wine, where cross.sh has built it: the recorded texts, files as Windows has them, and the DLL.
. tests/tap.sh

exe=$PWD/build/windows/depthprec.exe here=$PWD/build/plain/depthprec there=$scratch/depthprec
mkdir "$scratch/work"
printf '#!/bin/sh\nLC_ALL=C.UTF-8 exec wine "%s" "$@"\n' "$exe" >"$there" # whose words are UTF-8
chmod +x "$there"

# ---- The recorded texts: all but those that ask for what Windows or Wine has not ----------------------------------

cat >"$scratch/others" <<'END'
a figure and its numbers: each what it is alone, whatever says that the file is a figure's
a figure is the same under any name, and says how it was made
a figure on stdout is that of a file; --type says which, and what the name of a file does not
a histogram as large as asked
an old file is replaced and keeps its mode
a new file has the usual mode
a symbolic link stays one
a symbolic link to nothing makes its target
a name that is too long
a fifo is written to
/dev/stdout goes where the shell sends it
output below a file
a file size limit: the old file survives
a file size limit: no file appears
a million rows in little memory
SIGTERM in a long table: the old file survives
SIGHUP in a long table: the old file survives
interrupted: the old file stays
colour on a terminal, not with NO_COLOR (script)
what is read is not overwritten, by whatever name
so does reading
names that are no UTF-8: JSON and CSV are
what no link can hold, 2
END
recorded() {
    mkdir "$scratch/cases"
    for file in tests/cli/*.txt; do
        awk 'NR == FNR { other[$0] = 1; next }
            /^# / { title = substr($0, 3) }
            { text = text $0 "\n" }
            /^= / { if (!(title in other)) printf "%s", text; text = "" }' "$scratch/others" "$file" >"$scratch/cases/${file##*/}"
    done
    DEPTHPREC=$there sh tests/cli.sh "$scratch"/cases/*.txt >"$scratch/recorded"
    lines -A 20 '^not ok' "$scratch/recorded" | head -n 100
    [ "$(grep -c '^ok ' "$scratch/recorded")" -gt 650 ] && ! grep -q '^not ok' "$scratch/recorded"
}
check "the recorded texts" recorded

# ---- Files -------------------------------------------------------------------------------------------------------

cd "$scratch/work" || exit 1
cp "$OLDPWD"/tests/models/house.gltf "$OLDPWD"/tests/models/street.obj "$OLDPWD"/tests/needs/village.need .
mkdir folder
same() { # same ARGUMENTS THEIRS: both programs print the same of files whose names or ends of lines are those of each
    # shellcheck disable=SC2086
    "$here" $1 >"$scratch/want" 2>&1
    want=$?
    "$there" $2 >"$scratch/got" 2>&1
    [ $? -eq $want ] && sed 's/folder\\/folder\//' "$scratch/got" | diff "$scratch/want" - && [ -s "$scratch/want" ]
}
ended() { # ended FILE ARGUMENTS: the same with lines that end in CR LF
    "$here" $2 >"$scratch/want" 2>&1
    want=$?
    sed -i 's/$/\r/' "$1"
    "$there" $2 >"$scratch/got" 2>&1
    [ $? -eq $want ] && diff "$scratch/want" "$scratch/got" && [ -s "$scratch/want" ]
}
check "OBJ whose lines end in CR LF" ended street.obj 'scene street.obj -F d24 -m d3d --within 60'
check "glTF whose lines end in CR LF" ended house.gltf 'scene house.gltf -F d24 -m d3d --within 60'
check "requirements whose lines end in CR LF" ended village.need 'check village.need'
printf '1.2 0 0 0\n0 2 0 0\n0 0 -1.0002 -1\n0 0 -0.20002 0\n' >matrix.txt
check "a matrix whose lines end in CR LF" ended matrix.txt 'table --matrix matrix.txt --at 10'
cp street.obj folder/öde-街.obj
cp "$OLDPWD"/tests/profiles/*.json folder
cat >folder/gpu.need <<'END'
cameras = { a = { near = 0.1; far = 1000; mapping = "d3d"; format = "d24"; raster = "softpipe.json"; viewport = [640, 480]; }; };
requirements = { b = { camera = "a"; at = 50; separation = 1; }; };
END
check "a name of letters beyond ASCII, behind a backslash" same 'scene folder/öde-街.obj --within 60' 'scene folder\öde-街.obj --within 60'
check "a file beside another, behind a backslash" same 'check folder/gpu.need' 'check folder\gpu.need'
figure() {
    "$here" plot scene street.obj -o want.svg && "$there" plot scene '.\street.obj' -o 'folder\Größe 大.svg' || return
    lines -v 'depthprec plot' want.svg >want.text # which is the command
    lines -v 'depthprec plot' folder/'Größe 大.svg' | cmp - want.text && ls -a folder >"$scratch/folder" &&
        ! grep tmp "$scratch/folder"
}
check "a figure into a folder behind a backslash, by a name with a blank" figure
replaced() {
    echo old >folder/table.csv && "$there" table --csv -o 'folder\table.csv' && "$here" table --csv | cmp - folder/table.csv
}
check "a file that is there is replaced" replaced
kept() {
    cp street.obj folder/kept.svg && ! "$there" plot scene 'folder\kept.svg' -o 'FOLDER\kept.svg' 2>"$scratch/errors" &&
        cmp street.obj folder/kept.svg && grep -F 'must not be a file that is read' "$scratch/errors"
}
check "what is read is not overwritten, by whatever name" kept
streams() {
    "$here" texture --synthetic plane --size 8x8 -F d16 -o a.png -q
    "$there" texture - -F d16 -m d3d --pixel 4,4 <a.png >one && "$there" texture - -F d16 -m d3d --pixel 4,4 -q <a.png | cmp - one &&
        "$there" plot share -o - --type svg >two.svg && "$here" plot share -o - --type svg | cmp - two.svg && "$there" table | head -n 1 | cmp - "$1"
}
"$here" table | head -n 1 >first
check "images through pipes, and a reader that has enough" streams first
no_probe() { ! "$there" probe >probed 2>&1 && grep -q 'the program for Windows has no probe yet' probed; }
check "probe says that there is none" no_probe
cd "$OLDPWD" || exit 1

# ---- The library -------------------------------------------------------------------------------------------------

sed -n '/^cat >.*user.c/,/^END$/p' tests/install.sh | sed '1d; $d' >"$scratch/user.c"
linked() { # near 0.1, far 1000, z 10: round((1000/999.9) (1 - 0.01) (2^24 - 1)) is 16611104
    x86_64-w64-mingw32-gcc-posix -Iinclude -o "$scratch/user.exe" "$scratch/user.c" build/windows/depthprec.lib &&
        cp build/windows/depthprec.dll "$scratch" && wine "$scratch/user.exe" >"$scratch/code" && [ "$(cat "$scratch/code")" -eq 16611104 ]
}
check "the example is linked with the DLL, and runs" linked
by_cmake() { # as the archive lies
    mkdir -p "$scratch/cmake/zip/include" && cp -r include/depthprec "$scratch/cmake/zip/include" &&
        cp src/windows/depthprec-config.cmake build/windows/depthprec.dll build/windows/depthprec.lib "$scratch/cmake/zip" &&
        cp "$scratch/user.c" "$scratch/cmake" && cat >"$scratch/cmake/CMakeLists.txt" <<'END' &&
cmake_minimum_required(VERSION 3.15)
project(user C)
find_package(depthprec CONFIG REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE depthprec::depthprec)
END
        cmake -S "$scratch/cmake" -B "$scratch/cmake/b" -DCMAKE_SYSTEM_NAME=Windows -Ddepthprec_DIR="$scratch/cmake/zip" \
            -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc-posix && cmake --build "$scratch/cmake/b" &&
        objdump -p "$scratch/cmake/b/user.exe" | grep -q 'DLL Name: depthprec.dll'
}
if command -v cmake >/dev/null; then
    check "CMake finds the DLL" by_cmake
else
    skip "CMake finds the DLL" "there is no cmake"
fi
needs() { # needs FILE: what it needs but Windows' own
    objdump -p "$1" >"$scratch/headers" && grep -q 'DLL Name: KERNEL32.dll' "$scratch/headers" || return
    lines 'DLL Name' "$scratch/headers" | lines -vE 'KERNEL32.dll|msvcrt.dll'
}
check "the program needs nothing else" empty needs "$exe"
check "the library needs nothing else" empty needs build/windows/depthprec.dll
# The stack is aligned to 16 bytes there.
aligned() {
    objdump -d "$exe" >"$scratch/code" && grep -q 'vmovdqu .*%ymm.*(%rsp' "$scratch/code" || return
    lines -E 'vmov(ap|dqa)[^ ]* .*%[yz]mm.*\(%r' "$scratch/code"
}
check "no vector of 32 bytes is moved as if memory were aligned" empty aligned

finish
