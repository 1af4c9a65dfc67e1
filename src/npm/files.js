// SPDX-License-Identifier: GPL-3.0-or-later
// What the command's module asks of a system besides what engine.js has: an environment, an end, standard input, and the
// files of node's fs where one is given. A file that is written is kept in memory until the command has ended well, and
// then takes its place whole.
const FINE = 0, REFUSED = 2, BAD_HANDLE = 8, EXISTS = 20, IO = 29, IS_FOLDER = 31, NO_FILE = 44, NOT_FOLDER = 54, PIPE = 70; // WASI's errno
const ERRNO = { ENOENT: NO_FILE, EACCES: REFUSED, EPERM: 63, EISDIR: IS_FOLDER, ENOTDIR: NOT_FOLDER, EEXIST: EXISTS, ELOOP: 32, ENAMETOOLONG: 37, EROFS: 69 };
const ROOT = 3, FOLDER = 3, REGULAR = 4, DEVICE = 2; // the handle of "/", and WASI's kinds of files
const ALL = 0x1fffffffn; // every right

export class Ended extends Error {
    constructor(status) {
        super(`the command ended with status ${status}`);
        this.status = status;
    }
}

const errno = (error) => {
    if (error.code === undefined) throw error;
    return ERRNO[error.code] ?? IO;
};

// Beside the target first, then in its place; a device is written straight to.
function keep(fs, path, bytes) {
    if (fs.existsSync(path) && !fs.statSync(path).isFile()) return fs.writeFileSync(path, bytes);
    const target = fs.existsSync(path) ? fs.realpathSync(path) : path, beside = `${target.replace(/[^/\\]*$/, "")}.depthprec-${Date.now()}.tmp`;
    try {
        fs.writeFileSync(beside, bytes);
        if (target !== path || fs.existsSync(target)) fs.chmodSync(beside, fs.statSync(target).mode & 0o777);
        fs.renameSync(beside, target);
    } catch (error) {
        fs.rmSync(beside, { force: true });
        throw error;
    }
}

export function host(memory, { input, fs, env = {}, opened, streams }) {
    const view = () => new DataView(memory().buffer), handles = new Map(), encoder = new TextEncoder();
    const path = (at, length) => `/${new TextDecoder().decode(new Uint8Array(memory().buffer, at, length))}`;
    const variables = Object.entries({ ...env, ...(fs ? { PWD: globalThis.process.cwd() } : {}) }).map(([name, value]) => encoder.encode(`${name}=${value}\0`));
    let standard;
    const file = (fd) => {
        if (fd === 0 && standard === undefined) standard = { bytes: (typeof input === "function" ? input() : input) ?? new Uint8Array(), at: 0 };
        return fd === 0 ? standard : handles.get(fd);
    };
    const number64 = (at, value) => view().setBigUint64(at, BigInt(value), true);

    function status(of, at) {
        new Uint8Array(memory().buffer, at, 64).fill(0);
        view().setUint8(at + 16, of.isFile() ? REGULAR : of.isDirectory() ? FOLDER : DEVICE);
        number64(at, BigInt.asUintN(64, BigInt(of.dev)));
        number64(at + 8, BigInt.asUintN(64, BigInt(of.ino)));
        number64(at + 32, of.size);
        return FINE;
    }

    function open(name, create) {
        if (!fs) throw new Error(`the file '${name}' needs a file system: run(words, { fs }) with that of node`);
        const there = fs.existsSync(name) ? fs.statSync(name, { bigint: true }) : null;
        if (there?.isDirectory() && create) return IS_FOLDER;
        const fd = ROOT + 1 + opened.length;
        if (create) {
            fs.accessSync(there ? name : name.replace(/[^/]*$/, ""), fs.constants.W_OK);
            const made = { there, pieces: [], name, keep: () => made.name !== null && keep(fs, name, Buffer.concat(made.pieces)) };
            opened.push(made);
            return handles.set(fd, made), -fd;
        }
        opened.push({ keep() {} });
        return handles.set(fd, { there: fs.statSync(name, { bigint: true }), bytes: there.isDirectory() ? new Uint8Array() : fs.readFileSync(name), at: 0 }), -fd;
    }

    const trying = (work) => (...args) => {
        try {
            return work(...args);
        } catch (error) {
            return errno(error);
        }
    };

    return {
        environ_sizes_get(count, size) {
            view().setUint32(count, variables.length, true);
            view().setUint32(size, variables.reduce((sum, one) => sum + one.length, 0), true);
            return FINE;
        },
        environ_get(pointers, at) {
            variables.forEach((one, i) => {
                view().setUint32(pointers + 4 * i, at, true);
                new Uint8Array(memory().buffer).set(one, at);
                at += one.length;
            });
            return FINE;
        },
        fd_prestat_get(fd, out) {
            if (fd !== ROOT) return BAD_HANDLE;
            view().setUint32(out, 0, true);
            view().setUint32(out + 4, 1, true);
            return FINE;
        },
        fd_prestat_dir_name(_fd, at) {
            view().setUint8(at, 0x2f);
            return FINE;
        },
        fd_fdstat_get(fd, out) {
            if (fd > ROOT && !handles.has(fd)) return BAD_HANDLE;
            new Uint8Array(memory().buffer, out, 24).fill(0);
            view().setUint8(out, fd === ROOT ? FOLDER : REGULAR);
            number64(out + 8, ALL);
            number64(out + 16, ALL);
            return FINE;
        },
        path_open: trying((_fd, _follow, at, length, flags, _rights, _inherited, _fdflags, out) => {
            const got = open(path(at, length), (flags & 1) !== 0);
            if (got > 0) return got;
            view().setUint32(out, -got, true);
            return FINE;
        }),
        path_filestat_get: trying((_fd, _follow, at, length, out) => {
            if (!fs) return NO_FILE;
            return status(fs.statSync(path(at, length), { bigint: true }), out);
        }),
        path_unlink_file(_fd, at, length) {
            for (const one of opened) if (one.name === path(at, length)) one.name = null;
            return FINE;
        },
        fd_filestat_get(fd, out) {
            const of = file(fd);
            if (fd > 2 && of === undefined) return BAD_HANDLE;
            return status(of?.there ?? { isFile: () => fd > ROOT, isDirectory: () => false, dev: 0, ino: fd, size: 0 }, out);
        },
        fd_read(fd, pieces, count, out) {
            const of = file(fd);
            if (of?.bytes === undefined) return BAD_HANDLE;
            if (of.there?.isDirectory()) return IS_FOLDER;
            let size = 0;
            for (let i = 0; i < count; i++) {
                const at = view().getUint32(pieces + 8 * i, true), length = view().getUint32(pieces + 8 * i + 4, true);
                const piece = of.bytes.subarray(of.at, of.at + length);
                new Uint8Array(memory().buffer).set(piece, at);
                of.at += piece.length;
                size += piece.length;
            }
            view().setUint32(out, size, true);
            return FINE;
        },
        fd_write(fd, pieces, count, out) {
            const to = fd === 1 || fd === 2 ? (piece) => streams.write(fd, piece) : handles.get(fd)?.pieces && ((piece) => handles.get(fd).pieces.push(piece.slice()));
            if (to === undefined) return BAD_HANDLE;
            let size = 0;
            for (let i = 0; i < count; i++) {
                const at = view().getUint32(pieces + 8 * i, true), length = view().getUint32(pieces + 8 * i + 4, true);
                to(new Uint8Array(memory().buffer, at, length));
                size += length;
            }
            view().setUint32(out, size, true);
            return FINE;
        },
        fd_seek(fd, offset, whence, out) {
            const of = handles.get(fd);
            if (of?.bytes === undefined) return PIPE;
            of.at = Number(offset) + (whence === 0 ? 0 : whence === 1 ? of.at : of.bytes.length);
            number64(out, of.at);
            return FINE;
        },
        fd_tell(fd, out) {
            const of = handles.get(fd);
            if (of?.bytes === undefined) return PIPE;
            number64(out, of.at);
            return FINE;
        },
        fd_close: () => FINE,
        proc_exit(status) {
            throw new Ended(status);
        },
    };
}
