#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages that a job needs and this machine lacks:  packages.sh build|check|lint|fuzz
# Silent and quick when nothing is missing, so that every `make` may call it.

job=${1:-build}

# job   | how to see that it is there                   | Debian, Ubuntu    | Fedora             | Arch
rows='
build | command pkg-config                            | pkg-config        | pkgconf-pkg-config | pkgconf
build | library cairo                                 | libcairo2-dev     | cairo-devel        | cairo
build | library gsl                                   | libgsl-dev        | gsl-devel          | gsl
build | library libconfig                             | libconfig-dev     | libconfig-devel    | libconfig
build | library libpng                                | libpng-dev        | libpng-devel       | libpng
build | file share/fonts/*/*/DejaVuSans.ttf           | fonts-dejavu-core | dejavu-sans-fonts  | ttf-dejavu
check | library cmocka                                | libcmocka-dev     | libcmocka-devel    | cmocka
check | library gmp                                   | libgmp-dev        | gmp-devel          | gmp
check | library mpfr                                  | libmpfr-dev       | mpfr-devel         | mpfr
check | library jansson                               | libjansson-dev    | jansson-devel      | jansson
check | library libxml-2.0                            | libxml2-dev       | libxml2-devel      | libxml2
check | command mandoc                                | mandoc            | mandoc             | mandoc
check | command rsvg-convert                          | librsvg2-bin      | librsvg2-tools     | librsvg
check | command g++                                   | g++               | gcc-c++            | gcc
check | command xmllint                               | libxml2-utils     | libxml2            | libxml2
check | command jq                                    | jq                | jq                 | jq
lint  | command clang                                 | clang             | clang              | clang
lint  | header omp.h                                  | libomp-dev        | libomp-devel       | openmp
lint  | command clang-format                          | clang-format      | clang-tools-extra  | clang
lint  | command cppcheck                              | cppcheck          | cppcheck           | cppcheck
lint  | command codespell                             | codespell         | codespell          | codespell
fuzz  | command clang                                 | clang             | clang              | clang
fuzz  | file lib*/clang/*/lib/*/libclang_rt.fuzzer*.a | libclang-rt-dev   | compiler-rt        | compiler-rt
'

case $job in
build) jobs=' build ' ;;
check) jobs=' build check ' ;;
lint) jobs=' build check lint ' ;;
fuzz) jobs=' build fuzz ' ;;
*)
    echo "packages.sh: the job must be build, check, lint or fuzz, got '$job'" >&2
    exit 2
    ;;
esac

present() { # present KIND NAME
    case $1 in
    command) command -v "$2" >/dev/null 2>&1 ;;
    library) command -v pkg-config >/dev/null 2>&1 && pkg-config --exists "$2" ;;
    header) echo "#include <$2>" | clang -fopenmp -fsyntax-only -x c - >/dev/null 2>&1 ;;
    file) (cd /usr && ls $2 >/dev/null 2>&1) ;;
    esac
}

# One word per missing row: its names under each manager, joined by '|'.
missing=$(
    echo "$rows" | while IFS='|' read -r for probe apt dnf pacman; do
        case $jobs in *" ${for%% *} "*) ;; *) continue ;; esac
        [ -z "$for" ] || present $probe || echo "$apt|$dnf|$pacman" | tr -d ' '
    done
)
[ -n "$missing" ] || exit 0

names() { echo "$missing" | cut -d'|' -f"$1" | sort -u | tr '\n' ' ' | sed 's/ $//'; }

if command -v apt-get >/dev/null 2>&1; then
    names=$(names 1)
    install="apt-get install -y --no-install-recommends"
    refresh="apt-get update"
elif command -v dnf >/dev/null 2>&1; then
    names=$(names 2)
    install="dnf install -y"
    refresh=:
elif command -v pacman >/dev/null 2>&1; then
    names=$(names 3)
    install="pacman -S --needed --noconfirm"
    refresh="pacman -Sy"
else
    echo "depthprec: no apt-get, dnf or pacman here: please install these (Debian's names): $(names 1)" >&2
    exit 1
fi

as_root=
if [ "$(id -u)" -ne 0 ]; then
    as_root=sudo
    if ! command -v sudo >/dev/null 2>&1; then
        echo "depthprec: packages are missing and only root may install them: $install $names" >&2
        exit 1
    fi
fi

echo "  INSTALL $names" >&2
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
install="$as_root env DEBIAN_FRONTEND=noninteractive $install"
# A fresh machine has no package lists, so a first refusal is answered with a refresh.
$install $names >"$log" 2>&1 </dev/null || { $as_root $refresh && $install $names; } >"$log" 2>&1 </dev/null || {
    tail -n 5 "$log" >&2
    echo "depthprec: these packages are missing and could not be installed: $names" >&2
    exit 1
}
