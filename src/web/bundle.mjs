// SPDX-License-Identifier: GPL-3.0-or-later
// One file of all: bundle.mjs MODULE.wasm OUT.html. Style, script and the module (gzip, base64) go into page.html; the
// policy allows just these by their hashes, and no network. Modules are joined because file:// cannot import.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const [wasm, out] = process.argv.slice(2);
const read = (name) => readFileSync(new URL(name, import.meta.url), "utf8");

// Comments on lines of their own, indentation and blank lines; nothing that has a meaning.
const short = (text) =>
    text.replaceAll(/\/\*[^]*?\*\/\n?/g, "").split("\n").map((line) => line.trim())
        .filter((line) => line !== "" && !line.startsWith("//")).join("\n");

const done = new Set();
function script(name) {
    if (done.has(name)) return "";
    done.add(name);
    let before = "";
    const own = read(name).replaceAll(/^import [^;]*? from "\.\/([^"]+)";\n/gm, (_, other) => ((before += script(other)), ""));
    return before + own.replaceAll(/^export (default )?/gm, "");
}

const style = short(read("page.css"));
const code = `\n${short(script("page.js"))}\n`;
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const parts = {
    policy: ["default-src 'none'", `script-src ${hash(code)} 'wasm-unsafe-eval'`, `style-src ${hash(style)}`,
        "worker-src blob:", "img-src data: blob:", "base-uri 'none'", "form-action 'none'"].join("; "),
    style,
    script: code,
    module: execFileSync("zopfli", ["-c", wasm], { maxBuffer: 1 << 24 }).toString("base64"),
};
if (code.includes("</script") || style.includes("</style")) throw new Error("a part ends its element");
const page = short(read("page.html").replaceAll(/<!--[^]*?-->/g, "")).replaceAll(/@(\w+)@/g, (_, name) => parts[name]);
writeFileSync(out, `${page}\n`);
console.log(`${out}: ${(page.length / 1024).toFixed(0)} KiB, of which the module ${(parts.module.length / 1024).toFixed(0)}`);
