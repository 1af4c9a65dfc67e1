// SPDX-License-Identifier: GPL-3.0-or-later
// Addresses and lines that are no command: a sentence is shown, nothing is run, the page stays as it was and goes on.
import { close, go, open, shown } from "./browser.mjs";
import { paste } from "./page_states.mjs";
import { random, seed } from "./states.mjs";
import { demand, test } from "./tap.mjs";

const r = random(seed());
const bytes = (length) => Array.from({ length }, () => `%${(128 + r.below(128)).toString(16)}`).join("");
const text = (words) => encodeURIComponent(words);

const FRAGMENTS = [
    ["random bytes", () => bytes(40)],
    ["random letters", () => Array.from({ length: 60 }, () => String.fromCharCode(33 + r.below(94))).join("")],
    ["a megabyte", () => "a".repeat(1 << 20)],
    ["a megabyte of an option", () => text(`table -n 0.${"1".repeat(1 << 20)}`)],
    ["a little too long", () => text(`plot error --title ${"x".repeat(4100)}`)],
    ["NaN", () => text("table -n NaN -f nan")],
    ["infinite near", () => text("table -n inf")],
    ["huge numbers", () => text("table -n 1e400 -f 1e999")],
    ["a script", () => text("<script>alert(1)</script>")],
    ["a script as an option", () => text("table --<script>alert(1)</script>")],
    ["a script as an argument", () => text("table -F '<img src=x onerror=alert(1)>'")],
    ["a lone %", () => "table%20-n%"],
    ["half a %", () => "table%2"],
    ["half a character", () => "table%20-F%20%ED%A0%80"],
    ["a null", () => "table%20-n%201%00"],
    ["lines", () => "table%0Atable"],
    ["very many options", () => text(`table ${"-q ".repeat(1000)}-n 1 -n 2`)],
    ["very many words", () => text(`table ${"x ".repeat(1900)}`)],
    ["very many commands", () => text(Array(50).fill("table").join(" ; "))],
    ["another command", () => text("scene house.glb")],
    ["a file", () => text("check /etc/passwd")],
    ["an unknown command", () => text("tabel")],
    ["a prototype's name", () => text("__proto__ constructor")],
    ["an open quote", () => text("table -n '1")],
    ["a web command", () => text("web table")],
    ["no command at all", () => text(" ; ; ")],
];
// A line can hold what no address can.
const LINES = [["half a character", "plot error --title '\ud800'"], ["a null", "table -n 1\0"], ["a line of 1 MB", `table ${"x".repeat(1 << 20)}`]];

// How many commands ran is counted from here on.
const watch = (page) => page.evaluate(() => {
    const { engine } = window.depthprec, { run } = engine;
    window.ran = [];
    engine.run = (words) => (window.ran.push(words.join(" ")), run(words));
});

// One that only its run refuses may be run; it is then the only one, and prints nothing.
async function refused(page, name, set) {
    const before = await shown(page);
    await page.evaluate(() => (window.ran.length = 0));
    await set();
    const now = await shown(page), ran = await page.evaluate(() => window.ran);
    demand(now.error.length > 10 && now.error.length < 600, `${name}: the error is ${JSON.stringify(now.error.slice(0, 700))}`);
    demand(!/undefined|null|\[object|is not a function|TypeError/.test(now.error), `${name}: ${now.error}`);
    demand(now.link === before.link && JSON.stringify(now.runs) === JSON.stringify(before.runs), `${name} changed the page`);
    demand(ran.length === 0, `${name}: ran ${ran.join("; ")}`);
}

const STANDARD = "depthprec table -n 0.1 -f 1000 -F unorm24 -m d3d --unit m --viewport 1920x1080";
const promises = (runs) => runs.some((one) => one.panel === "table" && one.text.includes("Guaranteed"));

async function works(page) {
    await go(page, text(`table -n 0.${1 + r.below(1e6)} -f 1000 -F d24 -m d3d`));
    const { error, runs } = await shown(page);
    demand(error === "" && promises(runs), `the page is broken: ${error}`);
}

export async function bad() {
    const page = await open();
    await watch(page);
    await test("a bad address: a sentence, nothing is run, the page stays and goes on", async () => {
        for (const [name, make] of FRAGMENTS) {
            await refused(page, name, () => go(page, make()));
            await works(page);
        }
        for (let i = 0; i < 200; i++) await refused(page, "random bytes", () => go(page, bytes(1 + r.below(50))));
        return `${FRAGMENTS.length + 200} addresses`;
    });
    await test("a bad line in the field: the same", async () => {
        for (const [name, line] of LINES) {
            await refused(page, name, () => paste(page, line));
            await works(page);
        }
    });
    await close(page);
    await test("a page that opens at a bad address says so and shows its standard camera", async () => {
        for (const [name, make] of FRAGMENTS) {
            const other = await open({ fragment: make(), folded: true });
            const { error, link } = await shown(other);
            demand(error.length > 10 && link === STANDARD, `${name}: ${error}, ${link}`);
            await close(other);
        }
    });
    await test("a link that is refused at the start: said, and left in the field to be mended", async () => {
        for (const [line, ends] of [["table -n 0.1 -f 0.05", "far 0.05"], ["table -F d25", "'d24'?"], ["check x", "the program has it"]]) {
            const other = await open({ fragment: text(line), folded: true });
            const { error, link } = await shown(other), field = await other.inputValue("#command");
            demand(error.startsWith("The link is refused, so the standard set-up is shown. ") && error.endsWith(ends), `${line}: ${error}`);
            demand(field === line && !link.includes(line), `${line}: the field has ${field}`);
            await other.fill("#command", "table -n 3");
            await other.keyboard.press("Enter");
            await other.waitForFunction(() => document.querySelector("#link").textContent.endsWith("-n 3"));
            const now = await shown(other);
            demand(now.error === "" && now.link === "depthprec table -n 3", `mended: ${now.error}`);
            await close(other);
        }
        const other = await open({ fragment: "table%2", folded: true });
        demand((await other.inputValue("#command")) === "table%2", "half a % is not in the field");
        await close(other);
    });
    await test("a title with a script is text", async () => {
        const other = await open({ fragment: text("plot error -F d24 --title '<script>alert(1)</script><img src=x onerror=alert(2)>'") });
        const { error, link } = await shown(other);
        demand(error === "" && link.includes("<script>"), error);
        demand(await other.evaluate(() => document.querySelectorAll("main script, main iframe, [onerror]").length === 0), "there are elements of it");
        await close(other);
    });
}
