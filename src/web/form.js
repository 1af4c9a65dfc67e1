// SPDX-License-Identifier: GPL-3.0-or-later
// The controls: they are built, follow the state and change it.
import { join, plain, split } from "./command.js";
import { later } from "./schedule.js";
import { $, $$, errorOf, fields, make, mapOf, page, set, start, state, takes, unitOf, VIEW, VIEWPORT, words, world } from "./state.js";

// ---- Controls -----------------------------------------------------------------------------------------------------

export const names = (option, verb = "table") => takes[verb].get(option).names;

// Sliders are logarithmic; a slider writes a plain number of three digits. Each of its steps is two of the module's.
const SLIDERS = ["near", "far"], STEPS = 500;
const slide = (option, step) => page.engine.lengthAt(option, 2 * step, false);
const stepOf = (option, text, unit = "") => Math.round(page.engine.stepOf(option, page.engine.length(text, unit)) / 2);

export function buildSetup(index) {
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
        const [near, far] = SLIDERS.map((name) => page.engine.length(own[name].value || STARTS[name], unitOf(setup)));
        if (!(near >= far)) return;
        own[other].value = slide(other, Math.max(stepOf(other, own[option].value) + beside, 0));
        setup.set(other, own[other].value);
    };
    const verbatim = { spellcheck: "false", autocomplete: "off" };
    const text = (option, label, hint) => {
        const id = `${option}-${letter}`;
        const input = make("input", { "data-option": option, id, size: 8, placeholder: hint, ...verbatim });
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
    // Those that compute their planes ask for more than a name: they are typed as a further option.
    const preset = select("preset", "Engine", ["", ...names("preset")], "any");
    own.preset.addEventListener("change", () => {
        if (index === 0) $("#engine").value = own.preset.value;
        if (own.preset.value === "") return;
        const [{ near, far, mapping, format, unit }] = JSON.parse(page.engine.run(["table", "--preset", own.preset.value, "--json"]).out).setups;
        const setup = state.setups[index];
        for (const [option, value] of Object.entries({ near, far: far ?? "inf", mapping, format })) setup.set(option, String(value));
        if (unit === null) setup.delete("unit");
        else setup.set("unit", unit);
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
    const more = make("input", { class: "more", id: `more-${letter}`, placeholder: "--rounding zero", ...verbatim });
    more.addEventListener("change", () => {
        try {
            const base = new Map([...state.setups[index]].filter(([name]) => name in own));
            const read = page.engine.parse(["table", ...words(base), ...split(more.value)]);
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
        make("div", { class: "row" }, select("model", "Model", ["", ...names("model").filter((name) => name !== "auto")], "auto"),
            select("arith", "Arithmetic", ["", ...names("arith")], "auto")),
        make("div", { class: "row" }, text("viewport", "Viewport", "1920x1080"), text("slant", "Slant", "0:90"),
            text("at", "Depths", "1,10,100"), select("unit", "Unit", ["", ...names("unit")], "scene units")),
        make("label", { for: more.id }, "Further options, as the command has them"), more);
    details.open = matchMedia("(min-width: 60rem)").matches;
    root.append(make("fieldset", {}, make("legend", {}, `Set-up ${letter}`), make("div", { class: "row" }, preset),
        length("near", "Near"), length("far", "Far"),
        make("div", { class: "row", role: "group", "aria-label": `Depth buffer, set-up ${letter}` }, ...plainly),
        make("div", { class: "row" }, select("format", "Format", names("format")),
            select("mapping", "Mapping", names("mapping")),
            make("span", {}, ortho, make("label", { for: ortho.id }, " orthographic"))),
        details, own.refused));
    for (const option of Object.keys(STARTS)) own[option].setAttribute("aria-describedby", own.refused.id);
}

// The help of an option, as the commands have it, stands beside its control.
export function explain() {
    for (const input of $$("[data-option], [data-slider]")) {
        const verb = input.closest("[data-asks]")?.dataset.asks ?? "table", { option = input.dataset.slider } = input.dataset;
        input.title = takes[verb].get(option).help;
    }
}

function show(input, value) {
    if (input.tagName === "SELECT" && ![...input.options].some((option) => option.value === value))
        input.append(make("option", {}, value));
    if (document.activeElement !== input || input.tagName === "SELECT") input.value = value;
}

export const OTHER_WAY = { d3d: "reversed", reversed: "d3d", gl: "gl-reversed", "gl-reversed": "gl" };
/** @type {[string, string, RegExp, (now: string) => string][]} */
const PLAIN = [
    ["16-bit", "format", /^(unorm|d)16$/i, () => "unorm16"], ["24-bit", "format", /^(unorm|d)24$/i, () => "unorm24"],
    ["32-bit float", "format", /^(fp32|d32f)$/i, () => "fp32"], ["reversed", "mapping", /reversed/, (now) => OTHER_WAY[now] ?? "reversed"],
];

// A command takes these where it is given nothing. A preset gives something else.
const STARTS = {
    near: "0.1", far: "1000", format: "all", mapping: "d3d,reversed", model: "", arith: "",
    unit: "", viewport: "", slant: "", at: "",
};

function showSliders(index) {
    for (const option of SLIDERS) {
        const given = state.setups[index].get(option) ?? STARTS[option], slider = fields[index][`${option}-slider`];
        slider.value = stepOf(option, given, unitOf(state.setups[index]));
        slider.setAttribute("aria-valuetext", given);
    }
}

// Gap and distance, where they are, and where what is known of the set-ups lies on their axes.
export function showWorld(facts) {
    for (const [name, mark] of [["gap", "enough"], ["distance", "limit"]]) {
        const slider = $(`#${name}`), known = facts.find((one) => one[name])?.[name];
        const text = $(`#${name}-text`);
        show(text, world[name]);
        text.setAttribute("aria-invalid", known === undefined);
        slider.setAttribute("aria-valuetext", world[name]);
        if (known !== undefined) slider.value = known.step;
        for (const at of $$(".mark", slider.parentElement)) {
            const i = Number(at.dataset.mark), is = state.setups[i] && facts[i]?.[mark];
            at.hidden = !is;
            if (!is) continue;
            at.textContent = `${state.setups.length > 1 ? `${"AB"[i]}: ` : ""}${is.text}`;
            at.style.setProperty("--at", is.step / 1000);
            at.classList.toggle("before", is.step > 600);
        }
    }
}

// The questions about the set-ups follow, but where it is asked otherwise.
export function ask(name, value) {
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
export function fitQuestions() {
    $("[data-asks=solve] [data-option=at]").disabled = state.asked.solve.get("for") === "distance";
}

export function refuseSetup(index, text) {
    const own = fields[index];
    own.said = text;
    if (own.refused.textContent !== plain(text)) own.refused.textContent = plain(text);
    for (const option of Object.keys(STARTS)) own[option].setAttribute("aria-invalid", text.startsWith(`--${option}: `));
}

function fillQuestions() {
    for (const form of $$("[data-asks]"))
        for (const input of $$("[data-option]", form))
            show(input, state.asked[form.dataset.asks].get(input.dataset.option) ?? "");
}

// The controls show the state.
export function fill() {
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
    for (const input of $$("[name=figure]")) input.checked = input.value === state.figure;
}

// The GPU's findings here, for set-up A.
export function take(options) {
    for (const [option, value] of Object.entries(options)) state.setups[0].set(option, value);
    fill();
    later();
}
