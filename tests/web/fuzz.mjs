// SPDX-License-Identifier: GPL-3.0-or-later
// What the page makes of an address and of a pasted line, whatever stands there:  node fuzz.mjs COMMAND.mjs COUNT
// The words are those of a shell, and those of which --link made the link.
import { execFileSync } from "node:child_process";
import { pathToFileURL } from "node:url";
import { native } from "./native.mjs";
import { named, random, seed, state } from "./states.mjs";
import { demand, finish, test } from "./tap.mjs";

const [file, count] = process.argv.slice(2);
const { LONGEST, commands, fromFragment, join, split, toFragment } = await import(pathToFileURL(file));
const used = seed(), r = random(used);
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

const PIECES = ["table", "depthprec", "-n", "0.1", ";", "%3B", "%20", " ", "'", '"', "\\", "%", "%2", "%zz", "%00", "%0A", "%ED%A0%80",
    "%C3%A4", "%F0%9F%98%80", "\ud800", "\udc00", "😀", "ä", "\n", "\t", "\x7f", "<script>", "--title=", "NaN", "&", "=", "#", "%E2%80%AE", ""];
const letters = (length) => Array.from({ length }, () => String.fromCharCode(r.chance(0.9) ? r.below(128) : r.below(65536))).join("");
const anything = () => Array.from({ length: r.below(12) }, () => (r.chance(0.7) ? r.of(PIECES) : letters(r.below(6)))).join("");

// A sentence, or commands of words that the program may be given.
function judge(read, text) {
    let all;
    try {
        all = read(text);
    } catch (error) {
        demand(error.constructor === Error && error.message.length > 10 && error.message.length < 200, `${JSON.stringify(text)}: ${error.name} ${error.message}`);
        return false;
    }
    demand(Array.isArray(all) && all.every((words) => words.length > 0 && words.every((word) => typeof word === "string" && word !== ";" && word.isWellFormed() && !/[\0-\x1f\x7f]/.test(word))), JSON.stringify(text));
    return all;
}

await test(`${count} addresses: words without control characters, or a sentence`, () => {
    let good = 0, back = 0;
    for (let i = 0; i < count; i++) {
        const text = i % 1000 === 0 ? letters(LONGEST + r.below(3) - 1) : anything();
        judge(commands, text);
        const all = judge(fromFragment, text);
        if (all === false || all.length === 0) continue;
        demand(text.length <= LONGEST, `${text.length} characters`);
        good++;
        if (all.some((words) => words[0] === "depthprec")) continue;
        const again = toFragment(all);
        demand(again.length > LONGEST || same(fromFragment(again), all), `${JSON.stringify(text)} -> ${again}`);
        back++;
    }
    demand(good > count / 20 && back > count / 40, `only ${good} good ones, ${back} written again`);
    return `seed ${used}: ${good} good ones`;
});

await test("the words of a line are those of a shell", () => {
    const alphabet = [..."ab1.,:=-%  ''\"\"\\\\"];
    let compared = 0;
    while (compared < 300) {
        const line = Array.from({ length: r.below(14) }, () => r.of(alphabet)).join("");
        let there, here;
        try {
            there = execFileSync("sh", ["-c", `for word in ${line}\ndo printf '%s\\n' "$word"; done`], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
        } catch {
            there = null;
        }
        try {
            here = split(line).map((word) => `${word}\n`).join("");
        } catch {
            here = null;
        }
        if (/(^|[^\\])(\\\\)*\\$/.test(line)) continue; // a shell reads on
        demand(here === there, `${JSON.stringify(line)}: ${JSON.stringify(here)}, a shell says ${JSON.stringify(there)}`);
        compared++;
    }
});

await test("words, written for a shell and read again", () => {
    for (let i = 0; i < count / 10; i++) {
        const words = Array.from({ length: 1 + r.below(5) }, () => anything().toWellFormed().replace(/[\0-\x1f\x7f]/g, ""));
        demand(same(split(join(words)), words), JSON.stringify(words));
    }
});

await test("a link is the command again", async () => {
    named();
    const lines = Array.from({ length: 300 }, () => state(r)), links = await native(lines.map((line) => ["--link", ...line]));
    let good = 0;
    links.forEach(({ status, out }, i) => {
        if (status !== 0) return;
        const fragment = out.trim().replace(/^[^#]*#/, ""), [words] = fromFragment(fragment);
        demand(same(words, lines[i].filter((word) => word !== "--")) && toFragment([words]) === fragment, `${lines[i].join(" ")} -> ${out}`);
        good++;
    });
    demand(good > 200, `only ${good}`);
});
finish();
