#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A release, made twice of the last commit, in folders of different names:  make check-dist
. tests/tap.sh

release() { git clone -q . "$1" && make -C "$1" --no-print-directory dist CC="$CC"; }
check "make dist" release "$scratch/one"
check "make dist elsewhere" release "$scratch/another-length"
one=$scratch/one/build/dist
check "the same bytes" diff -r "$one" "$scratch/another-length/build/dist"
digests() { (cd "$one" && sha256sum -c SHA256SUMS && [ "$(wc -l <SHA256SUMS)" -eq $(($(ls | wc -l) - 1)) ]); }
check "SHA256SUMS has all of it" digests
version=$(sed -n 's/^#define DP_VERSION *"\(.*\)"/\1/p' include/depthprec/depthprec.h)
has() { # has NAME TOOL... : the file has what stands on stdin, as the tool lists it
    file=$1
    shift
    [ -e "$one/$file" ] && "$@" "$one/$file" >"$scratch/list" || return
    while read -r wanted; do lines -c -- "$wanted" "$scratch/list" | grep -qv '^0$' || { echo "$file lacks $wanted" && return 1; }; done
}
listed() { python3 -m zipfile -l "$1"; }
check "the source archive" has "depthprec-$version-source.tar.gz" tar -tzf <<END
depthprec-$version/Makefile
depthprec-$version/CHANGELOG.md
END
told() { # each file is told of in README.txt, by its name or a pattern there
    sed -n 's/   .*//; s/, / /g; /^[*a-z]/p' "$one/README.txt" >"$scratch/told" && [ "$(wc -l <"$scratch/told")" -ge 9 ] || return
    (cd "$one" && for file in *; do
        case $file in README.txt | SHA256SUMS | lib*.deb) continue ;; esac
        for word in $(set -f && cat "$scratch/told"); do case $file in $word) continue 2 ;; esac; done
        echo "$file is not told of"
    done) | lines .
}
check "README.txt says which is which" empty told
pictures() { # what the README of Windows' archive shows and links is in it
    python3 -m zipfile -e "$one/depthprec-$version-windows-x86_64.zip" "$scratch/zip" && cd "$scratch"/zip/* &&
        grep -oE '\]\([^)]*\)' README.md | sed 's/^](//; s/)$//' >"$scratch/links" && [ "$(wc -l <"$scratch/links")" -ge 5 ] &&
        while read -r link; do [ -s "$link" ] || echo "no $link"; done <"$scratch/links"
}
check "what Windows' README shows is there" empty pictures
check "Windows" has "depthprec-$version-windows-x86_64.zip" listed <<END
depthprec.exe
depthprec.dll
depthprec.lib
depthprec-config.cmake
include/depthprec/depthprec.h
LICENSE.GPL-3.0
NOTICES.txt
docs/index.html
docs/man/depthprec-table.1.html
END
check "all pages as HTML" has "depthprec-$version-docs.zip" listed <<END
docs/index.html
docs/depthprec.html
docs/man/depthprec.7.html
docs/plots/staircase.svg
END
check "Debian's program, with the page" has "depthprec_$version-1~upstream_$(dpkg --print-architecture).deb" dpkg-deb -c <<END
usr/bin/depthprec
usr/share/doc/depthprec/depthprec.html
END
! grep -q '^npm:' Makefile || check "npm's" sh -c "ls '$one'/*.tgz"
for more in "depthprec-$version.tar.gz" "depthprec-$version-*.whl" "depthprec-$version.html" "libdepthprec-dev_$version-*.deb"; do
    check "$more" sh -c "ls '$one'/$more"
done
finish
