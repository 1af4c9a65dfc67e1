// SPDX-License-Identifier: GPL-3.0-or-later
// Depth images that are chosen or dropped: files are put together here, the native program says what is in them.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { crc32, deflateSync } from "node:zlib";
import { axe, close, open, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { plain } from "./plain.mjs";
import { demand, test } from "./tap.mjs";

const WIDTH = 37, HEIGHT = 23;
const folder = mkdtempSync(join(tmpdir(), "depthprec-")); // of others' images, too
process.on("exit", () => rmSync(folder, { recursive: true }));
export const put = (name, bytes) => (writeFileSync(join(folder, name), bytes), join(folder, name));

// Window depths of a slope with waves, near 0.3 and far 100; reversed or not.
const depthAt = (x, y, reversed) => {
    const z = 2 + 9 * (x / WIDTH) ** 2 + y / 3 + Math.sin(x + y), d = (100 * (z - 0.3)) / (z * 99.7);
    return reversed ? 1 - d : d;
};
const field = (of) => Array.from({ length: WIDTH * HEIGHT }, (_, i) => of(i % WIDTH, Math.floor(i / WIDTH)));

// ---- PNG ----------------------------------------------------------------------------------------------------------

const crc = crc32 ?? ((bytes) => { // node has it since 22
    let sum = -1;
    for (const byte of bytes) {
        sum ^= byte;
        for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return ~sum >>> 0;
});

function chunk(name, content) {
    const all = Buffer.alloc(content.length + 12);
    all.writeUInt32BE(content.length);
    all.write(name, 4, "latin1");
    Buffer.from(content).copy(all, 8);
    all.writeUInt32BE(crc(all.subarray(4, -4)), all.length - 4);
    return all;
}

const paeth = (a, b, c) => [a, b, c].reduce((best, one) => (Math.abs(a + b - c - one) < Math.abs(a + b - c - best) ? one : best));

// Its rows have the filters 0 to 4 in turn. The depth is in the first channel, or in all three of colours but where they differ.
export function png(values, { bits = 16, colour = 0, interlaced = 0, cut = 0, tint = 0 } = {}) {
    const channels = [1, 0, 3, 1, 2, 0, 4][colour], same = channels > 2 && tint === 0 ? 3 : 1, step = (channels * bits) / 8, rows = [];
    for (let y = 0, above = Buffer.alloc(WIDTH * step); y < HEIGHT; y++) {
        const row = Buffer.alloc(WIDTH * step), filtered = [y % 5];
        for (let x = 0; x < WIDTH; x++)
            for (let c = 0; c < channels; c++) row.writeUIntBE(c < same ? values[y * WIDTH + x] : (x * 77 + c) % 251, x * step + (c * bits) / 8, bits / 8);
        row.forEach((byte, i) => {
            const [a, b, c] = [i >= step ? row[i - step] : 0, above[i], i >= step ? above[i - step] : 0];
            filtered.push((byte - [0, a, b, (a + b) >> 1, paeth(a, b, c)][y % 5]) & 255);
        });
        rows.push(...filtered);
        above = row;
    }
    const head = Buffer.alloc(13), data = deflateSync(Buffer.from(rows.slice(0, rows.length - cut)));
    head.writeUInt32BE(WIDTH);
    head.writeUInt32BE(HEIGHT, 4);
    head.set([bits, colour, 0, 0, interlaced], 8);
    const parts = [data.subarray(0, 100), data.subarray(100)].map((part) => chunk("IDAT", part));
    return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), chunk("IHDR", head), ...parts, chunk("IEND", [])]);
}

function npy(name, array, shape = `${HEIGHT}, ${WIDTH}`) {
    const head = `{'descr': '${name}', 'fortran_order': False, 'shape': (${shape}), }`, size = Math.ceil((11 + head.length) / 64) * 64 - 10;
    const start = Buffer.concat([Buffer.from("\x93NUMPY\x01\0", "latin1"), Buffer.from([size & 255, size >> 8])]);
    return Buffer.concat([start, Buffer.from(`${head.padEnd(size - 1)}\n`), Buffer.from(array.buffer)]);
}

// ---- What is there, beside the program ----------------------------------------------------------------------------

const shown = (page) => page.evaluate(() => ({
    refused: document.querySelector("#unread").textContent, says: document.querySelector("#recognised").textContent,
    seen: document.querySelector("#image canvas").checkVisibility(), pixel: document.querySelector("#pixel").innerText,
    asks: document.querySelectorAll("#units button").length, use: document.querySelector("#use-image").checkVisibility(),
    set: ["format", "mapping"].map((name) => document.querySelector(`#${name}-A`).value),
}));

async function choose(page, path) {
    const before = await shown(page);
    await page.setInputFiles("#file", []);
    await page.setInputFiles("#file", path);
    await page.waitForFunction(([refused, says]) => {
        const [a, b] = ["#unread", "#recognised"].map((id) => document.querySelector(id).textContent);
        return a !== refused || b !== says;
    }, [before.refused, before.says]);
    await settled(page);
    return shown(page);
}

// Moves there by keys, from the middle, and says what is told.
async function at(page, x, y) {
    await page.focus("#image canvas");
    for (let i = WIDTH >> 1; i !== x; i += Math.sign(x - i)) await page.keyboard.press(x > i ? "ArrowRight" : "ArrowLeft");
    for (let i = HEIGHT >> 1; i !== y; i += Math.sign(y - i)) await page.keyboard.press(y > i ? "ArrowDown" : "ArrowUp");
    await page.waitForFunction((name) => new RegExp(`^${name}[ :]`).test(document.querySelector("#pixel").innerText), `Pixel ${x},${y}`);
    return shown(page);
}

// What is said of a pixel is what the program says by the same words.
async function pixelAgrees(page, path, words, [x, y]) {
    const [{ out }] = await native([["texture", path, ...words, "--pixel", `${x},${y}`, "--json"]]), { z, lo, hi, code } = JSON.parse(out).pixels[0];
    const says = (await at(page, x, y)).pixel, all = /code (\d+), eye depth (\S+?)(?: m)?, which may be (\S+?)(?: m)? to (\S+?)(?: m)?:/.exec(says)?.slice(1).map(Number);
    demand(all !== undefined && all[0] === code && [z, lo, hi].every((one, i) => Math.abs(all[i + 1] - one) <= Math.max((hi - lo) / 5, 1e-12 * one)), `${path}: ${says}, not ${[code, z, lo, hi]}`);
}

// Holes and sky are counted as the program does, and the depths of the others are its.
function counts(says, { invalid, sky, lo, hi }) {
    const number = (pattern) => Number(pattern.exec(says)?.[1] ?? 0), [a, b] = [/Depths from (\S+)/, / to (\S+?)(?: m)?\.$/].map(number);
    const same = (one, other) => Math.abs(one - other) <= 6e-4 * other;
    demand(number(/(\d+) pixels are holes/) === invalid && number(/(\d+) pixels are sky/) === sky.pixels && same(a, lo) && same(b, hi), `${says}: ${[invalid, sky.pixels, lo, hi]}`);
}

// Grey by the logarithm of what is drawn, holes clear; of an image that is not made smaller, once it is painted.
async function painted(page, valueOf) {
    const values = field(valueOf), finite = values.filter((one) => !Number.isNaN(one)), [lo, hi] = [Math.min(...finite), Math.max(...finite)];
    const fault = (pixels) => values.flatMap((value, i) => {
        const own = pixels.slice(4 * i, 4 * i + 4), grey = Math.floor((255 * Math.log(value / lo)) / Math.log(hi / lo));
        const fine = Number.isNaN(value) ? own[3] === 0 : own[3] === 255 && own[0] === own[1] && own[1] === own[2] && Math.abs(own[0] - grey) <= 1;
        return fine ? [] : [`pixel ${i % WIDTH},${Math.floor(i / WIDTH)} is ${own}, of ${value} from ${lo} to ${hi}`];
    })[0];
    for (let tries = 100, wrong; (wrong = fault(await page.evaluate(([width, height]) => {
        const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(document.querySelector("#image canvas"), 0, 0);
        return [...copy.getImageData(0, 0, width, height).data];
    }, [WIDTH, HEIGHT]))) !== undefined; await page.waitForTimeout(100)) demand(tries-- > 0, wrong);
}

// At a corner the keys go no further.
async function corners(page) {
    for (const [x, y, out, back] of [[0, 0, ["ArrowLeft", "ArrowUp"], ["ArrowRight", "ArrowDown"]], [WIDTH - 1, HEIGHT - 1, ["ArrowRight", "ArrowDown"], ["ArrowLeft", "ArrowUp"]]]) {
        await at(page, x, y);
        for (const key of [...out, ...back]) await page.keyboard.press(key);
        const name = `Pixel ${Math.abs(x - 1)},${Math.abs(y - 1)}`;
        await page.waitForFunction((text) => document.querySelector("#pixel").innerText.startsWith(text), name, { timeout: 10000 }).catch(async () => demand(false, `${name}: ${(await shown(page)).pixel}`));
        for (const key of out) await page.keyboard.press(key);
        for (let i = x; i !== WIDTH >> 1; i += Math.sign((WIDTH >> 1) - i)) await page.keyboard.press(x > 0 ? "ArrowLeft" : "ArrowRight");
        for (let i = y; i !== HEIGHT >> 1; i += Math.sign((HEIGHT >> 1) - i)) await page.keyboard.press(y > 0 ? "ArrowUp" : "ArrowDown");
    }
}

// A pixel's eye depth and cell are the program's, and so is how the image was recognised; set-up A changes by its button alone.
async function agrees(page, path, format, mapping, pixel) {
    const line = ["-n", "0.3", "-f", "100", "-m", mapping], before = (await shown(page)).set, now = await choose(page, path);
    const [plain] = await native([["texture", path, ...line, "--json"]]), { why } = JSON.parse(plain.out).recognised;
    demand(now.refused === "" && now.seen, `${path}: ${now.refused}`);
    demand(String(now.set) === String(before), `${path}: set-up A became ${now.set}`);
    if (now.asks > 0) await page.selectOption("#holds", "window");
    await page.waitForFunction((text) => document.querySelector("#recognised").textContent.includes(text), `: Window depth: ${why}. `);
    counts((await shown(page)).says, JSON.parse(plain.out));
    await pixelAgrees(page, path, line, pixel);
    if ((await shown(page)).use) await page.click("#use-image");
    await settled(page);
    demand(String((await shown(page)).set) === `${format},${mapping}`, `${path}: set-up A is ${(await shown(page)).set}`);
}

// A metric file that was taken for window depth once: the page asks, and knows the sensor's levels and their error.
async function lengths() {
    const page = await open({ fragment: encodeURIComponent("table -n 0.3 -f 100 -F fp32 -m reversed --unit m") });
    const levels = (z) => Math.round(5 * Math.round(1000 / (0.002923 * Math.round(1 / (0.002923 * z))))); // of 1/z, in mm, then in 0.2 mm
    const path = put("tum.png", png(field((x, y) => (x === 3 ? 0 : levels(0.65 + x / 8 + y / 9)))));
    const now = await choose(page, path);
    demand(now.asks > 0 && now.pixel === "" && now.says.includes("may be lengths"), JSON.stringify(now));
    await page.selectOption("#holds", "--metric tum");
    await page.waitForFunction(() => /1 in a sample is 0\.0002 m.*even in 1\/z.*23 pixels are holes/.test(document.querySelector("#recognised").textContent));
    await pixelAgrees(page, path, ["--metric", "tum", "--unit", "m"], [30, 20]);
    const before = await page.evaluate(() => document.querySelector("#image canvas").toDataURL());
    await page.check("#errors");
    await page.waitForFunction(() => document.querySelector("#painted").textContent.includes("off at most"));
    const { pixel, set } = await shown(page), off = Number(/off by at most (\S+)/.exec(pixel)[1]), z = Number(/eye depth (\S+)/.exec(pixel)[1]);
    demand(off > 0.4 * 0.002923 * z * z, `${pixel}: less than half a level, ${0.5 * 0.002923 * z * z}`); // by hand
    demand(before !== (await page.evaluate(() => document.querySelector("#image canvas").toDataURL())), "errors look as depths do");
    demand(String(set) === "fp32,reversed", `set-up A became ${set}`);
    for (const [name, value, says] of [["none.npy", 0, "no sample is a depth"], ["one.npy", 777, "the same"]]) {
        const one = await choose(page, put(name, npy("<u2", Uint16Array.from(field(() => value)))));
        if (value === 0) await page.selectOption("#holds", "--metric mm");
        await page.waitForFunction((text) => `${document.querySelector("#recognised").textContent} ${document.querySelector("#unread").textContent}`.includes(text), says)
            .catch(async () => demand(false, `${name}: ${JSON.stringify([one, await shown(page)])}`));
    }
    await close(page);
}

// 25 megapixels, from the file to what it is.
async function large() {
    const page = await open(), width = 5000, path = put("large.npy", npy("<u2", Uint16Array.from({ length: width * width }, (_, i) => 1000 + ((i % width) >> 1) + (Math.floor(i / width) >> 3)), `${width}, ${width}`));
    const begun = performance.now();
    await choose(page, path);
    const read = performance.now() - begun;
    await close(page);
    demand(read < (process.env.DEPTHPREC_FULL ? 4000 : 40000), `${read} ms`); // beside other work
    return `25 megapixels in ${(read / 1000).toFixed(1)} s`;
}

const words = (scale, reversed) => field((x, y) => Math.round(scale * depthAt(x, y, reversed)));

async function read() {
    const page = await open({ fragment: encodeURIComponent("table -n 0.3 -f 100 -F fp32 -m reversed") });
    const of24 = Float32Array.from(words(2 ** 24 - 1), (code) => code / (2 ** 24 - 1)), singles = Float32Array.from(field((x, y) => depthAt(x, y, true)));
    const files = [
        ["grey.png", png(words(65535)), "unorm16", "d3d"], ["colours.png", png(words(65535), { colour: 2 }), "unorm16", "d3d"],
        ["alpha.png", png(words(65535), { colour: 6 }), "unorm16", "d3d"], ["u2.npy", npy("<u2", Uint16Array.from(words(65535))), "unorm16", "d3d"],
        ["u4.npy", npy("<u4", Uint32Array.from(words(2 ** 24 - 1))), "unorm24", "d3d"], ["lattice.npy", npy("<f4", of24), "unorm24", "d3d"],
        ["reversed.npy", npy("<f4", singles), "fp32", "reversed"], ["f8.npy", npy("<f8", Float64Array.from(singles)), "fp32", "reversed"],
        ["bits.npy", npy("<u4", new Uint32Array(singles.buffer)), "fp32", "reversed"],
        ["channels.npy", npy("<u2", Uint16Array.from(words(65535).flatMap((code) => [code, 9])), `${HEIGHT}, ${WIDTH}, 2`), "unorm16", "d3d"],
    ];
    const skies = (far) => npy("<f4", Float32Array.from(field((x, y) => (x === 5 ? far : x + y === 20 ? NaN : Math.round(65535 * depthAt(x, y, far === 0)) / 65535))));
    files.push(["sky.npy", skies(1), "unorm16", "d3d"], ["dark.npy", skies(0), "unorm16", "reversed"]);
    for (const [i, [name, bytes, format, mapping]] of files.entries()) await agrees(page, put(name, bytes), format, mapping, [(7 * i) % WIDTH, (5 * i) % HEIGHT]);
    for (const [name, code] of [["sky.npy", 65535], ["dark.npy", 0]]) {
        await choose(page, join(folder, name));
        demand((await at(page, 5, 4)).pixel.startsWith(`Pixel 5,4 is sky, or was cleared: code ${code}, from `), (await shown(page)).pixel);
    }
    await close(page);
    return `${files.length} files`;
}

export async function axeFindsNothing(page) {
    await page.evaluate(readFileSync(axe, "utf8"));
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    demand(violations.length === 0, JSON.stringify(violations.map(({ id, nodes }) => [id, nodes[0].html])));
}

async function others() {
    const page = await open(), ramp = words(255);
    const bytes = put("bytes.png", png(ramp, { bits: 8 })), camera = ["-n", "0.1", "-f", "1000", "-m", "d3d", "--unit", "m"];
    demand((await choose(page, bytes)).says.includes("255"), (await shown(page)).says);
    await pixelAgrees(page, bytes, camera, [3, 3]);
    const metres = put("metres.npy", npy("<f4", Float32Array.from(field((x, y) => 1 + x + y / 8))));
    await choose(page, metres);
    await page.selectOption("#holds", "--metric 1m");
    await page.waitForFunction(() => document.querySelector("#recognised").textContent.includes("1 in a sample is 1 m"));
    await painted(page, (x, y) => 1 + x + y / 8);
    await pixelAgrees(page, metres, ["--metric", "1m", "--unit", "m"], [5, 8]);
    const holes = await choose(page, put("holes.npy", npy("<f4", Float32Array.from(field((x, y) => (x + y === 20 ? NaN : depthAt(x, y)))))));
    await axeFindsNothing(page);
    demand(holes.seen && (await at(page, 12, 8)).pixel === "Pixel 12,8 is a hole.", (await shown(page)).pixel);
    await painted(page, (x, y) => (x + y === 20 ? NaN : 100 / (1000 - 999.9 * depthAt(x, y))));
    await page.selectOption("#holds", "window"); // the pixel is the middle one again
    await settled(page);
    await corners(page);
    const half = put("f2.npy", npy("<f2", Uint16Array.from(field((x, y) => ((y % 14) << 10) | x))));
    demand((await choose(page, half)).says.includes("numbers of fp16"), (await shown(page)).says);
    await pixelAgrees(page, half, camera.map((word) => (word === "d3d" ? "reversed" : word)), [30, 9]); // which their mass shows
    // Dropped anywhere; by the pointer.
    await page.evaluate((bytes) => {
        const dropped = new DataTransfer();
        dropped.items.add(new File([Uint8Array.from(bytes)], "dropped.png"));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, bubbles: true, cancelable: true }));
    }, [...png(words(65535))]);
    await page.waitForFunction(() => document.querySelector("#recognised").textContent.startsWith("dropped.png, 37 x 23: "));
    const box = await page.locator("#image canvas").boundingBox();
    await page.mouse.move(box.x + ((10.5 / WIDTH) * box.width), box.y + (4.5 / HEIGHT) * box.height);
    await page.waitForFunction(() => document.querySelector("#pixel").innerText.startsWith("Pixel 10,4"));
    // The words about a pixel follow the set-up.
    const before = (await shown(page)).pixel;
    await page.fill("#near-A", "0.7");
    await page.waitForFunction((old) => document.querySelector("#pixel").innerText !== old, before);
    await close(page);
}

async function refused() {
    const page = await open(), good = png(words(65535)), cut = Buffer.from(npy("<f4", Float32Array.from(field(() => 0.5)))).subarray(0, -5);
    const wide = Buffer.from(good);
    wide.writeUInt32BE(70000, 16);
    wide.writeUInt32BE(70000, 20);
    const filter = deflateSync(Buffer.alloc(HEIGHT * (1 + 2 * WIDTH), 9)), head = good.subarray(0, 33);
    for (const [name, bytes, says] of [
        ["interlaced.png", png(words(65535), { interlaced: 1 }), "interlaced"], ["palette.png", png(words(255), { bits: 8, colour: 3 }), "palette"],
        ["short.png", png(words(65535), { cut: 40 }), "damaged PNG"], ["half.png", good.subarray(0, good.length >> 1), "damaged PNG"],
        ["filter.png", Buffer.concat([head, chunk("IDAT", filter), chunk("IEND", [])]), "damaged PNG"], ["dds.dds", Buffer.from("DDS \0\0\0\0"), "not read in the page"],
        ["tinted.png", png(words(65535), { colour: 2, tint: 1 })], ["tinted8.png", png(words(255), { bits: 8, colour: 6, tint: 1 })], ["wide.png", wide, "must be from 1 to 65536 pixels"],
        ["empty.npy", Buffer.alloc(0)], ["text.txt", Buffer.from("depth")], ["cut.npy", cut], ["c.npy", npy("<c8", new Float32Array(2 * WIDTH * HEIGHT))],
        ["line.npy", npy("<f4", new Float32Array(9), "9,")], ["zero.npy", npy("<f4", new Float32Array(0), "0, 0")],
    ]) {
        const now = await choose(page, put(name, bytes));
        const [{ err }] = await native([["texture", join(folder, name)]]), own = says ?? plain(err.trim().split(": ").slice(2).join(": ")); // by the program
        demand(now.refused.startsWith(`${name}: `) && now.refused.includes(own) && own !== "" && !now.seen, `${name}: ${JSON.stringify(now)}, not ${own}`);
    }
    await axeFindsNothing(page);
    await close(page);
}

export async function image() {
    await test("depth images: recognised as the program does, and its depths and cells at a pixel", read);
    await test("lengths: asked for, levels, holes and errors are the program's; empty ones and one value", lengths);
    await test("25 megapixels", large);
    await test("samples that are coarser, metric, holes and halves; dropped; by pointer; beside a set-up that changes", others);
    await test("a file that is damaged or of another kind is refused in a sentence", refused);
}
