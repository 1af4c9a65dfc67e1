// SPDX-License-Identifier: GPL-3.0-or-later
// The page: it begins, and listens. It computes no number that is shown: each comes out of the module, see engine.js.
import { createAside, inWorker, serve } from "./aside.js";
import { createCheckPanel } from "./check_panel.js";
import { commands, join, LONGEST, split, toFragment, written } from "./command.js";
import { load } from "./engine.js";
import { numberOfStep } from "./figure.js";
import { ask, buildSetup, explain, fill, names, OTHER_WAY, take } from "./form.js";
import { gpu } from "./gpu.js";
import { createGpuPanel, profile } from "./gpu_panel.js";
import { createImagePanel } from "./image_panel.js";
import { axesNow, copy, crossTo, DARK, narrow, observeWidths, save, TYPE } from "./outputs.js";
import { createPicture } from "./picture.js";
import { heard, later, onScreen, release, showKnown, showPicture, showRun, want } from "./schedule.js";
import { unpack } from "./unpack.mjs";
import {
    $, $$, commandOf, fields, FIGURES, link, make, mapOf, page, pictured, pictureLines, refuse, SCHEMES, SECOND, set, setLink,
    setTheme, shown, state, takes, unitOf, VERBS, words,
} from "./state.js";

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
        else state.setups.push(mapOf(page.engine.parse(split(SECOND))));
        fill();
        later();
    });
    $("#theme").addEventListener("click", () => {
        setTheme(SCHEMES[(SCHEMES.indexOf(document.documentElement.dataset.theme ?? "system") + 1) % 3]);
        later();
    });
    const copies = (id, text) => $(id).addEventListener("click", ({ target }) => copy(target, text()));
    const addressOf = (fragment) => `${location.href.split("#")[0]}#${fragment}`, address = () => addressOf(link());
    copies("#copy", address);
    $("#share").hidden = !navigator.share;
    $("#share").addEventListener("click", () => navigator.share({ title: document.title, url: address() }).catch(() => {}));
    $("#ask").addEventListener("submit", (event) => event.preventDefault());
    $("#engine").append(...[...fields[0].preset.options].map(({ value }) => make("option", { value }, value || "any engine")));
    $("#engine").addEventListener("change", ({ target }) => {
        fields[0].preset.value = target.value;
        fields[0].preset.dispatchEvent(new Event("change"));
    });
    for (const name of ["gap", "distance"]) {
        $(`#${name}`).addEventListener("input", ({ target }) => ask(name, page.engine.lengthAt(name, Number(target.value), unitOf(state.setups[0]) !== "")));
        $(`#${name}-text`).addEventListener("input", ({ target }) => target.value.trim() && ask(name, target.value.replaceAll(" ", "")));
    }
    copies("#copy-profile", () => profile.json);
    $("#save-profile").addEventListener("click", () => save("depthprec-gpu.json", profile.json, TYPE.json));
    copies("#link-profile", () => addressOf(toFragment([["page", `gpu=${profile.brief}`]]).replaceAll(/['()]/g, (c) => `%${c.charCodeAt(0).toString(16)}`)));
    copies("#copy-commands", () => $("#link").textContent);
    for (const panel of $$("details[data-panel]"))
        panel.addEventListener("toggle", () => {
            if (panel.open === state.shown.has(panel.dataset.panel)) return;
            state.shown[panel.open ? "add" : "delete"](panel.dataset.panel);
            later();
        });
    for (const form of $$("[data-asks]")) {
        form.addEventListener("submit", (event) => event.preventDefault());
        form.addEventListener("input", (event) => {
            const asked = state.asked[form.dataset.asks], { option } = event.target.dataset;
            if (option === "for") asked.delete(asked.get("for"));
            asked.delete("method");
            if (event.target.value.trim() === "") asked.delete(option);
            else asked.set(option, event.target.value.trim());
            later();
        });
    }
    for (const [name, title] of Object.entries(FIGURES)) {
        const input = make("input", { type: "radio", name: "figure", value: name, id: `figure-${name}` });
        input.addEventListener("change", () => {
            state.figure = name;
            later();
        });
        $("#figures").append(make("span", {}, input, make("label", { for: input.id }, ` ${title}`)));
    }
    $("#cross").addEventListener("input", () => crossTo(numberOfStep(axesNow().x, Number($("#cross").value))));
    addEventListener("pointerdown", () => (page.pressed = true), true);
    for (const end of ["pointerup", "pointercancel"])
        addEventListener(end, () => {
            page.pressed = false;
            if (page.held === "" || page.resting !== null) return;
            release();
            want();
        }, true);
    addEventListener("hashchange", () => setLink(location.hash.slice(1)));
    addEventListener("resize", later);
    for (const when of ["beforeprint", "afterprint"])
        addEventListener(when, () => {
            page.printing = when === "beforeprint";
            showKnown();
        });
    const watch = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) onScreen[isIntersecting ? "add" : "delete"](target);
    });
    for (const panel of $$("[data-panel]")) watch.observe(panel);
    DARK.addEventListener("change", later);
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
    const context = /** @type {any} */ (inWorker ? new OffscreenCanvas(1, 1) : document.createElement("canvas")).getContext("2d");
    return (text, size, bold) => {
        context.font = `${bold ? "bold " : ""}${size}px "DejaVu Sans", Verdana, sans-serif`;
        return context.measureText(text).width;
    };
}

async function begin() {
    const packed = Uint8Array.from(atob($("#module").textContent), (c) => c.charCodeAt(0));
    page.engine = await load(unpack(packed));
    page.engine.measure = measurer();
    page.engine.gpu = gpu;
    page.aside = createAside(page.engine.module, {
        here: (line, most) => page.engine.run(line, most),
        onSaid: heard,
        onRun: showRun,
    });
    $("#cancel").addEventListener("click", () => page.aside.cancel());
    for (const verb of [...VERBS, "judge", "texture"]) takes[verb] = page.engine.takes(verb);
    $("#version").textContent = page.engine.version();
    for (const [option, verb] of [["api", "bias"], ["language", "code"]])
        for (const name of names(option, verb)) $(`[data-option=${option}]`).append(make("option", {}, name));
    page.widths = observeWidths();
    buildSetup(0);
    buildSetup(1);
    explain();
    listen();
    const views = $$("#picture figure").slice(0, 2).map(viewOf);
    page.picture = createPicture({ views, engine: page.engine, play: $("#play") });
    const fragment = location.hash.slice(1);
    await setLink(""); // something to change, however long the link takes
    if (fragment !== "" && !(await setLink(fragment))) {
        refuse(`The link is refused, so the standard set-up is shown. ${$("#error").textContent}`);
        if (fragment.length <= LONGEST) $("#command").value = written(fragment); // to be mended: the address is no longer it
    }
    page.opened = true;
    want();
    $("#marks").addEventListener("change", () => page.picture.marks($("#marks").checked));
    page.gpuPanel = createGpuPanel({
        $, make, aside: page.aside, frame: page.picture.frame, shared: () => page.shared, setup: () => state.setups[0], force: () => page.facts[0],
        pictured: () => pictureLines()[0],
        judged: (text) => ["judge", ...commandOf("judge", state.setups[0]).slice(1), "--", text],
        take,
    });
    page.checkPanel = createCheckPanel();
    page.imagePanel = createImagePanel({
        $, make, aside: page.aside, setup: () => state.setups[0], take, otherWay: OTHER_WAY, packings: names("packing", "texture"),
        camera: (all) => words([...state.setups[0]].filter(([name]) => all.includes(name))),
    });
    showPicture();
    Object.assign(window, { depthprec: { engine: page.engine, state: () => shown().map(join), set: setLink } });
}

const NEEDED = "It needs WebAssembly and DecompressionStream, which browsers have since 2023.";
if (inWorker) serve(measurer());
else begin().catch((error) => refuse(`The page cannot run here: ${error.message}. ${NEEDED}`));
