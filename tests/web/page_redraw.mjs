// SPDX-License-Identifier: GPL-3.0-or-later
// How long a whole update takes while a slider is dragged: the commands, the figure, style and layout.
import { address, close, go, open, settled, shown } from "./browser.mjs";
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

// What the slow panels show once all is there, beside what the module says on the page's own thread.
const slow = (page) => page.evaluate(() => {
    const { engine } = window.depthprec;
    const text = document.querySelector("[data-panel=zfight] [data-run]"), svg = document.querySelector("[data-panel=plot] [data-run]");
    const drawn = decodeURIComponent(svg.querySelector("img").src.split(",")[1]), size = /width="(\d+)" height="(\d+)"/.exec(drawn);
    const again = ["--type", "svg", "-o", "-", "--theme", "light", "--figure-size", `${size[1]}x${size[2]}`];
    return {
        text: text.querySelector("pre").textContent, svg: drawn,
        textHere: engine.run(text.dataset.run.split(" ")).out,
        svgHere: engine.run([...svg.dataset.run.split(" "), ...again]).out,
    };
});

async function compareSlow(page) {
    const { text, svg, textHere, svgHere } = await slow(page);
    demand(text.length > 200 && text === textHere, `ties and swaps: ${text.slice(0, 300)}`);
    demand(svg.length > 2000 && svg === svgHere, "the map is another figure");
}

async function aside() {
    const page = await open();
    await page.evaluate(() => {
        const { engine } = window.depthprec, { run } = engine;
        window.held = [0], window.ranHere = [];
        engine.run = (line) => (window.ranHere.push(line.join(" ")), run(line));
        new PerformanceObserver((list) => window.held.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: "longtask" });
    });
    await go(page, SLOW);
    await page.waitForTimeout(230);
    const before = await page.evaluate(() => document.documentElement.dataset.updates);
    await page.fill("#near-A", "0.3"); // leaves what runs
    await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before);
    await settled(page);
    await page.waitForTimeout(100);
    const held = Math.max(...(await page.evaluate(() => window.held)));
    const here = (await page.evaluate(() => window.ranHere)).filter((line) => /^(zfight|plot map)/.test(line));
    demand(here.length === 0, `on the page's own thread: ${here.join("; ")}`);
    demand((await shown(page)).runs.some(({ panel, run }) => panel === "zfight" && run.includes("-n 0.3")), "the last change is not shown");
    await compareSlow(page);
    await close(page);
    return `longest task, which is the browser's with the map's picture: ${held} ms`;
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

export async function redraw() {
    await test("what takes long does not hold the page, and is the same", aside);
    await test("without workers it is the same, too", alone);
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
