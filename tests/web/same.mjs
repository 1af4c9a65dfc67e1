// SPDX-License-Identifier: GPL-3.0-or-later
// The module of the page under node against the native program, random commands:  node same.mjs MODULE ENGINE COUNT
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { difference, native } from "./native.mjs";
import { named, random, seed, state } from "./states.mjs";

const [module, engineFile, count] = process.argv.slice(2);
const { load } = await import(pathToFileURL(engineFile));
const engine = await load(new Uint8Array(readFileSync(module)));
const used = seed(), r = random(used);
named();
const commands = Array.from({ length: Number(count) }, () => state(r));
const natives = await native(commands), times = {};
let different = 0, fine = 0;
commands.forEach((words, i) => {
    const start = performance.now();
    const here = engine.run(words);
    (times[words[0]] ??= []).push(performance.now() - start);
    const what = difference(natives[i], here);
    fine += here.status < 2 ? 1 : 0;
    if (what !== "" && different++ < 10) console.log(`depthprec ${words.join(" ")}\n    ${what}`);
});
console.log(`seed ${used}: ${count} commands, ${fine} that run, ${different} different`);
if (process.env.TIMES)
    for (const [verb, list] of Object.entries(times)) {
        list.sort((a, b) => a - b);
        console.log(`${verb}: ${list.length}, median ${list[list.length >> 1].toFixed(2)} ms, longest ${list.at(-1).toFixed(1)} ms`);
    }
process.exitCode = different === 0 && fine > Number(count) / 3 ? 0 : 1;
