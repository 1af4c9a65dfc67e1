// SPDX-License-Identifier: GPL-3.0-or-later
// What the pages show of the package is what it prints:  node shown.mjs PAGE...  Of a line behind "> " the value stands below.
import { readFileSync } from "node:fs";
import { inspect } from "node:util";
import * as depthprec from "depthprec";

Object.assign(globalThis, depthprec);
const even = (text) => text.replaceAll(/\s+/g, " ").trim();
let shown = 0, wrong = 0;

async function value(source) {
    try {
        return inspect(await new Function(`return (async () => (${source}))()`)());
    } catch (error) {
        return `${error.name}: ${error.message}`;
    }
}

for (const page of process.argv.slice(2)) {
    for (const [, line, below] of readFileSync(page, "utf8").matchAll(/^ *> (.*)\n((?:(?! *>|```|\n).*\n)*)/gm)) {
        const source = line.replace(/ +\/\/ .*$/, "");
        if (source.startsWith("import ")) continue;
        const got = await value(source.replace(/^const (\w+)/, "globalThis.$1").replaceAll(/, (\w) = /g, ", globalThis.$1 = "));
        if (below === "") continue;
        shown++;
        if (even(got) !== even(below)) wrong += console.log(`${page}: ${source}\n${got}\nshown:\n${below}`) ?? 1;
    }
}
process.exitCode = shown >= 8 && wrong === 0 ? 0 : 1;
