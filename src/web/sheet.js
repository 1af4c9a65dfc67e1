// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a command as tables and what stands around them, to the byte: the module parts the cells of a table by
// U+001F and marks sentences by U+001E, see report/output.h.

const CELL = "\x1f", SENTENCE = "\x1e", MOST_ROWS = 200; // of longer tables the rest stays text
const NUMERIC = /^\s*([-+<~.\d]|inf|none|blind)/;
// A reader wants to know this first, where there is no room for all.
const KEYS = ["slanted", "guaranteed", "interval", "error"];

const unmarked = (text) => text.replaceAll(CELL, "").replaceAll(SENTENCE, "");

// What a report says in sentences, as one line.
export const sentences = (text) => text.split(SENTENCE).filter((_, i) => i % 2 === 1).map((one) => one.replaceAll(/\n +/g, " ")).join(" ");

function rowOf(line, order, numbers, head) {
    const cells = line.split(CELL).slice(1), all = document.createElement("tr");
    for (const i of order) {
        const cell = document.createElement(head || i === 0 ? "th" : "td");
        if (head || i === 0) cell.scope = head ? "col" : "row";
        cell.className = numbers[i] ? "number" : "";
        cell.textContent = cells[i] ?? "";
        all.append(cell);
    }
    return all;
}

function tableOf(rows, narrow) {
    const [head, ...lines] = rows;
    const titles = head.split(CELL).slice(1), all = document.createElement("table");
    const numbers = titles.map((_, i) => lines.every((line) => NUMERIC.test(line.split(CELL)[i + 1])));
    const rest = titles.map((_, i) => i), place = (i) => (KEYS.indexOf(titles[i].trim()) + 1 || 9) - (i === 0 ? 9 : 0);
    const order = narrow ? rest.sort((a, b) => place(a) - place(b)) : rest;
    all.createTHead().append(rowOf(head, order, numbers, true));
    all.createTBody().append(...lines.map((line) => rowOf(line, order, numbers, false)));
    return all;
}

export function sheet(text, narrow) {
    const parts = [];
    let kind = null, from = [];
    const end = () => {
        if (kind === true) parts.push(tableOf(from.splice(0, MOST_ROWS), narrow));
        if (from.length === 0) return;
        const pre = document.createElement("pre");
        pre.textContent = unmarked(from.join(""));
        parts.push(pre);
    };
    for (const line of text.split(/(?<=\n)/)) {
        const cells = line.startsWith(CELL);
        if (cells !== kind) end();
        from = cells === kind ? from : [];
        from.push(line);
        kind = cells;
    }
    end();
    return parts;
}
