#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The npm package: written twice to the same bytes, installed into an empty folder without a network, and used there by the
# tests of npm/. Its answers, Python's and the library's are the same bits; its command prints what the program prints.
. tests/tap.sh

tarball() { echo "$B"/dist/depthprec-*.tgz; }
if ! command -v node >/dev/null 2>&1; then
    skip "the npm package" "there is no node"
elif [ -z "${DEPTHPREC_FULL-}" ] && [ ! -e "$(tarball)" ]; then
    skip "the npm package" "make npm has not made it"
fi
[ $tests -eq 0 ] || { finish; exit; }
unset MAKEFLAGS MFLAGS MAKELEVEL NODE_OPTIONS
site=$scratch/site package=$site/node_modules/depthprec count=1000 seed=${DEPTHPREC_SEED:-$(date +%s)}

build() { make --no-print-directory B="$B" CC="$CC" npm "$B/plain/depthprec" "$B/libdepthprec.a" "$B/libdepthprec.so.0"; }
same() {
    cp "$(tarball)" "$scratch/one.tgz" && touch README.md src/npm/index.js && rm "$(tarball)" && build >"$scratch/again" &&
        cmp "$scratch/one.tgz" "$(tarball)" && [ "$(wc -c <"$scratch/one.tgz")" -gt 300000 ]
}
# By npm where it is, as users do; else as npm would: unpacked.
install() {
    mkdir "$site"
    if command -v npm >/dev/null 2>&1; then
        (cd "$site" && npm install --offline --no-audit --no-fund --cache "$scratch/cache" "$scratch/one.tgz")
    else
        mkdir -p "$package" && tar -xzf "$scratch/one.tgz" -C "$package" --strip-components=1
    fi && [ -s "$package/index.js" ] && cp tests/npm/*.mjs tests/needs/engine.need "$site"
}
imports_nothing() {
    node -e '
        const imports = WebAssembly.Module.imports(new WebAssembly.Module(require("fs").readFileSync(process.argv[1])));
        console.log(imports);
        process.exitCode = imports.length' "$B/npm/core.wasm"
}
tests_of() { # tests_of FILE: some tests ran, and all of them went well
    (cd "$site" && DEPTHPREC=$plain node --test "$1") >"$scratch/unit" 2>&1
    status=$?
    cat "$scratch/unit"
    [ $status -eq 0 ] && grep -qE '^# pass [1-9]' "$scratch/unit"
}
plain=$PWD/$B/plain/depthprec
shown() { (readme=$PWD && cd "$site" && node shown.mjs "$readme/README.md" "$readme/src/npm/README.md"); }

# As a bundler that splits nothing makes it: as large as the page says, to a tenth, and it runs; without the command, too.
bundled() {
    for size in core:162 whole:935; do
        from=depthprec
        [ "${size%:*}" = whole ] || from=depthprec/core
        echo "import { Camera } from \"$from\"; console.log(new Camera({ format: \"d16\" }).encode(Infinity));" >"$site/${size%:*}.mjs"
        (cd "$site" && esbuild --bundle --minify --format=esm --platform=node --log-level=error --outfile="bundle.${size%:*}.mjs" "${size%:*}.mjs" &&
            mkdir -p apart && cp "bundle.${size%:*}.mjs" apart && [ "$(node "apart/bundle.${size%:*}.mjs")" = 65535 ]) || return
        grep -q "${size#*:} kB" src/npm/README.md || return
        wc -c <"$site/bundle.${size%:*}.mjs" | awk -v said="${size#*:}" '{ print $1, said; exit !($1 / 1000 / said > 0.9 && $1 / 1000 / said < 1.1) }' || return
    done
}
required() { # by CommonJS, as the page says of node
    (cd "$site" && [ "$(node -e 'console.log(require("depthprec").version, new (require("depthprec/core").Camera)({ format: "d16" }).codeMax)')" = "$("$DEPTHPREC" --version | sed -n '1s/.* //p') 65535" ])
}

# ---- The same bits through each door -----------------------------------------------------------------------------

walk() {
    $CC -std=gnu11 -Iinclude -Isrc -o "$scratch/walk" tests/npm/walk.c "$B/libdepthprec.a" -lm &&
        "$scratch/walk" "$seed" $count >"$scratch/setups" && "$scratch/walk" <"$scratch/setups" >"$scratch/library" &&
        [ "$(grep -c '^ ' "$scratch/library")" -gt $((count / 2)) ] &&
        (cd "$site" && node walk.mjs) <"$scratch/setups" >"$scratch/by_npm" && cmp "$scratch/library" "$scratch/by_npm"
}
walk_python() {
    mkdir "$scratch/python" && cp -r src/python/depthprec "$scratch/python" && cp "$B/libdepthprec.so.0" "$scratch/python/depthprec" &&
        PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$scratch/python python3 tests/npm/walk.py <"$scratch/setups" >"$scratch/by_python" &&
        cmp "$scratch/library" "$scratch/by_python"
}

# ---- The command -------------------------------------------------------------------------------------------------

part=3 least=30 # every third of those commands; but zfight, which takes ten seconds each
[ -z "${DEPTHPREC_FULL-}" ] || part=1 least=50

# A requirement file with all that its grammar has, and some that it refuses.
grammar() {
    cat >"$1/rich.need" <<'END'
/* two
   lines */ unit : "m" # a colon
cameras = { "a" }; // a fault
END
    sed 's/{ "a" }/{ game : { near = 1e-1, far = 0x3E8; mapping = "d" "3d"; format = "d24" } game-2 = { near = .5; far = 2000L; mapping = "REVERSED"; format = "fp32"; ortho = FALSE; }; }/' \
        "$1/rich.need" >"$1/good.need"
    cat >>"$1/good.need" <<'END'
requirements = ( { name = "x\x79\"z"; camera = "game"; at = 50; separation = 1.e-1; },
    { name = "b"; camera = "game-2"; range = [1, 40], error = 0.5 } );
END
    sed 's/\[1, 40\]/[1, 2.5]/' "$1/good.need" >"$1/mixed.need"
    sed 's/game-2 =/game =/' "$1/good.need" >"$1/twice.need"
    sed 's/= 50;/= 50 60;/' "$1/good.need" >"$1/number.need"
    sed 's/= 0.5 }/= "0.5 }/' "$1/good.need" >"$1/open.need"
}

# Files that the commands of depthprec-questions.7 read, and those commands, each on a line.
commands() {
    for door in native npm; do
        mkdir -p "$scratch/$door/bin" "$scratch/$door/work" && cp tests/needs/engine.need "$scratch/$door/work" &&
            printf 'v 0 0 -5\nv 1 0 -5\nv 0 1 -5\nv 0 0 -5.001\nv 1 0 -5.001\nv 0 1 -5.001\nf 1 2 3\nf 4 5 6\n' >"$scratch/$door/work/two.obj" &&
            grammar "$scratch/$door/work" &&
            "$plain" texture --synthetic plane --parameter tilt=60 -F unorm16 -m d3d -q -o "$scratch/$door/work/depth.npy" || return
    done
    ln -s "$plain" "$scratch/native/bin/depthprec"
    printf '#!/bin/sh\nexec node "%s/depthprec.js" "$@"\n' "$package" >"$scratch/npm/bin/depthprec"
    chmod +x "$scratch/npm/bin/depthprec"
    "$plain" list questions | sed -e ':more' -e '/\\$/{' -e 'N' -e 's/ *\\\n */ /' -e 'b more' -e '}' |
        sed -n 's/^  depthprec /depthprec /p' | sed 's/\.png/.npy/g' |
        awk -v part=$part 'part == 1 || (NR % part == 0 && !/ zfight /)' >"$scratch/questions"
    cat >>"$scratch/questions" <<'END'
depthprec check engine.need
depthprec check engine.need --json
depthprec check - <engine.need --csv
depthprec check rich.need
depthprec check good.need
depthprec check mixed.need
depthprec check twice.need
depthprec check number.need
depthprec check open.need
depthprec scene two.obj -F d24 -m d3d
depthprec texture depth.npy -n 0.1 -f 1000 -m d3d --json
depthprec texture depth.npy -n 0.1 -f 1000 -m d3d --product position -o place.npy
depthprec texture none.npy
depthprec plot error -n 0.1 -o error.svg
depthprec table -n 0.1 -o none/here
depthprec texture depth.npy -n 0.1 -f 1000 -o depth.npy
depthprec list presets
depthprec methods interval
depthprec completions bash
depthprec help texture
depthprec tables
END
}
by() { # by DOOR: the commands, what each prints, its exit status; then the files that are there
    export PATH="$scratch/$1/bin:$PATH" TERM=dumb
    cd "$scratch/$1/work" && while read -r line; do
        echo "$line"
        sh -c "$line" 2>../error </dev/null
        echo "exit status $?"
        cat ../error
    done <"$scratch/questions"
    cksum -- *
}
# A command that is refused by name may differ.
compare() {
    commands || return
    (by native) >"$scratch/native/said" 2>&1 && (by npm) >"$scratch/npm/said" 2>&1
    awk -v commands="$scratch/questions" -v least=$least '
        BEGIN { while ((getline line <commands) > 0) known[line] = 1 }
        FNR == 1 { at = "" }
        $0 in known { at = $0 }
        FILENAME == ARGV[1] { native[at] = native[at] $0 "\n"; next }
        { npm[at] = npm[at] $0 "\n" }
        END {
            for (c in known)
                if (npm[c] ~ /not (read )?in the npm package: the native program has it/) refused++
                else if (native[c] == npm[c]) same++
                else printf "native:\n%snpm:\n%s", native[c], npm[c]
            print same + 0, "the same,", refused + 0, "refused"
            exit !(same >= least && refused <= 2)
        }' "$scratch/native/said" "$scratch/npm/said" >"$scratch/compared"
    status=$?
    cat "$scratch/compared"
    [ $status -eq 0 ] && [ "$(wc -l <"$scratch/compared")" -eq 1 ]
}

check "it is built" build
check "written twice it is the same bytes" same
check "it is installed into an empty folder" install
[ $failures -eq 0 ] || { finish; exit 1; }
check "the library's module imports nothing" imports_nothing
check "tests of npm/: numbers" tests_of numbers.mjs
check "tests of npm/: program" tests_of program.mjs
check "its page and README.md show what it prints" shown
if command -v esbuild >/dev/null 2>&1; then
    check "bundled, alone and with the command" bundled
else
    skip "bundled, alone and with the command" "there is no esbuild"
fi
if node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 22 || (a === 22 && b >= 12) || (a === 20 && b >= 19) ? 0 : 1)'; then
    check "required by CommonJS" required
else
    skip "required by CommonJS" "node is older than the page asks for"
fi
check "$count set-ups of seed $seed: the same bits as the library" walk
if command -v python3 >/dev/null 2>&1; then
    check "the same bits by Python" walk_python
else
    skip "the same bits by Python" "there is no python3"
fi
if [ -n "${DEPTHPREC_FULL-}" ] && (cd "$site" && npm install --no-audit --no-fund --ignore-scripts three@0.187.0 @cesium/engine@26.3.0) >"$scratch/log" 2>&1; then
    check "matrices of three.js and Cesium" tests_of engines.mjs
else
    skip "matrices of three.js and Cesium" "make check-full fetches them by npm, where there is a network"
fi
check "the command prints what the program prints" compare
finish
