#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds Debian's source package and its three packages into build/deb, from the tree as it lies here with .ci/debian at
# its top, and lets lintian judge them. Then they are unpacked, and the example of depthprec(3) is compiled against them.
# DEB_BUILD_OPTIONS=nocheck is the default: the tests have run before; give another to run them in the package too.
set -eu
LC_ALL=C
export LC_ALL

: "${DEB_BUILD_OPTIONS:=nocheck}"
export DEB_BUILD_OPTIONS
unset MAKEFLAGS MFLAGS MAKELEVEL
version=$(sed -n 's/^#define DP_VERSION *"\(.*\)"/\1/p' include/depthprec/depthprec.h)
out=$PWD/build/deb
tree=$out/depthprec-$version

rm -rf "$out"
mkdir -p "$tree"
: "${SOURCE_DATE_EPOCH:=$(date +%s -r include/depthprec/depthprec.h)}"
export SOURCE_DATE_EPOCH
umask 022
tar -c --exclude=./build --exclude=./.git --exclude=./shared --exclude=__pycache__ . | tar -x -C "$tree"
tar -c -C "$out" --sort=name --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw --mtime="@$SOURCE_DATE_EPOCH" \
    "depthprec-$version" | gzip -9n >"$out/depthprec_$version.orig.tar.gz"
cp -r .ci/debian "$tree/debian"
{
    echo "depthprec ($version-1~upstream) unstable; urgency=medium" # below the first revision that Debian itself may make
    echo
    echo "  * Version $version of upstream: its CHANGELOG.md says what has changed."
    echo
    echo " -- $(sed -n 's/^Maintainer: //p' .ci/debian/control)  $(date -R -u -d "@$SOURCE_DATE_EPOCH")"
} >"$tree/debian/changelog"

if ! (cd "$tree" && dpkg-buildpackage -us -uc -j"${JOBS:-$(nproc)}") >"$out/log" 2>&1; then
    tail -n 30 "$out/log" >&2
    echo "depthprec: dpkg-buildpackage failed, see $out/log" >&2
    exit 1
fi
lintian --fail-on error,warning --allow-root "$out"/*.changes

# ---- As an installed machine has them ----------------------------------------------------------------------------

root=$out/root
for package in "$out"/*.deb; do dpkg-deb -x "$package" "$root"; done
libraries=$(dirname "$(find "$root/usr/lib" -name libdepthprec.so.0)")
mkdir "$out/example"
PKG_CONFIG_SYSROOT_DIR=$root PKG_CONFIG_LIBDIR=$libraries/pkgconfig PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 \
    PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 LD_LIBRARY_PATH=$libraries sh tests/linked.sh "$out/example"
"$root/usr/bin/depthprec" --version
for page in "$tree"/build/man/*; do
    gzip -cd "$root/usr/share/man/man${page##*.}/${page##*/}.gz" | cmp - "$page"
done
ls "$out"/*.deb "$out"/*.dsc
