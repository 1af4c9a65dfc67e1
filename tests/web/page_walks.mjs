// SPDX-License-Identifier: GPL-3.0-or-later
// Six people on their way to an answer. Each acts by what a person sees, labels, buttons and fields by their names, and ends
// with a number on the screen, which this file finds by another way: binary32 one depth after the other, or by hand.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { close, open, settled } from "./browser.mjs";
import { differences, measure } from "./page_gpu.mjs";
import { axeFindsNothing, png, put } from "./page_image.mjs";
import { demand, test } from "./tap.mjs";

const { fround } = Math;
const METRES = { "µm": 1e-6, mm: 1e-3, cm: 1e-2, m: 1, km: 1e3 };

// ---- By another way -----------------------------------------------------------------------------------------------

// Codes of a vertex at z as IEEE 754 computes them: a product, a sum, a quotient, each rounded; then the format.
const PIPELINES = {
    d3d: ({ near: n, far: f }) => [f / (f - n), (-n * f) / (f - n), (d) => d],
    gl: ({ near: n, far: f }) => [(f + n) / (f - n), (-2 * n * f) / (f - n), (d) => fround(fround(d * 0.5) + 0.5)],
    reversed: ({ near: n, far: f }) => [-n / (f - n), (n * f) / (f - n), (d) => d],
};
function codesOf({ mapping, bits, ...planes }) {
    const [a, b, window] = PIPELINES[mapping](planes), [A, B] = [fround(a), fround(b)];
    const stored = (d) => (bits === 32 ? d : Math.floor(d * (2 ** bits - 1) + 0.5));
    return (z) => stored(window(fround(fround(fround(A * z) + B) / z))) * (mapping === "reversed" ? -1 : 1);
}

// The widest gap about z whose farther surface is not stored farther: all binary32 depths within `reach` of it are tried, to
// which the eye depths of surfaces are rounded before.
function widest(camera, z, reach) {
    const step = 2 ** (Math.floor(Math.log2(z)) - 23), all = [], code = codesOf(camera);
    for (let at = fround(z - reach); at <= z + reach; at += step) all.push(at);
    const codes = all.map(code), least = [...codes];
    for (let i = all.length - 1; i-- > 0;) least[i] = Math.min(least[i], least[i + 1]);
    let most = 0;
    for (let i = 0, j = 0; i < all.length; i++) {
        while (j < all.length && least[j] <= codes[i]) j++;
        for (let k = j - 1; k > i && all[k] - all[i] > most; k--)
            if (codes[k] <= codes[i]) most = all[k] - all[i];
    }
    return most + step;
}

// What is guaranteed is never less than what happens, and not much more.
function guarantee(said, camera, z) {
    const happens = widest(camera, z, 4 * said);
    demand(happens <= said && said <= 2.01 * happens, `${said} m is guaranteed, ${happens} m happens, of ${JSON.stringify(camera)} at ${z} m`);
    return `guaranteed ${said} m, found ${happens.toPrecision(3)} m`;
}

// ---- What a person sees and does ----------------------------------------------------------------------------------

const metres = (number, unit) => Number(number) * METRES[unit];
const verdict = (page) => page.getByRole("region", { name: "What is resolved", exact: true });
const says = async (page, what, wait = 60000) => {
    await verdict(page).getByText(what).waitFor({ timeout: wait }).catch(async () => demand(false, `the verdict is ${await verdict(page).innerText()}`));
    await settled(page);
    return verdict(page).innerText();
};
const facing = (text) => metres(.../Facing the camera.*from ([\d.e-]+) (\S+) on/.exec(text).slice(1));
const setup = (page) => page.getByRole("group", { name: "Set-up A", exact: true });
async function asks(page, { engine = "any engine", gap, distance }) {
    await page.getByLabel("In", { exact: true }).selectOption({ label: engine });
    await page.getByLabel("things", { exact: true }).fill(gap);
    await page.getByLabel("apart at", { exact: true }).fill(distance);
}
const press = (page, name) => page.getByRole("button", { name }).click();
const unfold = (page, title) => page.getByText(title, { exact: true }).click();

// ---- The six ------------------------------------------------------------------------------------------------------

// A map in three.js flickers. near is raised by the page's own button, and the line to paste is the near that it set.
async function map(page) {
    await asks(page, { engine: "three", gap: "2cm", distance: "200m" });
    await says(page, /^2 cm apart, 200 m away: may flicker/);
    const line = await page.getByText(/^camera\.near = /).innerText();
    await press(page, /^Raise near to /);
    const text = await says(page, "resolved at any slant"), near = Number(await setup(page).getByLabel("Near", { exact: true }).inputValue());
    demand(line.startsWith(`camera.near = ${near};`), `${line}, and near is ${near}`);
    return guarantee(facing(text), { near, far: 2000, mapping: "gl", bits: 24 }, 200);
}

// A student turns 24 bits into reversed float, sees why, and how much finer it is.
async function student(page) {
    await asks(page, { gap: "1mm", distance: "100m" });
    const before = facing(await says(page, "may flicker"));
    await unfold(page, /^Figures: /);
    await page.getByLabel("why reversed floats").check();
    await page.getByText(/^Reversed, far is stored as 0/).waitFor({ timeout: 60000 });
    await setup(page).getByRole("button", { name: "32-bit float" }).click();
    await setup(page).getByRole("button", { name: "reversed" }).click();
    await settled(page);
    const camera = { near: 0.1, far: 1000 };
    return [guarantee(before, { ...camera, mapping: "d3d", bits: 24 }, 100), guarantee(facing(await says(page, "Facing")), { ...camera, mapping: "reversed", bits: 32 }, 100)].join("; ");
}

// A decal in Unity: the units of a bias that bring it a centimetre nearer, each a step of a float's exponent.
async function decal(page) {
    await asks(page, { engine: "unity", gap: "1cm", distance: "100m" });
    await says(page, "may flicker");
    await press(page, "Bias what is in front");
    const answer = page.getByRole("region", { name: "bias, set-up A" });
    const [, units] = /DepthBias = (\d+),/.exec(await answer.getByText(/D3D11_RASTERIZER_DESC\.DepthBias = /).first().innerText());
    const [n, f, z, gap] = [0.3, 1000, 100, 0.01], depth = (at) => (n * (f - at)) / (at * (f - n)), unit = 2 ** (Math.floor(Math.log2(depth(z))) - 23);
    const least = (depth(z - gap) - depth(z)) / unit; // no depth of a triangle there is less, and none has a smaller unit
    demand(Number(units) >= least && Number(units) <= 1.02 * least, `${units} units, ${least} by hand`);
    return `${units} units, ${least.toFixed(0)} by hand`;
}

// A viewer of CAD models, 10 km far: which near resolves a centimetre at 500 m.
async function cad(page) {
    await setup(page).getByLabel("Far", { exact: true }).fill("10km");
    await unfold(page, "What it takes: near, far, a format, a mapping");
    const form = page.locator("form", { has: page.getByLabel("Resolve") });
    await form.getByLabel("Resolve").fill("1cm");
    await form.getByLabel("at", { exact: true }).fill("500m");
    await settled(page);
    const answer = await page.getByText(/^Near [\d.]+ m suffices for unorm24 d3d, far 10 km, to resolve 1 cm at any slant/).first().innerText();
    const near = /^Near ([\d.]+) m/.exec(answer)[1];
    await setup(page).getByLabel("Near", { exact: true }).fill(near);
    await asks(page, { gap: "1cm", distance: "500m" });
    const text = await says(page, "resolved at any slant"), least = (500 ** 2 / (2 ** 24 - 1) / 0.01); // one code a centimetre: n = z²/(2^24 - 1)/gap
    demand(Number(near) > least, `${near}, and not less than ${least}`);
    return `near ${near} m; ${guarantee(facing(text), { near: Number(near), far: 10000, mapping: "d3d", bits: 24 }, 500)}`;
}

// A depth camera's PNG of 16 bits, in millimetres: what a pixel holds, and how far off it may be.
async function robot(page) {
    const folder = mkdtempSync(join(tmpdir(), "walk-")), millimetres = (x, y) => (x === 7 ? 0 : 900 + 3 * x + 2 * y);
    await page.getByLabel(/^PNG, npy, PFM or PGM/).setInputFiles(put("depth.png", png(Array.from({ length: 37 * 23 }, (_, i) => millimetres(i % 37, Math.floor(i / 37))))));
    await page.getByText(/may be lengths: what are they\?/).waitFor({ timeout: 60000 });
    await page.getByLabel("Its samples are").selectOption({ label: "millimetres" });
    await page.getByText(/1 in a sample is 0\.001/).waitFor({ timeout: 60000 });
    const image = page.getByRole("application", { name: /^The image/ });
    await image.focus();
    for (const key of ["ArrowRight", "ArrowRight", "ArrowRight", "ArrowDown"]) await image.press(key);
    const said = await page.getByText(/^Pixel 21,12: /).innerText();
    const numbers = /eye depth (\S+) m, which may be (\S+) m to (\S+) m: off by at most (\S+) m\./.exec(said)?.slice(1).map(Number);
    const sample = millimetres(21, 12), wanted = [sample, sample - 0.5, sample + 1, 1]; // whether it was rounded or cut, none knows
    demand(numbers?.every((one, i) => Math.abs(1000 * one - wanted[i]) < 0.002), `${said}, and by hand ${wanted} mm`);
    rmSync(folder, { recursive: true });
    return said;
}

// The author of a driver measures, and compares with a driver that is known.
async function driver(page) {
    const own = JSON.parse(await measure(page)), { findings } = own, known = JSON.parse(readFileSync("tests/profiles/softpipe.json", "utf8"));
    await page.getByLabel("Beside what is known of").locator("visible=true").selectOption({ label: `${known.device.name}, ${known.device.api}` });
    const said = await page.getByText(/findings are otherwise/).innerText();
    demand(said.startsWith(`${differences(known, own).length} of `), said);
    const one = (all, key, format) => all.find((finding) => finding.key === key && finding.format === format)?.found;
    const rows = await page.getByRole("row").filter({ hasText: "rounding d16" }).innerText();
    demand(rows.includes(one(known.findings, "rounding", "d16")) && rows.includes(one(findings, "rounding", "d16")), rows);
    return `${said} ${rows.replaceAll("\t", " | ")}`;
}

const WALKS = {
    "a three.js developer's map flickers, and no longer": map, "a student of reversed depth": student, "an artist's decal in Unity": decal,
    "a viewer of CAD models with far at 10 km": cad, "a robot's PNG of 16 bits in millimetres": robot, "a driver's author": driver,
};

export async function walks() {
    for (const [who, walk] of Object.entries(WALKS))
        for (const width of [1280, 390])
            await test(`${who}, ${width} px`, async () => {
                const page = await open({ folded: true, width, height: 800, mobile: width < 500 });
                const said = await walk(page).finally(() => page.screenshot({ path: `${process.env.B ?? "build"}/web/shots/walk-${walk.name}-${width}.png`, fullPage: true }));
                await axeFindsNothing(page);
                await close(page);
                return said;
            });
}
