// SPDX-License-Identifier: GPL-3.0-or-later
// What two things on one screen say agrees: random settings, dragged and typed, and what is shown then compared with itself:
// controls, headlines, pictures, marks, the requirement, the table, the answer to what it takes, the readout.
import { close, go, open, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { random, seed } from "./states.mjs";
import { demand, note, test } from "./tap.mjs";

const WRONG = [0xf0, 0xe4, 0x42]; // the colour of a wrong pixel that is marked

const screen = (page) => page.evaluate((yellow) => {
    const $$ = (selector) => [...document.querySelectorAll(selector)], text = (one) => one?.textContent.trim() ?? "";
    const field = (name, letter) => document.getElementById(`${name}-${letter}`).value;
    const marks = (name) => [0, 1].map((i) => {
        const one = document.querySelector(`#${name}`).parentElement.querySelector(`[data-mark="${i}"]`);
        return one.hidden ? null : { step: Math.round(1000 * Number(one.style.getPropertyValue("--at"))), text: text(one) };
    });
    const cells = (root, column) => [...root.querySelectorAll("table")].flatMap((table) => {
        const heads = [...table.tHead.rows[0].cells].map(text), at = heads.indexOf(column);
        return at < 0 ? [] : [...table.tBodies[0].rows].map((row) => [Number(text(row.cells[heads.indexOf("z")])), Number(text(row.cells[at]))]);
    });
    const two = !document.querySelector("#b").hidden;
    return {
        two, gap: Number(document.querySelector("#gap").value), distance: Number(document.querySelector("#distance").value),
        asked: ["gap", "distance"].map((name) => document.querySelector(`#${name}-text`).value),
        marks: { gap: marks("gap"), distance: marks("distance") },
        headlines: $$("#verdicts p").map(text),
        setups: ["A", "B"].slice(0, two ? 2 : 1).map((letter) => ({
            format: field("format", letter), mapping: field("mapping", letter), viewport: field("viewport", letter),
            unit: field("unit", letter), ortho: document.getElementById(`ortho-${letter}`).checked, refused: text(document.getElementById(`refused-${letter}`)),
        })),
        pictures: $$("#picture figure").slice(0, 2).filter((one) => !one.hidden).map((one) => {
            const canvas = one.querySelector("canvas");
            let wrong = null;
            if (!canvas.hidden) {
                const copy = new OffscreenCanvas(640, 360).getContext("2d", { willReadFrequently: true });
                copy.drawImage(canvas, 0, 0);
                const { data } = copy.getImageData(0, 0, 640, 360);
                wrong = 0;
                for (let i = 0; i < data.length; i += 4) wrong += data[i] === yellow[0] && data[i + 1] === yellow[1] && data[i + 2] === yellow[2];
            }
            return { name: text(one.querySelector(".name")), says: text(one.querySelector(".answer")), wrong };
        }),
        required: text(document.querySelector("#required")),
        wanted: ["separation", "at"].map((name) => document.querySelector(`[data-asks=solve] [data-option=${name}]`).value),
        tables: $$("[data-panel=table] [data-run]").filter((one) => one.checkVisibility()).map((one) => ({ facing: cells(one, "guaranteed"), slanted: cells(one, "slanted") })),
        stale: $$("[data-panel].stale").length,
    };
}, WRONG);

// One change, as a person makes it: what was done, in words.
async function change(page, r) {
    const which = r.below(4) === 0 && (await page.locator("#b").isVisible()) ? "b" : "a";
    const slide = (selector, step) => page.locator(selector).evaluate((one, to) => ((one.value = to), one.dispatchEvent(new Event("input"))), step);
    const type = (selector, value) => page.locator(selector).fill(value);
    const length = () => `${Number((10 ** r.between(-3, 2)).toPrecision(2))}${r.of(["mm", "cm", "m", "in"])}`;
    const options = async (name) => r.of(await page.locator(`#${name}-${which.toUpperCase()} option`).evaluateAll((all) => all.map(({ value }) => value).filter(Boolean)));
    const acts = {
        gap: () => slide("#gap", r.below(1001)),
        distance: () => slide("#distance", r.below(1001)),
        "typed gap": () => type("#gap-text", length()),
        "typed distance": () => type("#distance-text", `${Number((10 ** r.between(-1, 4)).toPrecision(3))}${r.of(["m", "m", "km", "cm"])}`),
        "a gap that is none": () => type("#gap-text", r.of(["2x", "-1cm", "0", "cm"])),
        near: () => slide(`#${which} [data-slider=near]`, r.below(501)),
        far: () => slide(`#${which} [data-slider=far]`, r.below(501)),
        "typed near": () => type(`#near-${which.toUpperCase()}`, r.of(["0.1", "0.5", "25cm", "3", "5000", "-3", "x"])),
        format: async () => page.selectOption(`#format-${which.toUpperCase()}`, await options("format")),
        mapping: async () => page.selectOption(`#mapping-${which.toUpperCase()}`, await options("mapping")),
        engine: async () => page.selectOption(`#preset-${which.toUpperCase()}`, await options("preset")),
        orthographic: () => page.locator(`#ortho-${which.toUpperCase()}`).setChecked(r.chance(0.3)),
        viewport: () => type(`#viewport-${which.toUpperCase()}`, r.of(["", "1920x1080", "3840x2160", "800x600", "64x64"])),
        arithmetic: async () => page.selectOption(`#arith-${which.toUpperCase()}`, await options("arith")),
        B: () => page.locator("#add-b").click(),
    };
    const names = Object.keys(acts), name = r.chance(0.3) ? r.of(["gap", "distance", "near"]) : r.of(names);
    await acts[name]();
    return `${name} (${which})`;
}

function judgeOne(now, i, tell) {
    const { setups: all, headlines, pictures, marks } = now, one = all[i], headline = headlines[i], picture = pictures[i];
    tell(headline.length > 25 && !/undefined|null|NaN/.test(headline), `headline: ${headline}`);
    const resolved = /: resolved at any slant/.test(headline), flickers = /: may flicker\./.test(headline), none = /no gap is guaranteed at any slant/.test(headline);
    const refused = !resolved && !flickers && !none;
    if (one.refused !== "") {
        tell(refused && marks.gap[i] === null && marks.distance[i] === null, `refused, and promised: ${one.refused} / ${headline}`);
        if (picture !== undefined) tell(picture.wrong === null, "a picture of a set-up that is refused");
        return { refused: true };
    }
    if (picture === undefined) return { refused };
    // The picture is of this set-up, or there is none and both say why.
    if (refused) {
        tell(picture.wrong === null && picture.says !== "" && headline.includes(picture.says), `no picture: ${picture.says} / ${headline}`);
        return { refused };
    }
    if (one.format !== "" && one.format !== "all" && one.format !== "depth24plus" && !one.format.startsWith("unormN"))
        tell(picture.name.startsWith(`${one.format} `), `${picture.name} is not of ${one.format}`);
    if (one.mapping !== "" && one.mapping !== "d3d,reversed") tell(` ${picture.name.replaceAll(",", "")} `.includes(` ${one.mapping} `), `${picture.name} is not of ${one.mapping}`);
    if (picture.wrong === null) tell(/too wide to be drawn/.test(picture.says), `no picture: ${picture.says}`);
    else if (/^No pixel is wrong/.test(picture.says)) tell(picture.wrong === 0, `${picture.wrong} wrong: ${picture.says}`);
    else tell(picture.wrong > 0 && /^[\d.]+ % of sign/.test(picture.says), `${picture.wrong} wrong: ${picture.says}`);
    if (picture.wrong !== null) tell(/nor will be/.test(picture.says) === resolved, `${picture.says} / ${headline}`);
    tell((marks.gap[i] === null) === none, `the mark of the gap: ${marks.gap[i]?.text} / ${headline}`);
    if (resolved) {
        tell(now.gap >= marks.gap[i].step - 1 && (marks.distance[i] === null || now.distance <= marks.distance[i].step + 1), `marks ${JSON.stringify(marks)} of ${now.gap}, ${now.distance} / ${headline}`);
        tell(headline.includes(marks.gap[i].text.replace(/^[AB]: /, "")), `the mark says ${marks.gap[i].text} / ${headline}`);
    }
    if (flickers) {
        tell(now.gap <= marks.gap[i].step + 1 && (marks.distance[i] === null || now.distance >= marks.distance[i].step - 1), `marks ${JSON.stringify(marks)} of ${now.gap}, ${now.distance} / ${headline}`);
        tell(headline.includes(marks.gap[i].text.replace(/^[AB]: /, "")), `the mark says ${marks.gap[i].text} / ${headline}`);
    }
    return { resolved, flickers, none };
}

const METRES = { mm: 1e-3, cm: 1e-2, m: 1, km: 1e3, in: 0.0254, ft: 0.3048 };
function metres(text, unit) {
    const [, number, of] = /^([\d.e+-]+) ?([a-z]*)/.exec(text);
    return Number(number) * METRES[of || unit || "m"];
}

// The table's own columns never ask for more than the mark up to that distance, which is rounded up.
function judgeTable(now, i, is, tell) {
    const mark = now.marks.gap[i], table = now.tables[i], [, distance] = now.asked, unit = now.setups[i].unit;
    if (mark === null || table === undefined || is.refused) return;
    const most = metres(mark.text.replace(/^[AB]: /, ""), now.setups[0].unit), upTo = metres(distance, now.setups[0].unit);
    for (const [z, needed] of table.slanted)
        if (z * METRES[unit || "m"] <= 0.999 * upTo) tell(!(needed * METRES[unit || "m"] > 1.001 * most), `the table needs ${needed} at ${z}, the mark says ${mark.text}`);
}

// What is required is the same gap at the same distance, of a set-up with a view at any slant: the same answer.
function judgeRequired(now, i, is, tell) {
    const letter = now.two ? "AB"[i] : "", all = now.required.replace(/^Required: [^:]*: /, "").split(", ");
    const own = all.find((one) => (letter === "" ? !/^[AB] /.test(one) : one.startsWith(`${letter} `)));
    if (now.required === "" || own === undefined || is.refused || is.none || now.setups[i].viewport === "" || String(now.wanted) !== String(now.asked)) return 0;
    tell(/holds/.test(own) === is.resolved, `${now.required} / ${now.headlines[i]}`);
    return 1;
}

async function agree(count) {
    const r = random(seed()), page = await open(), done = [], wrong = [], seen = { resolved: 0, flickers: 0, none: 0, refused: 0, required: 0, drawn: 0 };
    note(`seed ${seed()}`);
    await page.locator("#marks").check();
    for (let i = 0; i < count; i++) {
        if (i % 40 === 39) await page.evaluate(() => window.depthprec.set("")); // not to be lost among what is refused
        const before = await page.evaluate(() => document.documentElement.dataset.updates);
        done.push(await change(page, r));
        await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before, { timeout: 400 }).catch(() => null); // or it was so before
        await settled(page);
        await page.evaluate(() => { // pictures are drawn where they are seen
            document.querySelector("#picture").scrollIntoView({ block: "center" });
            return new Promise((go) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(go)), 50));
        });
        const now = await screen(page), tell = (fine, what) => fine || wrong.push(`${i}, after ${done.slice(-3).join(", ")}: ${what}\n    ${JSON.stringify(now.setups)} ${now.asked}`);
        tell(now.headlines.length === now.setups.length, `${now.headlines.length} headlines`);
        tell(now.stale === 0 || now.setups.some(({ refused }) => refused !== ""), `${now.stale} panels are behind`);
        for (let k = 0; k < now.setups.length; k++) {
            const is = judgeOne(now, k, tell);
            judgeTable(now, k, is, tell);
            seen.required += judgeRequired(now, k, is, tell);
            for (const name of ["resolved", "flickers", "none", "refused"]) seen[name] += is[name] ? 1 : 0;
            seen.drawn += now.pictures[k]?.wrong != null ? 1 : 0;
        }
        if (wrong.length >= 5) break;
    }
    await close(page);
    demand(wrong.length === 0, wrong.join("\n"));
    demand(Object.values(seen).every((number) => number > count / 30), JSON.stringify(seen));
    return `${count} settings: ${JSON.stringify(seen)}`;
}

// A bias is no set-up: its panel opens, and the command there writes what stands beside the button.
async function asBias(page, name, code) {
    const panel = page.locator("[data-panel=bias]");
    await page.waitForFunction(() => document.querySelector("[data-panel=bias]").open && document.querySelector("[data-panel=bias] [data-run]"));
    await settled(page);
    const run = await panel.locator("[data-run]").first().getAttribute("data-run"), [said] = await native([run.split(" ")]);
    demand(said.status === 0 && code.length === 1 && said.out.replaceAll(/\s+/g, " ").includes(` to write ${code[0]} `), `${name}: ${code}\n${run}\n${said.out}${said.err}`);
}

// Each way out does what it says: it is pressed, and the headline says yes.
const CAMERAS = [ // an engine, if any, a gap and a distance, and what stands beside the first way
    ["", "2cm", "200m", ""], ["three", "2cm", "200m", "camera.near = "], ["babylon", "2cm", "200m", "camera.minZ = "],
    ["unity-gl", "2cm", "100m", "camera.nearClipPlane = "], ["cesium", "10cm", "1km", null],
];
async function waysOut() {
    let pressed = 0, biases = 0;
    const page = await open(), buttons = page.locator("#ways button");
    for (const [engine, gap, distance, beside] of CAMERAS)
        for (let i = 0; i < 4; i++) {
            await go(page, encodeURIComponent(`table -n 0.1 -f 5000 -F d24 -m d3d --viewport 1920x1080 --unit m ; page gap=${gap} distance=${distance} theme=${i % 2 === 0 ? "light" : "dark"}`));
            const before = await page.evaluate(() => document.documentElement.dataset.updates);
            if (engine !== "") {
                await page.selectOption("#engine", engine);
                await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before);
            }
            await settled(page);
            const headline = () => page.locator("#verdicts p").first().textContent(), said = await headline();
            demand(!/: resolved/.test(said), `${engine} ${gap} ${distance}: nothing to mend: ${said}`);
            demand((await page.inputValue("#more-A")) === "", `${engine}: what has a control is among the further options: ${await page.inputValue("#more-A")}`);
            if (i >= (await buttons.count())) break;
            const name = await buttons.nth(i).textContent(), code = await page.locator("#ways > span").nth(i).locator("code").allTextContents();
            if (i === 0 && beside !== null) demand(/^Raise near/.test(name) && String(code).startsWith(beside), `${engine}: ${name}: ${code}`);
            await buttons.nth(i).click();
            biases += name.startsWith("Bias") ? 1 : 0;
            if (name.startsWith("Bias")) await asBias(page, name, code);
            else await page.waitForFunction(() => /: resolved at any slant/.test(document.querySelector("#verdicts p").textContent), null, { timeout: 30000 })
                .catch(async () => demand(false, `${engine} ${gap} ${distance}, ${name}: ${await headline()}`));
            await settled(page); // what is under way would be taken for the next link's
            pressed++;
        }
    await close(page);
    demand(pressed >= 12 && biases >= 4, `only ${pressed} ways, ${biases} biases`);
    return `${pressed} ways, ${biases} of them biases`;
}

// Beside each control stands what the command's help says of its option.
async function explained() {
    const page = await open(), all = await page.evaluate(() => [...document.querySelectorAll("[data-option]")].map((one) =>
        ({ verb: one.closest("[data-asks]")?.dataset.asks ?? "table", option: one.dataset.option, title: one.title })));
    const verbs = [...new Set(all.map(({ verb }) => verb))], helps = await native(verbs.map((verb) => [verb, "--help"]));
    for (const { verb, option, title } of all) {
        const words = helps[verbs.indexOf(verb)].out.replaceAll(/\s+/g, " "), at = words.indexOf(title);
        demand(title.length > 20 && at > 0 && words.slice(at - 60, at).includes(`--${option}`), `${verb} --${option}: ${title}`);
    }
    await close(page);
    return `${all.length} controls`;
}

export async function agrees() {
    await test("each way out that the page names does, once it is pressed", waysOut);
    await test("each control is explained as the command's help does", explained);
    await test("what is on one screen agrees with itself, whatever is dragged and typed", () => agree(process.env.DEPTHPREC_FULL ? 300 : 80));
}
