// SPDX-License-Identifier: GPL-3.0-or-later
// What lies over the figures: the values at the crosshair, computed here in fractions of whole numbers; axes that stand
// still; the requirement; and tables as tables.
import { close, open, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { demand, test } from "./tap.mjs";

// ---- Fractions: [numerator, denominator], which is above 0 --------------------------------------------------------

function fraction(x) { // a double, exactly
    let power = 0;
    for (; !Number.isInteger(x); power++) x *= 2;
    return [BigInt(x), 1n << BigInt(power)];
}
const positive = ([n, d]) => (d < 0n ? [-n, -d] : [n, d]);
const minus = ([a, b], [c, d]) => [a * d - c * b, b * d];
const times = ([a, b], [c, d]) => [a * c, b * d];
const over = ([a, b], [c, d]) => positive([a * d, b * c]);
const below = ([a, b], [c, d]) => a * d < c * b;
const value = ([n, d]) => { // to 17 digits, whatever the sizes
    const sign = n < 0n ? -1 : 1, digits = BigInt(d.toString().length - n.toString().length + 20);
    const scaled = digits > 0n ? (n * 10n ** digits) / d : n / (d * 10n ** -digits);
    return sign * Number(`${scaled < 0n ? -scaled : scaled}e${-digits}`);
};

// ---- Two pipelines in ideal arithmetic ----------------------------------------------------------------------------

const A = { near: 0.1, far: 1000, words: "-n 0.1 -f 1000 -F unorm24 -m d3d" };
const B = { near: 0.05, far: 5000, words: "-n 0.05 -f 5000 -F fp32 -m reversed" };

// Window depth of z: far (z - near)/(z (far - near)), or 1 minus that; and back.
function curve({ near, far }, reversed) {
    const n = fraction(near), f = fraction(far), span = minus(f, n), one = [1n, 1n];
    return {
        window: (z) => over(reversed ? times(n, minus(f, z)) : times(f, minus(z, n)), times(z, span)),
        eye: (d) => over(times(n, f), minus(f, times(reversed ? minus(one, d) : d, span))),
    };
}

function atUnorm24(z) {
    const { window, eye } = curve(A, false), most = (1n << 24n) - 1n, [n, d] = window(z);
    const code = (2n * n * most + d) / (2n * d), at = (twice) => eye([twice, 2n * most]);
    return { code, z: at(2n * code), ends: [at(2n * code - 1n), at(2n * code + 1n)] };
}

const word = new DataView(new ArrayBuffer(4));
const bitsOf = (x) => (word.setFloat32(0, x), word.getUint32(0));
const floatOf = (bits) => (word.setUint32(0, bits), word.getFloat32(0));

function atFp32(z) {
    const { window, eye } = curve(B, true), d = window(z);
    const between = (bits) => times(minus(fraction(floatOf(bits)), times([-1n, 1n], fraction(floatOf(bits + 1)))), [1n, 2n]);
    let bits = bitsOf(value(d));
    while (below(d, between(bits - 1))) bits--;
    while (!below(d, between(bits))) bits++;
    return { code: BigInt(bits), z: eye(fraction(floatOf(bits))), ends: [eye(between(bits)), eye(between(bits - 1))] };
}

// ---- The page -----------------------------------------------------------------------------------------------------

const LINK = encodeURIComponent([A, B].map(({ words }) => `table ${words} --unit m`).join(" ; "));
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

function agrees([head, cells], { code, z, ends }, shown) {
    const column = (title) => cells[head.indexOf(title)], wanted = value(minus(ends[1], ends[0]));
    demand(column("code") === String(code), `z ${shown}: code ${column("code")}, not ${code}`);
    demand(near(Number(column("interval")), wanted, 6e-5), `z ${shown}: interval ${column("interval")}, not ${wanted}`);
    const error = value(minus(z, fraction(Number(shown))));
    demand(near(Number(column("error")), error, 6e-5), `z ${shown}: error ${column("error")}, not ${error}`);
}

async function crosshair() {
    const page = await opened();
    for (const t of [0.13, 0.31, 0.5, 0.62, 0.77]) {
        const { box: [x, y, scale], frame } = await seen(page);
        await page.mouse.move(x + scale * (frame[0] + t * (frame[2] - 1)), y + scale * (frame[1] + 10));
        await rest(page);
        const now = await seen(page), [shown, unit] = now.z.split(" "), at = B.near * (B.far / B.near) ** t;
        demand(unit === "m" && near(Number(shown), at, 0.03), `at ${t} of the axis z is ${now.z}, not ${at}`);
        agrees(now.tables[0], atUnorm24(fraction(Number(shown))), shown);
        agrees(now.tables[1], atFp32(fraction(Number(shown))), shown);
        const said = await native([A, B].map(({ words }) => ["table", ...words.split(" "), "--unit", "m", "--at", shown]));
        said.forEach(({ out }, i) => now.tables[i][1].forEach((cell) => demand(out.includes(` ${cell}`), `${cell} is not in\n${out}`)));
    }
    await page.locator("#cross").focus();
    await page.locator("#cross").evaluate((one) => ((one.value = 0), one.dispatchEvent(new Event("input"))));
    await rest(page);
    demand(/^A .*0.05/.test(await page.locator("#crossed").innerText().catch(() => "")), "A has no depth before its near plane");
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
    await page.mouse.move(x + scale * (frame[0] + 0.7 * frame[2]), y + scale * (frame[1] + 0.4 * frame[3]), { steps: 5 });
    await page.mouse.up();
    await rest(page);
    const at = parseFloat(await field("at")), separation = await field("separation");
    demand(near(at, B.near * (B.far / B.near) ** 0.7, 0.03) && separation !== "1cm", `dragged to ${separation} at ${at}`);
    const [said] = await native([["solve", ...A.words.split(" "), "--unit", "m", "--for", "distance", "--separation", separation, "--json"]]);
    const { distance } = JSON.parse(said.out).answer, now = await seen(page), px = (z) => now.frame[0] + Math.log(z / B.near) / Math.log(B.far / B.near) * (now.frame[2] - 1);
    demand(distance < at && now.fails.length === 1, `${separation} at ${at}: ${distance}, ${now.fails.length} fail`);
    demand(Math.abs(now.fails[0][0] - px(distance)) < 1 && Math.abs(now.fails[0][0] + now.fails[0][1] - px(at)) < 1, `fails at ${now.fails}`);
    demand(now.required.includes(`A fails beyond ${String(distance).slice(0, 5)}`) && now.required.includes("B holds"), now.required);
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

export async function figures() {
    await test("the crosshair's code, error and interval, by pointer and keys", crosshair);
    await test("A and B share axes, which stand still while dragging; the curves of before lie under them", axes);
    await test("a requirement is dragged, by keys too, and what fails of it is marked", requirement);
    await test("a map has the pixels of the program's, and so has its scale", map);
    await test("tables are tables, on a phone with the key columns first", tables);
}
