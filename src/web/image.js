// SPDX-License-Identifier: GPL-3.0-or-later
// A depth image that was dropped, in the page's worker: its bytes as the module reads them, and what it says of them.
const BYTES_MAX = 2 ** 28, PNG_HEAD = 33;

// A PNG's head and its rows, which the browser inflates; kinds.c has the rest.
async function inflated(bytes) {
    const view = new DataView(bytes.buffer), { readable, writable } = new DecompressionStream("deflate");
    const writer = writable.getWriter(), reader = readable.getReader(), all = [bytes.subarray(0, PNG_HEAD)];
    const write = (done) => done.catch(() => {}); // the reader tells
    for (let at = 8, size; at + 8 <= bytes.length; at += 12 + size) {
        size = view.getUint32(at);
        if (view.getUint32(at + 4) === 0x49444154) write(writer.write(bytes.subarray(at + 8, at + 8 + size))); // IDAT
    }
    write(writer.close());
    let size = PNG_HEAD;
    for (let next; !(next = await reader.read()).done; all.push(next.value)) {
        size += next.value.length;
        if (size > BYTES_MAX) throw new Error(`has more than ${BYTES_MAX} bytes of pixels, which is as many as the page reads`);
    }
    const out = new Uint8Array(size);
    for (const one of all.reverse()) out.set(one, (size -= one.length));
    return out;
}

async function bytesOf(file) {
    if (file.size > BYTES_MAX) throw new Error(`has ${file.size} bytes, the page reads at most ${BYTES_MAX}`);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (bytes[0] !== 0x89 || bytes[1] !== 0x50 || bytes.length <= PNG_HEAD) return bytes;
    return inflated(bytes).catch(() => {
        throw new Error("is a damaged PNG: its pixels do not inflate");
    });
}

// Answers what is asked of an image, "says", "pixel" or "paint", once it is opened by the words of a texture line: what was
// asked last stays open.
let bytes = null, opened = null;
export async function answer(engine, { id, file, words }, [what, ...numbers]) {
    try {
        if (bytes?.id !== id) bytes = { id, all: await bytesOf(file) };
        const key = [id, ...words].join("\0");
        if (opened?.key !== key) opened = { key, image: engine.image(words, bytes.all) };
        return opened.image[what](...numbers.map(Number));
    } catch (error) {
        opened = null;
        return { status: 2, out: "", err: error.message };
    }
}
