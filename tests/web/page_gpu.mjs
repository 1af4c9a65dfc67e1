// SPDX-License-Identifier: GPL-3.0-or-later
// The visitor's GPU, here the browser's software: what the page says of it is what this file draws and predicts itself, by
// WebGL of its own and binary32 by Math.fround.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { axe, close, open, said, settled } from "./browser.mjs";
import { native } from "./native.mjs";
import { random, seed } from "./states.mjs";
import { demand, test } from "./tap.mjs";

const { fround } = Math;
const LIMIT = 90000; // longer than the page has patience with a GPU: it says itself that it gave up
const POINTS = 4096, FORMATS = ["DEPTH_COMPONENT16", "DEPTH_COMPONENT24", "DEPTH_COMPONENT32F"];

// What the GPU stores of points (z, w), a pixel each, and of a triangle of that depth with a bias of 64 units and without.
const stored = (page, signed, points, depths) => page.evaluate(([all, flat, formats, ndc]) => {
    const gl = document.createElement("canvas").getContext("webgl2"), clip = gl.getExtension("EXT_clip_control");
    if (!ndc) clip.clipControlEXT(clip.LOWER_LEFT_EXT, clip.ZERO_TO_ONE_EXT);
    const side = Math.sqrt(all.length), out = {};
    const program = (vertex, fragment) => {
        const made = gl.createProgram();
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${text}`);
            gl.compileShader(shader);
            gl.attachShader(made, shader);
        }
        gl.linkProgram(made);
        return made;
    };
    const put = program("in vec4 v; void main() { gl_Position = v; gl_PointSize = 1.0; }", "out vec4 c; void main() { c = vec4(1.0); }");
    const read = program("in vec4 v; void main() { gl_Position = v; }",
        "uniform highp sampler2D t; out highp uvec4 c; void main() { c = uvec4(floatBitsToUint(texelFetch(t, ivec2(gl_FragCoord.xy), 0).r)); }");
    const draw = (kind, made, numbers) => {
        const at = gl.getAttribLocation(made, "v");
        gl.useProgram(made);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, 4, gl.FLOAT, false, 0, 0);
        gl.drawArrays(kind, 0, numbers.length / 4);
    };
    const shot = (format, drawAll) => {
        const textures = [gl[format], gl.RGBA32UI].map((kind) => {
            gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
            gl.texStorage2D(gl.TEXTURE_2D, 1, kind, side, side);
            for (const which of ["MIN", "MAG"]) gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${which}_FILTER`], gl.NEAREST);
            return gl.getParameter(gl.TEXTURE_BINDING_2D);
        });
        const frame = (place, texture) => {
            gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
            gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, texture, 0);
        };
        gl.viewport(0, 0, side, side);
        frame(gl.DEPTH_ATTACHMENT, textures[0]);
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.ALWAYS);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        drawAll();
        gl.disable(gl.DEPTH_TEST);
        frame(gl.COLOR_ATTACHMENT0, textures[1]);
        gl.bindTexture(gl.TEXTURE_2D, textures[0]);
        draw(gl.TRIANGLES, read, [-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1]);
        const four = new Uint32Array(4 * side * side);
        gl.readPixels(0, 0, side, side, gl.RGBA_INTEGER, gl.UNSIGNED_INT, four);
        return [...new Float32Array(four.buffer)].filter((_, i) => i % 4 === 0);
    };
    const centre = (i) => (2 * i + 1 - side) / side;
    const points = all.flatMap(([z, w], i) => [centre(i % side) * w, centre(Math.floor(i / side)) * w, z, w]);
    for (const format of formats) {
        out[format] = { points: shot(format, () => draw(gl.POINTS, put, points)) };
        for (const units of [0, 64]) {
            gl.polygonOffset(0, units);
            gl.enable(gl.POLYGON_OFFSET_FILL);
            out[format][units] = flat.map((z) => shot(format, () => draw(gl.TRIANGLES, put, [-1, -1, z, 1, 3, -1, z, 1, -1, 3, z, 1]))[0]);
            gl.disable(gl.POLYGON_OFFSET_FILL);
        }
    }
    return out;
}, [points, depths, FORMATS, signed]);

const even = (x) => (Math.abs(x - Math.trunc(x)) === 0.5 ? 2 * Math.round(x / 2) : Math.round(x));
const DIVISIONS = { "": (z, w) => fround(z / w), reciprocal: (z, w) => fround(z * fround(1 / w)) };
const CODES = { exact: (d) => Math.floor(d * 65535 + 0.5), even: (d) => even(fround(d * 65535)), zero: (d) => Math.trunc(fround(d * 65535)) };
const ROWS = { ieee: ["", "exact"], reciprocal: ["reciprocal", "exact"], product: ["", "even"], mesa: ["reciprocal", "even"], softpipe: ["reciprocal", "zero"] };

export async function measure(page) {
    await page.evaluate(() => (navigator.clipboard.writeText = async (text) => void (window.copied = text)));
    await page.locator("#measure").click();
    await page.waitForFunction(() => !document.querySelector("#measure").disabled, null, { timeout: LIMIT });
    const refused = await page.locator("#unmeasured").textContent();
    demand(refused === "", refused);
    await page.locator("#copy-profile").click();
    const [copied, file] = await Promise.all([page.evaluate(() => window.copied), page.waitForEvent("download"), page.locator("#save-profile").click()]);
    demand(file.suggestedFilename() === "depthprec-gpu.json" && readFileSync(await file.path(), "utf8") === copied, "the file is not what is copied");
    return copied;
}

// Clip z from -w to w is moved to [0, 1] after the division, or before it by a row with the remap.
const WINDOWS = {
    "": (divide, z, w, signed) => (signed ? fround(fround(divide(z, w) * 0.5) + 0.5) : divide(z, w)),
    "-remap": (divide, z, w, signed) => divide(signed ? fround(fround(z + w) * 0.5) : NaN, w),
};

async function profile(page, signed) {
    const r = random(seed()), draws = Array.from({ length: POINTS }, () => fround(r.spread(2 ** -10, 2 ** 20))).map((w) => [fround(w * r.spread(1e-3, 0.999)), w]);
    const flat = [2000, 19660, 40000, 65000].map((k) => fround((k + 0.25) / 65535)), own = await stored(page, signed, draws, flat);
    const text = await measure(page), found = JSON.parse(text), finding = (key, format) => found.findings.filter((one) => one.key === key && (!format || one.format === format));
    const says = ([division, code], moved) => draws.every(([z, w], i) => {
        const d = WINDOWS[moved](DIVISIONS[division], z, w, signed);
        return own.DEPTH_COMPONENT32F.points[i] === d && Math.round(own.DEPTH_COMPONENT16.points[i] * 65535) === CODES[code](d);
    });
    const rows = Object.entries(ROWS).flatMap(([name, row]) => Object.keys(WINDOWS).filter((moved) => says(row, moved)).map((moved) => name + moved));
    demand(rows.length === 1 && found.arith === rows[0], `the arithmetic is ${found.arith}, and here ${rows}`);
    FORMATS.forEach((format, i) => {
        const real = own[format].points.every((d, k) => d === own.DEPTH_COMPONENT32F.points[k]);
        const [said] = finding("stored").filter(({ found: words }) => words.startsWith(`${format}: `));
        demand(said.sure === "sure" && said.format === (real ? "d32f" : ["d16", "d24"][i]), `${format}: ${JSON.stringify(said)}, and here ${real}`);
    });
    if (!signed) flat.forEach((z, i) => {
        const step = (format) => own[format][64][i] - own[format][0][i];
        demand(step("DEPTH_COMPONENT32F") === 64 * 2 ** (Math.floor(Math.log2(z)) - 23), `fp32's step at ${z}`);
        demand(Math.abs(step("DEPTH_COMPONENT16") * 65535 - 64) < 1.01, `d16's step at ${z}: ${step("DEPTH_COMPONENT16") * 65535}`);
    });
    demand(finding("bias", "d16")[0].found === "r = one code" && (signed || /^r = 2\^\(n-23\)/.test(finding("bias", "d32f")[0].found)), "bias");
    demand(found.command === "probe" && found.device.api === "WebGL 2", text.slice(0, 300));
    const shown = await page.locator("#own pre").textContent();
    demand(shown.includes(`--arith ${found.arith}`) && (signed || shown.includes(found.raster)), shown);
    return { text, found };
}

// The command line takes the profile for the row that it names, and refuses what is not stored.
async function read({ text, found }) {
    const file = join(mkdtempSync(join(tmpdir(), "gpu")), "page.json");
    writeFileSync(file, text);
    const table = (more) => ["table", "-n", "0.1", "-f", "1000", "-m", "d3d", "--model", "float", "--csv", ...more];
    const view = ["-F", "fp32", "--viewport", "1920x1080", "--raster"];
    const [byFile, byName, raster, rasterByName, without] = await native([table(["-F", "d16", "--arith", file]),
        table(["-F", "d16", "--arith", found.arith]), table([...view, file]), table([...view, found.raster]), table(["-F", "d24", "--arith", file])]);
    demand(byFile.status === 0 && byFile.out === byName.out, `--arith: ${byFile.err}${byFile.out}`);
    demand(raster.status === 0 && raster.out === rasterByName.out, `--raster: ${raster.err}${raster.out}`);
    demand(without.status === 2 && without.err.includes("fp32"), `d24: ${without.status} ${without.err}`);
}

// Where a recorded profile differs from this one, by the files: what a device calls its formats is its own.
export function differences(known, { findings }) {
    const words = ({ key, found, sure, value }) => (sure === "measured" ? value : key === "stored" ? found.replace(/^\S+: /, "") : found);
    const near = (a, b) => (typeof a === "number" ? Math.abs(a - b) < 0.005 * a : a === b), seen = new Set();
    return known.findings.flatMap((one) => {
        const other = findings.find((got) => got.key === one.key && got.format === one.format && !seen.has(got) && (one.sure !== "measured" || got.found === one.found));
        seen.add(other);
        return other === undefined || near(words(one), words(other)) ? [] : [`${one.key}${one.format ? ` ${one.format}` : ""}`];
    });
}

const PROFILES = ["llvmpipe", "lavapipe", "softpipe", "swiftshader", "nvidia-h100", "nvidia-h100-gl"];
async function beside(page, { found }) {
    const place = page.locator("#own"), select = place.getByLabel("Beside what is known of"), options = await select.locator("option").allTextContents();
    const counts = [];
    demand(options.length === PROFILES.length && /SwiftShader/.test(options[0]), `the nearest first: ${options}`);
    for (const name of PROFILES) {
        const known = JSON.parse(readFileSync(`tests/profiles/${name}.json`, "utf8")), wanted = differences(known, found);
        await select.selectOption(`${known.device.name}, ${known.device.api}`);
        const rows = await place.getByRole("row").evaluateAll((all) => all.slice(1).map((row) => [...row.cells].map(({ textContent }) => textContent)));
        demand(String(rows.map(([subject]) => subject)) === String(wanted), `${name}: ${rows}, not ${wanted}`);
        for (const [subject, expected, got] of rows) {
            const [key, format] = subject.split(" "), shown = (all, text) => all.some((one) => one.key === key && (one.format ?? undefined) === format && text.endsWith(one.found.replace(/^[A-Z_0-9]+: /, "")));
            demand(shown(known.findings, expected) && shown(found.findings, got) && expected !== got, `${name}: ${subject}: ${expected}, ${got}`);
        }
        counts.push(`${name} ${rows.length}`);
    }
    return `otherwise: ${counts.join(", ")}`;
}

// A link of one person is opened by another one, who has a set-up: the same words, whose GPU it is, and nothing else changes.
async function carried(page) {
    await page.locator("#link-profile").click();
    const link = await page.evaluate(() => window.copied), fragment = link.split("#")[1], own = await page.locator("#own pre").textContent();
    demand(fragment.length < 600 && decodeURIComponent(fragment).startsWith("page 'gpu=ANGLE"), link);
    const other = await open({ fragment: encodeURIComponent("table -n 0.3 -f 77 -F fp32 -m reversed ; page gap=7cm") });
    const setup = () => other.locator("#link").textContent(), before = await setup(), updates = await other.evaluate(() => document.documentElement.dataset.updates);
    await other.evaluate((to) => void (location.hash = to), fragment);
    const there = other.locator("#shared");
    await there.getByRole("row").first().or(there.getByText("findings are the same")).first().waitFor({ timeout: LIMIT });
    await settled(other);
    demand((await there.locator("pre").textContent()) === own, `${await there.locator("pre").textContent()}\n${own}`);
    demand((await setup()) === before && (await other.locator("#gap-text").inputValue()) === "7cm", `the set-up became ${await setup()}`);
    demand((await there.getByRole("heading").textContent()) === "Somebody else’s GPU" && !(await other.locator("#own").isVisible()), "whose it is");
    await other.reload(); // the address has both
    await there.locator("pre").waitFor({ timeout: LIMIT });
    demand((await setup()) === before, await setup());
    await there.getByRole("button", { name: "Use it in set-up A" }).click();
    await settled(other);
    demand(/--model float --arith mesa/.test(await setup()), await setup());
    await close(other);
    return `${fragment.length} characters`;
}

const LINKS = ["page gpu=x", "page 'gpu=~~~~~~'", "page 'gpu=A~B~C~8~mesa~llvmpipe~a0s9'", "page 'gpu=A~B~C~8~mesa~doom~a0s1'", "page 'gpu=<b>~B~C~8~mesa~~a0s1'",
    "page 'gpu=A~B~C~8~mesa~~l0n1*9*8'", `page 'gpu=${"A".repeat(3000)}'`, "table -n 1 ; page gpu=A~B~C~8~mesa~~a0s1_", "page 'gpu=A~B~C~8~magic~~a0s1'", "page gpu="];
async function hostile() {
    const page = await open({ fragment: encodeURIComponent("table -n 0.3 -f 77 -F fp32 -m reversed") }), before = await page.locator("#link").textContent();
    for (const line of LINKS) {
        await page.evaluate((to) => void (location.hash = to), encodeURIComponent(line));
        await page.waitForFunction(() => !document.querySelector("#error").hidden, null, { timeout: LIMIT });
        const error = await page.locator("#error").textContent();
        demand(/the profile of a GPU is damaged: |it takes gap=2cm/.test(error) && error.length < 250, `${line}: ${error}`);
        demand((await page.locator("#link").textContent()) === before && !(await page.locator("#shared").isVisible()), `${line} is taken`);
        await page.evaluate(() => void (location.hash = ""));
        await page.waitForFunction(() => document.querySelector("#error").hidden, null, { timeout: LIMIT });
        await page.evaluate((to) => void (location.hash = to), encodeURIComponent("table -n 0.3 -f 77 -F fp32 -m reversed"));
        await page.waitForFunction((text) => document.querySelector("#link").textContent === text, before, { timeout: LIMIT });
    }
    await close(page);
}

const FUNCTIONS = [
    ["right", "float f(float d) { return near * far / (far - d * (far - near)); }", (d) => 100 / (1000 - d * 999.9)],
    ["another set-up", "uniform float zNear, zFar;\nfloat f(in highp float d) {\n return 2. * zNear * zFar / (zFar + zNear - d * (zFar - zNear));\n}",
        (d) => 200 / (1000.1 - d * 999.9)],
    ["unknown", "float f(float d) { return d * d + near; }", (d) => d * d + 0.1],
];
const REFUSED = [
    ["float f(float d) {\n return d + q;\n}", "line 2: 'q' : undeclared identifier"],
    ["\n\nfloat f(float d) { return d }", "line 3: '}' : syntax error"],
    ["uniform float time; float f(float d) { return d * time; }", "uniform time: only near and far are given, as float"],
    ["int f(int d) { return d; }", "it has no function of a depth"],
];

async function judge(page, text) {
    await page.locator("#glsl").fill(text);
    await page.locator("#judging button").click();
    await page.waitForFunction(() => !document.querySelector("#judging button").disabled, null, { timeout: LIMIT });
    return page.evaluate(() => ["#judged", "#unjudged"].map((id) => document.querySelector(id)).map((one) => (one.checkVisibility() ? one.textContent : "")));
}

async function functions(page) {
    const folder = mkdtempSync(join(tmpdir(), "gpu")), title = (text) => text.split(/\n {2}\S/)[0].replaceAll(/\s+/g, " ").trim();
    for (const [verdict, text, of] of FUNCTIONS) {
        const file = join(folder, `${verdict}.csv`), [out, refused] = await judge(page, text);
        const depths = Array.from({ length: 300 }, (_, i) => fround(i < 200 ? i / 199 : 1 - 2 ** -((i - 199) / 5)));
        writeFileSync(file, depths.map((d) => `${d},${of(d)}\n`).join(""));
        const [said] = await native([["judge", "--pairs", file, "-n", "0.1", "-f", "1000", "-F", "unorm24", "-m", "d3d", "--unit", "m"]]);
        demand(out.startsWith(`${verdict}: `) && title(out) === title(said.out), `${text}\n${out}${refused}${said.out}`);
        demand(verdict === "unknown" || out.includes("with 1048576 depths"), out);
    }
    for (const [text, wanted] of REFUSED) {
        const [out, refused] = await judge(page, text);
        demand(out === "" && refused.startsWith(`judge: ${wanted}`), `${text}: ${out}${refused}`);
    }
}

// A context that is lost between two tries, or in the middle of one.
async function lost(page) {
    const [worker] = page.workers(), [right] = FUNCTIONS;
    await worker.evaluate(() => {
        const { isContextLost } = WebGL2RenderingContext.prototype;
        WebGL2RenderingContext.prototype.isContextLost = function () {
            WebGL2RenderingContext.prototype.isContextLost = isContextLost;
            this.getExtension("WEBGL_lose_context").loseContext();
            return this.isContextLost();
        };
    });
    const [out] = await judge(page, right[1]);
    demand(out.startsWith("right: "), `after a loss: ${out}`);
    await worker.evaluate(() => {
        const { readPixels } = WebGL2RenderingContext.prototype;
        WebGL2RenderingContext.prototype.readPixels = function (...all) {
            WebGL2RenderingContext.prototype.readPixels = readPixels;
            this.getExtension("WEBGL_lose_context").loseContext();
            this.readPixels(...all);
        };
    });
    const [none, refused] = await judge(page, right[1]);
    demand(none === "" && /context is lost/.test(refused), `lost: ${none}${refused}`);
    const [again] = await judge(page, right[1]);
    demand(again.startsWith("right: "), `after a loss in the middle: ${again}`);
}

// The pixels of both canvases that differ, and what is said of them.
const pictures = (page) => page.evaluate(() => {
    const [first, , own] = document.querySelectorAll("#picture figure"), at = (one) => one.querySelector("canvas").getContext("2d").getImageData(0, 0, 640, 360).data;
    const [a, b] = [at(first), at(own)].map((bytes) => new Uint32Array(bytes.buffer));
    return { differ: a.reduce((sum, one, i) => sum + (one !== b[i]), 0), distinct: new Set(b).size, text: own.querySelector("figcaption span").textContent };
});

// Once both are there: each is drawn where it is seen, the one after the other.
async function drawn(page, model) {
    await page.locator("#picture").scrollIntoViewIfNeeded();
    await page.waitForFunction((name) => document.querySelector("#by-gpu span").textContent.includes(`the model of ${name};`), model, { timeout: LIMIT });
    const caption = ({ text }) => Number(/: (\d+) of 230400 pixels differ/.exec(text)?.[1]), last = performance.now() + LIMIT;
    let now = await pictures(page);
    while (caption(now) !== now.differ && performance.now() < last) now = await pictures(page);
    demand(now.distinct >= 6 && caption(now) === now.differ, JSON.stringify(now));
    return now;
}

async function picture(page) {
    await page.locator("#draw-gpu").click();
    demand((await drawn(page, "the rules of the guarantee")).differ > 100, "the model of the guarantee draws as the GPU does");
    await page.locator("#own").getByRole("button").click();
    await settled(page);
    const second = await drawn(page, "swiftshader"), link = await page.locator("#link").textContent();
    demand(/-F fp32 .*--model float .*--arith mesa/.test(link) && link.includes("--raster swiftshader"), link);
    demand(second.differ === 0, JSON.stringify(second));
    await page.locator("#play").click(); // it follows the camera
    await page.waitForFunction((text) => document.querySelector("#by-gpu span").textContent !== text, second.text, { timeout: LIMIT });
    await page.locator("#play").click();
}

export async function gpu() {
    const page = await open();
    let measured;
    await test("the profile of this GPU: what was drawn here, predicted here", async () => (measured = await profile(page, false), measured.found.device.name));
    await test("the command line reads the profile", () => read(measured));
    await test("beside the profiles that were recorded: where it is otherwise", () => beside(page, measured));
    await test("a link carries the profile, and changes nothing of the one who opens it", () => carried(page));
    await test("a link whose profile is damaged is refused in a sentence", hostile);
    await test("a function in GLSL: the verdicts of judge, errors at the person's own line", () => functions(page));
    await test("a lost context is said, and the next try has another", () => lost(page));
    await test("a browser that has clip z from -w to w alone", async () => {
        const other = await open();
        await other.workers()[0].evaluate(() => {
            const { getExtension } = WebGL2RenderingContext.prototype;
            WebGL2RenderingContext.prototype.getExtension = function (name) {
                return name === "EXT_clip_control" ? null : getExtension.call(this, name);
            };
        });
        return profile(other, true).then(({ found }) => (close(other), found.arith));
    });
    await test("the picture by this GPU: pixels that differ are counted, none from the model that was measured", () => picture(page));
    await test("axe finds nothing in what is shown then", async () => {
        await page.evaluate(readFileSync(axe, "utf8"));
        const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        demand(violations.length === 0, JSON.stringify(violations.map(({ id, nodes }) => [id, nodes[0].html])));
    });
    await close(page);
    // The work of this file itself: a lost context, and reading back.
    for (let i = said.length; i-- > 0;) if (/CONTEXT_LOST_WEBGL|GPU stall|willReadFrequently/.test(said[i])) said.splice(i, 1);
}
