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

// Its header gets the number of bytes, which xz leaves open.
function packed(path) {
    const module = readFileSync(path), streams = apart(module);
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
