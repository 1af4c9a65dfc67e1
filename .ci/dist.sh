#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What is released, into build/dist: of one commit the same bytes, whenever and wherever it is made.
set -eu
LC_ALL=C TZ=UTC0
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export LC_ALL TZ SOURCE_DATE_EPOCH
umask 022

version=$(sed -n 's/^#define DP_VERSION *"\(.*\)"/\1/p' include/depthprec/depthprec.h)
out=$PWD/build/dist
if [ -n "$(git status --porcelain)" ]; then
    echo "depthprec: a release is made of a commit: git status names what is in none" >&2
    exit 1
fi
rm -rf "$out"
mkdir -p "$out"
for target in docs windows wheel $(sed -n 's/^\(npm\):.*/\1/p' Makefile); do make --no-print-directory $target; done
sh .ci/deb.sh
for file in build/deb/*.dsc build/deb/*.tar.* build/deb/*.deb; do
    case $file in *-dbgsym_*) ;; *) cp "$file" "$out" ;; esac
done
cp build/depthprec.html "$out/depthprec-$version.html"
git archive --format=tar --prefix="depthprec-$version/" HEAD | gzip -9n >"$out/depthprec-$version-source.tar.gz"

python3 - "$out/depthprec-$version" "depthprec-$version/" <<'END'
import glob, os, stat, sys, time, zipfile

def pack(name, files):
    with zipfile.ZipFile(f"{sys.argv[1]}-{name}.zip", "w") as out:
        for name, path in sorted(files.items()):
            entry = zipfile.ZipInfo(sys.argv[2] + name, time.gmtime(int(os.environ["SOURCE_DATE_EPOCH"]))[:6])
            entry.external_attr, entry.create_system = (stat.S_IFREG | 0o644) << 16, 3
            entry.compress_type = zipfile.ZIP_DEFLATED
            with open(path, "rb") as file:
                out.writestr(entry, file.read(), compresslevel=9)

docs = {os.path.relpath(os.path.join(folder, name), "build"): os.path.join(folder, name)
        for folder, _, names in os.walk("build/docs") for name in names}
pack("docs", docs)
pack("windows-x86_64", docs | {os.path.basename(path): path for path in [
    "build/windows/root/NOTICES.txt", "CHANGELOG.md", "src/windows/depthprec-config.cmake", *glob.glob("LICENSE*"),
    *("build/windows/depthprec." + end for end in ("exe", "dll", "lib", "def"))]} |
    {path: path for path in glob.glob("include/depthprec/*.h")} | {"README.md": "src/windows/archive.md"})
END

cat >"$out/README.txt" <<END
depthprec $version: what to take

depthprec-$version-windows-x86_64.zip   Windows: the program, a DLL, all pages. Its README.md says how to begin
depthprec-$version.html                 any system: the page, in a browser, without a network
depthprec_$version-*.deb                Debian, Ubuntu: the program. libdepthprec0 and libdepthprec-dev are the library
depthprec-$version-py3-*.whl            Python on Linux: pip install FILE
depthprec-$version.tgz                  node and browsers: npm install FILE
depthprec-$version-docs.zip             all pages as HTML: the manual, the theory, the gallery
depthprec-$version-source.tar.gz        the sources: make, make check, make install
depthprec-$version.tar.gz               the sources as pip builds them
depthprec_$version.orig.tar.gz, *.debian.tar.*, *.dsc   the sources as Debian builds them

Whole? sha256sum -c SHA256SUMS, or in PowerShell: Get-FileHash FILE
END

cd "$out"
sha256sum -- * >SHA256SUMS
ls -l
