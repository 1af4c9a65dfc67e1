// SPDX-License-Identifier: GPL-3.0-or-later
// The module and the page: words go in, text comes out. engine.c is the other side. Each command runs in an instance of
// its own, so that nothing is left of the one before.

const AXES = ["gap", "distance", "near", "far"]; // see picture.c
export const NEED = "depthprec.need"; // the name of the requirement file of the page
const NO_FILE = 44, BAD_HANDLE = 8; // WASI's errno
const encoder = new TextEncoder();

class Streams {
    bytes = [[], [], []];
    left = 0; // bytes that were written beyond `most`
    constructor(most = Infinity) {
        this.most = most;
    }
    write(fd, piece) {
        if (piece.length > this.most) this.left += piece.length;
        else this.bytes[fd].push(piece.slice());
        this.most -= Math.min(piece.length, this.most);
    }
    text(fd) {
        const decoder = new TextDecoder();
        return this.bytes[fd].map((piece) => decoder.decode(piece, { stream: true })).join("") + decoder.decode();
    }
}

// What the module asks of a system: two streams to write to, and a clock.
function system(memory, streams) {
    const view = () => new DataView(memory().buffer);
    const none = (count, size) => (view().setUint32(count, 0, true), view().setUint32(size, 0, true), 0);
    return {
        environ_get: () => 0,
        environ_sizes_get: none,
        args_get: () => 0,
        args_sizes_get: none,
        clock_time_get(_id, _precision, out) {
            view().setBigUint64(out, BigInt(Date.now()) * 1000000n, true);
            return 0;
        },
        fd_close: () => 0,
        fd_fdstat_get(fd, out) {
            if (fd > 2) return BAD_HANDLE;
            new Uint8Array(memory().buffer, out, 24).fill(0);
            view().setUint8(out, 4); // a file: not a terminal
            view().setBigUint64(out + 8, 0xffffn, true);
            return 0;
        },
        fd_fdstat_set_flags: () => 0,
        fd_filestat_get: () => BAD_HANDLE,
        fd_tell: () => BAD_HANDLE,
        fd_prestat_get: () => BAD_HANDLE,
        fd_prestat_dir_name: () => BAD_HANDLE,
        fd_read(_fd, _pieces, _count, out) {
            view().setUint32(out, 0, true);
            return 0;
        },
        fd_seek: () => 70, // a pipe
        fd_write(fd, pieces, count, out) {
            if (fd !== 1 && fd !== 2) return BAD_HANDLE;
            let size = 0;
            for (let i = 0; i < count; i++) {
                const at = view().getUint32(pieces + 8 * i, true), length = view().getUint32(pieces + 8 * i + 4, true);
                streams.write(fd, new Uint8Array(memory().buffer, at, length));
                size += length;
            }
            view().setUint32(out, size, true);
            return 0;
        },
        path_open: () => NO_FILE,
        proc_exit(status) {
            throw new Error(`the command ended with status ${status}`);
        },
    };
}

// Starts the module's bytes, or the module that another thread has compiled; a host knows more of a system.
/** @param {(memory: () => any, streams: Streams) => object} host */
export async function load(from, host = () => ({})) {
    const module = from instanceof WebAssembly.Module ? from : await WebAssembly.compile(from);

    function begin(most = Infinity) {
        /** @type {{ exports: any }} */
        let instance;
        const memory = () => instance.exports.memory, streams = new Streams(most), decoder = new TextDecoder();
        instance = new WebAssembly.Instance(module, {
            wasi_snapshot_preview1: { ...system(memory, streams), ...host(memory, streams) },
            page: {
                measure: (text, length, size, bold) =>
                    engine.measure(decoder.decode(new Uint8Array(memory().buffer, text, length)), size, bold !== 0),
                gpu: (request) => engine.gpu(memory().buffer, request),
            },
        });
        instance.exports._initialize();
        return { exports: instance.exports, memory: instance.exports.memory, streams };
    }

    function put(room, bytes, memory) {
        if (room === 0) throw new Error("needs more memory than there is");
        new Uint8Array(memory.buffer, room, bytes.length).set(bytes);
    }

    function write(words, { exports, memory }) {
        const bytes = encoder.encode(words.map((word) => word.replaceAll("\0", "\ufffd") + "\0").join(""));
        put(exports.words(bytes.length), bytes, memory);
    }

    function call(name, words, most, cells = false, { exports, memory, streams } = begin(most)) {
        if (cells) exports.cells(1);
        write(words, { exports, memory });
        const status = exports[name](words.length);
        return { status, out: streams.text(1), err: streams.text(2), left: streams.left };
    }

    let own = null;
    function say(name, ...numbers) {
        const { exports, streams } = (own ??= begin());
        streams.bytes[1] = [];
        exports[name](...numbers);
        return streams.text(1);
    }

    const engine = {
        module,
        gpu: (/** @type {[ArrayBuffer, number]} */ ..._request) => 1, // there is none; the page has one

        // How far text reaches, px; the page has a better one.
        measure: (text, size, bold) => text.length * size * (bold ? 0.65 : 0.58),

        // The command's exit status and what it wrote, up to so many bytes; `left` are the others. Where asked for, the cells
        // of tables are parted, see sheet.js. What begins with "seen" is a frame of a picture by the GPU, with "ways" what else
        // would do, with "need" a requirement file: see picture.c; with "profile" what a GPU is: see profile.c; with "judged"
        // check of a file with that text.
        run: ([first, ...others], most, cells) => {
            if (["seen", "ways", "need", "profile"].includes(first)) return call(first, others, most);
            if (first !== "judged") return call("run", [first, ...others], most, cells);
            const own = begin(most), bytes = encoder.encode(others[0]);
            put(own.exports.file(bytes.length), bytes, own.memory);
            return call("run", ["check", NEED], most, false, own);
        },

        // The program reads the words: { status, err, verb, operands, options: [{ name, value }] }.
        parse(words) {
            const { status, out, err } = call("parse", words);
            const [verb, count, ...rest] = out.split("\0").slice(0, -1);
            const operands = rest.slice(0, Number(count)), options = [];
            for (let i = operands.length; i < rest.length; i += 2) options.push({ name: rest[i], value: rest[i + 1] });
            return { status, err, verb, operands, options };
        },

        // The options that a command takes: a Map from long name to { argument, help, names }: how its argument is written,
        // "" of none, and what it may name.
        takes(verb) {
            const words = call("takes", [verb]).out.split("\0").slice(0, -1), taken = new Map();
            for (let i = 0; i < words.length; i += 4)
                taken.set(words[i], { argument: words[i + 1], help: words[i + 2], names: words[i + 3].split(" ").slice(0, -1) });
            return taken;
        },

        // A file that was dropped, opened by the words of a texture line, in an instance that stays: what is said of it, of a
        // pixel, and the picture of its depths or of their errors. What refuses it is thrown.
        image(words, bytes) {
            const own = begin(Infinity), { exports, memory, streams } = own;
            put(exports.file(bytes.length), bytes, memory);
            const opened = call("image_open", words, Infinity, false, own);
            if (opened.status !== 0) throw new Error(opened.err.trim().replace(/^depthprec: /, ""));
            const said = () => {
                const out = streams.text(1);
                streams.bytes[1] = [];
                return { status: 0, out, err: "" };
            };
            streams.bytes[1] = [];
            return {
                says: () => ({ status: 0, out: opened.out, err: opened.err }),
                pixel(x, y) {
                    exports.image_pixel(x, y);
                    return said();
                },
                paint(width, height, error) {
                    const at = exports.image_paint(width, height, error);
                    return { ...said(), values: new Uint8ClampedArray(memory.buffer, at, 4 * width * height).slice() };
                },
            };
        },

        // The length at a step of a slider, from 0 to 1000, with a unit or without; its step; and a length that was typed as a
        // number of units.
        lengthAt: (axis, step, named) => say("length_at", AXES.indexOf(axis), step, named ? 1 : 0),
        stepOf: (axis, value) => (own ??= begin()).exports.length_step(AXES.indexOf(axis), value),
        length(...words) {
            own ??= begin();
            write(words, own);
            return own.exports.length_value(words.length);
        },

        version: () => say("version"),

        // A number at a share of an axis, as text.
        numberAt: (lo, hi, log, share) => say("number_at", lo, hi, log ? 1 : 0, share),

        // A number in few digits, rounded up (1), down (-1) or to the nearest (0).
        number: (value, way) => say("number", value, way),

        // An instance that stays: { exports, memory, streams }; and words for it.
        instance: () => begin(),
        write,
    };
    return engine;
}
