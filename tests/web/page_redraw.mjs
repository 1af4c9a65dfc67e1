// SPDX-License-Identifier: GPL-3.0-or-later
// How long a whole update takes while a slider is dragged: the commands, the figure, style and layout.
import { close, open } from "./browser.mjs";
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

export async function redraw() {
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
