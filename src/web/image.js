// SPDX-License-Identifier: GPL-3.0-or-later
// A depth image that was dropped, in the page's worker: what the module recognises in it, and its window depths.
const BYTES_MAX = 2 ** 28, PIXELS_MAX = 2 ** 25;
// As .npy names them, in the module's order; of f2 the bits.
const TYPES = { u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, f2: Uint16Array, f4: Float32Array, f8: Float64Array };
const CHANNELS = { 0: 1, 2: 3, 4: 2, 6: 4 }; // of a PNG, by its colour type

function fit(width, height) {
    if (width * height > PIXELS_MAX) throw new Error(`has ${width} x ${height} pixels, the page reads at most ${PIXELS_MAX}`);
    return width * height;
}

async function inflated(parts, size) {
    const bytes = new Uint8Array(size), stream = new Blob(parts).stream().pipeThrough(new DecompressionStream("deflate"));
    let at = 0;
    for (const reader = stream.getReader(); ;) {
        const { value, done } = await reader.read();
        if (done && at === size) return bytes;
        if (done || at + value.length > size) throw new Error("it holds another number of bytes");
        bytes.set(value, at);
        at += value.length;
    }
}

// Each filter predicts a byte: from the byte before it, the one above, and the one before that.
const FILTERS = [
    () => 0, (left) => left, (_, up) => up, (left, up) => (left + up) >> 1,
    (left, up, corner) => {
        const [a, b, c] = [up - corner, left - corner, left + up - 2 * corner].map(Math.abs);
        return a <= b && a <= c ? left : b <= c ? up : corner;
    },
];

function unfiltered(bytes, row, step) {
    for (let at = 0; at < bytes.length; at += row) {
        const guess = FILTERS[bytes[at]];
        if (guess === undefined) throw new Error(`no filter is ${bytes[at]}`);
        for (let i = at + 1; i < at + row; i++) {
            const left = i - at > step, up = at > 0;
            bytes[i] += guess(left ? bytes[i - step] : 0, up ? bytes[i - row] : 0, left && up ? bytes[i - row - step] : 0);
        }
    }
    return bytes;
}

// One of colours is no depth; grey in three channels is.
function refuseColours(rows, row, height, step, each) {
    for (let y = 0; y < height; y++)
        for (let at = y * row + 1; at < (y + 1) * row; at += step)
            for (let i = 0; i < each; i++)
                if (rows[at + i] !== rows[at + each + i] || rows[at + i] !== rows[at + 2 * each + i])
                    throw new Error("has colours, and depth is one number a pixel: save it as grey, or name its packing to the program");
}

// Its first channel.
async function png(bytes) {
    const view = new DataView(bytes.buffer), parts = [], [width, height] = [view.getUint32(16), view.getUint32(20)];
    const [bits, colour, , , interlaced] = bytes.subarray(24, 29), channels = CHANNELS[colour];
    if (channels === undefined || bits < 8 || interlaced !== 0)
        throw new Error("is a PNG of a palette, of fewer than 8 bits or interlaced: save it as grey of 16 bits");
    for (let at = 8, size; at + 8 <= bytes.length; at += 12 + size) {
        size = view.getUint32(at);
        if (view.getUint32(at + 4) === 0x49444154) parts.push(bytes.subarray(at + 8, at + 8 + size)); // IDAT
    }
    const each = bits / 8, step = each * channels, row = 1 + step * width, samples = new TYPES[each === 1 ? "u1" : "u2"](fit(width, height));
    const rows = await inflated(parts, row * height).then((bytes) => unfiltered(bytes, row, step)).catch((error) => {
        throw new Error(`is a damaged PNG: ${error.message}`);
    });
    if (channels > 2) refuseColours(rows, row, height, step, each);
    for (let y = 0, to = 0; y < height; y++)
        for (let x = 0, at = y * row + 1; x < width; x++, at += step) samples[to++] = each === 1 ? rows[at] : (rows[at] << 8) | rows[at + 1];
    return { type: each - 1, samples, width, height, channels: 1 };
}

// Its header is a Python dictionary: {'descr': '<f4', 'fortran_order': False, 'shape': (480, 640), }
function npy(bytes) {
    const view = new DataView(bytes.buffer), from = bytes[6] === 1 ? 10 : 12, start = from + (from === 10 ? view.getUint16(8, true) : view.getUint32(8, true));
    const head = new TextDecoder().decode(bytes.subarray(from, start)), [, name] = /'descr': *'[<|]([uf][1248])'/.exec(head) ?? [];
    const [height, width, channels = 1] = /'shape': *\(([\d, ]*)\)/.exec(head)?.[1].split(",").filter((one) => one.trim() !== "").map(Number) ?? [];
    if (!(name in TYPES) || !width || channels > 4 || !/'fortran_order': *False/.test(head))
        throw new Error("is npy of another kind than the page reads, little-endian u1 u2 u4 f2 f4 f8 of rows and columns: the program reads more");
    const samples = new TYPES[name](fit(width, height) * channels), rest = bytes.subarray(start);
    if (rest.length !== samples.byteLength) throw new Error(`is damaged: ${samples.byteLength} bytes of samples are needed, ${rest.length} are there`);
    new Uint8Array(samples.buffer).set(rest);
    return { type: Object.keys(TYPES).indexOf(name), samples, width, height, channels };
}

function numberOfHalf(bits) {
    const exponent = (bits >> 10) & 31, fraction = bits & 1023, sign = bits >> 15 ? -1 : 1;
    return sign * (exponent === 31 ? (fraction ? NaN : Infinity) : exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25));
}

// The first channel as window depths, or as it is stored; holes are not finite.
function valuesOf({ type, samples, channels }, { top }) {
    const bits = top === 0 && new Float32Array(samples.buffer), half = Object.keys(TYPES)[type] === "f2";
    return Float64Array.from({ length: samples.length / channels }, (_, i) =>
        bits ? bits[i * channels] : half ? numberOfHalf(samples[i * channels]) : samples[i * channels] / top);
}

// The least and the greatest value that is no cleared background.
function spread(values, { depth }) {
    let [lo, hi] = [Infinity, 0];
    for (const v of values) if (v > 0 && !(depth && v >= 1)) [lo, hi] = [Math.min(lo, v), Math.max(hi, v)];
    return { lo, hi };
}

// What is recognised in a file: { status, err } of one that is refused, else { width, height, depth, format, reversed, exact, why,
// values, lo, hi }, the values by rows from the top.
export async function recogniseFile(engine, file) {
    try {
        if (file.size > BYTES_MAX) throw new Error(`has ${file.size} bytes, the page reads at most ${BYTES_MAX}`);
        const bytes = new Uint8Array(await file.arrayBuffer()), magic = String.fromCharCode(...bytes.subarray(0, 6));
        const read = magic.startsWith("\x89PNG") && bytes.length > 32 ? png : magic === "\x93NUMPY" && bytes.length > 12 ? npy : null;
        if (read === null) throw new Error("is neither PNG nor npy: the program reads other kinds, too");
        const image = await read(bytes), found = engine.recognise(image), values = valuesOf(image, found);
        return { status: 0, width: image.width, height: image.height, values, ...spread(values, found), ...found };
    } catch (error) {
        return { status: 2, err: error.message };
    }
}
