// SPDX-License-Identifier: GPL-3.0-or-later
// How long a whole update takes while a slider is dragged: the commands, the figure, style and layout.
import { readFileSync } from "node:fs";
import { address, close, go, open, settled, shown } from "./browser.mjs";
import { isEnded } from "./page_states.mjs";
import { plain } from "./plain.mjs";
import { demand, test } from "./tap.mjs";

const LIMIT = 16, UPDATES = 200, ROUNDS = 3; // ms; a busy machine has another try

// Stamps around each frame's update: one callback stands before the page's own, one behind it.
function record() {
    window.taken = [];
    const { dataset } = document.documentElement;
    let start = 0, count = 0;
    addEventListener("input", () => requestAnimationFrame(() => ((count = dataset.updates), (start = performance.now()))), true);
    addEventListener("input", () => requestAnimationFrame(() => {
        if (dataset.updates === count) return;
        document.body.getBoundingClientRect();
        window.taken.push(performance.now() - start);
    }));
}

async function drag(page) {
    const box = await page.locator("#a [data-slider=near]").boundingBox(), y = box.y + box.height / 2;
    await page.evaluate(() => (window.taken.length = 0));
    await page.mouse.move(box.x + 10, y);
    await page.mouse.down();
    for (let step = 0; (await page.evaluate(() => window.taken.length)) < UPDATES && step < 4 * UPDATES; step++)
        await page.mouse.move(box.x + 10 + ((3 * step) % (box.width - 20)), y);
    await page.mouse.up();
    return (await page.evaluate(() => window.taken)).sort((a, b) => a - b);
}

const SLOW = encodeURIComponent("table -n 0.2 -f 1000 -F d24 -m d3d ; plot map ; zfight -n 0.2 -f 1000 -F d24 -m d3d");

// The slow panels once all is there, beside what the module says on the page's own thread.
const slow = (page) => page.evaluate(() => {
    const { engine } = window.depthprec;
    const text = document.querySelector("[data-panel=zfight] [data-run]"), svg = document.querySelector("[data-panel=plot] [data-run]");
    const drawn = decodeURIComponent(svg.querySelector("img").src.split(",")[1]), size = /width="(\d+)" height="(\d+)"/.exec(drawn);
    const again = ["--type", "svg", "-o", "-", "--theme", "light", "--figure-size", `${size[1]}x${size[2]}`];
    return {
        text: text.querySelector("[data-output]").textContent, svg: drawn,
        textHere: engine.run(text.dataset.run.split(" ")).out,
        svgHere: engine.run([...svg.dataset.run.split(" "), ...again]).out,
    };
});

async function compareSlow(page) {
    const { text, svg, textHere, svgHere } = await slow(page);
    demand(text.length > 200 && text === plain(textHere), `ties and swaps: ${text.slice(0, 300)}`);
    demand(svg.length > 2000 && svg === svgHere, "the map is another figure");
}

// From here on: what runs on the page's own thread, and how long a task of it takes.
const watch = (page) => page.evaluate(() => {
    const { engine } = window.depthprec, { run } = engine;
    window.held = [0], window.ranHere = [];
    engine.run = (line, most) => (window.ranHere.push(line.join(" ")), run(line, most));
    new PerformanceObserver((list) => window.held.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: "longtask" });
});

// The longest task; no command may have run here.
async function held(page, what) {
    await page.waitForTimeout(100);
    const { longest, ran } = await page.evaluate(() => ({ longest: Math.max(...window.held.splice(0), 0), ran: window.ranHere.splice(0) }));
    demand(ran.length === 0, `${what}: on the page's own thread: ${ran.slice(0, 5).join("; ")}`);
    return longest;
}

async function aside() {
    const page = await open();
    await watch(page);
    await page.evaluate((to) => (location.hash = to), SLOW);
    await page.waitForTimeout(230);
    await page.fill("#near-A", "0.3"); // leaves what runs
    await page.waitForFunction(() => document.querySelector("#link").textContent.includes("-n 0.3"));
    await settled(page);
    const longest = await held(page, "slow commands");
    demand((await shown(page)).runs.some(({ panel, run }) => panel === "zfight" && run.includes("-n 0.3")), "the last change is not shown");
    await compareSlow(page);
    await close(page);
    return `longest task, which is the browser's with the map's picture: ${longest} ms`;
}

// Each figure of each model while near, far and the format change.
async function everything() {
    const page = await open(), worst = { ms: -1 };
    await watch(page);
    for (const model of ["exact", "staged", "float"])
        for (const figure of await page.evaluate(() => [...document.querySelectorAll("[name=figure]")].map(({ value }) => value))) {
            await page.evaluate((value) => document.querySelector(`[name=figure][value=${value}]`).click(), figure);
            await page.selectOption("#model-A", model);
            for (const [slider, to] of [["near", 100], ["near", 300], ["far", 250], ["far", 500], ["near", 200]])
                await page.evaluate(([name, step]) => {
                    const one = document.querySelector(`#a [data-slider=${name}]`);
                    one.value = step;
                    one.dispatchEvent(new Event("input"));
                    return new Promise(requestAnimationFrame);
                }, [slider, to]);
            await page.selectOption("#format-A", figure === "error" ? "fp32" : "unorm24");
            await settled(page);
            const ms = await held(page, `${figure}, ${model}`);
            if (ms > worst.ms) Object.assign(worst, { ms, figure, model });
        }
    await close(page);
    return `longest task ${worst.ms} ms: ${worst.figure}, ${worst.model}`;
}

const pasted = (page, line) => page.evaluate((text) => {
    document.querySelector("#command").value = text;
    document.querySelector("#line").requestSubmit();
}, line);

// Those of the manual page that the page has, as a person pastes them.
async function questions() {
    const text = readFileSync(`${process.env.B ?? "build"}/man/depthprec-questions.7`, "utf8").replaceAll(/ *\\e\n */g, " ").replaceAll("\\(aq", "'");
    const lines = [...text.matchAll(/^depthprec ((?:table|solve|bias|budget|zfight|prepass)\b[^|>\n]*)$/gm)].map(([, line]) => line);
    const page = await open();
    await watch(page);
    let longest = 0;
    for (const line of lines) {
        const before = await page.evaluate(() => document.documentElement.dataset.updates);
        await pasted(page, line);
        await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before);
        await settled(page);
        longest = Math.max(longest, await held(page, line));
        const { error } = await shown(page);
        demand(error === "" || /the program/.test(error), `${line}: ${error}`);
    }
    demand(lines.length >= 8, `only ${lines.length} questions`);
    await close(page);
    return `${lines.length} commands; longest task ${longest} ms`;
}

// What would hold a thread for hours: the page goes on, and says after ten seconds, or when asked, that it has ended it.
async function endless() {
    const page = await open(), line = "zfight -n 0.1 -f 1000 -F d24 -m d3d --sample 1000000000000 --separation 1";
    await watch(page);
    await pasted(page, line);
    await page.waitForFunction(() => !document.querySelector("#busy").hidden, null, { timeout: 5000 });
    await page.click("#cancel");
    await page.waitForFunction(() => !document.querySelector("#error").hidden, null, { timeout: 5000 });
    demand((await shown(page)).error.includes("was cancelled"), (await shown(page)).error);
    await held(page, "cancelled");
    await close(page);
    // Opened at such a link, the page can be used at once.
    const used = await open({ wait: false, fragment: encodeURIComponent(line) });
    await used.waitForFunction(() => document.querySelector("#link").textContent.includes("-n 0.1"));
    await used.fill("#near-A", "0.7");
    const begun = Date.now();
    await settled(used);
    demand(Date.now() - begun < 9000, "a change waits for what it replaces"); // ten seconds are its limit
    demand((await shown(used)).runs.some(({ run }) => run.startsWith("table -n 0.7")), "a page that waits for its link cannot be used");
    await close(used);
    for (const [fragment, says] of [[line, true], ["table -n 0.5 --at 1:2:lin:300000", false]]) { // a busy machine may not end it
        const other = await open({ fragment: encodeURIComponent(fragment) }), { error, runs } = await shown(other);
        const ended = isEnded(error);
        demand(ended || (!says && error === ""), `${fragment}: ${error}`);
        demand(runs.every(({ text }) => text === null || text.length < 300000), `${fragment}: ${runs.map(({ text }) => text?.length)}`);
        demand(ended || runs.some(({ text }) => text?.includes("KiB more: CSV has all")), `${fragment}: nothing says that it is cut`);
        await close(other);
    }
}

// Where no worker is to be had, the page runs them itself.
async function alone() {
    const page = await open();
    await page.addInitScript(() => delete window.Worker);
    await page.goto("about:blank");
    await page.goto(`${address}#${SLOW}`);
    await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined);
    await settled(page);
    await compareSlow(page);
    await close(page);
}

// Frames a second on a phone of a quarter of this machine's speed; the aim is 30, and an idle machine. Below 5 it stands still.
async function phone() {
    const page = await open({ width: 390, height: 844, mobile: true }), said = [];
    await settled(page);
    await (await page.context().newCDPSession(page)).send("Emulation.setCPUThrottlingRate", { rate: 4 });
    for (const [what, selector] of [["the camera moves", "#play"], ["the gap is dragged", "#gap"], ["near is dragged", "#a [data-slider=near]"]]) {
        if (selector === "#play") await page.click(selector);
        await page.locator(selector).scrollIntoViewIfNeeded();
        const before = await page.evaluate(() => document.documentElement.dataset.updates);
        const frames = await page.evaluate(([slider, count]) => new Promise((done) => {
            const one = document.querySelector(slider), start = performance.now();
            let n = 0;
            const step = () => {
                if (one.type === "range") {
                    one.value = Number(one.max) * (0.3 + 0.3 * Math.abs((n % 40) / 20 - 1));
                    one.dispatchEvent(new Event("input", { bubbles: true }));
                }
                if (n++ < count) requestAnimationFrame(step);
                else done((1000 * count) / (performance.now() - start));
            };
            requestAnimationFrame(step);
        }), [selector, 120]);
        if (selector === "#play") await page.click(selector);
        await settled(page);
        const after = await page.evaluate(() => document.documentElement.dataset.updates);
        demand(frames > 5 && (after !== before) === selector.includes("near"), `${what}: ${frames} frames a second, updates ${before} to ${after}`);
        said.push(`${what}: ${frames.toFixed(0)}`);
    }
    await close(page);
    return `frames a second: ${said.join(", ")}`;
}

export async function redraw() {
    await test("what takes long does not hold the page, and is the same", aside);
    await test("no figure of any model runs on the page's own thread", everything);
    await test("nor does a question of the manual page that is pasted", questions);
    await test("what never ends is ended, and what is endless is cut", endless);
    await test("without workers it is the same, too", alone);
    await test("a slow phone goes on", phone);
    const page = await open();
    await page.evaluate(record);
    await test(`a whole update while near is dragged takes less than ${LIMIT} ms, median of ${UPDATES}`, async () => {
        let said, median;
        for (let round = 0; round < ROUNDS && !(median < LIMIT); round++) {
            const times = await drag(page), at = (share) => times[Math.floor(share * (times.length - 1))];
            demand(times.length >= UPDATES, `only ${times.length} updates`);
            median = at(0.5);
            said = `median ${median.toFixed(1)} ms, 95 % ${at(0.95).toFixed(1)} ms, longest ${at(1).toFixed(1)} ms`;
        }
        demand(median < LIMIT, said);
        return said;
    });
    await close(page);
}
