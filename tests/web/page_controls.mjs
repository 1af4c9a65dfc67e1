// SPDX-License-Identifier: GPL-3.0-or-later
// Each control does what it says: it is set as a person sets it, and what is shown, beside it, above the panels and of
// which set-up, is what the program prints for a command that is written here by hand.
import { spawnSync } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { close, go, open, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { plain } from "./plain.mjs";
import { demand, test } from "./tap.mjs";

const A = ["-n", "0.1", "-f", "1000", "-F", "unorm24", "-m", "d3d", "--viewport", "1920x1080", "--unit", "m"];
const B = ["-n", "0.1", "-f", "1000", "-F", "fp32", "-m", "reversed", "--viewport", "1920x1080", "--unit", "m"];

// A command with other words behind some of its options; null takes one out.
function changed(words, changes) {
    const pairs = new Map();
    for (let i = 0; i < words.length; i += 2) pairs.set(words[i], words[i + 1]);
    for (const [name, value] of Object.entries(changes)) value === null ? pairs.delete(name) : pairs.set(name, value);
    return [...pairs].flatMap(([name, value]) => (value === "" ? [name] : [name, value]));
}

const flat = (text) => text.replaceAll(/\s+/g, " ").trim();

// What stands above the numbers of an answer is its first sentence.
const sentence = (out) => flat(/^[^]*?\.$/m.exec(out)?.[0] ?? "");

const updated = (page, act) => page.evaluate(() => document.documentElement.dataset.updates).then(async (before) => {
    await act();
    await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before);
    await settled(page);
});

async function put(page, selector, value) {
    const at = page.locator(selector), kind = await at.evaluate((one) => (one.tagName === "SELECT" ? "select" : one.type));
    await updated(page, async () => {
        if (kind === "select") await at.selectOption(value);
        else if (kind === "checkbox") await at.setChecked(value);
        else if (kind === "range") await at.evaluate((one, to) => ((one.value = to), one.dispatchEvent(new Event("input"))), value);
        else await at.fill(value).then(() => at.blur()); // some follow each letter, some the whole
    });
}

const seen = (page, panel, index) => page.evaluate(([name, i]) => {
    const one = document.querySelectorAll(`[data-panel=${name}] [data-run]`)[i], text = (at) => at?.textContent ?? "";
    const verdicts = [...document.querySelectorAll("#verdicts p")].map(text);
    return { text: text(one?.querySelector("[data-output]")), above: text(one?.querySelector(".answer")), verdicts };
}, [panel, index]);

const CONTROLS = [
    ["[data-option=near]", "0.25", { "-n": "0.25" }],
    ["[data-option=far]", "2km", { "-f": "2km" }],
    ["[data-slider=near]", "250", { "-n": "0.316" }], // half way from 0.001 to 100, three digits
    ["[data-slider=far]", "0", { "-f": "1" }],
    ["[data-slider=far]", "500", { "-f": "inf" }],
    ["[data-option=format]", "unorm16", { "-F": "unorm16" }],
    ["[data-option=mapping]", "gl", { "-m": "gl" }],
    ["[data-option=ortho]", true, { "--ortho": "", "--viewport": null }],
    ["[data-option=preset]", "unity", { "--preset": "unity", "-n": "0.3", "-f": "1000", "-F": "fp32", "-m": "reversed" }],
    ["[data-option=preset]", "unreal", { "--preset": "unreal", "-n": "10", "-f": "inf", "-F": "fp32", "-m": "reversed", "--unit": "cm" }],
    ["[data-option=model]", "float", { "--model": "float" }],
    ["[data-option=arith]", "fused", { "--model": "float", "--arith": "fused" }, [["[data-option=model]", "float"]]],
    ["[data-option=viewport]", "800x600", { "--viewport": "800x600" }],
    ["[data-option=slant]", "10:20", { "--viewport": "800x600", "--slant": "10:20" }, [["[data-option=viewport]", "800x600"]]],
    ["[data-option=at]", "3,30", { "--at": "3,30" }],
    ["[data-option=unit]", "cm", { "--unit": "cm" }],
    [".more", "--rounding zero", { "--rounding": "zero" }],
];

// How far 2 cm are guaranteed, as solve says of any slant; null where no command says that.
async function reach(words) {
    const more = changed(words, { "--model": null, "--slant": null, "--at": null, "--tolerance": null });
    const [said] = await native([["solve", ...more, "--for", "distance", "--separation", "2cm", "--json"]]);
    if (said.status !== 0) return null;
    const { answer } = JSON.parse(said.out);
    return answer.throughout ? Infinity : answer.distance * (answer.unit === "cm" ? 0.01 : 1);
}

// One control of one set-up: its table, and the headline, each under its own letter.
async function setUp(page, which, [selector, value, changes, before = []]) {
    const both = [A, B].map((words, i) => ["table", ...changed(words, i === which ? changes : {})]);
    for (const [other, to] of before) await put(page, `#${"ab"[which]} ${other}`, to);
    await put(page, `#${"ab"[which]} ${selector}`, value);
    await settled(page);
    const said = await native(both), what = `${"AB"[which]}, ${selector} at ${value}`;
    for (let i = 0; i < 2; i++) {
        const { text, verdicts } = await seen(page, "table", i), far = both[i].includes("--ortho") ? null : await reach(both[i].slice(1));
        demand(said[i].status === 0 && text === plain(said[i].out), `${what}: ${both[i].join(" ")}\n${text}${said[i].out}${said[i].err}`);
        if (verdicts[i] === `${"AB"[i]} Nothing is drawn 200 m away: the far plane cuts what is drawn.` && /far|unit/.test(selector)) continue;
        demand(verdicts[i].startsWith(`${"AB"[i]} 2 cm apart, 200 m away: `) && verdicts[i].includes("Facing the camera"), `${what}: above stands ${verdicts[i]}`);
        const [, number, unit] = /(?:up to|gap up to) ([\d.]+) (m|km)\./.exec(verdicts[i]) ?? [], shown = Number(number) * (unit === "km" ? 1000 : 1);
        if (far === null) demand(/no gap is guaranteed/.test(verdicts[i]), `${what}: above stands ${verdicts[i]}`);
        else if (far === Infinity) demand(/up to far\./.test(verdicts[i]), `${what}: above stands ${verdicts[i]}`);
        else demand(shown <= far && shown > 0.99 * far && (far >= 200) === /resolved at any slant/.test(verdicts[i]), `${what}: ${far}, above stands ${verdicts[i]}`);
    }
}

const solve = (more) => ["solve", ...changed([...changed(A, { "-n": null }), "--separation", "2cm", "--at", "200m", "--for", "near"], more)];
const bias = (more) => ["bias", ...changed([...A, "--separation", "2cm", "--at", "200m", "--api", "all"], more)];
const code = (what, more) => ["code", "--what", what, "-n", "0.1", "-f", "1000", "-m", "d3d", "--unit", "m", ...more];
const QUESTIONS = [
    ["solve", "separation", "3cm", solve({ "--separation": "3cm" })],
    ["solve", "at", "70m", solve({ "--at": "70m" })],
    ["solve", "for", "far", ["solve", ...changed(A, { "-f": null }), "--separation", "2cm", "--at", "200m", "--for", "far"]],
    ["solve", "for", "distance", ["solve", ...A, "--separation", "2cm", "--for", "distance"]],
    ["bias", "separation", "5cm", bias({ "--separation": "5cm" })],
    ["bias", "at", "30m", bias({ "--at": "30m" })],
    ["bias", "api", "gl", bias({ "--api": "gl" })],
    ["code", "language", "wgsl", code("linearize", ["--language", "wgsl"])],
    ["code", "what", "position", code("position", ["--viewport", "1920x1080"])],
    ["code", "what", "projection", code("projection", ["--viewport", "1920x1080"])],
];

async function question(page, [panel, option, value, line]) {
    await put(page, `[data-asks=${panel}] [data-option=${option}]`, value);
    await settled(page);
    const [said] = await native([line]), { text, above } = await seen(page, panel, 0);
    demand(said.status < 2 && text === plain(said.out), `${option} at ${value}: ${line.join(" ")}\n${text}${said.out}${said.err}`);
    if (panel === "solve") demand(above === sentence(plain(said.out)), `${option} at ${value}: above stands ${above}\nnot ${sentence(said.out)}`);
}

const hashOf = (page) => decodeURIComponent(new URL(page.url()).hash.slice(1));
const shows = (page) => page.evaluate(() => [document.querySelector("#near-A").value, document.querySelector("#gap-text").value,
    document.documentElement.dataset.theme ?? "system", document.querySelector("[name=figure]:checked").value].join(" "));

// A link says what differs from a page that nobody has touched; each change is a step that Back undoes.
async function address() {
    const page = await open({ folded: true }), camera = "table -n 0.25 -f 1000 -F unorm24 -m d3d --unit m --viewport 1920x1080";
    const drawn = `${camera} ; plot share -n 0.25 -f 1000 -F unorm24 -m d3d --unit m`;
    demand(hashOf(page) === "", `the first link: ${hashOf(page)}`);
    await put(page, "#near-A", "0.25");
    demand(hashOf(page) === `${camera} ; page table=shut`, `near: ${hashOf(page)}`);
    for (const name of ["plot", "table"]) await updated(page, () => page.locator(`[data-panel=${name}] > summary`).click());
    await updated(page, () => page.locator("#figure-share").check());
    demand(hashOf(page) === drawn, `figure: ${hashOf(page)}`);
    await updated(page, () => page.locator("#theme").click());
    await put(page, "#gap", 650);
    demand(hashOf(page).endsWith(" ; page gap=17.8cm theme=light"), `gap and theme: ${hashOf(page)}`);
    const other = await open({ fragment: new URL(page.url()).hash.slice(1) });
    demand(await shows(other) === "0.25 17.8cm light share", `opened elsewhere: ${await shows(other)}`);
    await other.reload();
    await other.waitForFunction(() => document.documentElement.dataset.ready !== undefined);
    demand(await shows(other) === "0.25 17.8cm light share", `reloaded: ${await shows(other)}`);
    await close(other);
    const steps = ["0.25 2cm light share plot table", "0.25 2cm system share plot table", "0.25 2cm system interval plot table",
        "0.25 2cm system interval plot", "0.25 2cm system interval", "0.1 2cm system interval"];
    const open_ = async () => [await shows(page), ...await page.evaluate(() => [...document.querySelectorAll("[data-panel][open]")].map((one) => one.dataset.panel))].join(" ");
    for (const step of steps) {
        await updated(page, () => page.goBack());
        demand(await open_() === step, `back: ${await open_()}, not ${step}`);
    }
    await updated(page, () => page.goForward());
    demand(await open_() === steps[4], `forward: ${await open_()}`);
    await close(page);
}

// The second picture is of reversed fp32, or of B; where A is that already, there is none. Every mapping is drawn.
async function pictures() {
    const page = await open(), names = () => page.evaluate(() =>
        [...document.querySelectorAll("#picture figure")].filter((one) => one.checkVisibility()).map((one) => one.querySelector(".name").textContent));
    const expect = async (what, ...wanted) => {
        const [said] = [await page.waitForFunction((list) => {
            const all = [...document.querySelectorAll("#picture figure")].filter((one) => one.checkVisibility());
            return all.length === list.length && all.every((one, i) => one.querySelector(".name").textContent === list[i] && one.querySelector("canvas").checkVisibility());
        }, wanted, { timeout: 5000 }).catch(() => null)];
        demand(said !== null, `${what}: ${await names()}`);
    };
    await expect("first", "unorm24 d3d", "fp32 reversed");
    for (const [mapping, name] of [["linear", "linear"], ["log", "log"], ["cesium", "cesium"], ["osgearth", "osgearth"], ["gl-reversed", "gl-reversed"]]) {
        await put(page, "#a [data-option=mapping]", mapping);
        await expect(mapping, `unorm24 ${name}`, "fp32 reversed");
    }
    await put(page, "#a [data-option=format]", "fp16");
    await put(page, "#a [data-option=ortho]", true);
    await expect("orthographic", "fp16 gl-reversed, orthographic", "fp32 reversed, orthographic");
    await put(page, "#a [data-option=ortho]", false);
    await put(page, "#a [data-option=preset]", "godot-mobile");
    await expect("an engine", "unorm24 reversed", "fp32 reversed");
    await updated(page, () => page.locator("#add-b").click());
    await put(page, "#b [data-option=format]", "unorm16");
    await expect("B", "unorm24 reversed", "unorm16 reversed");
    await updated(page, () => page.locator("#add-b").click());
    await put(page, "#a [data-option=format]", "fp32");
    await expect("the best", "fp32 reversed");
    await close(page);
}

// Gap and distance are lengths that stay when the camera changes, heal when near is raised, and are asked about below, too.
async function worldIsFixed() {
    const page = await open(), values = () => page.evaluate(() => ["gap-text", "gap", "distance-text", "distance"].map((id) => document.getElementById(id).value).join(" "));
    const wrong = async () => {
        await page.waitForTimeout(150);
        return page.evaluate(() => document.querySelector("#picture .answer").textContent);
    };
    const first = await values();
    demand(first === "2cm 460 200m 550", first);
    demand(/ % of sign/.test(await wrong()), `D24 does not flicker at first: ${await wrong()}`);
    for (const near of ["0.5", "5", "20"]) {
        await put(page, "#near-A", near);
        demand(await values() === first, `near ${near} moves the goalposts: ${await values()}`);
    }
    demand(/^No pixel is wrong, nor will be/.test(await wrong()), `near 20 does not heal: ${await wrong()}`);
    await updated(page, () => page.locator("#a").getByRole("button", { name: "reversed", exact: true }).click());
    await put(page, "#a [data-option=format]", "unorm16");
    demand(await values() === first, `another format moves the goalposts: ${await values()}`);
    await put(page, "#distance", 750);
    await put(page, "#gap-text", "5 mm");
    demand(await values() === "5 mm 340 3.16km 750", await values());
    demand(hashOf(page).endsWith(" ; page gap=5mm distance=3.16km"), hashOf(page));
    const asked = await page.evaluate(() => [...document.querySelectorAll("[data-asks] :is([data-option=separation], [data-option=at])")].map(({ value }) => value).join(" "));
    demand(asked === "5mm 3.16km 5mm 3.16km", `asked below: ${asked}`);
    const other = await open({ fragment: new URL(page.url()).hash.slice(1) });
    demand(await other.inputValue("#distance-text") === "3.16km" && await other.inputValue("#gap-text") === "5mm", "not in the link");
    await close(other);
    await updated(page, () => page.locator("#distance").press("ArrowRight"));
    demand(await page.inputValue("#distance-text") === "3.21km", `by a key: ${await values()}`);
    await put(page, "#a [data-option=unit]", "");
    await put(page, "#distance", 500);
    demand(await page.inputValue("#distance-text") === "100", `without a unit: ${await values()}`);
    await close(page);
}

// Plain names are the formats and mappings that the lists have, and say what is chosen there.
async function plainNames() {
    const page = await open(), button = (name) => page.locator("#a").getByRole("button", { name, exact: true });
    const pressed = () => page.locator("#a [role=group] button").evaluateAll((all) => all.filter((one) => one.ariaPressed === "true").map((one) => one.textContent).join(" "));
    for (const [name, line, now] of [
        ["16-bit", "table -n 0.1 -f 1000 -F unorm16 -m d3d --viewport 1920x1080 --unit m", "16-bit"], ["reversed", "table -n 0.1 -f 1000 -F unorm16 -m reversed --viewport 1920x1080 --unit m", "16-bit reversed"],
        ["32-bit float", "table -n 0.1 -f 1000 -F fp32 -m reversed --viewport 1920x1080 --unit m", "32-bit float reversed"], ["24-bit", "table -n 0.1 -f 1000 -F unorm24 -m reversed --viewport 1920x1080 --unit m", "24-bit reversed"],
        ["reversed", "table -n 0.1 -f 1000 -F unorm24 -m d3d --viewport 1920x1080 --unit m", "24-bit"],
    ]) {
        await updated(page, () => button(name).click());
        const [said] = await native([line.split(" ")]), { text } = await seen(page, "table", 0);
        demand(text === plain(said.out) && (await pressed()) === now, `${name}: ${await pressed()}\n${text}`);
    }
    await put(page, "#a [data-option=mapping]", "gl");
    await updated(page, () => button("reversed").click());
    demand(hashOf(page).includes("-m gl-reversed") && (await pressed()) === "24-bit reversed", `of gl: ${hashOf(page)}`);
    await put(page, "#a [data-option=format]", "fp16");
    demand((await pressed()) === "reversed", `fp16: ${await pressed()}`);
    await close(page);
}

// A plane that is dragged pushes the other; a field that is refused says so itself.
async function planes() {
    const page = await open(), values = () => page.evaluate(() => ["near", "far"].map((name) => document.querySelector(`#${name}-A`).value).join(" "));
    await put(page, "#a [data-slider=far]", "0");
    await put(page, "#a [data-slider=near]", "400");
    const [near, far] = (await values()).split(" ").map(Number);
    demand(near === 10 && far > 10 && far < 20, `near pushes far: ${near} ${far}`);
    await put(page, "#a [data-slider=far]", "0");
    const pushed = await values();
    demand(Number(pushed.split(" ")[0]) < 1 && pushed.endsWith(" 1"), `far pushes near: ${pushed}`);
    await put(page, "#near-A", "-3");
    const said = await page.evaluate(() => {
        const field = document.querySelector("#near-A");
        return [field.getAttribute("aria-invalid"), document.getElementById(field.getAttribute("aria-describedby")).textContent,
            document.querySelector("#far-A").getAttribute("aria-invalid")];
    });
    demand(said[0] === "true" && said[1].startsWith("Near: ") && said[2] === "false", `refused: ${said}`);
    await close(page);
}

// What is printed for an engine is in the language of its users; the button puts it on the clipboard, to the byte.
async function codeOfEngines() {
    const page = await open(), seenBefore = new Set();
    await page.evaluate(() => (navigator.clipboard.writeText = async (text) => void (window.copied = text)));
    for (const [engine, language] of [["three", "GLSL"], ["unity", "HLSL"], ["bevy", "WGSL"]]) {
        await put(page, "#engine", engine);
        const run = await page.locator("[data-panel=code] [data-run]").getAttribute("data-run"), [said] = await native([run.split(" ")]);
        await page.locator("[data-panel=code] [data-export=copy]").click();
        const { text } = await seen(page, "code", 0), copied = await page.evaluate(() => window.copied);
        demand(run.includes(`--preset ${engine} `) && text === said.out && copied === said.out, `${engine}: ${run}\n${text}${copied}${said.out}${said.err}`);
        demand(LANGUAGES[language].test(text) && !seenBefore.has(text), `${engine} is written in ${language}: ${text}`);
        seenBefore.add(text);
    }
    await close(page);
}
const LANGUAGES = { GLSL: /precise float z/, HLSL: /float eye_depth\(float d\)[^]*f;/, WGSL: /fn eye_depth\(d: f32\)/ };

// The requirement file asks of set-up A what the page asks, until somebody writes in it; its verdicts, and what is wrong with
// it, are those that check prints of the same file.
async function requirements() {
    const page = await open(), folder = mkdtempSync(join(tmpdir(), "need-")), program = resolve(process.env.DEPTHPREC ?? "build/depthprec");
    const judged = async (what, must) => {
        const text = await page.inputValue("#need");
        writeFileSync(join(folder, "depthprec.need"), text);
        const { status, stdout, stderr } = spawnSync(program, ["check", "depthprec.need"], { cwd: folder, encoding: "utf8", argv0: "depthprec" });
        const wanted = [stdout, stderr.trim().replace(/^depthprec: /, "")];
        await page.waitForFunction(([out, err]) => document.querySelector("#checked").textContent === out && document.querySelector("#unchecked").textContent === err, wanted, { timeout: 5000 })
            .catch(async () => demand(false, `${what}: ${text}\n${wanted}\n${await page.locator("#checked").textContent()} ${await page.locator("#unchecked").textContent()}`));
        demand(must.test(stdout + stderr), `${what}: ${stdout}${stderr}`);
        return status;
    };
    const follows = (words) => page.waitForFunction((list) => list.every((one) => document.querySelector("#need").value.includes(one)), words, { timeout: 5000 })
        .catch(async () => demand(false, `${words}: ${await page.inputValue("#need")}`));
    await page.locator("#check > summary").click();
    await follows(["near = 0.1; far = 1000.0; mapping = \"d3d\"", "range = [0.1, 200.0]; separation = 0.02;"]);
    demand((await judged("at first", /FAIL .* any\s+slant/s)) === 1, "2 cm at 200 m are resolved");
    await put(page, "#near-A", "20");
    await follows(["near = 20.0;", "range = [20.0, 200.0]"]);
    demand((await judged("near 20", /1 passed/)) === 0, "they are not from 20 m on");
    await page.fill("#need", (await page.inputValue("#need")).replace("separation = 0.02", "separation = \"1 mm\""));
    await judged("1 mm", /1 failed/);
    await put(page, "#near-A", "0.5");
    demand((await page.inputValue("#need")).includes("near = 20.0; ") && (await judged("near 0.5", /1 failed/)) === 1, "what was written is lost");
    await page.fill("#need", "cameras = { a = { near = 1; far = 10; maping = \"d3d\"; }; };");
    demand((await judged("a word that is none", /maping/)) === 2, "it is judged");
    await page.locator("#own-need").click();
    await follows(["near = 0.5;"]);
    await judged("again", /1 failed/);
    await close(page);
}

export async function controls() {
    await test("each control of both set-ups: table, sentence and letter are those of the command", async () => {
        for (const which of [0, 1])
            for (const control of CONTROLS) {
                const page = await open();
                await updated(page, () => page.locator("#add-b").click());
                await setUp(page, which, control);
                await close(page);
            }
        return `${2 * CONTROLS.length} controls`;
    });
    await test("each field of a question: the answer and what stands above it are those of the command", async () => {
        for (const one of QUESTIONS) {
            const page = await open();
            await question(page, one);
            await close(page);
        }
        return `${QUESTIONS.length} fields`;
    });
    await test("code in the language of the engine's users, to paste", codeOfEngines);
    await test("a requirement file, judged as check judges it", requirements);
    await test("a link holds what differs, Back and Forward step through changes", address);
    await test("the second picture: reversed fp32, or B; every mapping is drawn", pictures);
    await test("gap and distance are lengths that stay when the camera changes", worldIsFixed);
    await test("buttons of plain names", plainNames);
    await test("a plane pushes the other, a refused field is marked", planes);
}
