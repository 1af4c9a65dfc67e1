// SPDX-License-Identifier: GPL-3.0-or-later
// Cameras and numbers, each worked out by hand: near 1, far 2, so that window depth is 2 - 2/z; unorm2 has the codes 0 to 3.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { inspect } from "node:util";
import { Camera, DepthprecError, version } from "depthprec";

const small = new Camera({ near: 1, far: 2, format: "unorm2" });
const near = (got, want, bound = 1e-15) => assert.ok(Math.abs(got - want) <= bound * Math.abs(want), `${got} is not ${want}`);
const refuses = (work, said, kind = DepthprecError) => assert.throws(work, (error) => error.constructor === kind && (said.test(error.message) || assert.fail(error.message)));

test("codes: those whose window depth, a third each, is nearest", () => {
    assert.deepEqual([1, 12 / 11 - 1e-9, 12 / 11 + 1e-9, 1.2, 1.3, 1.5, 1.7, 1.72, 2].map((z) => small.encode(z)), [0, 0, 1, 1, 1, 2, 2, 3, 3]);
    assert.deepEqual([0, 5, -1, Infinity, -Infinity].map((z) => small.encode(z)), [0, 3, 0, 3, 0]);
    assert.equal(small.codeMax, 3);
    const reversed = new Camera({ near: 1, far: 2, format: "unorm2", mapping: "reversed" });
    assert.deepEqual([1, 1.2, 1.5, 2].map((z) => reversed.encode(z)), [3, 2, 1, 0]);
    const infinite = new Camera({ near: 1, far: Infinity, format: "unorm2" }); // 1 - 1/z
    assert.deepEqual([1, 1.5, 3, 7].map((z) => infinite.encode(z)), [0, 1, 2, 3]);
    assert.equal(infinite.decode(3), Infinity);
    const flat = new Camera({ near: -1, far: 2, format: "unorm2", ortho: true }); // (z + 1)/3
    assert.deepEqual([-1, 0, 1, 2].map((z) => [flat.encode(z), flat.decode(flat.encode(z))]), [[0, -1], [1, 0], [2, 1], [3, 2]]);
});

test("eye depths and the ends of cells: 12/12, 12/11, 12/9, 12/7, 12/6", () => {
    const want = [[1, 1, 12 / 11], [1.2, 12 / 11, 12 / 9], [1.5, 12 / 9, 12 / 7], [2, 12 / 7, 2]];
    want.forEach(([z, lo, hi], code) => {
        const got = small.decode(code, { bounds: true });
        near(got.z, z);
        near(got.lo, lo);
        near(got.hi, hi);
        assert.equal(small.decode(code), got.z);
        near(small.interval(z), hi - lo, 1e-14);
        assert.deepEqual(small.decode(code / 3, { window: true, bounds: true }), got);
    });
});

test("window depths, and one step on: 1.2 to 1.5", () => {
    near(small.windowDepth(1.5), 2 / 3);
    near(small.lattice(1.2), 0.3, 1e-14);
    near(small.lattice(2), 1, 1e-14); // from 2 on to 1/(1 - 4/6)
    assert.ok(small.separation(1.2) >= small.lattice(1.2) && small.separation(1.2) < 0.3001);
});

test("the worst: code 2 is widest, 8/21; at 12/7 code 3 is 2/7 off", () => {
    const worst = small.worst();
    near(worst.interval, 8 / 21, 1e-12);
    near(worst.error, 2 / 7, 1e-12);
    near(worst.errorZ, 12 / 7);
    assert.deepEqual([worst.lo, worst.hi, worst.intervalCode, worst.errorCode, worst.blindFrom], [1, 2, 2, 3, NaN]);
    near(small.worst(1, 1.05).interval, 1 / 11, 1e-12);
    assert.equal(Object.keys(worst).length, 12);
});

test("what a camera is", () => {
    assert.deepEqual({ ...small, viewport: null }, { near: 1, far: 2, format: "unorm2", mapping: "d3d", ortho: false, rounding: "nearest", model: "exact", arith: "ieee",
        logC: 1, depthRange: [0, 1], viewport: null, fov: 60, raster: undefined, subpixel: undefined, slant: [0, 90], triangleClass: [2, 512, 16], codeMax: 3, nearLeast: 1, nearMost: 1, farLeast: 2, farMost: 2, nearDigits: 17, farDigits: 17 });
    assert.throws(() => { small.near = 3; }, TypeError);
    const view = small.replace({ viewport: [320, 200] });
    for (const [key, value] of Object.entries({ near: 0.5, far: 60, format: "fp32", mapping: "log", ortho: true, rounding: "even", model: "staged", arith: "fused",
        logC: 3, depthRange: [1, 0.5], viewport: [640, 480], fov: 30, raster: "spec-gl", subpixel: 4, slant: [1, 2], triangleClass: [2, 4, 3] })) {
        const own = ["ortho", "mapping"].includes(key) ? small : view, other = own.replace({ [key]: value });
        assert.deepEqual(other[key], value);
        assert.notDeepEqual({ ...other }, { ...own });
        assert.deepEqual({ ...other.replace({ [key]: own[key] }) }, { ...own });
    }
    for (const [key, value] of Object.entries({ fov: 30, raster: "spec-gl", subpixel: 4, slant: [0, 5], triangleClass: [2, 3, 4] })) refuses(() => new Camera({ [key]: value }), new RegExp(`^${key} needs a viewport`));
    refuses(() => view.replace({ raster: "mesa" }), /^raster must be spec-d3d/);
    refuses(() => view.replace({ raster: "spec-gl", subpixel: 3 }), /^subpixel must be at least 4/);
    refuses(() => view.replace({ raster: "spec-d3d", subpixel: 8 }), /^subpixel does not apply/);
    assert.ok(view.replace({ raster: "spec-d3d" }).separation(1.5) > view.separation(1.5));
    assert.equal(new Camera({ format: "D24", mapping: "GL" }).format, "unorm24");
    assert.equal(new Camera().far, 1000);
    const wide = new Camera({ viewport: [1920, 1080], slant: [0, 80] });
    assert.ok(wide.separation(10) > 5 * new Camera().separation(10));
    assert.equal(wide.lattice(10), new Camera().lattice(10));
    assert.ok(Number.isNaN(new Camera({ model: "float" }).interval(10)));
    assert.match(version, /^\d+\.\d+\.\d+$/);
});

test("a depth range from 1 down to 1/4: codes 3, 2, 1 are at 1, 9/7, 9/5, and 0 is beyond far", () => {
    const moved = small.replace({ depthRange: [1, 0.25] });
    assert.deepEqual(Array.from(moved.encode([1, 9 / 7, 9 / 5, 2])), [3, 2, 1, 1]);
    [2, 9 / 5, 9 / 7, 1].forEach((z, code) => near(moved.decode(code), z));
    near(moved.windowDepth(9 / 7), 2 / 3);
    near(moved.decode(5 / 8, { window: true }), 9 / 7); // as the nearest code
    assert.deepEqual({ ...moved.replace({ depthRange: [0, 1] }) }, { ...small });
});

test("what a camera refuses", () => {
    for (const [options, said] of [[{ near: -1 }, /^near must be/], [{ far: 0.01 }, /^far must be/], [{ near: NaN }, /^near must be/], [{ format: "d25x" }, /not a format/],
        [{ mapping: "up" }, /a mapping must be/], [{ rounding: "up" }, /rounding must be/], [{ model: "fast" }, /model/], [{ arith: "?" }, /binary32/],
        [{ far: Infinity, mapping: "log" }, /infinite/], [{ logC: 0, mapping: "log" }, /C of the log/], [{ format: "depth24plus" }, /^depth24plus is unorm24 or fp32/],
        [{ viewport: [0, 5] }, /^viewport must/], [{ viewport: [2 ** 40, 5] }, /^viewport must/], [{ viewport: [1, 2, 3] }, /^viewport must be 2 numbers/], [{ mapping: "log", ortho: true }, /orthographic/],
        ...[[0, 0], [0.5, 0.5], [0, 1e-7], [-0.1, 1], [0, 1.1], [0, NaN]].map((depthRange) => [{ depthRange }, /^a depth range must/]), [{ depthRange: [0, 0.5], mapping: "log" }, /^a depth range must/],
        [{ depthRange: [0, 0.5, 1] }, /^depthRange must be 2 numbers/],
        [{ format: "a\0b" }, /zero byte/], [{ format: "x".repeat(1000) }, /shorter/]])
        refuses(() => new Camera(options), said);
    for (const options of [{ near: "1" }, { near: null }, { near: 1n }, { format: 24 }, { mapping: null }, { viewport: 3 }, { viewport: [1.5, 2] }, { depthRange: 1 }, { depthRange: ["0", 1] }, { what: 1 }, null, 3])
        refuses(() => new Camera(options), /must be|has no/, TypeError);
    for (const [lo, hi] of [[5, 1], [0, 5], [1, Infinity], [NaN, 5]]) refuses(() => new Camera().worst(lo, hi), /^a range must/);
    for (const method of ["windowDepth", "separation", "lattice", "interval"]) {
        refuses(() => small[method](3), /a depth must lie in/);
        refuses(() => small[method](NaN), /must be a number, got NaN/);
    }
    refuses(() => small.encode(NaN), /must be a number/);
    refuses(() => small.decode(4), /a code must be a whole number from 0 to 3, got 4/);
    refuses(() => small.decode(0.5), /\{ window: true \}/);
    refuses(() => small.decode(1.5, { window: true }), /from 0 to 1, got 1.5/);
});

// Matrices of near 1 and far 4, by rows and for cameras that look along -z.
const matrix = (c, e, w = [0, 0, -1, 0]) => [[2, 0, 0, 0], [0, 3, 0, 0], [0, 0, c, e], w];
const turned = (m) => m[0].flatMap((_, i) => m.map((row) => row[i]));

test("cameras of matrices", () => {
    const all = [["d3d", matrix(-4 / 3, -4 / 3)], ["gl", matrix(-5 / 3, -8 / 3)], ["reversed", matrix(1 / 3, 4 / 3)], ["gl-reversed", matrix(5 / 3, 8 / 3)]];
    for (const [mapping, m] of all)
        for (const given of [m, m.flat(), turned(m), Float64Array.from(turned(m)), m.map((row) => Float64Array.from(row))]) {
            const c = Camera.fromMatrix(given, { mapping, format: "d24" });
            near(c.near, 1, 1e-14);
            near(c.far, 4, 1e-13);
            assert.deepEqual([c.mapping, c.format, c.ortho], [mapping, "unorm24", false]);
        }
    assert.deepEqual({ ...Camera.fromMatrix({ elements: turned(all[2][1]) }) }, { ...Camera.fromMatrix(turned(all[2][1])) }); // as three.js has it
    assert.deepEqual({ ...Camera.fromMatrix({ elements: Float32Array.from(turned(all[2][1])) }) }, { ...Camera.fromMatrix(Float32Array.from(turned(all[2][1]))) });
    assert.equal(Camera.fromMatrix(turned(all[2][1])).mapping, "reversed"); // which alone says all of itself
    assert.equal(Camera.fromMatrix(matrix(-1, -1), { mapping: "d3d" }).far, Infinity);
    const flat = Camera.fromMatrix(matrix(-1 / 3, -1 / 3, [0, 0, 0, 1]), { mapping: "d3d" });
    assert.deepEqual([flat.ortho, Math.round(flat.near * 1e12) / 1e12, Math.round(flat.far * 1e12) / 1e12], [true, 1, 4]);
    refuses(() => Camera.fromMatrix(all[0][1]), /more than one convention.*: d3d by rows near 1, far 4; gl by rows near 0\.571428571, far 4/);
    refuses(() => Camera.fromMatrix(all[0][1], { mapping: "reversed" }), /with distance: the mapping must be/);
    refuses(() => Camera.fromMatrix(all[0][1], { mapping: "log" }), /mapping must be one of/);
    refuses(() => Camera.fromMatrix(all[0][1], { mapping: "d3d", layout: "up" }), /layout must be/);
    refuses(() => Camera.fromMatrix([[1, 0], [0, 1]]), /16 numbers, got 4/);
    for (const key of ["near", "far", "ortho", "metric"])
        refuses(() => Camera.fromMatrix(all[0][1], { mapping: "d3d", [key]: 3 }), new RegExp(`options of fromMatrix must have no '${key}'`), TypeError);
    refuses(() => Camera.fromMatrix(new Array(16).fill(0)), /fourth row must be .*, got 0 0 0 0$/);
    const entries = Float32Array.of(1.1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 100000 / 99999.9, -10000 / 99999.9, 0, 0, 1, 0), rounded = Camera.fromMatrix(entries, { mapping: "d3d" });
    assert.ok(rounded.farDigits < 17 && rounded.nearDigits < 17);
    for (const [changes, name, other] of [[{ far: 7 }, "far", "near"], [{ near: 0.5 }, "near", "far"]]) {
        const moved = rounded.replace(changes);
        assert.deepEqual([moved[`${name}Least`], moved[`${name}Most`], moved[`${name}Digits`], moved[`${other}Least`]], [changes[name], changes[name], 17, rounded[`${other}Least`]]);
    }
    // Of an API that asks for at least 4 bits of the grid.
    for (const subpixel of [4, 5]) assert.equal(new Camera({ viewport: [640, 480], raster: "spec-vulkan", subpixel }).subpixel, subpixel);
    // Side by side is no overlap.
    const both = Float64Array.of(5, 6, 7, 8), c = new Camera(), want = c.separation(both.slice(2));
    assert.deepEqual(c.separation(both.subarray(2), { out: both.subarray(0, 2) }), want);
    assert.deepEqual(c.separation(both.subarray(0, 2), { out: both.subarray(2) }).length, 2);
    // As %.9g of C, at both ends of what it writes without an exponent.
    for (const [numbers, said] of [[[1e9, 999999999, 999999999.4, 999999999.6], "1e+09 999999999 999999999 1e+09"], [[1e-4, 9.9999e-5, -1e-5, 0.000123456789012], "0.0001 9.9999e-05 -1e-05 0.000123456789"],
        [[-1234567890.5, 1e100, 0.5, 100], "-1.23456789e+09 1e+100 0.5 100"], [[99999999.95, 0.1, 1 / 3, -2e-100], "100000000 0.1 0.333333333 -2e-100"]])
        refuses(() => Camera.fromMatrix([...new Array(12).fill(1), ...numbers]), new RegExp(`, got ${said.replaceAll(/[.+]/g, "\\$&")}$`));
    refuses(() => Camera.fromMatrix(new Array(16).fill(NaN)), /finite/);
    refuses(() => Camera.fromMatrix([[2, 0, 0, 0], [0, 3, 0, 0], [0.1, 0, -4 / 3, -4 / 3], [0, 0, -1, 0]], { mapping: "d3d" }), /the same for every pixel/);
    for (const bad of ["matrix", null, {}, undefined]) refuses(() => Camera.fromMatrix(bad), /a matrix must be/, TypeError);
});

// Near 0.1 and far 100000 of Direct3D in entries of 32 bits: c is 1.000001, a step 2^-23 there, e -0.1, 2^-27.
test("the planes of a rounded matrix", () => {
    const rows = Float32Array.from([1.1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1e5 / (1e5 - 0.1), -1e4 / (1e5 - 0.1), 0, 0, 1, 0]);
    const c = rows[10], e = -rows[11], half = 2 ** -24, given = Camera.fromMatrix(rows, { mapping: "d3d" });
    near(given.farLeast, (e - half / 16) / (c + half - 1), 1e-9);
    near(given.farMost, (e + half / 16) / (c - half - 1), 1e-9);
    near(given.nearLeast, (e - half / 16) / (c + half), 1e-12);
    near(given.nearMost, (e + half / 16) / (c - half), 1e-12);
    assert.ok(given.farLeast <= 1e5 && 1e5 <= given.farMost && given.nearLeast <= 0.1 && 0.1 <= given.nearMost);
    assert.match(inspect(given), /near: 0\.1,\s+far: 100000,/);
    assert.match(inspect({ given }), /far: 100000,/);
    const typed = Camera.fromMatrix(matrix(-1.25, -0.5), { mapping: "d3d" });
    assert.deepEqual([typed.nearLeast, typed.nearMost, typed.farLeast, typed.farMost, typed.farDigits], [0.4, 0.4, 2, 2, 17]);
    assert.deepEqual([new Camera({ far: 7 }).farLeast, new Camera({ far: 7 }).nearMost], [7, 0.1]);
});

test("arrays: of any type, of any length, each element as by itself", () => {
    const c = new Camera({ near: 0.1, far: 1000, format: "unorm24" }), z = Float64Array.from({ length: 20011 }, (_, i) => 0.1 + i * 0.0499);
    const codes = c.encode(z);
    assert.equal(codes.constructor, Uint32Array);
    const bounds = c.decode(codes, { bounds: true }), windows = c.windowDepth(z);
    for (const i of [0, 1, 8190, 8191, 8192, 8193, 16383, 16384, 20010]) {
        assert.equal(codes[i], c.encode(z[i]));
        assert.deepEqual({ z: bounds.z[i], lo: bounds.lo[i], hi: bounds.hi[i] }, c.decode(codes[i], { bounds: true }));
        assert.equal(windows[i], c.windowDepth(z[i]));
        for (const method of ["separation", "lattice", "interval"]) assert.equal(c[method](z.subarray(i, i + 1))[0], c[method](z[i]));
    }
    const decoded = c.decode(windows), same = c.decode(codes);
    assert.deepEqual(decoded, same);
    assert.equal(c.separation(new Float32Array([1, 2])).constructor, Float32Array);
    const Half = globalThis.Float16Array ?? class extends Float32Array { get [Symbol.toStringTag]() { return "Float16Array"; } };
    assert.deepEqual(c.encode(Half.from([1, 2.5])), c.encode(Float32Array.of(1, 2.5))); // numbers that both hold
    assert.deepEqual(c.decode(Half.from([0.5, 0.75])), c.decode(Float32Array.of(0.5, 0.75)));
    assert.equal(c.separation(Half.from([1])).constructor, Float32Array);
    assert.deepEqual(c.encode([1, 2, 3]), c.encode(new Int8Array([1, 2, 3])));
    assert.deepEqual(c.decode([0, 100]), c.decode(new Uint8Array([0, 100])));
    assert.deepEqual([...c.decode([2 ** 32 - 1])], [c.decode(c.codeMax)]);
    assert.equal(new Camera({ format: "unorm16" }).encode([1]).constructor, Uint16Array);
    for (const method of ["encode", "decode", "windowDepth", "separation", "lattice", "interval"])
        for (const empty of [[], new Float32Array(), new Uint8Array()]) assert.equal(c[method](empty).length, 0);
    assert.deepEqual([...c.separation(new Float64Array([NaN, Infinity, -1, 1001]))], [NaN, NaN, NaN, NaN]);
    assert.deepEqual([...c.encode([NaN, Infinity, -Infinity])], [0, c.codeMax, 0]);
});

// What a camera was asked for before, and in which types, is forgotten: each call after each other, beside a camera that is asked for nothing else.
test("a camera is as a fresh one, whatever it made before", () => {
    const fresh = () => new Camera({ near: 0.5, far: 800, format: "unorm16", mapping: "reversed" }), z = [0.5, 3, 70, 800], codes = [65535, 9000, 12, 0];
    const from = [Float64Array.from(z), Float32Array.from(z)], stored = [Uint32Array.from(codes), Uint16Array.from(codes), Uint8Array.from([9, 8, 7, 0])];
    const calls = [(c) => c.encode(3), (c) => c.decode(9000), (c) => c.decode(9000, { bounds: true }), (c) => c.separation(3), (c) => c.lattice(3), (c) => c.interval(3), (c) => c.worst(1, 5),
        ...from.flatMap((given) => [Uint32Array, Uint16Array].map((of) => (c) => c.encode(given, { out: new of(4) }))),
        ...stored.flatMap((given) => [Float64Array, Float32Array].map((of) => (c) => c.decode(given, { out: new of(4) }))), ...stored.map((given) => (c) => c.decode(given, { bounds: true })),
        ...from.flatMap((given) => ["windowDepth", "separation", "lattice", "interval"].map((method) => (c) => c[method](given))), (c) => c.decode(from[0].map((x) => x / 1000), { window: true })];
    const want = calls.map((call) => call(fresh())), other = new Camera({ near: 1, far: 2, format: "unorm2" });
    calls.forEach((before, i) => calls.forEach((call, k) => {
        const c = fresh();
        before(c);
        assert.deepEqual(call(c), want[k], `call ${k} after ${i}`);
        other.encode(from[0], { out: new Uint32Array(4) });
        assert.deepEqual(call(c), want[k], `call ${k} after ${i} and another camera`);
    }));
});

test("arrays of the caller's", () => {
    const c = new Camera({ near: 0.1, far: 1000, format: "unorm24" }), z = Float64Array.of(1, 2, 3), codes = Uint32Array.of(5, 100), whole = new Float64Array(6);
    const out = new Float32Array(2);
    assert.equal(c.decode(codes, { out }), out);
    near(out[1], c.decode(100), 1.85e-7);
    const want = c.separation(z);
    assert.equal(c.separation(z, { out: z }), z);
    assert.deepEqual(z, want);
    for (const [work, said] of [[() => c.separation(whole.subarray(1, 4), { out: whole.subarray(0, 3) }), /overlap/], [() => c.decode(whole, { out: whole }), /overlap/],
        [() => c.separation(z, { out: new Float64Array(2) }), /3, got 2/], [() => c.decode(codes, { bounds: true, out: [out] }), /z, lo and hi/],
        [() => c.decode([-1]), /codes must be from 0 to 4294967295, got -1/], [() => c.decode([1.5]), /got 1\.5/], [() => c.decode(new Int16Array([-1])), /got -1/]])
        refuses(work, said);
    for (const wrong of [new Float32Array(3), new Uint32Array(3), [], null, {}]) refuses(() => c.separation(z, { out: wrong }), /out must be a Float64Array, got/, TypeError);
    for (const method of ["encode", "decode", "windowDepth", "separation", "lattice", "interval"])
        for (const wrong of [undefined, null, "1", {}, true, 1n, [null], ["a"], [[1]], new DataView(new ArrayBuffer(8)), new ArrayBuffer(8), new BigInt64Array(1), () => 3])
            refuses(() => c[method](wrong), /must be/, TypeError);
});

test("types name what there is", async () => {
    const types = readFileSync(new URL("./node_modules/depthprec/index.d.ts", import.meta.url), "utf8"), own = await import("depthprec");
    const named = [...types.matchAll(/^export (?:class|function|const) (\w+)/gm)].map((match) => match[1]);
    assert.deepEqual(Object.keys(own).sort(), [...new Set(named)].sort());
    for (const name of [...Object.getOwnPropertyNames(Camera.prototype), "fromMatrix", "preset"])
        assert.match(types, new RegExp(`^    (static )?${name}[(<]`, "m"), name);
    for (const name of Object.keys(small)) assert.match(types, new RegExp(`^    readonly ${name}: `, "m"), name);
});
