// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the page: two set-ups as lists of options, the questions that are asked, gap and distance; and all of it as
// commands and as the link.
import { commands, fromFragment, join, split, toFragment } from "./command.js";
import { fill } from "./form.js";
import { theme } from "./outputs.js";
import { count, outputs, update, want } from "./schedule.js";

/** An element. @type {(selector: string, root?: ParentNode) => any} */
export const $ = (selector, root = document) => root.querySelector(selector);
/** All such elements. @type {(selector: string, root?: ParentNode) => any[]} */
export const $$ = (selector, root = document) => [...root.querySelectorAll(selector)];

export function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
}

// ---- What there is ------------------------------------------------------------------------------------------------

export const VERBS = ["table", "plot", "solve", "bias", "code", "budget", "zfight", "prepass"];
export const FIGURES = {
    interval: "what is resolved", error: "error", distribution: "codes per metre", budget: "causes", share: "codes beyond", map: "which near and far", staircase: "why reversed floats",
};
const LETTERS = { near: "-n", far: "-f", format: "-F", mapping: "-m" };
// Options of the panels, and of a picture, are not those of a set-up.
const ASKED = {
    solve: ["for", "separation", "error", "at", "range"],
    bias: ["separation", "at", "range", "api", "units", "factor", "clamp", "slope"],
    code: ["what", "language", "uniforms"],
    zfight: ["separation", "sample", "seed", "rasterize"],
    prepass: ["against", "program", "vertices", "sample", "seed"],
    table: [], plot: [], budget: [],
};
export const REFUSED = 2; // the exit status of a command
const NEVER = ["link", "output", "json", "csv", "type", "theme", "figure-size", "axes", "threads", "quiet", "color"];
export const SHARED = ["interval", "error", "distribution", "share"]; // what holds the curves of both set-ups
// A figure does not refuse what it has no use for: it leaves it out.
export const VIEW = ["viewport", "fov", "hfov", "raster", "subpixel", "slant", "triangle-class"];
const UNUSED = {
    interval: ["at"], error: ["at", "tolerance", ...VIEW], distribution: ["at", "tolerance", ...VIEW],
    budget: ["at", "model"],
    share: ["at", "tolerance", ...VIEW], map: ["tolerance", ...VIEW],
    staircase: ["format", "mapping", "model", "arith", "at", "tolerance", ...VIEW], // it draws four of few codes
};
export const VIEWPORT = "1920x1080"; // at any slant is said of a view alone
const STANDARD = `table -n 0.1 -f 1000 -F unorm24 -m d3d --unit m --viewport ${VIEWPORT} ; page table=shut`;
export const SECOND = `table -n 0.1 -f 1000 -F fp32 -m reversed --viewport ${VIEWPORT} --unit m`;

// What the modules share, once it is there: the program, its worker, the panels; and what is under way.
export const page = {
    engine: null, aside: null, picture: null, gpuPanel: null, imagePanel: null, checkPanel: null, widths: null,
    linked: true, opened: false, printing: false, // what is shown came by the address; the link that the page was opened at is shown
    shared: "", // the profile of somebody’s GPU, by the address
    pressed: false, steady: null, before: null, held: "", crossing: "100", facts: [], // see outputs.js, what lies over a figure
    resting: null, // while something is dragged, a timer
};
export const takes = {}; // options of each command
// A page shows this at first: a link says only what differs from it.
export const start = (world) => ({
    setups: [], figure: "interval", shown: new Set(), // panels that are open
    asked: {
        solve: new Map([["for", "near"], ["separation", world.gap], ["at", world.distance]]),
        bias: new Map([["separation", world.gap], ["at", world.distance], ["api", "all"]]),
        code: new Map([["what", "linearize"]]),
        zfight: new Map(),
        prepass: new Map([["sample", "100000"]]),
    },
});
const WORLD = { gap: "2cm", distance: "200m" }; // what is asked of all set-ups, whatever else is changed
export const world = { ...WORLD };
export const state = start(world);
export const fields = []; // of each set-up: its controls by option

export const errorOf = ({ err }) => err.trim().replace(/^depthprec: /, "");

// ---- Commands -----------------------------------------------------------------------------------------------------

export const words = (options) =>
    [...options].flatMap(([name, value]) => [LETTERS[name] ?? `--${name}`, ...(value === "" ? [] : [value])]);

export const mapOf = (read) => new Map(read.options.map(({ name, value }) => [name, value]));

// Options of a set-up that a command does not want although it takes them, and of a question that another one replaces.
const AFFINE = ["d3d", "gl", "reversed", "gl-reversed"]; // on the screen, so that there is a guarantee at a slant
const PLACED = ["position", "projection"], PLANES = ["near", "far", "ortho", "unit", "log-c"], CODES = ["format", "rounding"];
// Code refuses what it has no use for. Codes of depth that no shader writes are those of a format.
function unwantedOf(what, setup) {
    const coded = what === "encode" && (setup.has("ortho") || AFFINE.includes(setup.get("mapping") ?? AFFINE[0]));
    return [...(coded ? PLANES : CODES), ...(PLACED.includes(what) ? [] : VIEW), ...(PLACED.includes(what) || what === "linearize" ? [] : ["depth-range"])];
}
function unwanted(verb, asked, setup) {
    const view = AFFINE.includes(setup.get("mapping") ?? AFFINE[0]) || verb === "table" ? [] : VIEW;
    if (verb === "plot") return [...UNUSED[state.figure], ...view];
    if (verb === "solve") return ["at", "range", asked.get("for"), ...view];
    if (verb === "code") return unwantedOf(asked.get("what") ?? "linearize", setup);
    return verb === "bias" ? ["at", "range", ...view] : view;
}

// A figure may have the curves of a second set-up beside it.
export function commandOf(verb, setup, b = state.setups[1]) {
    const asked = new Map(state.asked[verb] ?? []), without = unwanted(verb, asked, setup);
    if (asked.get("for") === "distance") asked.delete("at");
    const given = new Map([...[...setup].filter(([name]) => !without.includes(name)), ...asked]);
    const inOrder = [...takes[verb].keys()].filter((name) => given.has(name));
    const options = inOrder.map((name) => [name, given.get(name)]);
    if (verb === "plot" && b && setup !== b && SHARED.includes(state.figure))
        options.push(["beside", commandOf("plot", b, b).slice(2).map((word) => word.replaceAll(" ", "")).join(" ")]);
    const operand = verb === "plot" ? state.figure : asked.get("method"); // of code, where a line named it
    return [verb, ...(operand === undefined ? [] : [operand]), ...words(options)];
}

// All that the page shows, as commands: those of B are its tables alone, for the rest follows.
export function shown() {
    const [a, b] = state.setups;
    const all = [commandOf("table", a)];
    if (b !== undefined) all.push(commandOf("table", b));
    for (const verb of VERBS.slice(1)) if (state.shown.has(verb)) all.push(commandOf(verb, a));
    return all;
}

// ---- The address --------------------------------------------------------------------------------------------------

// What is seen beside the commands: gap and distance of the picture, as they were typed, the colours, and whether the
// table is shut, which says the set-ups all the same.
const LENGTH = /^\d[\d.e+-]*[a-z]{0,2}$/;
const SEEN = { gap: LENGTH, distance: LENGTH, theme: /^(system|light|dark)$/, table: /^(open|shut)$/, gpu: /./ };
const SEEN_FIRST = { ...WORLD, theme: "system", table: "open", gpu: "" };

function seen() {
    const now = { ...world, theme: document.documentElement.dataset.theme ?? "system", table: state.shown.has("table") ? "open" : "shut", gpu: page.shared };
    return Object.entries(now).filter(([name, value]) => value !== SEEN_FIRST[name]).map((pair) => pair.join("="));
}

// Takes the last words from those of a link, where they are these.
function takeSeen(all) {
    const said = { ...SEEN_FIRST };
    if (all.at(-1)?.[0] === "page")
        for (const word of all.pop().slice(1)) {
            const [name, value] = word.split("=");
            if (!Object.hasOwn(SEEN, name) || !SEEN[name].test(value))
                throw new Error(`page ${word}: it takes gap=2cm, distance=200m and the like, theme=light or theme=dark`);
            said[name] = value;
        }
    return said;
}

function see({ gap, distance, theme, table, gpu }) {
    Object.assign(world, { gap, distance });
    page.shared = gpu;
    if (table === "shut") state.shown.delete("table");
    setTheme(theme);
}

export function link() {
    const fragment = toFragment([...shown(), ...(seen().length === 0 ? [] : [["page", ...seen()]])]);
    return fragment === encodeURIComponent(STANDARD) ? "" : fragment;
}
// Not at each step of a drag: browsers count, and a set-up or a command that is refused is no link.
export function showAddress() {
    const fragment = link();
    const fine = $("#error").hidden && fields.every(({ refused }) => refused.textContent === "") &&
        shown().every((line) => page.engine.parse(line).status === 0);
    if (fine && location.hash.slice(1) !== fragment)
        history[page.linked ? "replaceState" : "pushState"](null, "", `#${fragment}`);
}

// ---- Setting the page ---------------------------------------------------------------------------------------------

// The words of commands are put together before anything is taken: one that is refused leaves the page as it was.
async function understand(all, from) {
    const next = { setups: [], asked: { ...from.asked }, figure: from.figure, shown: new Set() };
    if (all.length === 0) throw new Error("there is no command in it: table -n 0.1 -f 1000 is one");
    if (all.length > VERBS.length + 1) throw new Error(`the page shows at most ${VERBS.length + 1} commands`);
    for (const line of all) {
        if (!VERBS.includes(line[0]) && page.engine.parse([line[0], "--help"]).status === 0)
            throw new Error(`${line[0]} is not in the page, which has ${VERBS.join(", ")}: the program has it`);
        const read = page.engine.parse(line);
        if (read.status !== 0) throw new Error(errorOf(read));
        const { verb, operands } = read, panel = ASKED[verb];
        let beside;
        const given = mapOf(read);
        for (const name of ["help", "version"])
            if (given.has(name)) throw new Error(`--${name} is for the command line`);
        for (const name of NEVER) given.delete(name);
        if (verb === "plot") {
            if (!Object.hasOwn(FIGURES, operands[0]))
                throw new Error(`the page draws ${Object.keys(FIGURES).join(", ")}, not ${operands[0]}: the program does`);
            next.figure = operands[0];
            beside = given.get("beside");
            given.delete("beside");
        }
        if (verb === "table" || (verb !== "plot" && all.length === 1)) {
            trying = [verb, ...words(given)];
            const said = await page.aside.ask(trying, MOST);
            if (said.status === REFUSED) throw new Error(errorOf(said));
        }
        next.shown.add(verb);
        if (panel.length > 0) {
            const wanted = given.get("for"); // what is solved for may be given, too: to choose from
            next.asked[verb] = new Map([...given].filter(([name]) => panel.includes(name) || name === wanted));
            if (verb === "code" && operands.length > 0) next.asked.code.set("method", operands[0]);
            for (const name of panel) given.delete(name);
        }
        if (verb === "table" && next.setups.length < 2) next.setups.push(given);
        else if (next.setups.length === 0) next.setups.push(given);
        else for (const [name, value] of given) if (!takes.table.has(name)) next.setups[0].set(name, value);
        if (beside !== undefined && next.setups.length < 2) {
            const other = page.engine.parse(["table", ...split(beside)]);
            if (other.status !== 0) throw new Error(errorOf(other));
            next.setups.push(mapOf(other));
        }
    }
    if (all.length === 1) for (const verb of from.shown) next.shown.add(verb);
    return next;
}

export function refuse(error) {
    const at = $("#error");
    at.textContent = error === null ? "" : String(error.message ?? error);
    at.hidden = error === null;
}

// The last of several counts; a control that is touched counts, too.
let asking = 0, trying = []; // and the line that the program is asked about
export function supersede() {
    asking++;
    page.aside.leave(trying);
}
export async function set(all, byLink = false) {
    supersede();
    const mine = asking;
    let next, said;
    page.linked = byLink;
    try {
        const lines = all();
        said = byLink ? takeSeen(lines) : null;
        if (said?.gpu) {
            trying = ["profile", said.gpu];
            const known = await page.aside.ask(trying);
            if (known.status !== 0) throw new Error(errorOf(known));
        }
        // A profile alone leaves all else as it is.
        next = said?.gpu && lines.length === 0 ? null : await understand(lines, byLink ? start(said) : state);
    } catch (error) {
        if (mine !== asking) return true; // it is not the last one
        refuse(error);
        count();
        want();
        return false;
    }
    if (mine !== asking) return true;
    page.before = byLink ? null : page.steady;
    Object.assign(state, next);
    refuse(null);
    if (next === null) page.shared = said.gpu;
    else if (byLink) see(said);
    fill();
    update();
    return true;
}

export const setLink = (fragment) => set(() => (fragment === "" ? commands(STANDARD) : fromFragment(fragment)), true);

// A length for a set-up whose scene unit may be another than A's, which figures have.
export const unitOf = (setup) => setup.get("unit") ?? "";
export function lengthFor(setup, text) {
    const unit = unitOf(state.setups[0]);
    return unit === unitOf(setup) || !/[\d.]$/.test(text) ? text : text + unit;
}

// Other ways that do, each a button that does it, with what the engine's users write.
export const waysLine = () => ["ways", ...pictureLines()[0]];

export const MOST = 2 ** 18; // bytes of an answer that the page shows

export const SCHEMES = ["system", "light", "dark"];

export function setTheme(scheme) {
    const { dataset } = document.documentElement;
    if (scheme === "system") delete dataset.theme;
    else dataset.theme = scheme;
    $("#theme").textContent = `Colours: ${scheme}`;
}

// Beside A its second set-up, or what reversed fp32 makes of the same planes.
export function pictured() {
    const [a, b] = state.setups, best = new Map([...a, ["format", "fp32"], ["mapping", "reversed"]]);
    const lines = [a, b ?? best].map((setup, i) => commandOf("table", setup));
    return lines[0].join() === lines[1].join() ? lines.slice(0, 1) : lines;
}
// A's unit is that of gap and distance that have none.
const lengthsFor = (setup) => Object.values(world).map((text) => lengthFor(setup ?? state.setups[0], text));
export const pictureLines = () => pictured().map((line, i) => [...lengthsFor(state.setups[i]), ...line]);
