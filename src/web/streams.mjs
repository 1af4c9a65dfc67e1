// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a module apart, by what they are: a stream of operations, one of locals, one of offsets and so on, which LZMA
// makes a fifteenth smaller than the module itself. Lengths of functions are left out: their ends say them.
const REST = 0, OPERATION = 1, LOCAL = 2, ALIGN = 3, OFFSET = 4, WHOLE = 5, WIDE = 6, REAL = 7, CALL = 8, STREAMS = 9;
const HEADER = 8, CODE = 10; // bytes before the first section; the section of functions
const BLOCK = 2, IF = 4, END = 0x0b, TABLE = 0x0e, LOAD = 0x28, STORE32 = 0x3e, SHORT_REAL = 0x43, LONG_REAL = 0x44, BULK = 0xfc;
const NATURAL = [..."23230011001122232301012"].map(Number); // alignments from LOAD to STORE32, of which few have another
const BULK_NUMBERS = { 8: 2, 9: 1, 10: 2, 11: 1 };

// How many numbers are behind each other operation, and their stream.
const COUNT = new Uint8Array(256), STREAM = new Uint8Array(256);
for (const [stream, count, ...all] of [[OPERATION, 1, 2, 3, 4, 12, 13, 35, 36, 63, 64], [OPERATION, 2, 17], [CALL, 1, 16], [LOCAL, 1, 32, 33, 34],
    [WHOLE, 1, 65], [WIDE, 1, 66]])
    for (const is of all) [COUNT[is], STREAM[is]] = [count, stream];

// Goes through a module once: copy(stream, mask) takes its next byte from here to there and returns it, body(inside) does
// so with a function, whose length is here or there.
function walk(done, copy, body) {
    const several = (stream, count) => {
        for (; count > 0; count--) copy(stream);
    };
    const number = (stream) => {
        for (let value = 0, scale = 1; ; scale *= 128) {
            const byte = copy(stream);
            value += (byte & 127) * scale;
            if (byte < 128) return value;
        }
    };
    const numbers = (stream, count) => {
        for (; count > 0; count--) number(stream);
    };
    const operands = (is) => {
        if (is >= LOAD && is <= STORE32) {
            copy(ALIGN, NATURAL[is - LOAD]);
            number(OFFSET);
        } else if (is === SHORT_REAL || is === LONG_REAL) several(REAL, is === LONG_REAL ? 8 : 4);
        else if (is === TABLE) numbers(OPERATION, number(OPERATION) + 1);
        else if (is === BULK) numbers(OPERATION, BULK_NUMBERS[number(OPERATION)]);
        else numbers(STREAM[is], COUNT[is]);
    };
    const inside = () => {
        for (let count = number(REST); count > 0; count--) {
            number(REST);
            copy(REST);
        }
        for (let depth = 1; depth > 0; ) {
            const is = copy(OPERATION);
            depth += is === END ? -1 : is >= BLOCK && is <= IF ? 1 : 0;
            operands(is);
        }
    };
    several(REST, HEADER);
    while (!done()) {
        const section = copy(REST), size = number(REST);
        if (section !== CODE) several(REST, size);
        else for (let count = number(REST); count > 0; count--) body(inside);
    }
}

// The size of the module and of each stream, 4 bytes each, then the streams.
export function apart(module) {
    const streams = Array.from({ length: STREAMS }, () => []);
    let at = 0;
    walk(() => at === module.length, (stream, mask = 0) => {
        streams[stream].push(module[at] ^ mask);
        return module[at++];
    }, (inside) => {
        while (module[at++] > 127);
        inside();
    });
    return Uint8Array.from([...new Uint8Array(Uint32Array.of(module.length, ...streams.map(({ length }) => length)).buffer), ...streams.flat()]);
}

export function together(bytes) {
    const sizes = new Uint32Array(bytes.buffer, 0, 1 + STREAMS), module = new Uint8Array(sizes[0]), from = [sizes.byteLength];
    let at = 0;
    for (let i = 1; i < STREAMS; i++) from[i] = from[i - 1] + sizes[i];
    walk(() => at === module.length, (stream, mask = 0) => (module[at++] = bytes[from[stream]++] ^ mask), (inside) => {
        const start = at;
        inside();
        const length = [];
        let rest = at - start;
        for (; rest > 127; rest >>= 7) length.push((rest & 127) | 128);
        module.copyWithin(start + length.length + 1, start, at);
        module.set([...length, rest], start);
        at += length.length + 1;
    });
    return module;
}
