#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The libraries of the program for Windows, of Debian's sources, made by mingw-w64:  libraries.sh CC AR FOLDER
# Nothing is installed: FOLDER has include/, lib/libwindows.a and NOTICES.txt, their authors and licences.
set -eu
cc=$1 ar=$2 folder=$3
mkdir -p "${folder%/*}"
out=$(cd "${folder%/*}" && pwd)/${folder##*/}
rm -rf "$out"
mkdir -p "$out/apt/lists/partial" "$out/apt/archives/partial" "$out/include" "$out/lib" "$out/o"
cd "$out"

sources='zlib libpng1.6 jansson gsl'
release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
keys=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb-src [signed-by=$keys] http://deb.debian.org/debian ${release:-stable} main" >apt/list
ask() { # ask APT_ARGUMENTS...: apt-get, with lists of its own
    apt-get -q -o Dir::Etc::sourcelist="$out/apt/list" -o Dir::Etc::sourceparts=- -o Dir::Cache="$out/apt" \
        -o Dir::State::lists="$out/apt/lists" -o APT::Sandbox::User=root "$@" >>log 2>&1
}
if ! ask update || ! ask source --download-only $sources; then
    tail -n 5 log >&2
    echo "depthprec: could not be fetched from Debian: $sources" >&2
    exit 1
fi
{
    echo "In depthprec.exe, besides depthprec itself, are parts of these packages of Debian, built from their sources, and"
    echo "of mingw-w64 and GCC, with their runtimes. The packages' sources: http://deb.debian.org/debian/pool/main."
    for s in $sources; do
        dpkg-source --no-check -x "$s"_*.dsc "$s" >>log 2>&1
        printf '\n==== %s %s ====\n\n' "$s" "$(sed -n 's/^Version: //p' "$s"_*.dsc | head -n 1)"
        cat "$s/debian/copyright"
    done
    for s in mingw-w64-x86-64-dev gcc-mingw-w64-base; do
        [ ! -e /usr/share/doc/$s/copyright ] || { printf '\n==== %s ====\n\n' $s && cat /usr/share/doc/$s/copyright; }
    done
} >NOTICES.txt

# These are what configure would have found.
cp libpng1.6/scripts/pnglibconf.h.prebuilt libpng1.6/pnglibconf.h
cp jansson/android/jansson_config.h jansson/src
printf '#define HAVE_STDINT_H 1\n#define INITIAL_HASHTABLE_ORDER 3\n' >jansson/src/jansson_private_config.h
cp gsl/*/gsl_*.h gsl/gsl_*.h gsl/gsl
known='HAVE_DECL_(ACOSH|ASINH|ATANH|EXPM1|LOG1P|HYPOT|FREXP|LDEXP|ISINF|ISNAN|ISFINITE)'
known="$known|HAVE_(INLINE|MEM.*|STD.*|STR.*|IEEE_.*S)"
sed -E "s/^#undef ($known)\$/#define \\1 1/" gsl/config.h.in >gsl/config.h

parts='block blas cblas cheb err interpolation linalg matrix permutation sort statistics sys vector'
ls zlib/*.c libpng1.6/*.c jansson/src/*.c $(printf 'gsl/%s/*.c ' $parts) |
    grep -vE '/(test[^/]*|[^/]*_source|source_[^/]*|example|pngtest|apply_givens|cholesky_common|svdstep)\.c$' >files
nice xargs -P"${JOBS:-$(nproc)}" -n1 sh -c '
    top=${1%%/*}
    $0 -O2 -w -D__USE_MINGW_ANSI_STDIO=1 -include stdint.h -ffp-contract=off -I$top -I${1%/*} -Izlib \
        -c -o "o/$(echo "${1%.c}" | tr / _).o" "$1"' \
    "$cc" <files 2>>log || { tail -n 5 log >&2 && exit 1; }
"$ar" rcsD lib/libwindows.a o/*.o
cp -r zlib/zlib.h zlib/zconf.h libpng1.6/png*.h jansson/src/jansson*.h gsl/gsl include
rm -rf apt o $sources ./*.dsc ./*.tar.*
