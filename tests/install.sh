#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs into a folder, uses what was installed as a stranger would, and takes it away again.
. tests/tap.sh

stage=$scratch/stage # pkg-config's flags are words, so that it has a name without a space, too
mkdir "$scratch/a stage"
ln -s "a stage" "$stage"
unset MAKEFLAGS MFLAGS MAKELEVEL
install_to() { make --no-print-directory "$1" DESTDIR="$scratch/a stage" PREFIX=/usr; }
check "make install" install_to install
[ $failures -eq 0 ] || { finish; exit 1; }

export PKG_CONFIG_SYSROOT_DIR="$stage" PKG_CONFIG_LIBDIR="$stage/usr/lib/pkgconfig"
export PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
cat >"$scratch/user.c" <<'END'
#include <depthprec/depthprec.h>
#include <stdio.h>
int main(void) {
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    if (dp_format_parse("unorm24", format) != 1)
        return 1;
    spec.format = format[0];
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return 1;
    printf("%u\n", (unsigned)dp_code(&setup, 10.0));
    return 0;
}
END

# expect_code PROGRAM: near 0.1, far 1000, z 10: round((1000/999.9) (1 - 0.01) (2^24 - 1)) is 16611104
expect_code() { [ "$(LD_LIBRARY_PATH=$stage/usr/lib "$1")" = 16611104 ]; }
build_shared() { $CC -o "$scratch/shared" "$scratch/user.c" $(pkg-config --cflags --libs depthprec); }
build_static() {
    $CC -o "$scratch/static" "$scratch/user.c" $(pkg-config --static --cflags --libs depthprec |
        sed 's/-ldepthprec/-l:libdepthprec.a/')
}
needs() { readelf -d "$1" | grep -q "NEEDED.*$2"; }
needs_not() { [ -x "$1" ] && needs "$1" 'libc\.so' && ! needs "$@"; }

header_version() { sed -n 's/^#define DP_VERSION *"\(.*\)"/\1/p' include/depthprec/depthprec.h; }
same_version() { [ -n "$(header_version)" ] && [ "$(pkg-config --modversion depthprec)" = "$(header_version)" ]; }
soname() { readelf -d "$stage/usr/lib/libdepthprec.so" | grep -q 'SONAME.*\[libdepthprec\.so\.0\]'; }

check "pkg-config knows the version" same_version
check "and CHANGELOG.md what is new in it" grep -qF "## [$(header_version)] - 20" CHANGELOG.md
check "a program links with the shared library" build_shared
check "it needs libdepthprec.so.0" needs "$scratch/shared" 'libdepthprec\.so\.0'
check "it prints the right code" expect_code "$scratch/shared"
check "a program links with the static library" build_static
check "it needs no libdepthprec.so" needs_not "$scratch/static" libdepthprec
check "it prints the right code" expect_code "$scratch/static"
check "the SONAME is libdepthprec.so.0" soname

exported() { nm -D --defined-only "$stage/usr/lib/libdepthprec.so.0" | sed 's/.* //' | sort; }
declared() { cat include/depthprec/*.h | tr '\n' ' ' | grep -oE 'DP_API [^(;]*\(' | grep -oE 'dp_[a-z0-9_]+\($' | tr -d '(' | sort; }
exports_declared() {
    exported >"$scratch/exported"
    declared >"$scratch/declared"
    diff "$scratch/declared" "$scratch/exported" && grep -q . "$scratch/declared"
}
check "the library exports exactly what the headers declare with DP_API" exports_declared

pages() {
    for page in man/*.[1-9]; do
        cmp "$B/$page" "$stage/usr/share/man/man${page##*.}/${page##*/}" || return 1
    done
}
table() {
    "$stage/usr/bin/depthprec" table -n 0.1 -f 1000 -F unorm24 -m d3d --at 10 --csv >"$scratch/table" &&
        grep -q ',16611104,' "$scratch/table"
}
figure() { "$stage/usr/bin/depthprec" plot error -o "$scratch/error.svg" && grep -q '</svg>' "$scratch/error.svg"; }
completions() {
    share=$stage/usr/share
    grep -q 'complete .* depthprec' "$share/bash-completion/completions/depthprec" && grep -q '^#compdef depthprec' \
        "$share/zsh/site-functions/_depthprec" && grep -q -e '-l near' "$share/fish/vendor_completions.d/depthprec.fish"
}
check "the manual pages are installed" pages
check "the completions are installed" completions
# The page is made by `make web`, of more than the program needs; it is installed where it has been.
page() {
    installed=$stage/usr/share/doc/depthprec/depthprec.html
    if [ -e "$B/depthprec.html" ]; then cmp "$B/depthprec.html" "$installed"; else [ ! -e "$installed" ]; fi
}
check "the page is installed if it has been made" page
check "the installed program prints the right code" table
check "and draws" figure

# Without DESTDIR, where no loader looks: `make install` says so, and with what it says the example of depthprec(3) runs.
own=$scratch/own
install_own() { make --no-print-directory install PREFIX="$own" 2>"$scratch/said"; }
says_how() {
    cat "$scratch/said"
    grep -q "the dynamic loader does not search $own/lib\." "$scratch/said" &&
        grep -q "PKG_CONFIG_PATH=$own/lib/pkgconfig .*LD_LIBRARY_PATH=$own/lib " "$scratch/said"
}
example() { # as a stranger would: nothing but the two variables
    mkdir "$scratch/example" && env -u PKG_CONFIG_SYSROOT_DIR -u PKG_CONFIG_LIBDIR PKG_CONFIG_PATH="$own/lib/pkgconfig" \
        LD_LIBRARY_PATH="$own/lib" sh tests/linked.sh "$scratch/example" && needs "$scratch/example/example" 'libdepthprec\.so\.0'
}
check "make install where no loader looks" install_own
check "it says so, and what to do" says_how
check "the example of depthprec(3) runs with what was installed" example

lacking() { # without the libraries `make` names them, and the command
    ! PKG_CONFIG_LIBDIR=$scratch make --no-print-directory B="$scratch/none" >"$scratch/said" 2>&1 || return
    cat "$scratch/said"
    grep -q 'depthprec: missing: .*gsl.*install' "$scratch/said" || grep -q 'depthprec: .*missing .*gsl' "$scratch/said"
}
check "without the libraries make names them and the command" lacking

# On a machine with nothing but its shell: each command that the rules of a target call is among the packages that its job
# names, the package of a compiler's linker, too. What is called is looked for in the rows of packages.sh.
bare() { # bare JOB: what is missing there
    PATH=$scratch/bare sh src/packages.sh --missing "$1" 2>&1
}
named() { # named TARGET JOB LEAST
    mkdir -p "$scratch/bare" && for tool in sh sed cut tr sort paste awk id grep cat; do
        ln -sf "$(command -v $tool)" "$scratch/bare/$tool"
    done
    printf '#!/bin/sh\n' >"$scratch/bare/apt-get" && chmod +x "$scratch/bare/apt-get"
    (unset MAKEFLAGS MAKELEVEL MFLAGS && make -n --no-print-directory B="$scratch/none" "$1") 2>&1 |
        grep -v packages.sh >"$scratch/rules"
    bare "$2" >"$scratch/missing"
    sed -n 's/^[a-z]* *| command \([^ ]*\) *| \([^ ]*\) .*/\1 \2/p' src/packages.sh | grep -v '^\(gcc\|g++\|make\) ' |
        while read -r command package; do
            grep -qE "(^|[ \"';|&(])$command( |$)" "$scratch/rules" || continue
            echo "$command"
            grep -qwF -e "$package" "$scratch/missing" || echo "missing in the job $2: $package, for $command" >&2
        done 2>"$scratch/lacking" | sort -u >"$scratch/called"
    cat "$scratch/lacking"
    [ ! -s "$scratch/lacking" ] && [ "$(wc -l <"$scratch/called")" -ge "$3" ] || { cat "$scratch/called" && return 1; }
    case $1 in web | npm) grep -qw lld "$scratch/missing" && grep -qw wasi-libc "$scratch/missing" ;; esac
}
check "a fresh machine gets what make web calls" named web web 3
check "a fresh machine gets what make npm calls" named npm npm 1
check "a fresh machine gets what make lint calls" named lint lint 5
check "a fresh machine gets what make windows calls" named windows windows 1

left() { # a machine without programs lacks them all, one that has them nothing
    [ "$(PATH=$scratch/none /bin/sh src/packages.sh --left docs npm)" = "Left out, for want of programs: tests of docs npm. For each: sh src/packages.sh JOB; numpy: python3-numpy, types: python3-mypy" ] &&
        empty env -u PKG_CONFIG_LIBDIR sh src/packages.sh --left check
}
check "what is left out is told, with what installs it" left
other_make() { ! command -v bmake >/dev/null || bmake -f Makefile help 2>&1 | grep 'this is not GNU make: on this system it is called gmake'; }
check "another make says that it is none" other_make

check "make uninstall" install_to uninstall
nothing_left() { [ -d "$stage" ] && empty find "$stage/" ! -type d; }
check "nothing is left" nothing_left
finish
