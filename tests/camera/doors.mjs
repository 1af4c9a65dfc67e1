// SPDX-License-Identifier: GPL-3.0-or-later
// Each camera of cameras.txt by the npm package, as doors.py does by Python's:  node doors.mjs PACKAGE FILE
import { readFileSync } from "node:fs";
const { Camera } = await import(process.argv[2]);

const USUAL = { near: "0.1", far: "1000", mapping: "d3d", format: "fp32", model: "exact" };
const NAMES = { log_c: "logC", triangle: "triangleClass" }, LACKS = ["hfov"];
const bits = new DataView(new ArrayBuffer(8));
const show = (x) => (bits.setFloat64(0, x), bits.getBigUint64(0).toString(16).padStart(16, "0"));

function value(key, text) {
    const parts = text.split(",").map((part) => (part === "inf" ? Infinity : Number.isNaN(Number(part)) ? part : Number(part)));
    return key === "preset" ? text : key === "ortho" ? text === "true" : parts.length > 1 ? parts : parts[0];
}

for (const [i, line] of readFileSync(process.argv[3], "utf8").trim().split("\n").entries()) {
    const { at = "5", ...keys } = Object.fromEntries(line.startsWith("#") ? [] : line.split("|")[1].trim().split(" ").map((pair) => [pair.split("=")[0], pair.slice(pair.indexOf("=") + 1)]));
    const whole = "preset" in keys ? { model: "exact", ...keys } : { ...USUAL, ...keys };
    let said = "-";
    if (line.startsWith("#")) continue;
    const units = ["near", "far"].some((key) => /\d[a-z]+$/.test(whole[key] ?? ""));
    if (!LACKS.some((key) => key in whole) && !units && ("preset" in keys || !("unit" in keys)))
        try {
            const { preset, ...given } = Object.fromEntries(Object.entries(whole).map(([key, text]) => [NAMES[key] ?? key, value(key, text)]));
            const camera = preset === undefined ? new Camera(given) : await Camera.preset(preset, given);
            said = show(camera[whole.model === "float" ? "separation" : "lattice"](Number(at)));
        } catch (error) {
            said = error.message;
        }
    console.log(`${i + 1}\t${said}`);
}
