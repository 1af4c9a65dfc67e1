// SPDX-License-Identifier: GPL-3.0-or-later
// Search over all pages: a script fetches what they say when the field is first entered, which works from disk, too.
"use strict";

const script = document.currentScript;
const up = script.dataset.up;
const field = document.querySelector("input[type=search]");
const list = document.getElementById("search-results");
let all = null;

// sections.js calls it: of each heading and term its name, its page, its place and its words.
globalThis.sections = (given) => {
    all = given.map(([name, title, place, text]) => ({ name, title, place, text, low: [name, text].map((s) => s.toLowerCase()) }));
    show();
};

function load() {
    if (document.getElementById("sections")) return;
    const more = document.createElement("script");
    more.id = "sections";
    more.src = `${up}sections.js`;
    document.head.append(more);
}

// A name that is what was typed comes first, then one that begins so, then one that holds it, then words of the text.
function rank({ low: [name, text] }, words) {
    const whole = words.join(" ");
    if (name === whole || name === `--${whole}` || name.startsWith(`--${whole} `)) return 0;
    if (name.startsWith(whole)) return 1;
    if (words.every((w) => name.includes(w))) return 2;
    return words.every((w) => name.includes(w) || text.includes(w)) ? 3 : -1;
}

function excerpt(text, word) {
    const at = Math.max(0, text.toLowerCase().indexOf(word) - 40);
    return (at > 0 ? "... " : "") + text.slice(at, at + 160) + (text.length > at + 160 ? " ..." : "");
}

function show() {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    list.hidden = words.length === 0;
    if (list.hidden || all === null) return;
    const hits = all.map((s) => [rank(s, words), s]).filter(([r]) => r >= 0).sort(([a], [b]) => a - b);
    const count = document.createElement("p");
    count.textContent = hits.length === 0 ? `Nothing here is called ${field.value}.`
        : `${hits.length} places${hits.length > 30 ? ", the first 30" : ""}`;
    list.replaceChildren(count, ...hits.slice(0, 30).map(([, s]) => {
        const item = document.createElement("p"), link = document.createElement("a");
        link.href = up + s.place;
        link.textContent = s.name;
        item.append(link, ` in ${s.title}: `, excerpt(s.text, words[0]));
        return item;
    }));
}

field.addEventListener("focus", load);
field.addEventListener("input", show);
// A place on this page lies under the list of what was found.
list.addEventListener("click", (event) => { if (event.target.closest("a")) { field.value = ""; show(); } });
// A browser fills the field again when one comes back.
if (field.value !== "") load();
