// SPDX-License-Identifier: MIT
// What a depth buffer resolves, exact and proven: index.d.ts has the names, units and errors. Camera is the library, a
// module that imports nothing; index.js adds the command. No arithmetic here.
import data from "./core.data.js";

const bytes = typeof Buffer === "function" ? Buffer.from(data, "base64") : Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
const { exports: core } = new WebAssembly.Instance(new WebAssembly.Module(bytes));
core._initialize();

// The memory never grows, so these views stay.
const { buffer } = core.memory;
const place = new Uint8Array(buffer, core.at(0), core.size());
const numbers = new Float64Array(buffer, core.at(1), 17);
const text = new Uint8Array(buffer, core.at(2), 512);
const SIZE = 65536, COUNT = SIZE / 8; // bytes and elements of a block
const KINDS = { Float32Array, Float64Array, Uint16Array, Uint32Array };
const blocks = Object.fromEntries(Object.entries(KINDS).map(([name, Kind]) =>
    [name, [0, 1, 2, 3].map((i) => new Kind(buffer, core.at(3) + i * SIZE, COUNT))]));
const REALS = { Float32Array: 0, Float64Array: 1 }, WORDS = { Uint16Array: 0, Uint32Array: 1 };
const TASKS = { code: 0, eye: 1, lo: 5, hi: 6, window: 7, separation: 8, lattice: 8, interval: 9 };
const DEPTH = 13, TRIANGLES = 19, MATRIX = 20, CONVENTION = 21; // statuses
const LAYOUTS = { undefined: 0, rows: 1, columns: 2 };
const WORST = ["lo", "hi", "error", "errorZ", "errorCode", "interval", "intervalLo", "intervalHi", "intervalCode", "blindFrom",
    "separation", "separationZ"];

const USUAL = Object.freeze({ near: 0.1, far: 1000, format: "fp32", mapping: "d3d", ortho: false, rounding: "nearest",
    model: "exact", arith: "ieee", logC: 1, depthRange: Object.freeze([0, 1]), viewport: undefined, fov: 60, raster: undefined, subpixel: undefined, slant: Object.freeze([0, 90]),
    triangleClass: Object.freeze([2, 512, 16]) });

// Rasterizers that do what an API asks for: bits of the grid, and whether there may be more.
const RASTERS = { "spec-d3d": [8, false], "spec-vulkan": [4, true], "spec-gl": [4, true] };

export class DepthprecError extends Error {
    constructor(sentence, status = 0) {
        super(sentence);
        this.name = "DepthprecError";
        this.status = status;
    }
}

// ---- Words and numbers of the module --------------------------------------------------------------------------------

const encoder = new TextEncoder(), decoder = new TextDecoder();

function string(at) {
    const all = new Uint8Array(buffer, at);
    return decoder.decode(all.subarray(0, all.indexOf(0)));
}

function write(words) {
    const whole = encoder.encode(words.map((word) => `${word}\0`).join(""));
    if (whole.length > text.length) throw new DepthprecError("a name must be shorter");
    text.set(whole);
}

const read = (count) => decoder.decode(text).split("\0", count);

function demand(status) {
    if (status !== 0) throw new DepthprecError(string(core.status(status)), status);
}

function real(value, what) {
    if (typeof value !== "number") throw new TypeError(`${what} must be a number, got ${value === null ? "null" : typeof value}`);
    return value;
}

// An object that has no key but these; what is not known would have no effect.
function only(given, names, what = "options") {
    if (given === undefined) return {};
    if (typeof given !== "object" || given === null) throw new TypeError(`${what} must be an object, got ${given === null ? "null" : typeof given}`);
    for (const name of Object.keys(given))
        if (!names.includes(name)) throw new TypeError(`${what} must have no '${name}', but ${names.join(", ")}${what === "an image" ? ": options come behind it" : ""}`);
    return given;
}

function word(value, what) {
    if (typeof value !== "string") throw new TypeError(`${what} must be a word, got ${value === null ? "null" : typeof value}`);
    if (value.includes("\0")) throw new DepthprecError(`${what} must not contain a zero byte`);
    return value;
}

function several(value, what, count) {
    if (!Array.isArray(value) && !ArrayBuffer.isView(value)) throw new TypeError(`${what} must be an array of ${count} numbers, got ${value === null ? "null" : typeof value}`);
    if (value.length !== count) throw new DepthprecError(`${what} must be ${count} numbers, got ${value.length}`);
    return Array.from(value, (x) => real(x, what));
}

function whole(value, what) {
    if (!Number.isInteger(real(value, what))) throw new TypeError(`${what} must be a whole number, got ${value}`);
    return Math.max(-1, Math.min(value, 0x7fffffff));
}

// As %.9g of C.
function nine(x) {
    if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf";
    const [digits, exponent] = x.toExponential(8).split("e");
    const short = (of) => (of.includes(".") ? of.replace(/\.?0+$/, "") : of);
    return exponent < -4 || exponent >= 9 ? `${short(digits)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`
        : short(x.toFixed(Math.max(0, 8 - exponent)));
}

// ---- Arrays ---------------------------------------------------------------------------------------------------------

const kindOf = (values) => (ArrayBuffer.isView(values) ? values[Symbol.toStringTag] : undefined);
const INTEGERS = new Set(["Uint8Array", "Uint8ClampedArray", "Int8Array", "Int16Array", "Int32Array", "Uint16Array", "Uint32Array"]);

// Numbers as an array of the module's; undefined of a single one.
function elements(values, what) {
    if (typeof values === "number") return undefined;
    const kind = kindOf(values);
    if (kind in REALS || INTEGERS.has(kind)) return values;
    if (kind === "Float16Array") return Float32Array.from(values);
    if (!Array.isArray(values)) throw new TypeError(`${what} must be a number or an array of numbers, got ${values === null ? "null" : kind ?? typeof values}`);
    return Float64Array.from(values, (x) => real(x, "an element"));
}

const reals = (values) => (kindOf(values) in REALS ? values : Float64Array.from(values));

// Codes as uint32, or uint16 where those are all.
function codes(values, narrow) {
    const kind = kindOf(values);
    if (kind === "Uint32Array" || (kind === "Uint16Array" && narrow)) return values;
    for (const code of values)
        if (!(Number.isInteger(code) && code >= 0 && code <= 0xffffffff)) throw new DepthprecError(`codes must be from 0 to 4294967295, got ${code}`);
    return Uint32Array.from(values);
}

// The array that is written, a new one or the caller's; `like` is read, and may be it where `inPlace`.
function output(like, kinds, out, inPlace) {
    if (out === undefined) return new KINDS[kinds[0]](like.length);
    if (!kinds.includes(kindOf(out))) throw new TypeError(`out must be a ${kinds.join(" or a ")}, got ${out === null ? "null" : kindOf(out) ?? typeof out}`);
    if (out.length !== like.length) throw new DepthprecError(`out must have as many elements as are read, ${like.length}, got ${out.length}`);
    const from = like.byteOffset, to = out.byteOffset;
    const same = inPlace && from === to && out.byteLength <= like.byteLength;
    if (out.buffer === like.buffer && !same && to < from + like.byteLength && from < to + out.byteLength)
        throw new DepthprecError(`out must not overlap what is read${inPlace ? " unless both are one array" : ""}`);
    return out;
}

// Block by block through the module: work(count) makes of the first block the others.
function pass(given, outs, work) {
    const from = blocks[kindOf(given)][0], to = outs.map((out, i) => blocks[kindOf(out)][i + 1]);
    for (let at = 0; at < given.length; at += COUNT) {
        const count = Math.min(COUNT, given.length - at);
        from.set(count === given.length ? given : given.subarray(at, at + count));
        work(count);
        outs.forEach((out, i) => out.set(count === COUNT ? to[i] : to[i].subarray(0, count), at));
    }
}

// ---- Cameras --------------------------------------------------------------------------------------------------------

// The bits of the grid of vertices.
function grid({ raster, subpixel }) {
    if (raster === undefined) return whole(subpixel ?? 8, "subpixel");
    if (!(word(raster, "raster") in RASTERS)) throw new DepthprecError(`raster must be ${Object.keys(RASTERS).join(", ")} or undefined, got ${raster}`);
    const [bits, more] = RASTERS[raster];
    if (subpixel !== undefined && !(more && whole(subpixel, "subpixel") >= bits))
        throw new DepthprecError(`subpixel ${more ? "must be at least 4" : "does not apply"} with ${raster}, got ${subpixel}`);
    return subpixel ?? bits;
}

// Near, far and whether it is orthographic the matrix says.
const MATRIX_KEYS = ["layout", ...Object.keys(USUAL).filter((key) => !["near", "far", "ortho"].includes(key))];

let ready = {}; // what the module is prepared for
const PLANES = ["nearLeast", "nearMost", "farLeast", "farMost", "nearDigits", "farDigits"]; // as door.c has them

export class Camera {
    #setups = {};
    #narrow;

    constructor(options = {}, planes = undefined) { // the second by fromMatrix alone
        if (typeof options !== "object" || options === null) throw new TypeError(`a camera must be an object, got ${options === null ? "null" : typeof options}`);
        const given = { ...USUAL };
        for (const [name, value] of Object.entries(options)) {
            if (!(name in USUAL)) throw new TypeError(`a camera has no '${name}', but ${Object.keys(USUAL).join(", ")}`);
            if (value !== undefined) given[name] = value;
        }
        const format = word(given.format, "format");
        const scalars = [real(given.near, "near"), real(given.far, "far"), given.ortho ? 1 : 0, real(given.logC, "logC"), ...several(given.depthRange, "depthRange", 2), 0];
        given.depthRange = Object.freeze(scalars.slice(4, 6));
        if (given.viewport !== undefined) {
            const [width, height] = several(given.viewport, "viewport", 2).map((x) => whole(x, "viewport"));
            given.viewport = Object.freeze([width, height]);
            given.slant = Object.freeze(several(given.slant, "slant", 2));
            given.triangleClass = Object.freeze(several(given.triangleClass, "triangleClass", 3));
            scalars.splice(6, 1, 1, width, height, real(given.fov, "fov"), grid(given), ...given.slant, ...given.triangleClass, given.raster === undefined ? 0 : 1);
        }
        for (const name of given.viewport === undefined ? ["fov", "raster", "subpixel", "slant", "triangleClass"] : [])
            if (String(given[name]) !== String(USUAL[name])) throw new DepthprecError(`${name} needs a viewport: surfaces face the camera`);
        write([format]);
        if (core.formats() === 2) throw new DepthprecError(`${format} is ${read(2).join(" or ")}, as the implementation chooses: name one`);
        write([format, ...["mapping", "arith", "rounding", "model"].map((name) => word(given[name], name))]);
        numbers.set(scalars);
        const status = core.camera();
        if (status === TRIANGLES && !given.ortho) throw new DepthprecError(read(1)[0], status);
        demand(status);
        this.#setups.own = place.slice();
        this.#narrow = numbers[1] <= 16;
        const [named, mapping, arith] = read(3);
        Object.assign(this, given, { format: named, mapping, arith, ortho: Boolean(given.ortho), codeMax: numbers[0] });
        PLANES.forEach((name, i) => (this[name] = planes?.[i] ?? [given.near, given.near, given.far, given.far, 17, 17][i]));
        Object.freeze(this);
    }

    static fromMatrix(matrix, options) {
        const { mapping, layout, ...more } = only(options, MATRIX_KEYS, "options of fromMatrix");
        if (Array.isArray(matrix?.elements) || ArrayBuffer.isView(matrix?.elements)) matrix = matrix.elements; // three.js
        const flat = Array.isArray(matrix) && matrix.every((row) => Array.isArray(row) || ArrayBuffer.isView(row)) ? matrix.map((row) => Array.from(row)).flat() : matrix;
        const given = elements(flat, "a matrix");
        if (given?.length !== 16) throw new DepthprecError(`a matrix must have 16 numbers, got ${given === undefined ? 1 : given.length}`);
        if (!(layout in LAYOUTS)) throw new DepthprecError(`layout must be "rows", "columns" or undefined, got ${JSON.stringify(layout)}`);
        const find = (name, way) => (numbers.set(given), write([name]), core.matrix(LAYOUTS[way]));
        const asked = mapping === undefined ? "" : word(mapping, "mapping");
        const status = find(asked, layout);
        if (status === MATRIX) throw new DepthprecError(`${read(1)[0]}, got ${Array.from(numbers.subarray(0, 4), nine).join(" ")}`, status);
        if (status === CONVENTION) {
            const readings = [];
            for (const name of asked === "" ? MAPPINGS : [asked])
                for (const way of layout === undefined ? ["rows", "columns"] : [layout])
                    if (find(name, way) === 0) readings.push(`${read(1)[0]} by ${way} near ${nine(numbers[0])}, far ${nine(numbers[1])}`);
            throw new DepthprecError(`${string(core.status(status))}: ${readings.join("; ")}`, status);
        }
        demand(status);
        const [near, far, ortho] = numbers, planes = numbers.slice(3, 9);
        return new Camera({ near, far, ortho: ortho !== 0, mapping: read(1)[0], ...more }, planes);
    }

    // Node.js shows the planes in the digits that they have.
    [Symbol.for("nodejs.util.inspect.custom")](depth, options, inspect) {
        const shown = (name) => Number(this[name].toPrecision(this[`${name}Digits`]));
        return `Camera ${inspect({ ...this, near: shown("near"), far: shown("far") }, options)}`;
    }

    // This camera but for what is named.
    replace(changes = {}) {
        const kept = Object.keys(USUAL).map((name) => [name, this[name]]);
        const planes = PLANES.map((name) => (changes[name.slice(0, name.startsWith("near") ? 4 : 3)] === undefined ? this[name] : undefined));
        return new Camera({ ...Object.fromEntries(kept), ...changes }, planes);
    }

    static async preset(name, { unit, ...more } = {}) {
        const asked = Object.fromEntries(["near", "far", "format", "mapping", "ortho", "logC"].map((key) => [key, more[key]]));
        if (more.viewport !== undefined)
            Object.assign(asked, { fov: more.fov, raster: more.raster, subpixel: more.subpixel, viewport: several(more.viewport, "viewport", 2).join("x") });
        if (program === undefined) throw new DepthprecError('Camera.preset runs the command: import from "depthprec", not from "depthprec/core"');
        const { setups, triangles } = await (await program()).answer(["table", "--quiet"], { preset: word(name, "a preset"), unit, ...asked });
        if (setups.length > 1) throw new DepthprecError(`the format of ${name} is ${setups.map((row) => row.format).join(" or ")}, as the implementation chooses: name one`);
        const [{ near, far, mapping, format, log_c: logC }] = setups, view = triangles === undefined ? {} : { fov: triangles.fov };
        if (triangles?.raster && more.raster === undefined && more.subpixel === undefined) view.raster = triangles.raster;
        return new Camera({ ...more, near, far: far ?? Infinity, mapping, format, ...(logC === undefined ? {} : { logC }), ...view });
    }

    encode(z, options) {
        const { out } = only(options, ["out"]);
        const given = elements(z, "eye depths");
        if (given === undefined) return this.#single("code", number(z, "an eye depth"), "Float64Array", "Uint32Array");
        const from = reals(given), to = output(from, this.#narrow ? ["Uint16Array", "Uint32Array"] : ["Uint32Array"], out, true);
        pass(from, [to], this.#prepared("code", REALS[kindOf(from)], WORDS[kindOf(to)]));
        return to;
    }

    decode(values, options) {
        const { bounds = false, window = false, out } = only(options, ["bounds", "window", "out"]);
        const given = elements(values, "codes or window depths");
        if (given === undefined) return this.#decoded(values, bounds, window);
        const floating = window || (kindOf(given) in REALS && !Array.isArray(values));
        const from = floating ? reals(given) : codes(given, this.#narrow);
        if (bounds && out !== undefined && Object.values(out).length !== 3) throw new DepthprecError("out must have z, lo and hi with bounds");
        const outs = bounds ? ["z", "lo", "hi"].map((name) => out?.[name]) : [out];
        const kinds = floating ? [kindOf(from)] : ["Float64Array", "Float32Array"];
        const made = outs.map((each) => output(from, kinds, each, !floating && !bounds));
        if (floating) {
            place.set(this.#setups.own);
            pass(from, made, (count) => demand(core.windows(REALS[kindOf(from)], bounds ? 1 : 0, count)));
        } else {
            ["eye", "lo", "hi"].slice(0, made.length).forEach((name, i) =>
                pass(from, [made[i]], this.#prepared(name, REALS[kindOf(made[i])], WORDS[kindOf(from)])));
        }
        return bounds ? { z: made[0], lo: made[1], hi: made[2] } : made[0];
    }

    windowDepth(z, options) {
        return this.#map("window", z, options);
    }

    separation(z, options) {
        return this.#map("separation", z, options);
    }

    lattice(z, options) {
        return this.#map("lattice", z, options);
    }

    interval(z, options) {
        return this.#map("interval", z, options);
    }

    worst(lo = this.near, hi = this.far) {
        place.set(this.#setups.own);
        numbers.set([real(lo, "lo"), real(hi, "hi")]);
        demand(core.worst());
        return Object.fromEntries(WORST.map((name, i) => [name, numbers[i]]));
    }

    // ---- What the methods share -------------------------------------------------------------------------------------

    #setupOf(name) {
        if (this.#setups[name] === undefined) {
            place.set(this.#setups.own);
            if (name === "separation") core.guaranteed();
            else demand(core.lattice());
            this.#setups[name] = place.slice();
        }
        return this.#setups[name];
    }

    // The module, prepared for a method of this camera.
    #prepared(name, real, word) {
        if (ready.camera !== this || ready.name !== name || ready.real !== real || ready.word !== word) {
            ready = {};
            place.set(this.#setupOf(name === "separation" || name === "lattice" ? name : "own"));
            demand(core.prepare(TASKS[name], real, word));
            ready = { camera: this, name, real, word };
        }
        return core.run;
    }

    #single(name, value, from, to) {
        const work = this.#prepared(name, REALS[from in REALS ? from : to], 1);
        blocks[from][0][0] = value;
        work(1);
        return blocks[to][1][0];
    }

    #map(name, z, options) {
        const { out } = only(options, ["out"]);
        const given = elements(z, "eye depths");
        if (given === undefined) {
            number(z, "an eye depth");
            if (!(this.near <= z && z <= this.far)) demand(DEPTH);
            return this.#single(name, z, "Float64Array", "Float64Array");
        }
        const from = reals(given), to = output(from, [kindOf(from)], out, true);
        pass(from, [to], this.#prepared(name, REALS[kindOf(from)], 1));
        return to;
    }

    #decoded(value, bounds, window) {
        const got = [];
        if (window) {
            if (!(value >= 0 && value <= 1)) throw new DepthprecError(`a window depth must be from 0 to 1, got ${value}`);
            place.set(this.#setups.own);
            blocks.Float64Array[0][0] = value;
            demand(core.windows(1, bounds ? 1 : 0, 1));
            got.push(...blocks.Float64Array.slice(1).map((block) => block[0]));
        } else {
            if (!(Number.isInteger(value) && value >= 0 && value <= this.codeMax))
                throw new DepthprecError(`a code must be a whole number from 0 to ${this.codeMax}, got ${value}: of a window depth say { window: true }`);
            for (const name of bounds ? ["eye", "lo", "hi"] : ["eye"]) got.push(this.#single(name, value, "Uint32Array", "Float64Array"));
        }
        return bounds ? { z: got[0], lo: got[1], hi: got[2] } : got[0];
    }
}

const MAPPINGS = [];
for (let at; (at = core.mapping(MAPPINGS.length)) !== 0;) MAPPINGS.push(string(at));

function number(value, what) {
    if (Number.isNaN(value)) throw new DepthprecError(`${what} must be a number, got NaN`);
    return value;
}

let program; // what loads the command, where index.js has said it
export const withCommand = (load) => (program = load);
export const door = { Camera, DepthprecError, USUAL, only };

export const version = string(core.version());
