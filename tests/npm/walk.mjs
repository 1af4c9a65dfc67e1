// SPDX-License-Identifier: GPL-3.0-or-later
// What walk.c prints, by the package:  node walk.mjs <SETUPS
import { readFileSync } from "node:fs";
import { Camera, DepthprecError } from "depthprec";

const bits = new DataView(new ArrayBuffer(8));
const show = (x) => (Number.isNaN(x) ? "nan" : (bits.setFloat64(0, x), bits.getBigUint64(0).toString(16).padStart(16, "0")));
const all = (values) => Array.from(values, show);

function depths(c, z) {
    const codes = c.encode(z), out = () => new z.constructor(z.length);
    const { z: eye, lo, hi } = c.decode(codes, { bounds: true, out: { z: out(), lo: out(), hi: out() } });
    return [...codes, ...[c.windowDepth(z), c.separation(z), c.lattice(z), c.interval(z), eye, lo, hi].flatMap(all)];
}

function answer(line) {
    const [near, far, format, mapping, ortho, rounding, model, arith, ...numbers] = line.split(" ");
    const z = Float64Array.from(numbers, Number);
    const c = new Camera({ near: Number(near), far: far === "inf" ? Infinity : Number(far), format, mapping, ortho: ortho === "1", rounding, model, arith });
    const decoded = c.decode(c.windowDepth(z), { bounds: true });
    let worst;
    try {
        worst = all(Object.values(c.worst(z[0], z.at(-1))));
    } catch (error) {
        worst = [error.message];
    }
    return ["", ...depths(c, z), ...depths(c, Float32Array.from(z)), ...Object.values(decoded).flatMap(all), ...worst].join(" ");
}

for (const line of readFileSync(0, "utf8").trim().split("\n")) {
    try {
        console.log(answer(line));
    } catch (error) {
        if (!(error instanceof DepthprecError)) throw error;
        console.log(error.message);
    }
}
