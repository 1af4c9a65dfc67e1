// SPDX-License-Identifier: GPL-3.0-or-later
// The five functions, against the program: node --test, with DEPTHPREC the native one without cairo.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import test from "node:test";
import { Camera, DepthprecError, bias, check, recognise, run, solve } from "depthprec";

const native = (words, encoding = "utf8") => execFileSync(process.env.DEPTHPREC, words, { encoding, stdio: ["ignore", "pipe", "ignore"] });
const camera = new Camera({ near: 0.2, far: 3000, format: "unorm24", rounding: "even" });
const words = ["--near=0.2", "--far=3000", "--format=unorm24", "--mapping=d3d", "--rounding=even"];
const wide = new Camera({ near: 0.2, far: 3000, format: "unorm24", viewport: [1920, 1080], slant: [0, 60] });
const refuses = (work, said, kind = DepthprecError) => assert.rejects(work, (error) => error.constructor === kind && (said.test(error.message) || assert.fail(error.message)));

test("with options as words and as an object they are the program's commands", async () => {
    for (const [got, asked] of [
        [await solve({ camera, near: null, separation: 0.01, at: 500 }), ["solve", ...words.slice(1), "--separation=0.01", "--at=500"]],
        [await solve({ far: "10km", format: "d24", separation: "1cm", at: "5km" }), ["solve", "--far=10km", "--format=d24", "--separation=1cm", "--at=5km"]],
        [await solve({ camera: wide, for: "separation", at: 100 }), ["solve", ...words.slice(0, 4), "--viewport=1920x1080", "--slant=0:60", "--for=separation", "--at=100"]],
        [await bias({ camera, api: "vulkan", separation: 0.02, at: [300, 400] }), ["bias", ...words, "--api=vulkan", "--separation=0.02", "--at=300,400"]],
        [await run("list formats --json"), ["list", "formats"]], [await run(["world", "--json"]), ["world"]],
        [await run("check engine.need --json", { fs }), ["check", "engine.need"]]]) assert.deepEqual(got, JSON.parse(native([...asked, "--json"])));
    for (const asked of [["table", "-n", "0.3"], ["help"], ["budget", "--csv"], ["plot", "error", "-n", "0.1", "--type", "svg", "-o", "-"]]) assert.equal(await run(asked), native(asked));
});

// Each key of a camera off its default, by itself, beside the program; what that refuses is refused.
test("each key of a camera reaches the command", async () => {
    const view = { viewport: [1280, 720] }, seen = new Set(), answers = new Set();
    const keys = [[{}, []], [{ ortho: true }, ["--ortho"]], [{ rounding: "zero" }, ["--rounding=zero"]], [{ mapping: "cesium", logC: 2 }, ["--mapping=cesium", "--log-c=2"]],
        [{ depthRange: [0, 0.125] }, ["--depth-range=0:.125"]], [{ depthRange: [1, 0.3] }, ["--depth-range=1:.3"]],
        ...["fused", "mesa", "nvidia"].map((arith) => [{ arith }, [`--arith=${arith}`]]), [view, []], [{ ...view, fov: 35 }, ["--fov=35"]], [{ ...view, subpixel: 4 }, ["--subpixel=4"]],
        [{ ...view, raster: "spec-gl" }, ["--raster=spec-gl"]], [{ ...view, raster: "spec-d3d" }, ["--raster=spec-d3d"]], [{ ...view, raster: "spec-vulkan", subpixel: 6 }, ["--raster=spec-vulkan", "--subpixel=6"]],
        [{ ...view, slant: [10, 70] }, ["--slant=10:70"]], [{ ...view, triangleClass: [3, 64, 8] }, ["--triangle-class=depth=3,pixels=64,slim=8"]],
        [{ near: 0.7 }, ["--near=0.7"]], [{ far: 900 }, ["--far=900"]], [{ format: "fp32" }, ["--format=fp32"]]];
    for (const [call, verb, asked] of [[bias, "bias", { api: "vulkan", separation: 0.5, at: 300 }], [solve, "solve", { for: "separation", at: 100 }]])
        for (const [given, more] of keys) {
            Object.keys(given).forEach((key) => seen.add(key));
            const usual = [["near", 0.2], ["far", 3000], ["format", "unorm24"], ["mapping", "d3d"]].filter(([key]) => given[key] === undefined).map(([key, value]) => `--${key}=${value}`);
            const line = [verb, ...usual, ...(given.viewport ? ["--viewport=1280x720"] : []), ...more, ...Object.entries(asked).map(([key, value]) => `--${key}=${value}`), "--json"];
            const own = new Camera({ near: 0.2, far: 3000, format: "unorm24", ...given });
            let want;
            try {
                want = JSON.parse(native(line));
            } catch {
                await refuses(() => call({ camera: own, ...asked }), /./);
                continue;
            }
            const got = await call({ camera: own, ...asked });
            assert.deepEqual(got, want, line.join(" "));
            answers.add(JSON.stringify(got));
        }
    assert.deepEqual([...seen].sort(), Object.keys(new Camera()).filter((key) => !/Least|Most|Digits|codeMax|model/.test(key)).sort());
    assert.ok(answers.size > 2 * keys.length - 6, `${answers.size} answers of ${2 * keys.length}: keys that change nothing`);
});

test("requirements are an object", async () => {
    const needs = { unit: "m", cameras: { world: new Camera({ far: Infinity, mapping: "reversed", depthRange: [0, 0.5] }), web: { near: "50 cm", far: 2000, format: "unorm24", mapping: "d3d" } },
        requirements: { decals: { camera: "world", range: [0.5, 50], separation: "0.1 mm" }, props: { camera: "web", at: "1 km", separation: "1 mm" } } };
    const found = await check(needs);
    assert.deepEqual([found.passed, ...found.requirements.map((row) => row.passed)], [false, true, false]);
    assert.equal(found.requirements[0].setup.far, null);
    await refuses(() => check({ cameras: { "a b": {} } }), /a name must be/);
    await refuses(() => check({ camera: {} }), /camera/);
    await refuses(() => check({ cameras: { a: { near: undefined } } }), /must hold words/, TypeError);
    for (const bad of [null, [], "engine.need", undefined]) await refuses(() => check(bad), /must be an object/, TypeError);
});

test("presets have the planes of the program's list", async () => {
    for (const { name } of (await run("list presets --json")).items) {
        let asked = name, more = {};
        const c = await Camera.preset(name).catch((error) => {
            if (/unorm24 or fp32/.test(error.message)) more = { format: "fp32" };
            else [, asked] = error.message.match(/^preset: needs .*: ([^ ]+:[^ ]+?)(?:,? |$)/);
            return Camera.preset(asked, more);
        });
        const [want] = JSON.parse(native(["table", "--quiet", "--json", `--preset=${asked}`, ...(more.format ? ["--format=fp32"] : [])])).setups;
        assert.deepEqual([c.near, c.far, c.mapping, c.format], [want.near, want.far ?? Infinity, want.mapping, want.format], asked);
    }
    await refuses(() => Camera.preset("none"), /^preset: must be .*'none'/);
    await refuses(() => Camera.preset("unity", { unit: "parsec" }), /^unit: must be/);
    await refuses(() => solve({ near: 1, nera: 3 }), /^unknown option 'nera'; did you mean 'near'/);
    await refuses(() => bias({ camera, logC: 3, at: 3 }), /^logC: needs one/);
    await assert.rejects(() => bias(camera, { at: 3 }), /^TypeError: options must be an object, which may have the camera: \{ camera/);
    await refuses(() => run("solve --nera 3"), /^unknown option '--nera'; did you mean '--near'/);
    const core = await import("depthprec/core");
    assert.deepEqual(Object.keys(core).sort(), ["Camera", "DepthprecError", "version"]);
    assert.equal(core.Camera, Camera);
    const alone = execFileSync(process.execPath, ["--input-type=module", "-e", 'import { Camera } from "depthprec/core"; console.log(new Camera().encode(5)); await Camera.preset("unity").catch((e) => console.log(e.message))'], { encoding: "utf8" });
    assert.match(alone, new RegExp(`^${new Camera().encode(5)}\nCamera.preset runs the command: import from "depthprec"`));
});

test("images", async () => {
    const c = new Camera({ format: "unorm16", mapping: "reversed" }), z = Float32Array.from({ length: 64 * 48 }, (_, i) => 1 + i * 0.02903517), data = c.encode(z);
    const codes = await recognise({ data, width: 64, height: 48 });
    assert.deepEqual([codes.format, codes.width, codes.height, codes.type, codes.channels], ["unorm16", 64, 48, "u2", 1]);
    const windows = await recognise({ data: Float32Array.from(data, (code) => code / 65535), width: 64, height: 48 });
    assert.deepEqual([windows.format, windows.certain], ["unorm16", true]);
    await refuses(() => recognise({ data: z, width: 64, height: 48 }), /cannot be window depth/);
    await refuses(() => recognise({ data: z, width: 64, height: 47 }), /got 3072 for 64 x 47/);
    for (const bad of [z, null, { data: [1], width: 1, height: 1 }, { data: new BigInt64Array(1), width: 1, height: 1 }]) await refuses(() => recognise(bad), /must be/, TypeError);
    const metres = await recognise({ data: z, width: 64, height: 48 }, { metric: "1m" });
    assert.deepEqual([metres.metric, metres.format, metres.lattice.name, metres.type], [1, null, "file", "f4"]);
    assert.equal(codes.lattice, null);
    await refuses(() => recognise({ data: z, width: 64, height: 48, metric: "1m" }), /an image must have no 'metric', but data, width, height, channels: options come behind it/, TypeError);
    for (const work of [() => c.encode(z, { ot: z }), () => c.decode(data, { bound: true }), () => c.separation(z, { o: z }), () => run("list", { txt: true })])
        await refuses(async () => work(), /options(?: of run)? must have no '/, TypeError);
});

test("files are those of the fs that is given, and whole or not there", async () => {
    await refuses(() => run("check engine.need"), /the file '.*engine\.need' needs a file system/, Error);
    await run("texture --synthetic plane --parameter tilt=60 -F d16 -o made.npy", { fs });
    native(["texture", "--synthetic", "plane", "--parameter", "tilt=60", "-F", "d16", "-o", "native.npy"]);
    assert.deepEqual(fs.readFileSync("made.npy"), fs.readFileSync("native.npy"));
    // A check that failed is an answer: it has its file. A refusal has none.
    fs.writeFileSync("failing.need", 'cameras = { a = { near = 0.1; far = 1000; format = "unorm16"; mapping = "d3d"; }; };\nrequirements = { b = { camera = "a"; range = [1.0, 500.0]; separation = 0.001; }; };\n');
    assert.throws(() => native(["check", "failing.need", "--json", "-o", "native.json"]), (error) => error.status === 1);
    await run("check failing.need --json -o made.json", { fs });
    assert.deepEqual(fs.readFileSync("made.json"), fs.readFileSync("native.json"));
    await refuses(() => run("check failing.need --json -o none.json --csv", { fs }), /csv/);
    assert.ok(!fs.existsSync("none.json"));
    const words = "-n 0.1 -f 1000 -m d3d --json";
    const piped = await run(`texture - ${words}`, { input: fs.readFileSync("made.npy") });
    assert.deepEqual(piped.recognised, JSON.parse(native(["texture", "made.npy", ...words.split(" ")])).recognised);
    await refuses(() => run("texture made.npy -n 0.1 --product eye -o made.npy", { fs }), /must not be a file that is read/);
    fs.writeFileSync("old.svg", "old");
    await refuses(() => run("plot stability -o old.svg", { fs }), /native program/); // once it is open
    assert.equal(fs.readFileSync("old.svg", "utf8"), "old");
    await refuses(() => run("table -o none/here.txt", { fs }), /cannot write 'none\/here.txt': No such file/);
    await refuses(() => run("table -o .", { fs }), /cannot write '\.': Is a directory/);
    for (const form of ["--json", "--report json"]) assert.equal((await run(`check failing.need ${form}`, { fs })).command, "check");
    assert.deepEqual(fs.readFileSync("made.npy"), fs.readFileSync("native.npy"));
});

// As the program does: the mode stays, and whatever fails on the way leaves the old file and nothing beside it.
test("a file that is written anew", async () => {
    for (const mode of [0o600, 0o640, 0o755]) {
        fs.writeFileSync("mode.csv", "old");
        fs.chmodSync("mode.csv", mode);
        await run("table --csv -o mode.csv", { fs });
        assert.equal(fs.statSync("mode.csv").mode & 0o777, mode);
        assert.match(fs.readFileSync("mode.csv", "utf8"), /^near/);
        fs.writeFileSync("mode.csv", "old");
        fs.symlinkSync("mode.csv", "link.csv");
        await run("table --csv -o link.csv", { fs }); // what the link points to is written, and it stays a link
        assert.equal(fs.readlinkSync("link.csv"), "mode.csv");
        assert.match(fs.readFileSync("mode.csv", "utf8"), /^near/);
        fs.unlinkSync("link.csv");
    }
    for (const failing of ["writeFileSync", "chmodSync", "renameSync"]) {
        fs.writeFileSync("mode.csv", "old");
        const fails = (...given) => {
            if (failing === "writeFileSync") fs.writeFileSync(given[0], "half");
            throw Object.assign(new Error("no space"), { code: "ENOSPC" });
        };
        const before = fs.readdirSync(".").sort();
        await assert.rejects(() => run("table --csv -o mode.csv", { fs: { ...fs, [failing]: fails } }), /mode\.csv|no space|No space/, failing);
        assert.equal(fs.readFileSync("mode.csv", "utf8"), "old", failing);
        assert.deepEqual(fs.readdirSync(".").sort(), before, failing);
    }
});

test("refusals", async () => {
    fs.writeFileSync("made.png", Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13));
    fs.writeFileSync("made.gltf", "{}");
    for (const [asked, said] of [["texture made.png", /PNG is not read.*\.npy/], ["scene made.gltf", /glTF.*native program/], ["tabl", /^unknown command .tabl.; did you mean/], ["plot error -n 0.1 --type png -o -", /must be svg.*rsvg-convert/s], ["methods interval", /^methods.*native program/], ["probe", /GPU.*native program/]])
        await refuses(() => run(asked, { fs }), said);
    await refuses(() => run(["table", "a\0b"]), /zero byte/);
    await refuses(() => run([3]), /words must be text/, TypeError);
    await refuses(() => solve({ camera: {} }), /must be a Camera/, TypeError);
});
