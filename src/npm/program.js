// SPDX-License-Identifier: GPL-3.0-or-later
// The command depthprec, a module of its own; each call has an instance of its own, so that nothing is left of the one
// before.
import { split } from "./command.js";
import { load } from "./engine.js";
import { Ended, host } from "./files.js";
import data from "./program.data.js";

const FAILED = 1; // a check failed, which is an answer

async function unpack() {
    const packed = typeof Buffer === "function" ? Buffer.from(data, "base64") : Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

// As engine.js has it, with files: { status, out, err }, the bytes of stdout and the text of stderr. `input` are bytes, or a
// function that gives them; `fs` is node's, or none.
let engine, called;
export async function command(words, { input, fs, env } = {}) {
    engine ??= await load(await unpack(), (memory, streams) => host(memory, (called = { ...called, streams })));
    called = { input, fs, env, opened: [] };
    let status;
    try {
        ({ status } = engine.run(words));
    } catch (error) {
        if (!(error instanceof Ended)) throw error;
        ({ status } = error);
    }
    const { streams, opened } = called;
    if (status <= FAILED) for (const file of opened) file.keep();
    const out = new Uint8Array(streams.bytes[1].reduce((sum, piece) => sum + piece.length, 0));
    streams.bytes[1].reduce((at, piece) => (out.set(piece, at), at + piece.length), 0);
    return { status, out, err: streams.text(2) };
}

const kebab = (name) => name.replaceAll(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
const numeral = (x) => (Number.isFinite(x) ? String(x) : Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf");
const argument = (value) => (Array.isArray(value) ? value.map(argument).join(",") : typeof value === "number" ? numeral(value) : String(value));

// Options as words: { far: "10km", at: [1, 2], full: true }; undefined, null and false are not there.
const wordsOf = (options) => Object.entries(options).filter(([, value]) => value !== undefined && value !== null && value !== false)
    .map(([name, value]) => `--${kebab(name)}${value === true ? "" : `=${argument(value)}`}`);

export function begin({ Camera, DepthprecError, USUAL, only }) {
    // A camera as options of a command, or as keys of a requirement file.
    function given(camera, verb) {
        if (camera === undefined || camera === null) return {};
        if (!(camera instanceof Camera)) throw new TypeError("camera must be a Camera");
        const { near, far, format, mapping, viewport, slant } = camera, whole = verb === "check";
        const names = { texture: ["ortho", "logC", "rounding", "depthRange"], check: ["ortho", "logC", "rounding", "depthRange", "model", "arith"] }[verb] ??
            ["ortho", "logC", "rounding", "depthRange", "arith"];
        const value = (name) => (name === "depthRange" && !whole ? camera.depthRange.join(":") : camera[name]);
        const other = names.filter((name) => String(camera[name]) !== String(USUAL[name])).map((name) => [whole ? kebab(name).replace("-", "_") : name, value(name)]);
        if (viewport === undefined || whole || verb === "texture") return { near, far, format, mapping, ...Object.fromEntries(other) };
        const [depth, pixels, slim] = camera.triangleClass;
        return { near, far, format, mapping, ...Object.fromEntries(other), viewport: viewport.join("x"), fov: camera.fov, raster: camera.raster, subpixel: camera.subpixel,
            slant: slant.join(":"), triangleClass: `depth=${depth},pixels=${pixels},slim=${slim}` };
    }

    const asked = (verb, { camera, ...options }) => ({ ...given(camera, verb), ...options });

    // The JSON of a command; what it says of options names them as they are called here, without hyphens.
    async function answer(words, options, more) {
        try {
            return await run([...words, "--json", ...wordsOf(options)], more);
        } catch (error) {
            if (!(error instanceof DepthprecError)) throw error;
            const said = error.message.replace(/^-:\d+: /, "").replaceAll(/(?<![\w-])--([a-z][a-z\d-]*)/g, (_, name) => name.replaceAll(/-./g, (two) => two[1].toUpperCase()));
            throw new DepthprecError(said, error.status);
        }
    }

    async function run(args, options) {
        const { input, text = false, fs } = only(options, ["input", "text", "fs"], "options of run");
        const words = typeof args === "string" ? split(args) : Array.from(args);
        for (const word of words) {
            if (typeof word !== "string") throw new TypeError(`words must be text, got ${word === null ? "null" : typeof word}`);
            if (word.includes("\0")) throw new DepthprecError("a word must not contain a zero byte");
        }
        const { status, out, err } = await command(words, { fs, input: typeof input === "string" ? new TextEncoder().encode(input) : input });
        const said = err.trim();
        if (status > FAILED) throw new DepthprecError(said.replace("depthprec: ", ""), status);
        if (said !== "") console.warn(said);
        const json = words.includes("--json") || words.some((word, i) => word === "--report" && words[i + 1] === "json");
        try {
            const whole = new TextDecoder("utf-8", { fatal: true }).decode(out);
            return json && !text && whole !== "" ? JSON.parse(whole) : whole;
        } catch (error) {
            if (json && !text) throw error;
            return out;
        }
    }

    function setting(value) {
        if (value instanceof Camera) return setting(given(value, "check"));
        if (Array.isArray(value)) {
            const all = value.map(setting), real = value.some((x) => typeof x === "number" && !Number.isInteger(x));
            return `[${all.map((one) => (real && /^-?\d+$/.test(one) ? `${one}.0` : one)).join(", ")}]`;
        }
        if (typeof value === "object" && value !== null) return `{ ${group(value, " ")}}`;
        if (typeof value === "boolean") return String(value);
        if (typeof value === "number") return Number.isFinite(value) ? String(value) : `"${numeral(value)}"`;
        if (typeof value !== "string") throw new TypeError(`a requirement must hold words, numbers, arrays and objects, got ${value === null ? "null" : typeof value}`);
        const bytes = Array.from(new TextEncoder().encode(value), (b) =>
            (b >= 0x20 && b < 0x7f && b !== 0x22 && b !== 0x5c ? String.fromCharCode(b) : `\\x${b.toString(16).padStart(2, "0")}`));
        return `"${bytes.join("")}"`;
    }

    // An object in the grammar of requirement files.
    const group = (of, end) => Object.entries(of).map(([name, value]) => {
        if (!/^[A-Za-z*][-\w*]*$/.test(name)) throw new DepthprecError(`a name must be letters, digits, - and _, and begin with a letter, got ${JSON.stringify(name)}`);
        return `${name} = ${setting(value)};${end}`;
    }).join("");

    const TYPES = { Float16Array: "f2", Float32Array: "f4", Float64Array: "f8", Uint8Array: "u1", Uint8ClampedArray: "u1", Uint16Array: "u2", Uint32Array: "u4" };

    // The bytes of an .npy file; typed arrays have the order of the machine's bytes, which is little wherever this runs.
    function npy(image) {
        const { data, width, height, channels } = only(image, ["data", "width", "height", "channels"], "an image");
        const type = TYPES[ArrayBuffer.isView(data) ? data[Symbol.toStringTag] : ""];
        if (type === undefined) throw new TypeError(`data must be an array of float16, float32, float64, uint8, uint16 or uint32`);
        const each = channels ?? data.length / (width * height);
        if (![width, height, each].every((n) => Number.isInteger(n) && n > 0) || width * height * each !== data.length)
            throw new DepthprecError(`an image must have width x height x channels samples, got ${data.length} for ${width} x ${height}${channels === undefined ? "" : ` x ${channels}`}`);
        const little = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;
        const head = `{'descr': '${little ? "<" : ">"}${type}', 'fortran_order': False, 'shape': (${height}, ${width}${each > 1 ? `, ${each}` : ""}), }`;
        const padded = `${head.padEnd(Math.ceil((head.length + 11) / 64) * 64 - 11)}\n`, whole = new Uint8Array(10 + padded.length + data.byteLength);
        whole.set([0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0, padded.length & 255, padded.length >> 8]);
        whole.set(new TextEncoder().encode(padded), 10);
        whole.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), 10 + padded.length);
        return whole;
    }

    const object = (of, what) => {
        if (of instanceof Camera) throw new TypeError(`${what} must be an object, which may have the camera: { camera, ... }`);
        if (typeof of !== "object" || of === null || Array.isArray(of) || ArrayBuffer.isView(of)) throw new TypeError(`${what} must be an object`);
        return of;
    };

    return {
        run,
        answer,
        solve: (options) => answer(["solve", "--quiet"], asked("solve", object(options, "options"))),
        bias: (options) => answer(["bias", "--quiet"], asked("bias", object(options, "options"))),
        check: (requirements) => answer(["check", "-"], {}, { input: group(object(requirements, "requirements"), "\n") }),
        async recognise(image, options = {}) {
            const found = await answer(["texture", "-", "--quiet"], asked("texture", object(options, "options")), { input: npy(object(image, "an image")) });
            const { samples, packing, metric = null, stereo = null, lattice = null, lossy, type, width, height, channels } = found;
            const own = found.recognised ?? { format: null, certain: null, reversed: null, why: null };
            return { ...own, samples, packing, metric, stereo, lattice, lossy, type, width, height, channels };
        },
    };
}
