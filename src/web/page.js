// SPDX-License-Identifier: GPL-3.0-or-later
// The page: two set-ups as lists of options, and panels that show what the commands say of them. It computes no number
// that is shown: each comes out of the module, see engine.js.
import { createAside, inWorker, serve } from "./aside.js";
import { load } from "./engine.js";
import { commands, fromFragment, join, LONGEST, split, toFragment, written } from "./command.js";
import { createOver, numberAt, numberOfStep, readFigure, stepAt } from "./figure.js";
import { gpu } from "./gpu.js";
import { createGpuPanel, profileText } from "./gpu_panel.js";
import { createImagePanel } from "./image_panel.js";
import { createPicture } from "./picture.js";
import { sheet, withoutCells } from "./sheet.js";

const $ = (selector, root = document) => root.querySelector(selector);

function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
}

// ---- What there is ------------------------------------------------------------------------------------------------

const VERBS = ["table", "plot", "solve", "bias", "budget", "zfight", "prepass"];
const FIGURES = ["interval", "error", "distribution", "budget", "share", "map"];
const LETTERS = { near: "-n", far: "-f", format: "-F", mapping: "-m" };
// Options of the panels, and of a picture, are not those of a set-up.
const ASKED = {
    solve: ["for", "separation", "error", "at", "range"],
    bias: ["separation", "at", "range", "api", "units", "factor", "clamp", "slope"],
    zfight: ["separation", "sample", "seed", "rasterize"],
    prepass: ["against", "program", "vertices", "sample", "seed"],
    table: [], plot: [], budget: [],
};
const REFUSED = 2; // the exit status of a command
const NEVER = ["link", "output", "json", "csv", "type", "theme", "figure-size", "axes", "threads", "quiet", "color"];
const SHARED = ["interval", "error", "distribution", "share"]; // what holds the curves of both set-ups
// A figure does not refuse what it has no use for: it leaves it out.
const VIEW = ["viewport", "fov", "hfov", "raster", "subpixel", "slant", "triangle-class"];
const UNUSED = {
    interval: ["at"], error: ["at", "tolerance", ...VIEW], distribution: ["at", "tolerance", ...VIEW],
    budget: ["at", "model"],
    share: ["at", "tolerance", ...VIEW], map: ["tolerance", ...VIEW],
};
const VIEWPORT = "1920x1080"; // at any slant is said of a view alone
const STANDARD = `table -n 0.1 -f 1000 -F unorm24 -m d3d --viewport ${VIEWPORT} --unit m`;
const SECOND = `table -n 0.1 -f 1000 -F fp32 -m reversed --viewport ${VIEWPORT} --unit m`;

let engine, aside, picture, gpuPanel, imagePanel;
const takes = {}; // options of each command
// A page shows this at first: a link says only what differs from it.
const start = (world) => ({
    setups: [], figure: "interval", shown: new Set(["table", "plot", "solve", "bias"]),
    asked: {
        solve: new Map([["for", "near"], ["separation", world.gap], ["at", world.distance]]),
        bias: new Map([["separation", world.gap], ["at", world.distance], ["api", "all"]]),
        zfight: new Map(),
        prepass: new Map([["sample", "100000"]]),
    },
});
const WORLD = { gap: "2cm", distance: "200m" }; // what is asked of all set-ups, whatever else is changed
const world = { ...WORLD };
const state = start(world);
const fields = []; // of each set-up: its controls by option

const errorOf = ({ err }) => err.trim().replace(/^depthprec: /, "");

// ---- Commands -----------------------------------------------------------------------------------------------------

const words = (options) =>
    [...options].flatMap(([name, value]) => [LETTERS[name] ?? `--${name}`, ...(value === "" ? [] : [value])]);

const mapOf = (read) => new Map(read.options.map(({ name, value }) => [name, value]));

// Options of a set-up that a command does not want although it takes them, and of a question that another one replaces.
const AFFINE = ["d3d", "gl", "reversed", "gl-reversed"]; // on the screen, so that there is a guarantee at a slant
function unwanted(verb, asked, setup) {
    const view = AFFINE.includes(setup.get("mapping") ?? AFFINE[0]) || verb === "table" ? [] : VIEW;
    if (verb === "plot") return [...UNUSED[state.figure], ...view];
    if (verb === "solve") return ["at", "range", asked.get("for"), ...view];
    return verb === "bias" ? ["at", "range", ...view] : view;
}

// A figure may have the curves of a second set-up beside it.
function commandOf(verb, setup, b = state.setups[1]) {
    const asked = new Map(state.asked[verb] ?? []), without = unwanted(verb, asked, setup);
    if (asked.get("for") === "distance") asked.delete("at");
    const given = new Map([...[...setup].filter(([name]) => !without.includes(name)), ...asked]);
    const inOrder = [...takes[verb].keys()].filter((name) => given.has(name));
    const options = inOrder.map((name) => [name, given.get(name)]);
    if (verb === "plot" && b && setup !== b && SHARED.includes(state.figure))
        options.push(["beside", commandOf("plot", b, b).slice(2).map((word) => word.replaceAll(" ", "")).join(" ")]);
    return [verb, ...(verb === "plot" ? [state.figure] : []), ...words(options)];
}

// All that the page shows, as commands: those of B are its tables alone, for the rest follows.
function shown() {
    const [a, b] = state.setups;
    const all = [commandOf("table", a)];
    if (b !== undefined) all.push(commandOf("table", b));
    for (const verb of VERBS.slice(1)) if (state.shown.has(verb)) all.push(commandOf(verb, a));
    return all;
}

// ---- The address --------------------------------------------------------------------------------------------------

// What is seen beside the commands: gap and distance of the picture, as they were typed, and the colours.
const LENGTH = /^\d[\d.e+-]*[a-z]{0,2}$/;
const SEEN = { gap: LENGTH, distance: LENGTH, theme: /^(system|light|dark)$/ };
const SEEN_FIRST = { ...WORLD, theme: "system" };

function seen() {
    const now = { ...world, theme: document.documentElement.dataset.theme ?? "system" };
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

function see({ gap, distance, theme }) {
    Object.assign(world, { gap, distance });
    setTheme(theme);
}

function link() {
    const first = start(world), simple = [...state.setups[0].keys()].every((name) => takes.table.has(name));
    const asks = ({ asked }, verb) => join(words(asked[verb]));
    const usual = simple && state.shown.size === first.shown.size &&
        [...state.shown].every((verb) => first.shown.has(verb) && (verb in first.asked ? asks(state, verb) === asks(first, verb) : true));
    const told = shown().filter(([verb]) => verb === "table" ||
        (verb === "plot" ? !simple || state.figure !== first.figure : !usual));
    return toFragment(seen().length === 0 ? told : [...told, ["page", ...seen()]]);
}

let linked = true; // what is shown came by the address: it is no step back
// Not at each step of a drag: browsers count, and a set-up or a command that is refused is no link.
function showAddress() {
    const fragment = link();
    const fine = $("#error").hidden && fields.every(({ refused }) => refused.textContent === "") &&
        shown().every((line) => engine.parse(line).status === 0);
    if (fine && location.hash.slice(1) !== fragment)
        history[linked ? "replaceState" : "pushState"](null, "", `#${fragment}`);
}

// ---- Setting the page ---------------------------------------------------------------------------------------------

// The words of commands are put together before anything is taken: one that is refused leaves the page as it was.
async function understand(all, from) {
    const next = { setups: [], asked: { ...from.asked }, figure: from.figure, shown: new Set(["table", "plot"]) };
    if (all.length === 0) throw new Error("there is no command in it: table -n 0.1 -f 1000 is one");
    if (all.length > VERBS.length + 1) throw new Error(`the page shows at most ${VERBS.length + 1} commands`);
    for (const line of all) {
        const read = engine.parse(line);
        if (read.status !== 0) throw new Error(errorOf(read));
        const { verb, operands } = read, panel = ASKED[verb];
        let beside;
        if (panel === undefined)
            throw new Error(`${verb} is not in the page, which has ${VERBS.join(", ")}: the program has it`);
        const given = mapOf(read);
        for (const name of ["help", "version"])
            if (given.has(name)) throw new Error(`--${name} is for the command line`);
        for (const name of NEVER) given.delete(name);
        if (verb === "plot") {
            if (!FIGURES.includes(operands[0]))
                throw new Error(`the page draws ${FIGURES.join(", ")}, not ${operands[0]}: the program does`);
            next.figure = operands[0];
            beside = given.get("beside");
            given.delete("beside");
        }
        if (verb === "table" || (verb !== "plot" && all.length === 1)) {
            trying = [verb, ...words(given)];
            const said = await aside.ask(trying, MOST);
            if (said.status === REFUSED) throw new Error(errorOf(said));
        }
        next.shown.add(verb);
        if (panel.length > 0) {
            const wanted = given.get("for"); // what is solved for may be given, too: to choose from
            next.asked[verb] = new Map([...given].filter(([name]) => panel.includes(name) || name === wanted));
            for (const name of panel) given.delete(name);
        }
        if (verb === "table" && next.setups.length < 2) next.setups.push(given);
        else if (next.setups.length === 0) next.setups.push(given);
        else for (const [name, value] of given) if (!takes.table.has(name)) next.setups[0].set(name, value);
        if (beside !== undefined && next.setups.length < 2) {
            const other = engine.parse(["table", ...split(beside)]);
            if (other.status !== 0) throw new Error(errorOf(other));
            next.setups.push(mapOf(other));
        }
    }
    if (all.length === 1) for (const verb of from.shown) next.shown.add(verb);
    if (next.shown.size === 2) for (const verb of ["solve", "bias"]) next.shown.add(verb);
    return next;
}

function refuse(error) {
    const at = $("#error");
    at.textContent = error === null ? "" : String(error.message ?? error);
    at.hidden = error === null;
}

// The last of several counts; a control that is touched counts, too.
let asking = 0, trying = []; // and the line that the program is asked about
function supersede() {
    asking++;
    aside.leave(trying);
}
async function set(all, byLink = false) {
    supersede();
    const mine = asking;
    let next, said;
    linked = byLink;
    try {
        const lines = all();
        said = byLink ? takeSeen(lines) : null;
        next = await understand(lines, byLink ? start(said) : state);
    } catch (error) {
        if (mine !== asking) return true; // it is not the last one
        refuse(error);
        count();
        want();
        return false;
    }
    if (mine !== asking) return true;
    before = byLink ? null : steady;
    Object.assign(state, next);
    refuse(null);
    if (byLink) see(said);
    fill();
    update();
    return true;
}

const setLink = (fragment) => set(() => (fragment === "" ? commands(STANDARD) : fromFragment(fragment)), true);

// ---- Controls -----------------------------------------------------------------------------------------------------

const names = (what) => JSON.parse(engine.run(["list", what, "--json"]).out).items.map((item) => item.name);
const choices = (option) => takes.table.get(option).split("|");

// Sliders are logarithmic; the last step of far is infinity. A slider writes a plain number of three digits.
const SLIDERS = { near: [-3, 2], far: [0, 7] }, STEPS = 500;

function slide(option, step) {
    const [lo, hi] = SLIDERS[option];
    if (option === "far" && step === STEPS) return "inf";
    return String(Number((10 ** (lo + (step / STEPS) * (hi - lo))).toPrecision(3)));
}

// Where a slider stands for a text. This places the thumb alone: the command reads the text itself.
const METRES = { nm: 1e-9, um: 1e-6, mm: 1e-3, cm: 1e-2, in: 0.0254, ft: 0.3048, m: 1, km: 1e3 };
function numberOf(text, unit) {
    const [, number, of] = /^\s*([-+.\de]+)\s*([a-z]*)/i.exec(text) ?? [];
    return /^\s*inf/i.test(text) ? Infinity : Number(number) * (of in METRES ? METRES[of] / (METRES[unit] ?? 1) : 1);
}

function stepOf(option, text, unit) {
    const [lo, hi] = SLIDERS[option], value = numberOf(text, unit);
    if (value === Infinity) return STEPS;
    const top = STEPS - (option === "far");
    return value > 0 ? Math.max(0, Math.min(top, Math.round(((Math.log10(value) - lo) / (hi - lo)) * STEPS))) : 0;
}

function buildSetup(index) {
    const letter = "AB"[index], root = $(index === 0 ? "#a" : "#b"), own = {};
    const change = (option, value) => {
        const to = state.setups[index];
        if (value === null) to.delete(option);
        else to.set(option, value);
        later();
    };
    // A plane that is dragged pushes the other one before it.
    const push = (option) => {
        const setup = state.setups[index], other = option === "near" ? "far" : "near", beside = option === "near" ? 10 : -10;
        const [near, far] = ["near", "far"].map((name) => numberOf(own[name].value || STARTS[name], setup.get("unit")));
        if (!(near >= far)) return;
        own[other].value = slide(other, Math.max(stepOf(other, own[option].value) + beside, 0));
        setup.set(other, own[other].value);
    };
    const plain = { spellcheck: "false", autocomplete: "off" };
    const text = (option, label, hint) => {
        const id = `${option}-${letter}`;
        const input = make("input", { "data-option": option, id, size: 8, placeholder: hint, ...plain });
        input.addEventListener("input", () => {
            change(option, input.value.trim() || null);
            showSliders(index);
        });
        own[option] = input;
        return make("span", {}, make("label", { for: input.id }, `${label} `), input);
    };
    const select = (option, label, list, none) => {
        const items = list.map((name) => make("option", { value: name }, name || none));
        const input = make("select", { "data-option": option, id: `${option}-${letter}` }, ...items);
        input.addEventListener("change", () => change(option, input.value || null));
        own[option] = input;
        return make("span", {}, make("label", { for: input.id }, `${label} `), input);
    };
    const length = (option, label) => {
        const named = { "data-slider": option, "aria-label": `${label}, set-up ${letter}` };
        const slider = make("input", { type: "range", min: 0, max: STEPS, ...named });
        own[`${option}-slider`] = slider;
        slider.addEventListener("input", () => {
            own[option].value = slide(option, Number(slider.value));
            push(option);
            change(option, own[option].value);
            showSliders(index);
        });
        return make("div", { class: "length" }, text(option, label, STARTS[option]), slider);
    };
    // A camera of an engine fills the fields with what the program says that it is.
    const engines = JSON.parse(engine.run(["list", "presets", "--json"]).out).items;
    const preset = select("preset", "Engine", ["", ...engines.map(({ name }) => name)], "any");
    own.preset.addEventListener("change", () => {
        if (index === 0) $("#engine").value = own.preset.value;
        const chosen = engines.find(({ name }) => name === own.preset.value);
        const said = /near ([^,]+), far ([^,]+), ([^,]+), ([^,]+),.* scene in (\w+)/.exec(chosen?.camera ?? "");
        if (said === null) return;
        const [, near, far, mapping, format, scene] = said, setup = state.setups[index];
        for (const [option, value] of Object.entries({ near, far, mapping, format })) setup.set(option, value);
        if (choices("unit").includes(scene)) setup.set("unit", scene);
        else setup.delete("unit");
        fill();
    });
    // The usual ones by their plain names, beside the lists of all.
    const plainly = PLAIN.map(([name, option, is, choose]) => {
        const one = make("button", { type: "button" }, name), now = () => own[option].value;
        one.addEventListener("click", () => {
            change(option, choose(now()));
            fill();
        });
        return Object.assign(one, { show: () => one.setAttribute("aria-pressed", is.test(now())) });
    });
    own.showPlain = () => plainly.forEach((one) => one.show());
    const ortho = make("input", { type: "checkbox", "data-option": "ortho", id: `ortho-${letter}` });
    ortho.addEventListener("change", () => { // which has no view
        for (const option of VIEW) state.setups[index].delete(option);
        if (!ortho.checked) state.setups[index].set("viewport", VIEWPORT);
        change("ortho", ortho.checked ? "" : null);
        fill();
    });
    own.ortho = ortho;
    const more = make("input", { class: "more", id: `more-${letter}`, placeholder: "--rounding zero", ...plain });
    more.addEventListener("change", () => {
        try {
            const base = new Map([...state.setups[index]].filter(([name]) => name in own));
            const read = engine.parse(["table", ...words(base), ...split(more.value)]);
            if (read.status !== 0) throw new Error(errorOf(read));
            state.setups[index] = mapOf(read);
            fill();
            later();
        } catch (error) {
            refuseSetup(index, error.message);
        }
    });
    own.more = more;
    own.refused = make("p", { class: "refused", role: "status", id: `refused-${letter}` });
    fields[index] = own;
    const details = make("details", {}, make("summary", {}, "Arithmetic, viewport and more"),
        make("div", { class: "row" }, select("model", "Model", ["", ...choices("model").filter((name) => name !== "auto")], "auto"),
            select("arith", "Arithmetic", ["", ...names("arithmetic")], "auto")),
        make("div", { class: "row" }, text("viewport", "Viewport", "1920x1080"), text("slant", "Slant", "0:90"),
            text("at", "Depths", "1,10,100"), select("unit", "Unit", ["", ...choices("unit")], "scene units")),
        make("label", { for: more.id }, "Further options, as the command has them"), more);
    details.open = matchMedia("(min-width: 60rem)").matches;
    root.append(make("fieldset", {}, make("legend", {}, `Set-up ${letter}`), make("div", { class: "row" }, preset),
        length("near", "Near"), length("far", "Far"),
        make("div", { class: "row", role: "group", "aria-label": `Depth buffer, set-up ${letter}` }, ...plainly),
        make("div", { class: "row" }, select("format", "Format", names("formats")),
            select("mapping", "Mapping", names("mappings")),
            make("span", {}, ortho, make("label", { for: ortho.id }, " orthographic"))),
        details, own.refused));
    for (const option of Object.keys(STARTS)) own[option].setAttribute("aria-describedby", own.refused.id);
}

// The help of an option, as the commands have it, stands beside its control.
function explain() {
    const texts = {};
    for (const input of document.querySelectorAll("[data-option], [data-slider]")) {
        const verb = input.closest("[data-asks]")?.dataset.asks ?? "table", { option = input.dataset.slider } = input.dataset;
        texts[verb] ??= engine.run([verb, "--help"]).out;
        const said = new RegExp(`^ {2,6}(?:-., )?--${option}\\b[^\n]*\n(?: {20,}[^\n]*\n)*`, "m").exec(texts[verb])?.[0].split("\n");
        input.title = said?.map((line) => (line[29] === " " ? line.slice(30) : "")).join(" ").trim() ?? "";
    }
}

function show(input, value) {
    if (input.tagName === "SELECT" && ![...input.options].some((option) => option.value === value))
        input.append(make("option", {}, value));
    if (document.activeElement !== input || input.tagName === "SELECT") input.value = value;
}

const OTHER_WAY = { d3d: "reversed", reversed: "d3d", gl: "gl-reversed", "gl-reversed": "gl" };
const PLAIN = [
    ["16-bit", "format", /^(unorm|d)16$/i, () => "unorm16"], ["24-bit", "format", /^(unorm|d)24$/i, () => "unorm24"],
    ["32-bit float", "format", /^(fp32|d32f)$/i, () => "fp32"], ["reversed", "mapping", /reversed/, (now) => OTHER_WAY[now] ?? "reversed"],
];

// A command takes these where it is given nothing. A preset gives something else.
const STARTS = {
    near: "0.1", far: "1000", format: "all", mapping: "all", model: "", arith: "",
    unit: "", viewport: "", slant: "", at: "",
};

function showSliders(index) {
    for (const option of Object.keys(SLIDERS)) {
        const given = state.setups[index].get(option) ?? STARTS[option], slider = fields[index][`${option}-slider`];
        slider.value = stepOf(option, given, state.setups[index].get("unit"));
        slider.setAttribute("aria-valuetext", given);
    }
}

// Gap and distance, where they are, and where what is known of the set-ups lies on their axes.
function showWorld(facts) {
    for (const [name, mark] of [["gap", "enough"], ["distance", "limit"]]) {
        const slider = $(`#${name}`), known = facts.find((one) => one[name])?.[name];
        const text = $(`#${name}-text`);
        show(text, world[name]);
        text.setAttribute("aria-invalid", known === undefined);
        slider.setAttribute("aria-valuetext", world[name]);
        if (known !== undefined) slider.value = known.step;
        for (const at of slider.parentElement.querySelectorAll(".mark")) {
            const i = Number(at.dataset.mark), is = state.setups[i] && facts[i]?.[mark];
            at.hidden = !is;
            if (!is) continue;
            at.textContent = `${state.setups.length > 1 ? `${"AB"[i]}: ` : ""}${is.text}`;
            at.style.setProperty("--at", is.step / 1000);
            at.classList.toggle("before", is.step > 600);
        }
    }
}

// What is asked of the set-ups follows, but where it is asked otherwise.
function ask(name, value) {
    const option = { gap: "separation", distance: "at" }[name];
    for (const asked of [state.asked.solve, state.asked.bias])
        if (asked.get(option) === world[name]) {
            asked.set(option, value);
            fillQuestions();
        }
    world[name] = value;
    later();
}

// Each question has the fields that its command takes.
function fitQuestions() {
    $("[data-asks=solve] [data-option=at]").disabled = state.asked.solve.get("for") === "distance";
}

function refuseSetup(index, text) {
    const own = fields[index];
    if (own.refused.textContent !== text) own.refused.textContent = text;
    for (const option of Object.keys(STARTS)) own[option].setAttribute("aria-invalid", text.startsWith(`--${option}: `));
}

function fillQuestions() {
    for (const form of document.querySelectorAll("[data-asks]"))
        for (const input of form.querySelectorAll("[data-option]"))
            show(input, state.asked[form.dataset.asks].get(input.dataset.option) ?? "");
}

// The controls show the state.
function fill() {
    state.setups.forEach((setup, index) => {
        const own = fields[index], rest = new Map(setup);
        for (const [option, start] of Object.entries(STARTS)) {
            const unsaid = own[option].tagName === "SELECT" && !setup.has("preset") ? start : "";
            show(own[option], setup.get(option) ?? unsaid);
            rest.delete(option);
        }
        showSliders(index);
        own.ortho.checked = setup.has("ortho");
        own.preset.value = setup.get("preset") ?? "";
        if (index === 0) $("#engine").value = own.preset.value;
        for (const name of ["ortho", "preset"]) rest.delete(name);
        own.more.value = join(words(rest));
    });
    const two = state.setups.length > 1;
    $("#b").hidden = !two;
    $("#add-b").setAttribute("aria-pressed", two);
    fillQuestions();
    for (const input of document.querySelectorAll("[name=figure]")) input.checked = input.value === state.figure;
    for (const input of document.querySelectorAll("[data-shows]")) input.checked = state.shown.has(input.dataset.shows);
}

// ---- What the panels show -----------------------------------------------------------------------------------------

// The sentences of a report, put together again where they were wrapped: lines from the margin that end in a full stop.
const ANSWER_LINES = 300;
function answers(text) {
    const all = [];
    let open = false;
    for (const line of text.split("\n", ANSWER_LINES)) {
        if (/^[^\s-]/.test(line)) all.push(line);
        else if (open && /^ {2}\S/.test(line)) all[all.length - 1] += line.slice(1);
        open = all.length > 0 && line !== "" && !all.at(-1).endsWith(".");
    }
    return all.filter((line) => line.endsWith(".") && !/ {2}/.test(line)).join(" ");
}

const [DARK, NARROW] = ["prefers-color-scheme: dark", "max-width: 40rem"].map((what) => globalThis.matchMedia?.(`(${what})`));
let printing = false;
const theme = () => (printing ? "print" : (document.documentElement.dataset.theme ?? (DARK.matches ? "dark" : "light")));

function save(name, text, type) {
    const link = make("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const RUN = { json: ["--json"], csv: ["--csv"] };
const TYPE = { json: "application/json", csv: "text/csv", svg: "image/svg+xml", png: "image/png" };

// The figure as the page shows it, two pixels for one of its own.
async function png(one) {
    const image = $("img", one), canvas = make("canvas", { width: 2 * image.naturalWidth, height: 2 * image.naturalHeight });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return new Promise((done) => canvas.toBlob(done, TYPE.png));
}

// One output of a panel: of set-up A or B.
function outputOf(panel, index) {
    const place = $(".outputs", panel), verb = panel.dataset.panel, drawn = verb === "plot";
    while (place.children.length <= index) {
        const letter = "AB"[place.children.length], title = `${verb}, set-up ${letter}`;
        const body = drawn ? make("div", { class: "stage" }, make("img", { alt: "" }), make("img", { alt: "", class: "ghost", hidden: "" }))
            : make("div", { tabindex: 0, "data-output": "text", role: "region", "aria-label": title });
        const saves = make("div", { class: "saves" });
        const one = make("div", { class: drawn ? "figure" : "text" }, make("h3", {}, `Set-up ${letter}`),
            make("p", { class: "answer" }), body, make("p", { class: "refused", role: "status" }), saves);
        for (const kind of drawn ? ["svg", "png", "csv", "json"] : ["csv", "json"]) {
            const name = kind.toUpperCase(), told = { "data-export": kind, "aria-label": `${name} of ${title}` };
            const button = make("button", { type: "button", ...told }, name);
            button.addEventListener("click", async () => {
                const run = async () => (await aside.ask([...split(one.dataset.run), ...RUN[kind]])).out;
                const what = kind === "svg" ? one.said.out : kind === "png" ? await png(one) : await run();
                save(`depthprec-${verb}-${letter}.${kind}`, what, TYPE[kind]);
            });
            saves.append(button);
        }
        place.append(one);
        if (!drawn) continue;
        one.over = createOver(body, { onCross: crossTo, onAsk: require });
        widths.observe(one);
    }
    return place.children[index];
}

const unescaped = (text) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&amp;", "&");

// How wide a figure may be is observed: to ask for it in each frame would lay out the page again and again.
let widths;
const observeWidths = () => new ResizeObserver((entries) => {
    for (const { target, contentRect: { width } } of entries) {
        const changes = target.width > 0 && width > 0 && target.width !== width;
        target.width = width;
        if (changes) later();
    }
});

function drawing(one, colours = theme()) {
    const width = Math.max(320, Math.min(1200, Math.round(one.width || one.clientWidth || 640)));
    const height = Math.max(320, Math.round(width * 0.55));
    return ["--type", "svg", "-o", "-", "--theme", colours, "--figure-size", `${width}x${height}`];
}

function showFigure(one, svg) {
    const image = $("img", one);
    image.src = `data:${TYPE.svg},${encodeURIComponent(svg)}`;
    image.alt = unescaped(/<desc[^>]*>([^<]*)/.exec(svg)?.[1] ?? "");
    one.axes = readFigure(svg);
}

const narrow = () => NARROW.matches && !printing;

function showText(one, verb, { out: text, left }) {
    const whole = left > 0 ? `${text}\n... and ${Math.ceil(left / 1024)} KiB more: CSV has all\n` : text;
    $("[data-output]", one).replaceChildren(...sheet(whole, narrow()));
    if (verb !== "table") $(".answer", one).textContent = answers(withoutCells(text));
}

// The outputs of a panel, those of set-ups that there are, and the command of one.
function outputsOf(panel) {
    const shared = panel.dataset.panel === "plot" && SHARED.includes(state.figure);
    const ones = state.setups.slice(0, shared ? 1 : 2).map((_, index) => outputOf(panel, index));
    for (const one of $(".outputs", panel).children) one.hidden = !ones.includes(one);
    $("h3", ones[0]).hidden = ones.length === 1;
    return ones;
}

function lineOf(verb, setup, one, colours = theme()) {
    const line = commandOf(verb, setup);
    return verb === "plot" ? [...line, ...(held === "" ? [] : ["--axes", held]), ...drawing(one, colours)] : line;
}

// ---- What lies over a figure --------------------------------------------------------------------------------------

// While something is dragged, until the hand is lifted, the axes stand still, as they were; the curves of what was shown
// before it lie under those of now.
let pressed = false, steady = null, before = null, held = "", crossing = "100";
const axesOf = ({ x, y }) => `${x.text},${y.text}`;
const figures = () => [...document.querySelectorAll("[data-panel=plot]:not([hidden]) .figure:not([hidden])")];
const axesNow = () => figures()[0]?.axes ?? null;

function hold() {
    const axes = axesNow();
    before = steady;
    held = axes !== null && SHARED.includes(state.figure) && steady?.figure === state.figure ? axesOf(axes) : "";
}

function release() {
    held = "";
    count();
    showKnown();
}

function ghostOf(one, colours) {
    if (before === null || before.figure !== state.figure || !SHARED.includes(state.figure) || !one.axes) return null;
    const [a, b] = before.setups, line = commandOf("plot", a, b ?? null);
    if (join(line) === join(commandOf("plot", state.setups[0]))) return null;
    return [...line, "--axes", held || axesOf(one.axes), ...drawing(one, colours)];
}

function showGhost(one) {
    const line = ghostOf(one), said = line && aside.known(line), ghost = $(".ghost", one);
    ghost.hidden = line === null || (said === undefined && ghost.hidden) || said?.status === REFUSED;
    if (!said || said === ghost.said || ghost.hidden) return;
    const { frame: { x, y, w, h }, size: [width, height] } = one.axes, share = (part, all) => `${(100 * part) / all}%`;
    ghost.said = said;
    ghost.src = `data:${TYPE.svg},${encodeURIComponent(said.out)}`;
    ghost.style.clipPath = `inset(${[share(y, height), share(width - x - w, width), share(height - y - h, height), share(x, width)].join(" ")})`;
}

// A length for a set-up whose scene unit may be another than A's, which figures have.
const unitOf = (setup) => setup.get("unit") ?? "";
function lengthFor(setup, text) {
    const unit = unitOf(state.setups[0]);
    return unit === unitOf(setup) || !/[\d.]$/.test(text) ? text : text + unit;
}

// The command's words about a set-up alone, with other options in place of those about depths.
const ABOUT_DEPTHS = ["at", "range", "depth", "code", "constants", "full"];
function askedOf(verb, setup, options) {
    const given = new Map([...[...setup].filter(([name]) => !ABOUT_DEPTHS.includes(name)), ...Object.entries(options)]);
    return [verb, ...words([...takes[verb].keys()].filter((name) => given.has(name)).map((name) => [name, given.get(name)]))];
}

function crossed({ x }) {
    const z = Number(crossing);
    return z < x.lo || z > x.hi ? numberAt(x, z < x.lo ? 0 : 1) : crossing;
}
const crossLine = (setup, axes) => askedOf("table", setup, { at: lengthFor(setup, crossed(axes)) });
const reachLine = (setup) =>
    askedOf("solve", setup, { for: "distance", separation: lengthFor(setup, state.asked.solve.get("separation") ?? "0"), json: "" });

// Commands that say what lies over a figure.
function outputsOver(colours) {
    const axes = axesNow(), [one] = figures(), ghost = one && ghostOf(one, colours);
    if (axes === null || axes.x.key !== "z") return [];
    const all = state.setups.map((setup) => ({ line: crossLine(setup, axes), over: true }));
    if (axes.y.key === "interval") all.push(...state.setups.map((setup) => ({ line: reachLine(setup), over: true })));
    return ghost ? [...all, { line: ghost, over: true }] : all;
}

function crossTo(text) {
    if (crossing === text) return;
    crossing = text;
    requestAnimationFrame(() => {
        count();
        showKnown();
        want();
    });
}

function require(at, separation) {
    const unit = unitOf(state.setups[0]), asked = state.asked.solve;
    asked.set("at", world.distance);
    asked.set("separation", world.gap);
    ask("distance", at + unit);
    ask("gap", separation + unit);
}

// How far each set-up resolves what is required, in A's scene units.
function reaches() {
    const all = [], unit = METRES[unitOf(state.setups[0])] ?? 1;
    state.setups.forEach((setup, i) => {
        const said = aside.known(reachLine(setup)), table = aside.known(commandOf("table", setup));
        if (!said || said.status === REFUSED || !/\x1f *guaranteed/.test(table?.out)) return; // or it is of several formats
        const { possible, answer } = JSON.parse(said.out), own = METRES[unitOf(setup)] ?? unit;
        if (answer) all.push({ letter: state.setups.length > 1 ? "AB"[i] : "", distance: possible ? (answer.distance * own) / unit : null });
    });
    return all;
}

const shortened = (number) => Number((number * (1 - 4e-6)).toPrecision(6)); // never above it
function required() {
    const asked = state.asked.solve, unit = unitOf(state.setups[0]), reach = reaches();
    const [at, separation] = ["at", "separation"].map((name) => numberOf(asked.get(name) ?? "", unit));
    const one = ({ letter, distance }) => `${letter} ${distance === null ? "fails everywhere"
        : distance >= at ? "holds" : `fails beyond ${shortened(distance)}${unit && ` ${unit}`}`}`.trim();
    const says = `${asked.get("separation")} at ${asked.get("at")}: ${reach.map(one).join(", ")}`;
    return { at, separation, reach, says: `Required: ${says}` };
}

let crossedNow = []; // what the tables there are of
function showCrossed(axes) {
    const unit = unitOf(state.setups[0]), z = crossed(axes), slider = $("#cross"), text = unit === "" ? z : `${z} ${unit}`;
    slider.value = stepAt(axes.x, Number(z));
    slider.setAttribute("aria-valuetext", text);
    $("#cross-is").textContent = text;
    const all = state.setups.map((setup) => aside.known(crossLine(setup, axes)));
    if (all.includes(undefined) || (all.length === crossedNow.length && all.every((said, i) => said === crossedNow[i]))) return;
    crossedNow = all;
    $("#crossed").replaceChildren(...all.flatMap((said, i) => {
        const name = state.setups.length > 1 ? `${"AB"[i]} ` : "";
        if (said.status === REFUSED) return [make("p", {}, `${name}${errorOf(said)}`)];
        const tables = sheet(said.out, true).filter(({ tagName }) => tagName === "TABLE");
        if (name !== "") for (const table of tables) table.createCaption().textContent = `Set-up ${name}${unitOf(state.setups[i]) && `(${unitOf(state.setups[i])})`}`;
        return tables;
    }));
}

function showOver() {
    const axes = axesNow(), has = axes !== null && axes.x.key === "z", wanted = required();
    $("#crossing").hidden = !has;
    for (const one of figures()) {
        one.over.show(one.axes?.x.key === "z" ? one.axes : null, has ? Number(crossed(axes)) : 0, wanted);
        showGhost(one);
    }
    $("#required").textContent = has && axes.y.key === "interval" && wanted.reach.length > 0 ? `${wanted.says}.` : "";
    if (has) showCrossed(axes);
}

// A set-up that is refused as a whole says so beside its controls; what was shown of it stays, paler.
function showOutput(panel, one, index, said) {
    const form = narrow();
    if (said === one.said && one.form === form) return;
    one.form = form;
    const verb = panel.dataset.panel, drawn = verb === "plot";
    const refused = said.status === REFUSED ? errorOf(said) : "";
    const saidAbove = fields.some((own) => refused === own.refused.textContent);
    one.classList.toggle("stale", refused !== "" && saidAbove);
    if (refused !== "" && saidAbove && one.said !== undefined) return;
    one.said = said;
    one.dataset.run = join(commandOf(verb, state.setups[index]));
    if (!drawn) showText(one, verb, said);
    else if (refused === "") showFigure(one, said.out);
    $(".refused", one).textContent = refused;
    for (const part of one.querySelectorAll(".stage, [data-output], .saves")) part.hidden = refused !== "";
}

function showSetup(index, said) {
    refuseSetup(index, said.status === REFUSED ? errorOf(said) : "");
    if (drawnRefusals[index] !== refusalOf(state.setups[index])) showPicture();
    document.documentElement.dataset.answered = "";
}

// What else would do, each a button that does it, with what the engine's users write.
const waysLine = () => ["ways", ...pictureLines()[0]];
function showWays() {
    const said = aside.known(waysLine());
    if (said === undefined || said === $("#ways").said) return;
    const all = said.status === 0 ? JSON.parse(said.out).filter((one) => one !== null).slice(0, 3) : [];
    $("#ways").said = said;
    $("#ways").hidden = all.length === 0;
    $("#ways").replaceChildren(...all.map(({ text, set: changes, code }) => {
        const button = make("button", { type: "button" }, text);
        button.addEventListener("click", () => ("gap" in changes ? ask("gap", changes.gap) : take(changes)));
        return make("span", {}, button, ...(code ? [" ", make("code", {}, code)] : []));
    }));
}

// What is in force where nothing was chosen.
function showForce(facts) {
    for (const [i, one] of facts.slice(0, state.setups.length).entries())
        for (const option of ["model", "arith", "format", "mapping"]) {
            const none = [...fields[i][option].options].find(({ value }) => value === "");
            if (none) none.textContent = one[option] === undefined ? "auto" : `auto: ${one[option]}`;
        }
}

// What is promised of gap and distance: at any slant first, then of what faces the camera; of a set-up that is refused, why.
function showHeadlines(facts) {
    $("#verdicts").replaceChildren(...state.setups.map((_, i) => {
        const { headline, facing, error } = facts[i] ?? {}, letter = state.setups.length > 1 ? [make("b", {}, "AB"[i]), " "] : [];
        return make("p", {}, ...letter, headline ?? error ?? "", ...(facing ? [make("br"), make("span", { class: "facing" }, facing)] : []));
    }));
}

function count() {
    const { dataset } = document.documentElement;
    dataset.updates = Number(dataset.updates ?? 0) + 1;
}

// The page shows the set-ups' tables first, which say above what is resolved, then the panels, those on the screen
// first.
const onScreen = new Set();
function outputs(colours) {
    const all = state.setups.map((setup, index) => ({ index, line: commandOf("table", setup) }));
    if (all.length === 0) return []; // the first answer comes before the first set-up
    const panels = [...document.querySelectorAll("[data-panel]:not([data-panel=view], [hidden])")];
    for (const panel of panels.sort((a, b) => onScreen.has(b) - onScreen.has(a)))
        for (const [index, one] of outputsOf(panel).entries())
            all.push({ panel, one, index, line: lineOf(panel.dataset.panel, state.setups[index], one, colours) });
    all.splice(state.setups.length, 0, { line: waysLine(), over: true }, ...outputsOver(colours));
    return all;
}

// Shows what is known; what is not is paler until it comes.
function showKnown() {
    const late = new Set();
    for (const { panel, one, index, line, over } of outputs()) {
        if (over) continue;
        const said = aside.known(line);
        if (said === undefined) late.add(panel);
        else if (panel === undefined) showSetup(index, said);
        else showOutput(panel, one, index, said);
    }
    for (const panel of document.querySelectorAll("[data-panel]")) panel.classList.toggle("stale", late.has(panel));
    if (state.setups.length === 0) return;
    showOver();
    showWays();
}

// Answers are shown, while something is dragged once in a frame; what lies over a figure follows it.
let following = 0;
function follow() {
    const axes = axesNow();
    following = 0;
    showKnown();
    if (axesNow() !== axes) want();
}

// While something is dragged, what took long the last time waits until the hand rests, as does what is not on the screen.
const MOST = 2 ** 18, LONG_MS = 80, REST_MS = 200, cost = {};
const costOf = ([verb, figure]) => (verb === "plot" ? `${verb} ${figure}` : verb);
const atMost = ({ line }) => [line, line[0] === "plot" ? Infinity : MOST];
let resting = null;

function want() {
    const urgent = ({ panel, line }) => panel === undefined || (onScreen.has(panel) && !(cost[costOf(line)] > LONG_MS));
    aside.want(outputs().filter((one) => resting === null || urgent(one)).map(atMost));
}

function update(dragged = false) {
    fitQuestions();
    for (const own of fields) own.showPlain();
    for (const panel of document.querySelectorAll("[data-panel]"))
        panel.hidden = panel.dataset.panel !== "view" && !state.shown.has(panel.dataset.panel);
    $("#link").textContent = shown().map((line) => `depthprec ${join(line)}`).join("\n");
    showPicture();
    clearTimeout(resting);
    resting = !dragged ? null : setTimeout(() => {
        resting = null;
        if (!pressed) release();
        want();
    }, REST_MS);
    count();
    showKnown();
    want();
}

let opened = false; // the link that the page was opened at is shown, or refused
// All is there: the address, what a screen reader says, and the figures as they are printed, which can't be waited for.
function settle() {
    const { dataset } = document.documentElement, said = $("#verdicts").textContent;
    if (!opened || resting !== null || dataset.settled === dataset.updates) return;
    showAddress();
    if ($("#said").textContent !== said) $("#said").textContent = said;
    dataset.settled = dataset.updates;
    dataset.ready = "";
    steady = { figure: state.figure, setups: state.setups.map((setup) => new Map(setup)) };
    aside.want([...outputs(), ...outputs("print")].map(atMost));
}

// An answer that takes a second is named, with a way out.
const NAMED_MS = 1000;
let naming = null;
function showRun(line) {
    clearInterval(naming);
    $("#busy").hidden = true;
    if (line === null) return settle();
    const begun = performance.now();
    naming = setInterval(() => {
        $("#busy").hidden = false;
        $("#busy span").textContent = `${line[0]} takes ${Math.round((performance.now() - begun) / 1000)} s, of 10 at most.`;
    }, NAMED_MS);
}

let waiting = false;
function later() {
    supersede();
    linked = false;
    if (waiting) return;
    if (resting === null && held === "") hold();
    waiting = true;
    requestAnimationFrame(() => {
        waiting = false;
        refuse(null);
        update(true);
    });
}

// ---- The page's own controls --------------------------------------------------------------------------------------

const SCHEMES = ["system", "light", "dark"];

function setTheme(scheme) {
    const { dataset } = document.documentElement;
    if (scheme === "system") delete dataset.theme;
    else dataset.theme = scheme;
    $("#theme").textContent = `Colours: ${scheme}`;
}

function listen() {
    $("#line").addEventListener("submit", (event) => {
        event.preventDefault();
        set(() => {
            const all = commands($("#command").value), second = state.setups[1];
            return all.length === 1 && second !== undefined ? [...all, commandOf("table", second)] : all;
        });
    });
    $("#add-b").addEventListener("click", () => {
        if (state.setups.length > 1) state.setups.pop();
        else state.setups.push(mapOf(engine.parse(split(SECOND))));
        fill();
        later();
    });
    $("#theme").addEventListener("click", () => {
        setTheme(SCHEMES[(SCHEMES.indexOf(document.documentElement.dataset.theme ?? "system") + 1) % 3]);
        later();
    });
    const copies = (id, text) =>
        $(id).addEventListener("click", async () => {
            try {
                await navigator.clipboard.writeText(text());
                $("#copied").textContent = "Copied.";
            } catch {
                $("#copied").textContent = "The browser does not let this page copy.";
            }
        });
    const address = () => `${location.href.split("#")[0]}#${link()}`;
    copies("#copy", address);
    $("#share").hidden = !navigator.share;
    $("#share").addEventListener("click", () => navigator.share({ title: document.title, url: address() }).catch(() => {}));
    $("#ask").addEventListener("submit", (event) => event.preventDefault());
    $("#engine").append(...[...fields[0].preset.options].map(({ value }) => make("option", { value }, value || "any engine")));
    $("#engine").addEventListener("change", ({ target }) => {
        fields[0].preset.value = target.value;
        fields[0].preset.dispatchEvent(new Event("change"));
    });
    for (const [i, name] of ["gap", "distance"].entries()) {
        $(`#${name}`).addEventListener("input", ({ target }) => ask(name, engine.lengthAt(i, Number(target.value), unitOf(state.setups[0]) !== "")));
        $(`#${name}-text`).addEventListener("input", ({ target }) => target.value.trim() && ask(name, target.value.replaceAll(" ", "")));
    }
    copies("#copy-profile", profileText);
    copies("#copy-commands", () => $("#link").textContent);
    for (const input of document.querySelectorAll("[data-shows]"))
        input.addEventListener("change", () => {
            if (input.checked) state.shown.add(input.dataset.shows);
            else state.shown.delete(input.dataset.shows);
            later();
        });
    for (const form of document.querySelectorAll("[data-asks]")) {
        form.addEventListener("submit", (event) => event.preventDefault());
        form.addEventListener("input", (event) => {
            const asked = state.asked[form.dataset.asks], { option } = event.target.dataset;
            if (option === "for") asked.delete(asked.get("for"));
            if (event.target.value.trim() === "") asked.delete(option);
            else asked.set(option, event.target.value.trim());
            later();
        });
    }
    for (const name of FIGURES) {
        const input = make("input", { type: "radio", name: "figure", value: name, id: `figure-${name}` });
        input.addEventListener("change", () => {
            state.figure = name;
            later();
        });
        $("#figures").append(make("span", {}, input, make("label", { for: input.id }, ` ${name}`)));
    }
    $("#cross").addEventListener("input", () => crossTo(numberOfStep(axesNow().x, Number($("#cross").value))));
    addEventListener("pointerdown", () => (pressed = true), true);
    for (const end of ["pointerup", "pointercancel"])
        addEventListener(end, () => {
            pressed = false;
            if (held === "" || resting !== null) return;
            release();
            want();
        }, true);
    addEventListener("hashchange", () => setLink(location.hash.slice(1)));
    addEventListener("resize", later);
    for (const [when, is] of [["beforeprint", true], ["afterprint", false]])
        addEventListener(when, () => {
            printing = is;
            showKnown();
        });
    const watch = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) onScreen[isIntersecting ? "add" : "delete"](target);
    });
    for (const panel of document.querySelectorAll("[data-panel]")) watch.observe(panel);
    DARK.addEventListener("change", later);
}

// Beside A its second set-up, or what reversed fp32 makes of the same planes.
function pictured() {
    const [a, b] = state.setups, best = new Map([...a, ["format", "fp32"], ["mapping", "reversed"]]);
    const lines = [a, b ?? best].map((setup, i) => commandOf("table", setup));
    return lines[0].join() === lines[1].join() ? lines.slice(0, 1) : lines;
}
// A's unit is that of gap and distance that have none.
const lengthsFor = (setup) => Object.values(world).map((text) => lengthFor(setup ?? state.setups[0], text));
const pictureLines = () => pictured().map((line, i) => [...lengthsFor(state.setups[i]), ...line]);
let drawnRefusals = []; // as the pictures know them
function refusalOf(setup) {
    const said = aside.known(commandOf("table", setup));
    return said?.status === REFUSED ? errorOf(said) : "";
}

function showPicture() {
    const lines = pictureLines(), [, second] = document.querySelectorAll("#picture figure");
    second.hidden = lines.length === 1;
    drawnRefusals = state.setups.map(refusalOf);
    const facts = picture.set(lines.map((line, i) => ({ line, error: drawnRefusals[i] ?? "" })));
    showWorld(facts);
    showForce(facts);
    showHeadlines(facts);
    gpuPanel?.draw();
    imagePanel?.follow();
}

// Each picture says what it is of.
const viewOf = (figure) => ({
    canvas: $("canvas", figure),
    onStatus(text, drawn) {
        $(".answer", figure).textContent = text;
        $(".name", figure).textContent = drawn;
    },
});

// Letters of the figures are measured as the page draws them.
function measurer() {
    const context = (inWorker ? new OffscreenCanvas(1, 1) : document.createElement("canvas")).getContext("2d");
    return (text, size, bold) => {
        context.font = `${bold ? "bold " : ""}${size}px "DejaVu Sans", Verdana, sans-serif`;
        return context.measureText(text).width;
    };
}

// The GPU's findings here, for set-up A.
function take(options) {
    for (const [option, value] of Object.entries(options)) state.setups[0].set(option, value);
    fill();
    later();
}

async function begin() {
    const packed = Uint8Array.from(atob($("#module").textContent), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    engine = await load(new Uint8Array(await new Response(stream).arrayBuffer()));
    engine.measure = measurer();
    engine.gpu = gpu;
    aside = createAside(engine.module, {
        here: (line, most) => engine.run(line, most),
        onSaid: (line, ms) => {
            cost[costOf(line)] = ms;
            if (resting === null) follow();
            else following ||= requestAnimationFrame(follow);
        },
        onRun: showRun,
    });
    $("#cancel").addEventListener("click", () => aside.cancel());
    for (const verb of [...VERBS, "judge"]) takes[verb] = engine.takes(verb);
    $("#version").textContent = engine.run(["--version"]).out.split("\n")[0].replace(/^depthprec /, "");
    for (const name of names("apis")) $("[data-option=api]").append(make("option", {}, name));
    widths = observeWidths();
    buildSetup(0);
    buildSetup(1);
    explain();
    listen();
    const views = [...document.querySelectorAll("#picture figure")].slice(0, 2).map(viewOf);
    picture = createPicture({ views, engine, play: $("#play") });
    const fragment = location.hash.slice(1);
    await setLink(""); // something to change, however long the link takes
    if (fragment !== "" && !(await setLink(fragment))) {
        refuse(`The link is refused, so the standard set-up is shown. ${$("#error").textContent}`);
        if (fragment.length <= LONGEST) $("#command").value = written(fragment); // to be mended: the address is no longer it
    }
    opened = true;
    want();
    $("#marks").addEventListener("change", () => picture.marks($("#marks").checked));
    gpuPanel = createGpuPanel({
        $, aside, frame: picture.frame, setup: () => state.setups[0],
        pictured: () => pictureLines()[0],
        judged: (text) => ["judge", ...commandOf("judge", state.setups[0]).slice(1), "--", text],
        take,
    });
    imagePanel = createImagePanel({ $, aside, setup: () => state.setups[0], take, narrow, otherWay: OTHER_WAY, line: (depth) => askedOf("table", state.setups[0], { depth }) });
    showPicture();
    window.depthprec = { engine, state: () => shown().map(join), set: setLink };
}

const NEEDED = "It needs WebAssembly and DecompressionStream, which browsers have since 2023.";
if (inWorker) serve(measurer());
else begin().catch((error) => refuse(`The page cannot run here: ${error.message}. ${NEEDED}`));
