// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths as the page's sliders have them: each unit as long as the program says, each place there and back, ends and what
// is no length:  node lengths.mjs MODULE ENGINE
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { native } from "./native.mjs";

const [module, engineFile] = process.argv.slice(2), { load } = await import(pathToFileURL(engineFile));
const engine = await load(new Uint8Array(readFileSync(module)));
const [{ err }] = await native([["table", "-n", "1parsec"]]), units = err.match(/\b(nm|um|mm|cm|m|km|in|ft)\b/g).filter((unit, i, all) => all.indexOf(unit) === i);
assert.equal(units.length, 8, err);
const lines = units.map((unit) => ["table", "-n", `1${unit}`, "-f", "10km", "--unit", "m", "--json"]);
for (const [i, { out }] of (await native(lines)).entries()) {
    const { near } = JSON.parse(out).setups[0];
    assert.equal(engine.length(`1${units[i]}`, "m"), near, units[i]);
    assert.equal(engine.length("2.5", units[i]), 2.5, `no unit: ${units[i]}`);
}
for (const [axis, lo, hi] of [["gap", 1e-4, 10], ["distance", 0.1, 1e5], ["near", 1e-3, 100], ["far", 1, 1e7]]) {
    for (let step = 0; step < 1000; step++) {
        const value = engine.length(engine.lengthAt(axis, step, false)), is = lo * (hi / lo) ** (step / 1000);
        assert.ok(Math.abs(value - is) <= 0.005 * is, `${axis} ${step}: ${value}, not ${is}`);
        assert.equal(engine.stepOf(axis, value), axis === "far" ? Math.min(step, 998) : step, `${axis} ${value}`);
    }
    assert.equal(engine.stepOf(axis, lo / 10), 0, axis);
    assert.equal(engine.stepOf(axis, -1), 0, axis);
    assert.equal(engine.stepOf(axis, 10 * hi), axis === "far" ? 998 : 1000, axis);
    assert.equal(engine.stepOf(axis, Infinity), 1000, axis);
}
assert.equal(engine.lengthAt("far", 1000, false), "inf");
assert.equal(engine.length("inf", "m"), Infinity);
for (const text of ["", "x", "1parsec", "nan", "1e400"]) assert.ok(Number.isNaN(engine.length(text, "m")) && engine.stepOf("near", NaN) === 0, text);
