// SPDX-License-Identifier: GPL-3.0-or-later
// One file of all: bundle.mjs MODULE.wasm OUT.html. Style, script and the module (streams, LZMA, base64) go into page.html; the
// policy allows just these by their hashes, and no network. Scripts are joined because file:// cannot import.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { apart } from "./streams.mjs";
import { BEFORE, unpack } from "./unpack.mjs";

const [wasm, out] = process.argv.slice(2);
const run = (program, words, input = undefined) => execFileSync(program, words, { maxBuffer: 1 << 24, input });
const path = (name) => fileURLToPath(new URL(name, import.meta.url));
const joined = (name) => run("esbuild", ["--bundle", "--minify", "--log-level=warning", path(name)]).toString();

// A module whose data are one piece with its zeros, of which LZMA makes less than of where 2,700 pieces lie: wasm-opt parts
// them. It counts the pieces in a section of its own, which nothing here needs.
function filled(module) {
    const DATA = 11, COUNT = 12, sections = [], pieces = [];
    let at = 0;
    const number = () => {
        for (let value = 0, scale = 1; ; scale *= 128) {
            const byte = module[at++];
            value += (byte & 127) * scale;
            if (byte < 128) return value;
        }
    };
    const written = (value, least = 128) => (value < least ? [value] : [(value & 127) | 128, ...written(value >> 7, least)]);
    for (at = 8; at < module.length; ) {
        const from = at++, size = number(), end = at + size;
        if (module[from] === DATA)
            for (let count = number(); count > 0; count--) {
                if (module[at] !== 0 || module[at + 1] !== 0x41) throw new Error("data without a place");
                at += 2;
                const place = number(), length = (at++, number());
                pieces.push([place, module.subarray(at, (at += length))]);
            }
        else if (module[from] !== COUNT) sections.push(module.subarray(from, end));
        at = end;
    }
    const lowest = pieces[0][0], highest = Math.max(...pieces.map(([place, { length }]) => place + length)), all = Buffer.alloc(highest - lowest);
    for (const [place, bytes] of pieces) all.set(bytes, place - lowest);
    const head = Buffer.from([1, 0, 0x41, ...written(lowest, 64), 0x0b, ...written(all.length)]);
    return Buffer.concat([module.subarray(0, 8), ...sections, Buffer.from([DATA, ...written(head.length + all.length)]), head, all]);
}

// Its header gets the number of bytes, which xz leaves open.
function packed(path) {
    const module = filled(readFileSync(path)), streams = apart(module);
    const all = run("xz", ["-c", "--format=lzma", `--lzma1=preset=9e,lc=${BEFORE},pb=0,nice=64`], streams);
    all.writeBigUInt64LE(BigInt(streams.length), 5);
    if (!module.equals(unpack(Uint8Array.from(all)))) throw new Error("the module is not unpacked as it was");
    return all;
}

const style = joined("page.css");
const code = joined("page.js");
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const parts = {
    policy: ["default-src 'none'", `script-src ${hash(code)} 'wasm-unsafe-eval'`, `style-src ${hash(style)}`,
        "worker-src blob:", "img-src data: blob:", "base-uri 'none'", "form-action 'none'"].join("; "),
    style,
    script: code,
    module: packed(wasm).toString("base64"),
};
if (code.includes("</script") || style.includes("</style")) throw new Error("a part ends its element");
const page = readFileSync(path("page.html"), "utf8").replaceAll(/@(\w+)@/g, (_, name) => parts[name]);
writeFileSync(out, page);
console.log(`${out}: ${(page.length / 1024).toFixed(0)} KiB, of which the module ${(parts.module.length / 1024).toFixed(0)}`);
