#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages that a job needs and this machine lacks:  packages.sh JOB, which is
# build, check, clang, lint, fuzz, web, docs, npm, browser, cross, deb, windows, wine or probe.
# Silent and quick when nothing is missing, so that every `make` may call it.
# packages.sh --missing JOB installs nothing: it names what is missing and the one command that installs it.
# packages.sh --libraries JOB prints Debian's names of the libraries of a job.
# packages.sh --left JOB... says in a line which of these jobs' tests are left out here, and what installs what they need.

how=install
case ${1-} in
--*)
    how=${1#--}
    shift
    ;;
esac
if [ "$how" = left ]; then
    left=
    for job; do sh "$0" --missing "$job" >/dev/null 2>&1 || left="$left $job"; done
    [ -z "$left" ] ||
        echo "Left out, for want of programs: tests of$left. For each: sh src/packages.sh JOB; numpy: python3-numpy, types: python3-mypy"
    exit 0
fi
job=${1:-build}

# job | how to see that it is there                   | Debian, Ubuntu        | Fedora             | Arch   ('-': not there, '+': done without)
rows='
build | command pkg-config                            | pkg-config            | pkgconf-pkg-config | pkgconf
build | library cairo                                 | libcairo2-dev         | cairo-devel        | cairo
build | library gsl                                   | libgsl-dev            | gsl-devel          | gsl
build | library jansson                               | libjansson-dev        | jansson-devel      | jansson
build | library libpng                                | libpng-dev            | libpng-devel       | libpng
build | library zlib                                  | zlib1g-dev            | zlib-devel         | zlib
build | library OpenEXR                               | libopenexr-dev        | openexr-devel      | openexr
build | library assimp                                | libassimp-dev         | assimp-devel       | assimp
build | library egl                                   | libegl-dev            | libglvnd-devel     | libglvnd
build | library gl                                    | libgl-dev             | libglvnd-devel     | libglvnd
build | library vulkan                                | libvulkan-dev         | vulkan-headers     | vulkan-headers
build | library libtiff-4                             | libtiff-dev           | libtiff-devel      | libtiff
build | file share/fonts/*/*/DejaVuSans.ttf           | fonts-dejavu-core     | dejavu-sans-fonts  | ttf-dejavu
check | library cmocka                                | libcmocka-dev         | libcmocka-devel    | cmocka
check | library gmp                                   | libgmp-dev            | gmp-devel          | gmp
check | library mpfr                                  | libmpfr-dev           | mpfr-devel         | mpfr
check | library libxml-2.0                            | libxml2-dev           | libxml2-devel      | libxml2
check | command mandoc                                | mandoc                | mandoc             | mandoc
check | command groff                                 | groff-base            | groff-base         | groff
check | command col                                   | bsdextrautils         | util-linux         | util-linux
check | command python3                               | python3               | python3            | python
check | command rsvg-convert                          | librsvg2-bin          | librsvg2-tools     | librsvg
check | command g++                                   | g++                   | gcc-c++            | gcc
check | command xmllint                               | libxml2-utils         | libxml2            | libxml2
check | command jq                                    | jq                    | jq                 | jq
check | command gappa                                 | gappa                 | gappa              | +
check | command glslangValidator                      | glslang-tools         | glslang            | glslang
check | command spirv-val                             | spirv-tools           | spirv-tools        | spirv-tools
clang | command clang                                 | clang                 | clang              | clang
clang | header omp.h                                  | libomp-dev            | libomp-devel       | openmp
lint  | command clang-format                          | clang-format          | clang-tools-extra  | clang
lint  | command cppcheck                              | cppcheck              | cppcheck           | cppcheck
lint  | command codespell                             | codespell             | codespell          | codespell
fuzz  | file lib*/clang/*/lib/*/libclang_rt.fuzzer*.a | libclang-rt-dev       | compiler-rt        | compiler-rt
wasm  | command clang                                 | clang                 | clang              | clang
wasm  | command wasm-ld                               | lld                   | lld                | lld
wasm  | file lib/wasm32-wasi/libc.a                   | wasi-libc             | -                  | -
wasm  | file lib/llvm*/lib/clang/*/lib/wasi/*wasm32.a | libclang-rt-dev-wasm32 | -                 | -
web   | command node                                  | nodejs                | nodejs             | nodejs
web   | command xz                                    | xz-utils              | xz                 | xz
web   | command esbuild                               | esbuild               | golang-github-evanw-esbuild | esbuild
web   | command wasm-opt                              | binaryen              | binaryen           | binaryen
docs  | command mandoc                                | mandoc                | mandoc             | mandoc
docs  | command cmark-gfm                             | cmark-gfm             | -                  | cmark-gfm
docs  | command python3                               | python3               | python3            | python
browser | command chromium                            | chromium              | chromium           | chromium
browser | command npm                                 | npm                   | nodejs-npm         | npm
cross | command aarch64-linux-gnu-gcc                 | gcc-aarch64-linux-gnu | -                  | -
cross | command s390x-linux-gnu-gcc                   | gcc-s390x-linux-gnu   | -                  | -
cross | command qemu-s390x                            | qemu-user             | qemu-user          | qemu-user
deb   | command dpkg-buildpackage                     | dpkg-dev              | -                  | -
deb   | command dh                                    | debhelper             | -                  | -
deb   | command lintian                               | lintian               | -                  | -
windows | command x86_64-w64-mingw32-gcc-posix        | gcc-mingw-w64-x86-64-posix | -              | -
windows | command dpkg-source                         | dpkg-dev              | -                  | -
wine  | command wine                                  | wine                  | -                  | -
wine  | file lib/wine/wine64                          | wine64                | -                  | -
probe | file lib*/*/libvulkan.so.1                    | libvulkan1            | vulkan-loader      | vulkan-icd-loader
probe | file share/vulkan/icd.d/lvp_icd*.json         | mesa-vulkan-drivers   | mesa-vulkan-drivers | vulkan-swrast
probe | file lib*/*/libEGL_mesa.so.0                  | libegl-mesa0          | mesa-libEGL        | mesa
probe | file lib*/*/libEGL.so.1                       | libegl1               | libglvnd-egl       | libglvnd
'

case $job in
build) jobs=' build ' ;;
check) jobs=' build check ' ;;
clang) jobs=' build check clang ' ;;
lint) jobs=' build check clang lint ' ;;
fuzz) jobs=' build clang fuzz ' ;;
web) jobs=' wasm web ' ;;
npm) jobs=' build wasm ' ;;
docs) jobs=' build wasm web docs ' ;;
browser) jobs=' wasm web browser ' ;;
cross) jobs=' build check cross ' ;;
deb) jobs=' build check wasm web deb ' ;;
windows) jobs=' windows ' ;;
wine) jobs=' build check windows wine ' ;;
probe) jobs=' build check probe ' ;;
*)
    echo "packages.sh: the job must be build, check, clang, lint, fuzz, web, docs, npm, browser, cross, deb, windows, wine or probe, got '$job'" >&2
    exit 2
    ;;
esac

present() { # present KIND NAME
    case $how-$1 in libraries-library) return 1 ;; libraries-*) return 0 ;; esac
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

names() { echo "$missing" | cut -d'|' -f"$1" | sed '/^[-+]$/d' | sort -u | tr '\n' ' ' | sed 's/ $//'; }
unknown() { echo "$missing" | awk -F'|' -v column="$1" '$column == "-" { print $1 }' | sort -u | paste -sd ' ' -; }

[ "$how" != libraries ] || { names 1 && exit; }

if command -v apt-get >/dev/null 2>&1; then
    names=$(names 1)
    unknown=
    install="apt-get install -y --no-install-recommends"
    refresh="apt-get update"
elif command -v dnf >/dev/null 2>&1; then
    names=$(names 2)
    unknown=$(unknown 2)
    install="dnf install -y"
    refresh='dnf makecache'
elif command -v pacman >/dev/null 2>&1; then
    names=$(names 3)
    unknown=$(unknown 3)
    install="pacman -S --needed --noconfirm"
    refresh="pacman -Sy"
else
    echo "depthprec: no apt-get, dnf or pacman here: missing (Debian's names): $(names 1)" >&2
    exit 1
fi
[ -n "$names$unknown" ] || exit 0
if [ -n "$unknown" ]; then
    echo "depthprec: missing, and of no package known here: $unknown (Debian's names). Install them by hand." >&2
    exit 1
fi

as_root=
[ "$(id -u)" -eq 0 ] || as_root='sudo '
if [ "$how" = missing ]; then
    echo "depthprec: missing: $names. This installs them: $as_root$install $names" >&2
    exit 1
fi
if [ -n "$as_root" ] && ! command -v sudo >/dev/null 2>&1; then
    echo "depthprec: missing, and there is no sudo here: $names. As root: $install $names" >&2
    exit 1
fi

echo "  INSTALL $names" >&2
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
quietly="$as_root env DEBIAN_FRONTEND=noninteractive $install"
# A fresh machine has no package lists, so a first refusal is answered with a refresh.
$quietly $names >"$log" 2>&1 </dev/null || { $as_root $refresh && $quietly $names; } >"$log" 2>&1 </dev/null || {
    tail -n 5 "$log" >&2
    echo "depthprec: missing, and could not be installed: $names. By hand: $as_root$refresh; $as_root$install $names" >&2
    exit 1
}
