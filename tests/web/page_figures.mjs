// SPDX-License-Identifier: GPL-3.0-or-later
// What lies over the figures: the values at the crosshair, against closed forms of ideal arithmetic; axes that stand
// still; the requirement; and tables as tables.
import { close, open, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { demand, test } from "./tap.mjs";

const A = { near: 0.1, far: 1000, words: "-n 0.1 -f 1000 -F unorm24 -m d3d" };
const B = { near: 0.05, far: 5000, words: "-n 0.05 -f 5000 -F fp32 -m reversed" };

// ---- The page -----------------------------------------------------------------------------------------------------

const LINK = encodeURIComponent(`${[A, B].map(({ words }) => `table ${words} --unit m`).join(" ; ")} ; plot interval ; solve --separation 2cm --at 200m`);
const opened = async (options) => {
    const page = await open({ fragment: LINK, ...options });
    await settled(page);
    await page.locator(".stage").first().scrollIntoViewIfNeeded();
    return page;
};
const rest = async (page) => { // what is dragged rests, and what follows has come
    await page.waitForTimeout(300);
    await settled(page);
};

// The figure that is shown: its axes and frame as it says them, and what lies over it.
const seen = (page) => page.evaluate(() => {
    const [one] = [...document.querySelectorAll(".figure")].filter((figure) => figure.checkVisibility());
    const svg = decodeURIComponent(one.querySelector("img").src.split(",")[1]), ghost = one.querySelector(".ghost");
    const label = [...new DOMParser().parseFromString(svg, "image/svg+xml").querySelectorAll("text")].find((text) => text.textContent === "100");
    const box = one.querySelector(".stage").getBoundingClientRect(), line = (name) => one.querySelector(`svg ${name}`);
    const rows = (table) => [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
    return {
        figures: [...document.querySelectorAll(".figure")].filter((figure) => figure.checkVisibility()).length, svg,
        axes: /\naxes: (.*)/.exec(svg)[1].split(/[ ,]+/), frame: /<clipPath id="clip1"><rect ([^>]*)/.exec(svg)[1].match(/[\d.]+/g).map(Number),
        label: Number(label?.getAttribute("x")), ghost: ghost.checkVisibility() ? decodeURIComponent(ghost.src) : "",
        box: [box.x, box.y, box.width / Number(/width="(\d+)/.exec(svg)[1])], z: document.querySelector("#cross-is").textContent,
        cross: Number(line(".cross")?.getAttribute("x1")), tables: [...document.querySelectorAll("#crossed table")].map(rows),
        fails: [...one.querySelectorAll("svg .fails")].map((bar) => [bar.getAttribute("x"), bar.getAttribute("width")].map(Number)),
        required: document.querySelector("#required").textContent,
    };
});

const near = (a, b, share) => Math.abs(a - b) <= share * Math.abs(b);

// What each figure's curves are at depth z of set-up A, in closed form: names, numbers, and by what share they may differ.
const codes = (z, { near: n, far: f } = A) => (2 ** 24 * n * f) / ((f - n) * z * z); // of 1/z, a metre
const FORMULAS = {
    interval: (z) => [["A unorm24 d3d, lattice", 1 / codes(z), 0.05], ["A unorm24 d3d", 1.5 / codes(z), 0.6]],
    error: (z) => [["A unorm24 d3d, lattice", 0.5 / codes(z), 0.05], ["A unorm24 d3d", 1.6 / codes(z), 0.7]],
    distribution: (z) => [["A unorm24 d3d", codes(z), 0.05]],
    share: (z) => [["A unorm24 d3d", 100 * (1 - (A.far * (z - A.near)) / (z * (A.far - A.near))), 0.05]],
};

async function pointAt(page, t, s = 0.5) {
    const { box: [x, y, scale], frame } = await seen(page);
    await page.mouse.move(x + scale * (frame[0] + t * (frame[2] - 1)), y + scale * (frame[1] + s * (frame[3] - 1)));
    await rest(page);
    return seen(page);
}

async function crosshair() {
    const page = await opened();
    for (const [figure, formula] of Object.entries(FORMULAS)) {
        await page.check(`#figure-${figure}`);
        await rest(page);
        for (const t of [0.31, 0.62, 0.77]) {
            const now = await pointAt(page, t), [shown, unit] = now.z.split(" "), z = Number(shown), at = B.near * (B.far / B.near) ** t;
            demand(unit === "m" && near(z, at, 0.03), `${figure}, at ${t} of the axis z is ${now.z}, not ${at}`);
            const rows = new Map(now.tables[0].map(([name, number, of]) => [name, [Number(number), of]]));
            for (const [name, wanted, share] of formula(z)) {
                const [number, of] = rows.get(name) ?? [];
                demand(near(number, wanted, share), `${figure}, z ${z}: ${name} is ${number} ${of}, not ${wanted}: ${JSON.stringify(now.tables)}`);
            }
            demand(rows.has("B fp32 reversed"), `${figure}: B has no curve: ${JSON.stringify(now.tables)}`);
        }
    }
    await page.check("#figure-budget");
    await rest(page);
    const { tables: both, z: depth } = await pointAt(page, 0.62), rows = both[0].map(([, number, of]) => [Number(number), of]);
    const sum = rows.filter(([, of]) => of === "%").reduce((all, [number]) => all + number, 0), [separation] = rows.find(([, of]) => of === "m");
    demand(both.length === 2 && near(sum, 100, 0.01) && separation > 0.9 / codes(parseFloat(depth)), `causes at ${depth}: ${JSON.stringify(both)}`);
    await page.check("#figure-interval");
    await rest(page);
    await page.locator("#cross").focus();
    await page.locator("#cross").evaluate((one) => ((one.value = 0), one.dispatchEvent(new Event("input"))));
    await rest(page);
    demand(!(await seen(page)).tables[0].some(([name]) => name.startsWith("A ")), "A has no depth before its near plane");
    const before = (await seen(page)).z;
    await page.keyboard.press("PageUp");
    await rest(page);
    demand((await seen(page)).z !== before, "a key does not move the crosshair");
    await page.locator("#cross").evaluate((one) => ((one.value = 660), one.dispatchEvent(new Event("input"))));
    await rest(page);
    const now = await seen(page), px = Math.log(Number(now.z.split(" ")[0]) / 100) / Math.log(B.far / B.near) * (now.frame[2] - 1);
    demand(Math.abs(now.cross - now.label - px) < 1.5, `the crosshair is at ${now.cross}, 100 at ${now.label}`);
    await close(page);
}

async function axes() {
    const page = await opened(), first = await seen(page);
    demand(first.figures === 1 && first.svg.includes(">A unorm24 d3d<") && first.svg.includes(">B fp32 reversed<"), "A and B are not in one figure");
    demand(near(Number(first.axes[2]), B.near, 1e-12) && near(Number(first.axes[3]), B.far, 1e-12), `x is ${first.axes}`);
    const slider = await page.locator("#a [data-slider=near]").boundingBox(), y = slider.y + slider.height / 2;
    await page.mouse.move(slider.x + 0.4 * slider.width, y);
    await page.mouse.down();
    for (const part of [0.42, 0.47, 0.51, 0.55]) {
        await page.mouse.move(slider.x + part * slider.width, y);
        await rest(page); // the hand rests, and is not lifted
        const now = await seen(page);
        demand(String(now.axes) === String(first.axes), `while near is dragged: ${now.axes}, not ${first.axes}`);
    }
    await page.mouse.up();
    await rest(page);
    const after = await seen(page);
    demand(/-n 0\.[2-9]/.test(after.svg) && String(after.axes) !== String(first.axes), "the axes never follow");
    demand(after.ghost.includes("command: depthprec plot interval -n 0.1 ") && after.ghost.includes(`axes: ${/\naxes: (.*)/.exec(after.svg)[1]}`), "the ghost is not of before, on the same axes");
    await page.check("#figure-budget");
    await rest(page);
    demand((await page.locator(".figure:visible").count()) === 2, "causes of both stand one above the other");
    await close(page);
}

async function requirement() {
    const page = await opened(), handle = page.locator(".handle").first();
    const field = (name) => page.locator(`[data-asks=solve] [data-option=${name}]`).inputValue();
    const { frame, box: [x, y, scale] } = await seen(page), from = await handle.boundingBox();
    demand(from.width >= 24 && from.height >= 24, `the handle has ${from.width} px`);
    await page.mouse.move(from.x + 12, from.y + 12);
    await page.mouse.down();
    await page.mouse.move(x + scale * (frame[0] + 0.7 * frame[2]), y + scale * (frame[1] + 0.25 * frame[3]), { steps: 5 });
    await page.mouse.up();
    await rest(page);
    const at = parseFloat(await field("at")), separation = await field("separation");
    demand(near(at, B.near * (B.far / B.near) ** 0.7, 0.03) && separation !== "1cm", `dragged to ${separation} at ${at}`);
    const [said] = await native([["solve", ...A.words.split(" "), "--unit", "m", "--viewport", "1920x1080", "--for", "distance", "--separation", separation, "--json"]]);
    const { distance } = JSON.parse(said.out).answer, now = await seen(page), px = (z) => now.frame[0] + Math.log(z / B.near) / Math.log(B.far / B.near) * (now.frame[2] - 1);
    demand(distance < at && now.fails.length === 1, `${separation} at ${at}: ${distance}, ${now.fails.length} fail`);
    demand(Math.abs(now.fails[0][0] - px(distance)) < 1 && Math.abs(now.fails[0][0] + now.fails[0][1] - px(at)) < 1, `fails at ${now.fails}`);
    demand(near(parseFloat(/A fails beyond ([\d.]+) m/.exec(now.required)?.[1]), distance, 0.01) && now.required.includes("B holds"), now.required);
    await handle.focus();
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("ArrowLeft");
    await rest(page);
    demand(parseFloat(await field("at")) < at && parseFloat(await field("separation")) > parseFloat(separation), "keys do not move it");
    await close(page);
}

async function tables() {
    const heads = (page) => page.locator("[data-panel=table] th[scope=col]").allTextContents().then((all) => all.map((text) => text.trim()).join(" "));
    for (const [width, wanted] of [[1280, "z code depth error interval lattice guaranteed"], [390, "z guaranteed interval error code depth lattice"], [320, "z guaranteed"]]) {
        const page = await opened({ width });
        demand((await heads(page)).startsWith(wanted), `${width} px: ${await heads(page)}`);
        const [wide, rows] = await page.evaluate(() => [document.documentElement.scrollWidth, document.querySelectorAll("[data-panel=table] th[scope=row]").length]);
        demand(wide <= width && rows === 18, `${width} px: ${wide} px wide, ${rows} rows`);
        await close(page);
    }
}

// The pixels of maps and their scale: those of the program's figure, which cairo and libpng write, decoded by the browser.
async function map() {
    const page = await opened();
    const pixels = (svg) => page.evaluate(async (text) => {
        const all = [];
        for (const [, href] of text.matchAll(/href="(data:image\/png[^"]*)/g)) {
            const image = new Image();
            image.src = href;
            await image.decode();
            const { width, height } = image, context = new OffscreenCanvas(width, height).getContext("2d");
            context.drawImage(image, 0, 0);
            all.push([width, height, ...new Uint32Array(context.getImageData(0, 0, width, height).data.buffer)].join(" "));
        }
        return all.sort();
    }, svg);
    for (const words of ["-n 0.1 -f 1000 -F unorm24 -m d3d", "-n 0.5 -f 20 -F fp32 -m reversed", "-n 0.1 -f 1000 -F unorm16 -m d3d --at 7"]) {
        const line = ["plot", "map", ...words.split(" "), "--type", "svg", "-o", "-"];
        const [{ out: there }] = await native([line]), here = await page.evaluate((run) => window.depthprec.engine.run(run).out, line);
        const [ours, theirs] = [await pixels(here), await pixels(there)];
        demand(theirs.length === 2 && ours.length === 2 && ours.every((one, i) => one === theirs[i]), `${words}: other pixels`);
    }
    await close(page);
}

// Why floats are reversed: codes of a few bits between the planes of the set-up, and a sentence a step.
async function why() {
    const page = await open(), run = () => page.locator("[data-panel=plot] [data-run]").first().getAttribute("data-run");
    const sentences = () => page.locator("#why:visible li").allTextContents();
    demand((await sentences()).length === 0, "they stand under another figure");
    await page.click("#figure-staircase");
    await settled(page);
    for (const [near, line] of [["0.1", "plot staircase -n 0.1 -f 1000 --unit m"], ["2", "plot staircase -n 2 -f 1000 --unit m"]]) {
        await page.fill("#near-A", near);
        await page.waitForTimeout(400);
        await settled(page);
        const [said] = await native([[...line.split(" "), "--type", "svg", "-o", "-"]]), alt = await page.locator("[data-panel=plot] .stage > img").first().getAttribute("alt");
        demand((await run()) === line && said.out.includes(alt) && alt.includes("float3.3b5 reversed"), `${await run()}: ${alt}`);
        demand((await sentences()).length === 3, `${(await sentences()).length} sentences`);
    }
    await page.setChecked("#ortho-A", true);
    await page.waitForTimeout(400);
    await settled(page);
    demand((await sentences()).length === 0, "1/z in an orthographic view");
    await close(page);
}

export async function figures() {
    await test("why floats are reversed: few bits, live, in three steps", why);
    await test("the crosshair reads out the curves of each figure, by pointer and keys", crosshair);
    await test("A and B share axes, which stand still while dragging; the curves of before lie under them", axes);
    await test("a requirement is dragged, by keys too, and what fails of it is marked", requirement);
    await test("a map has the pixels of the program's, and so has its scale", map);
    await test("tables are tables, on a phone with the key columns first", tables);
}
