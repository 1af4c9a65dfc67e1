// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of `make docs` in Chromium, from disk. Links are gone through by what the browser makes of them.
import { execFileSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { axe, browser, close, said } from "./browser.mjs";
import { demand, finish, test } from "./tap.mjs";

const folder = resolve(process.env.B ?? "build", "docs");
const pages = readdirSync(folder, { recursive: true }).map(String).filter((n) => n.endsWith(".html") && n !== "depthprec.html").sort();
const url = (name) => pathToFileURL(resolve(folder, name)).href;

async function open(name, { width = 1200, theme = "light" } = {}) {
    const context = await browser.newContext({ viewport: { width, height: 800 }, colorScheme: theme });
    const page = await context.newPage();
    page.on("console", (message) => said.push(`${name}: ${message.text()}`));
    page.on("pageerror", (error) => said.push(`${name}: ${error.message}`));
    await page.goto(url(name));
    return page;
}

const facts = new Map(); // of each page its ids, its links and its pictures
for (const name of pages) {
    const page = await open(name);
    facts.set(url(name), await page.evaluate(() => ({
        ids: [...document.querySelectorAll("[id]")].map((e) => e.id),
        links: [...document.querySelectorAll("a[href]")].map((a) => a.href),
        blank: [...document.images].filter((i) => i.complete && i.naturalWidth === 0).map((i) => i.src),
        names: [...document.querySelectorAll("h1,h2,h3,dt")].filter((e) => !e.id && !e.querySelector("[id]")).map((e) => e.textContent),
    })));
    await close(page);
}
const all = [...facts.values()].flatMap((f) => f.links);

await test("each manual page and each README.md is one", () => {
    const missing = [...readdirSync("man").filter((n) => /\.[1-9]$/.test(n)).map((n) => `man/${n}.html`), "index.html",
        "plots/index.html", "src/index.html", "tests/index.html"].filter((n) => !pages.includes(n));
    demand(missing.length === 0, `not there: ${missing}`);
});

await test("each link leads to a file and a place that are there", () => {
    const broken = [];
    for (const [page, { links }] of facts)
        for (const link of links) {
            const [file, place] = link.split("#");
            if (/^https?:/.test(file)) continue;
            if (!existsSync(fileURLToPath(file))) broken.push(`${page}: ${link}`);
            else if (place && facts.has(file) && !facts.get(file).ids.includes(decodeURIComponent(place))) broken.push(`${page}: no ${link}`);
        }
    demand(broken.length === 0, broken.slice(0, 20).join("\n"));
    demand(all.length > 1000, `only ${all.length} links`);
    return `${all.length} links`;
});

await test("no name of a place is given twice, and each heading and term has one", () => {
    for (const [page, { ids, names }] of facts) {
        const twice = ids.filter((id, i) => ids.indexOf(id) !== i);
        demand(twice.length === 0, `${page}: ${twice}`);
        demand(names.length === 0, `${page}: without: ${names}`);
    }
});

await test("each picture is there", () => {
    for (const [page, { blank }] of facts) demand(blank.length === 0, `${page}: ${blank}`);
});

await test("no address is one of this machine's root or of another host's script", () => {
    for (const name of pages) {
        const text = readFileSync(resolve(folder, name), "utf8");
        demand(!/(src|href)="\/|<(script|link|img)[^>]*(src|href)="https?:/.test(text), name);
    }
});

await test("on a phone nothing is wider than the screen", async () => {
    for (const name of pages) {
        const page = await open(name, { width: 360 });
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        await close(page);
        demand(wide <= 360, `${name}: ${wide}`);
    }
});

// All pages have the same colours, so that two are enough in the dark.
await test("axe finds nothing, in light and dark", async () => {
    for (const theme of ["light", "dark"])
        for (const name of theme === "light" ? pages : ["index.html", "man/depthprec-table.1.html"]) {
            const page = await open(name, { theme });
            await page.addScriptTag({ path: axe });
            const found = await page.evaluate(async () => (await window.axe.run(document, { preload: false })).violations.map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 200)}`));
            await close(page);
            demand(found.length === 0, `${name}, ${theme}: ${found.join("; ")}`);
        }
});

// What is typed, and the place that is to stand among the first three.
const LOOKED_FOR = [["separation", /separation/i], ["--viewport", /viewport/], ["near", /near/], ["monotony", /#Monotony$/],
    ["polygonoffset", /./], ["kScale", /Stereo/i], ["certain_to", /certain_to/], ["z-fighting", /./], ["_zbufferparams", /./]];
await test("search finds what people look for", async () => {
    const page = await open("man/depthprec.1.html");
    await page.focus("input[type=search]");
    for (const [typed, place] of LOOKED_FOR) {
        await page.fill("input[type=search]", typed);
        await page.waitForSelector("#search-results a", { timeout: 10000 }).catch(() => demand(false, `nothing for ${typed}`));
        const first = await page.evaluate(() => [...document.querySelectorAll("#search-results a")].slice(0, 3).map((a) => a.href));
        demand(first.some((a) => place.test(a)), `${typed}: ${first}`);
    }
    await page.fill("input[type=search]", "xyzzy");
    demand((await page.textContent("#search-results")).includes("Nothing here is called xyzzy"), "a word that is nowhere");
    await close(page);
});

await test("each question has its place, and the commands open in the page", async () => {
    const questions = facts.get(url("man/depthprec-questions.7.html"));
    const count = readFileSync(`${process.env.B ?? "build"}/man/depthprec-questions.7`, "utf8").match(/^\.It$/gm).length;
    demand(questions.ids.filter((id) => /^q\d+$/.test(id)).length === count, `not ${count} questions`);
    const commands = [...new Set(all.filter((link) => link.startsWith(`${url("depthprec.html")}#`)))];
    demand(commands.length >= 60, `only ${commands.length} commands`);
    const context = await browser.newContext(), page = await context.newPage();
    for (const link of commands.filter((l) => /#table/.test(l)).slice(0, 3)) {
        await page.goto("about:blank");
        await page.goto(link);
        await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined, null, { timeout: 30000 });
        const words = decodeURIComponent(link.split("#")[1]).split(" ");
        const first = execFileSync(process.env.DEPTHPREC, words, { encoding: "utf8" }).split("\n")[0];
        await page.waitForFunction((line) => document.body.textContent.includes(line), first, { timeout: 20000 })
            .catch(() => demand(false, `${link} does not show: ${first}`));
    }
    await context.close();
    return `${commands.length} commands`;
});

await test("nothing is said on the console", () => demand(said.length === 0, said.slice(0, 5).join("\n")));
await browser.close();
finish();
