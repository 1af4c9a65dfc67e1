// SPDX-License-Identifier: GPL-3.0-or-later
// The module's streams are packed by LZMA, a tenth smaller than what browsers unpack by themselves: the format's decoder, of
// places that count for nothing (lp=0, pb=0). Its header says how many bytes there are; a marker ends them.
import { together } from "./streams.mjs";

export const BEFORE = 2; // lc: bits of the byte before that tell what a byte is likely to be
const MATCH = 0, REP = 12, REP_0 = 24, REP_1 = 36, REP_2 = 48, REP_0_LONG = 60, SLOT = 72, PLACE = 328, ALIGN = 443, LENGTH = 459,
    REP_LENGTH = 733, LITERAL = 1007, HEADER = 13; // where the chances of each kind of bit begin

// Bits from the range coder, each by its own chance, of 2048.
function bitsOf(bytes, count) {
    const chances = new Uint16Array(count).fill(1024);
    let range = 0xffffffff, code = 0, at = HEADER;
    const next = () => (code = ((code << 8) | bytes[at++]) >>> 0);
    for (let i = 0; i < 5; i++) next();
    const fill = () => {
        if (range >= 0x1000000) return;
        range = (range << 8) >>> 0;
        next();
    };
    const bit = (i) => {
        const chance = chances[i], bound = (range >>> 11) * chance, is = code >= bound ? 1 : 0;
        range = is ? range - bound : bound;
        code -= is * bound;
        chances[i] = is ? chance - (chance >>> 5) : chance + ((2048 - chance) >>> 5);
        fill();
        return is;
    };
    const even = () => {
        range >>>= 1;
        const is = code >= range ? 1 : 0;
        code -= is * range;
        fill();
        return is;
    };
    return { bit, even };
}

function inflate(bytes) {
    const out = new Uint8Array(new DataView(bytes.buffer).getUint32(5, true)), { bit, even } = bitsOf(bytes, LITERAL + (0x300 << BEFORE));
    const tree = (base, bits) => {
        let at = 1;
        for (let i = 0; i < bits; i++) at = (at << 1) | bit(base + at);
        return at - (1 << bits);
    };
    const lowFirst = (base, bits) => {
        let at = 1, all = 0;
        for (let i = 0; i < bits; i++) {
            const one = bit(base + at);
            at = (at << 1) | one;
            all |= one << i;
        }
        return all;
    };
    const length = (base) => 2 + (!bit(base) ? tree(base + 2, 3) : !bit(base + 1) ? 8 + tree(base + 10, 3) : 16 + tree(base + 18, 8));
    const distance = (size) => {
        const slot = tree(SLOT + 64 * Math.min(size - 2, 3), 6), bits = (slot >> 1) - 1, from = (2 | (slot & 1)) << bits;
        if (slot < 4) return slot;
        if (slot < 14) return from + lowFirst(PLACE + from - slot, bits);
        let direct = 0;
        for (let i = 4; i < bits; i++) direct = 2 * direct + even();
        return (2 | (slot & 1)) * 2 ** bits + 16 * direct + lowFirst(ALIGN, 4);
    };
    const literal = (before, matched) => {
        const base = LITERAL + 0x300 * (before >> (8 - BEFORE));
        let symbol = 1, match = matched;
        while (match >= 0 && symbol < 0x100) {
            const expected = (match >> 7) & 1, one = bit(base + ((1 + expected) << 8) + symbol);
            match = one === expected ? (match << 1) & 0xff : -1;
            symbol = (symbol << 1) | one;
        }
        while (symbol < 0x100) symbol = (symbol << 1) | bit(base + symbol);
        return symbol;
    };
    let state = 0, last = [0, 0, 0, 0], at = 0;
    for (;;) {
        const short = state < 7;
        let size;
        if (!bit(MATCH + state)) {
            out[at] = literal(at > 0 ? out[at - 1] : 0, short ? -1 : out[at - last[0] - 1]);
            at++;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        if (!bit(REP + state)) {
            size = length(LENGTH);
            last = [distance(size), last[0], last[1], last[2]];
            state = short ? 7 : 10;
            if (last[0] === 0xffffffff) return out;
        } else {
            const which = !bit(REP_0 + state) ? 0 : !bit(REP_1 + state) ? 1 : 2 + bit(REP_2 + state);
            const one = which === 0 && !bit(REP_0_LONG + state);
            last = [last[which], ...last.filter((_, i) => i !== which)];
            size = one ? 1 : length(REP_LENGTH);
            state = one ? (short ? 9 : 11) : short ? 8 : 11;
        }
        for (; size > 0; size--, at++) out[at] = out[at - last[0] - 1];
    }
}

export const unpack = (bytes) => together(inflate(bytes));
