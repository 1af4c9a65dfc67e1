#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The Python package: written twice to the same bytes, installed into an empty folder without a network, and used there by
# the tests of python/. With DEPTHPREC_FULL it is also built from its own source archive.
. tests/tap.sh

if ! command -v python3 >/dev/null 2>&1; then
    skip "the Python package" "there is no python3"
    finish
    exit
fi
export PYTHONDONTWRITEBYTECODE=1
unset MAKEFLAGS MFLAGS MAKELEVEL PYTHONPATH
site=$scratch/site

build() { make --no-print-directory B="$B" CC="$CC" wheel-parts; }
write() { B=$B python3 src/python/package.py "$scratch/$1" >"$scratch/written"; }
wheel() { echo "$scratch"/one/depthprec-*.whl; }
same() {
    other=$scratch/elsewhere
    write one && mkdir -p "$other/b" && cp -r "$B/libdepthprec.so.0" "$B/plain" "$other/b" &&
        cp -r src include Makefile README.md LICENSE* "$other" && touch "$other/README.md" &&
        (cd "$other" && B=b python3 src/python/package.py "$scratch/two") &&
        [ "$(cat "$scratch"/one/* | wc -c)" -gt 1000000 ] && diff -r "$scratch/one" "$scratch/two"
}
# By pip where it is, as users do; else as pip would: unzipped, with its modes.
install() {
    if python3 -m venv "$scratch/venv" && "$scratch/venv/bin/python3" -m pip --version; then
        "$scratch/venv/bin/python3" -m pip install --no-index --target "$site" "$(wheel)"
    else
        python3 -c 'import os, sys, zipfile
for entry in zipfile.ZipFile(sys.argv[1]).infolist():
    path = zipfile.ZipFile(sys.argv[1]).extract(entry, sys.argv[2])
    os.chmod(path, entry.external_attr >> 16 & 0o777)' "$(wheel)" "$site"
    fi && [ -x "$site/depthprec/bin/depthprec" ]
}
recorded() { # each file is there with the digest that RECORD has of it, and no other
    python3 -c 'import base64, hashlib, sys, zipfile
wheel = zipfile.ZipFile(sys.argv[1])
rows = [row.split(",") for row in wheel.read([n for n in wheel.namelist() if n.endswith("/RECORD")][0]).decode().split()]
assert sorted(row[0] for row in rows) == sorted(wheel.namelist()) and len(rows) > 10, rows
for name, digest, size in rows[:-1]:
    data = wheel.read(name)
    want = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    assert (digest, int(size)) == ("sha256=" + want, len(data)), name' "$(wheel)"
}
# The machine gives it the C library; its version is as the tag says, and it needs none of its neighbours.
alone() {
    for file in "$site"/depthprec/libdepthprec.so.0 "$site"/depthprec/bin/depthprec; do
        readelf -d "$file" >"$scratch/needs" && grep -q 'NEEDED.*libm\.so' "$scratch/needs" || return
        lines -E 'NEEDED' "$scratch/needs" | lines -vE '\[lib(c|m|dl|pthread|rt)\.so|\[ld-linux'
    done
    readelf -V "$site/depthprec/bin/depthprec" | grep -oE 'GLIBC_2\.[0-9]+' | sort -V | tail -n 1 | tr . _ >"$scratch/newest"
    case $(wheel) in
    *-py3-none-manylinux_"$(sed 's/GLIBC_//' "$scratch/newest")"_*.whl) ;;
    *) [ ! -s "$scratch/newest" ] || echo "$(wheel) needs $(cat "$scratch/newest")" ;;
    esac
}
# What ctypes has of structures and numbers is what the compiler has.
layout() {
    used "$scratch/layout.c" "$scratch/want" && $CC -Iinclude -o "$scratch/layout" "$scratch/layout.c" &&
        "$scratch/layout" >"$scratch/got" && diff "$scratch/want" "$scratch/got" && [ "$(wc -l <"$scratch/got")" -gt 100 ]
}
used() { PYTHONPATH=$site:tests/python python3 tests/python/test_depthprec.py --layout "$@"; }
tests_of() { # tests_of CLASS: some tests ran, and all of them went well
    PYTHONPATH=$site:tests/python DEPTHPREC=$DEPTHPREC python3 tests/python/test_depthprec.py "$1" >"$scratch/unit" 2>&1
    status=$?
    cat "$scratch/unit"
    [ $status -eq 0 ] && grep -qE '^Ran [1-9][0-9]* tests?' "$scratch/unit" && grep -q '^OK' "$scratch/unit"
}
shown() { # what the pages show of the package is what it prints
    awk '/^```/ { inside = /python/ && !inside; next } inside' README.md src/python/README.md >"$scratch/page.txt"
    [ "$(grep -c '^>>>' "$scratch/page.txt")" -ge 10 ] && PYTHONPATH=$site python3 -m doctest -o ELLIPSIS "$scratch/page.txt"
}
command_runs() { [ "$(PYTHONPATH=$site python3 -m depthprec table -n 0.3 --csv)" = "$("$DEPTHPREC" table -n 0.3 --csv)" ]; }
from_sources() { # as pip does, in a folder of its own
    mkdir "$scratch/unpacked" "$scratch/three" && tar -xzf "$scratch"/one/*.tar.gz -C "$scratch/unpacked" &&
        (cd "$scratch"/unpacked/*/ && CC=$CC PYTHONPATH=src/python python3 -c 'import package, sys
package.build_wheel(sys.argv[1])' "$scratch/three") && [ -s "$(echo "$scratch"/three/*.whl)" ]
}

check "its program and library are built" build
check "written twice, in two folders, it is the same bytes" same
check "RECORD has every file" recorded
check "it is installed into an empty folder" install
[ $failures -eq 0 ] || { finish; exit 1; }
check "it needs nothing but the C library" empty alone
check "structures and numbers lie where C has them" layout
for class in Oracle Program Matrix Memory Cameras; do
    check "tests of python/: $class" tests_of $class
done
check "python3 -m depthprec is the program" command_runs
check "its page and README.md show what it prints" shown
if python3 -c 'import numpy'; then
    recipes() { PYTHONPATH=$site python3 tests/python/recipes.py src/python/RECIPES.md; }
    check "the recipes run as they stand" recipes
else
    skip "the recipes run as they stand" "no numpy here"
fi
if python3 -c 'import mypy, numpy, sys; sys.exit(sys.version_info < (3, 11))'; then
    types() { # they are of what is computed, and mypy knows the same, which refuses what is wrong
        PYTHONPATH=$site python3 tests/python/typed.py "$scratch/asserted.py" &&
            PYTHONPATH=$site python3 -m mypy --strict --warn-unused-ignores --cache-dir "$scratch/mypy" "$scratch/asserted.py"
    }
    check "types: of elements, shapes and keywords" types
else
    skip "types: of elements, shapes and keywords" "no mypy with numpy here, of Python 3.11 or later"
fi
if [ -n "${DEPTHPREC_FULL-}" ]; then
    check "it is built from its source archive" from_sources
fi
finish
