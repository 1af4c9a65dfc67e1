// SPDX-License-Identifier: GPL-3.0-or-later
// Words, command lines and the fragment of the address. What a command means only the module knows.

export const LONGEST = 4096; // characters of a fragment
const bare = /^[A-Za-z0-9_=+,.:\/%@-]+$/;

// The words of a line, in which quotes and backslashes are those of a shell. Throws a sentence.
export function split(line) {
    const words = [];
    let word = null, quote = "";
    if (/\p{Cs}/u.test(line)) throw new Error("a command has no halves of characters in it");
    if (/[\0-\x1f\x7f]/.test(line)) throw new Error("a command has no control characters in it");
    for (let i = 0; i < line.length; i++) {
        const c = line[i];
        if (quote !== "" ? c === quote : c === '"' || c === "'") {
            quote = quote === "" ? c : "";
            word ??= "";
        } else if (c === "\\" && quote !== "'") {
            if (++i === line.length) throw new Error("a command does not end in a backslash");
            word = (word ?? "") + (quote === '"' && !'"\\$`'.includes(line[i]) ? "\\" : "") + line[i];
        } else if (c === " " && quote === "") {
            if (word !== null) words.push(word);
            word = null;
        } else {
            word = (word ?? "") + c;
        }
    }
    if (quote !== "") throw new Error(`a quote is open: ${quote}`);
    if (word !== null) words.push(word);
    return words;
}

// The line that a shell takes for these words.
export const join = (words) =>
    words.map((word) => (bare.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`)).join(" ");

// A message as the page says it: options have the names of their controls, where there are such. Lines that are a command
// stay, and what only a command line has is left out.
export const plain = (text) => text.replace(/ *--full\s+prints [^.]*\./, "").replaceAll(/^.*$/gm, (line) => (/(^|\s)depthprec [a-z]/.test(line) ? line
    : line.replaceAll(/(?<![\w-])--([a-z][a-z-]*)/g, (_, name) => /** @type {any} */ (document.querySelector(`#a [data-option="${name}"]`))?.labels[0].textContent.trim() ?? name)));

// The commands of a line: its words between those that are ";", each without "depthprec" in front.
export function commands(line) {
    if (line.length > LONGEST) throw new Error(`a line of commands has at most ${LONGEST} characters, this one ${line.length}`);
    const all = [[]];
    for (const word of split(line))
        if (word === ";") all.push([]);
        else all.at(-1).push(word);
    return all.map((words) => (words[0] === "depthprec" ? words.slice(1) : words)).filter((words) => words.length > 0);
}

// The same of what stands behind the # of an address.
export function fromFragment(fragment) {
    if (fragment.length > LONGEST)
        throw new Error(`an address has at most ${LONGEST} characters behind the #, this one ${fragment.length}`);
    let line;
    try {
        line = decodeURIComponent(fragment);
    } catch {
        throw new Error("the address is damaged: a % in it is not followed by two digits of a character");
    }
    return commands(line);
}

// The words behind the # as a person reads it, even where it is no command.
export function written(fragment) {
    try {
        return decodeURIComponent(fragment);
    } catch {
        return fragment;
    }
}

export const toFragment = (all) => encodeURIComponent(all.map(join).join(" ; "));
