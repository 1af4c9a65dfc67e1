// SPDX-License-Identifier: GPL-3.0-or-later
// The module is packed by LZMA, a tenth smaller than what browsers unpack by themselves: the format's decoder. Its header
// says how many bytes there are; a marker ends them.
const MATCH = 0, REP = 192, REP_0 = 204, REP_1 = 216, REP_2 = 228, REP_0_LONG = 240, SLOT = 432, PLACE = 688, ALIGN = 803, LENGTH = 819,
    REP_LENGTH = 1333, LITERAL = 1847, HEADER = 13; // where the chances of each kind of bit begin

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

export function unpack(bytes) {
    const [head] = bytes, lc = head % 9, lp = Math.floor(head / 9) % 5, pb = Math.floor(head / 45), out = new Uint8Array(new DataView(bytes.buffer, bytes.byteOffset).getUint32(5, true));
    const { bit, even } = bitsOf(bytes, LITERAL + (0x300 << (lc + lp)));
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
    const length = (base, place) => 2 + (!bit(base) ? tree(base + 2 + 8 * place, 3) : !bit(base + 1) ? 8 + tree(base + 130 + 8 * place, 3) : 16 + tree(base + 258, 8));
    const distance = (size) => {
        const slot = tree(SLOT + 64 * Math.min(size - 2, 3), 6), bits = (slot >> 1) - 1, from = (2 | (slot & 1)) << bits;
        if (slot < 4) return slot;
        if (slot < 14) return from + lowFirst(PLACE + from - slot, bits);
        let direct = 0;
        for (let i = 4; i < bits; i++) direct = 2 * direct + even();
        return (2 | (slot & 1)) * 2 ** bits + 16 * direct + lowFirst(ALIGN, 4);
    };
    const literal = (at, before, matched) => {
        const base = LITERAL + 0x300 * (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
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
        const place = at & ((1 << pb) - 1), short = state < 7;
        let size;
        if (!bit(MATCH + 16 * state + place)) {
            out[at] = literal(at, at > 0 ? out[at - 1] : 0, short ? -1 : out[at - last[0] - 1]);
            at++;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        if (!bit(REP + state)) {
            size = length(LENGTH, place);
            last = [distance(size), last[0], last[1], last[2]];
            state = short ? 7 : 10;
            if (last[0] === 0xffffffff) return out;
        } else {
            const which = !bit(REP_0 + state) ? 0 : !bit(REP_1 + state) ? 1 : 2 + bit(REP_2 + state);
            const one = which === 0 && !bit(REP_0_LONG + 16 * state + place);
            last = [last[which], ...last.filter((_, i) => i !== which)];
            size = one ? 1 : length(REP_LENGTH, place);
            state = one ? (short ? 9 : 11) : short ? 8 : 11;
        }
        for (; size > 0; size--, at++) out[at] = out[at - last[0] - 1];
    }
}
