#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The core as WebAssembly: what it gives at 100,000 depths (a million with DEPTHPREC_FULL), in every mapping, format and
# arithmetic, is what it gives here, bit for bit; and the module of the core needs nothing from outside. The program as WebAssembly: random commands
# print what they print here, to the byte. Addresses of the page, and pasted lines, whatever stands there. page.sh goes on
# in a browser.
. tests/tap.sh

blocks=2000 commands=150 addresses=10000 # blocks of 50 depths
[ -z "${DEPTHPREC_FULL-}" ] || blocks=20000 commands=600 addresses=100000

lacking() { # prints what is not here of what the tests need
    echo 'int main(void) { return 0; }' | ${WEB_CC:-clang --target=wasm32-wasi} -x c -o "$scratch/probe.wasm" - >"$scratch/log" 2>&1 ||
        echo "clang, lld, wasi-libc and libclang-rt for wasm32"
    node -e 'require("node:wasi")' >"$scratch/log" 2>&1 || echo "node 20"
}

there() { # there PROGRAM WORD...: what it prints as a module
    program=$1
    shift
    node --no-warnings --input-type=module -e '
        import { WASI } from "node:wasi";
        import { readFileSync } from "node:fs";
        const [file, ...more] = process.argv.slice(1);
        const wasi = new WASI({ version: "preview1", args: [file, ...more], returnOnExit: true });
        const { instance } = await WebAssembly.instantiate(readFileSync(file), wasi.getImportObject());
        process.exitCode = wasi.start(instance);' "$B/web/$program.wasm" "$@"
}

same() { # same LINES PROGRAM WORD...: it prints the same here and there, more lines than that
    least=$1
    shift
    "$B/web/$@" >"$scratch/here" && there "$@" >"$scratch/there" || return
    diff "$scratch/here" "$scratch/there" | head -n 10
    [ "$(wc -l <"$scratch/here")" -gt "$least" ] && cmp "$scratch/here" "$scratch/there"
}

self_contained() {
    node -e '
        const module = new WebAssembly.Module(require("fs").readFileSync(process.argv[1]));
        const imports = WebAssembly.Module.imports(module), exports = WebAssembly.Module.exports(module).map((e) => e.name);
        console.log(imports, exports.length);
        process.exitCode = imports.length === 0 && exports.includes("dp_setup_init") ? 0 : 1;' "$B/web/core.wasm"
}

commands() {
    cp src/web/engine.js "$scratch/engine.mjs"
    node --no-warnings tests/web/same.mjs "$B/web/depthprec.wasm" "$scratch/engine.mjs" $commands
}

lengths() {
    node --no-warnings tests/web/lengths.mjs "$B/web/depthprec.wasm" "$scratch/engine.mjs"
}

addresses() {
    cp src/web/command.js "$scratch/command.mjs"
    node --no-warnings tests/web/fuzz.mjs "$scratch/command.mjs" $addresses
}

# What the page's forms and lists call an option of a command is one of that command.
controls() {
    awk -F '"' '/data-asks="/ { for (i = 1; i < NF; i++) if ($i ~ /data-asks=$/) verb = $(i + 1) }
        /<\/form>/ { verb = "" }
        verb != "" { for (i = 1; i < NF; i++) if ($i ~ /data-option=$/) print verb, $(i + 1) }' \
        src/web/page.html >"$scratch/controls"
    sed -n '/^const ASKED/,/^};/s/^    \([a-z]*\): \[\("[a-z", ]*"\)\],$/\1 \2/p' src/web/state.js | tr -d '",' |
        awk '{ for (i = 2; i <= NF; i++) print $1, $i }' >>"$scratch/controls"
    sed -n 's/^\(export \)\{0,1\}const \(NEVER\|VIEW\) = \[\("[a-z", -]*"\)\];$/\3/p' src/web/state.js | tr -d '",' | tr ' ' '\n' |
        sed 's/^/options /' >>"$scratch/controls"
    while read -r verb option; do
        "$DEPTHPREC" help "$verb" | grep -q -e "--$option\b" || echo "$verb has no --$option"
    done <"$scratch/controls"
    [ "$(wc -l <"$scratch/controls")" -ge 40 ] || echo "only $(wc -l <"$scratch/controls") controls"
}
check "each control of the page is an option of its command" empty controls

# A local of an imported name is taken for it elsewhere in its scope.
hidden() {
    node -e '
        const { readFileSync } = require("fs");
        let count = 0;
        for (const path of process.argv.slice(1)) {
            const text = readFileSync(path, "utf8").replaceAll(/\/\/.*$/gm, "");
            for (const [, list] of text.matchAll(/^import \{([^}]*)\}/gm))
                for (const name of list.split(",").map((part) => part.trim().split(" ").at(-1)).filter(Boolean)) {
                    const own = name.replace("$", "\\$"), end = "(?![\\w$])";
                    count++;
                    const local = new RegExp(`(?:const|let|var)\\s+(?:[^;\\n]*,\\s*)?${own}${end}\\s*(?:=[^=>]|;)|(?:const|let|var)\\s*[[{](?:[^=\\n]*[\\s,{[])?${own}${end}[^=\\n]*[\\]}]\\s*=`);
                    const found = local.exec(text.replaceAll(/^import [^;]*;/gm, ""));
                    if (found !== null) console.log(`${path}: ${name}: ${found[0]}`);
                }
        }
        if (count < 40) console.log(`only ${count} imports`);' src/web/*.js src/npm/*.js
}
check "no local of a module of the page hides what it imports" empty hidden

flickers() {
    cp src/web/picture.js "$scratch/picture.mjs" && node tests/web/picture.mjs "$scratch/picture.mjs"
}
if command -v node >"$scratch/log" 2>&1; then
    check "when a picture is said to flicker" flickers
else
    skip "when a picture is said to flicker" "there is no node"
fi

missing=$(lacking | paste -sd ';')
if [ -n "$missing" ]; then
    skip "the core as WebAssembly" "missing: $missing"
else
    check "it is built" make --no-print-directory B="$B" CC="$CC" "$B/web/core.wasm" "$B/web/samples.wasm" "$B/web/samples" \
        "$B/web/frames.wasm" "$B/web/frames"
    check "the same bits as here" same 200 samples $blocks
    check "the same frames of the flickering picture" same 30 frames
    check "the module imports nothing" self_contained
    check "the program is built" make --no-print-directory B="$B" CC="$CC" "$B/web/depthprec.wasm"
    check "random commands print the same" commands
    check "lengths of the page's sliders are the program's" lengths
    check "any address is commands or a sentence" addresses
fi
finish
