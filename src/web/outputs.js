// SPDX-License-Identifier: GPL-3.0-or-later
// Panels show what the commands say; and what lies over a figure.
import { join, split } from "./command.js";
import { createOver, numberAt, readFigure, stepAt } from "./figure.js";
import { ask, METRES, numberOf, refuseSetup, take } from "./form.js";
import { count, drawnRefusals, later, refusalOf, showKnown, showPicture, want } from "./schedule.js";
import { sheet, withoutCells } from "./sheet.js";
import {
    $, askedOf, commandOf, errorOf, fields, lengthFor, link, make, page, REFUSED, set, SHARED, state, unitOf, waysLine, world,
} from "./state.js";

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

export const [DARK, NARROW] = ["prefers-color-scheme: dark", "max-width: 40rem"].map((what) => globalThis.matchMedia?.(`(${what})`));
export const theme = () => (page.printing ? "print" : (document.documentElement.dataset.theme ?? (DARK.matches ? "dark" : "light")));

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
                const run = async () => (await page.aside.ask([...split(one.dataset.run), ...RUN[kind]])).out;
                const what = kind === "svg" ? one.said.out : kind === "png" ? await png(one) : await run();
                save(`depthprec-${verb}-${letter}.${kind}`, what, TYPE[kind]);
            });
            saves.append(button);
        }
        place.append(one);
        if (!drawn) continue;
        one.over = createOver(body, { onCross: crossTo, onAsk: require });
        page.widths.observe(one);
    }
    return place.children[index];
}

const unescaped = (text) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&amp;", "&");
export const observeWidths = () => new ResizeObserver((entries) => {
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

export const narrow = () => NARROW.matches && !page.printing;

function showText(one, verb, { out: text, left }) {
    const whole = left > 0 ? `${text}\n... and ${Math.ceil(left / 1024)} KiB more: CSV has all\n` : text;
    $("[data-output]", one).replaceChildren(...sheet(whole, narrow()));
    if (verb !== "table") $(".answer", one).textContent = answers(withoutCells(text));
}

// The outputs of a panel, those of set-ups that there are, and the command of one.
export function outputsOf(panel) {
    const shared = panel.dataset.panel === "plot" && SHARED.includes(state.figure);
    const ones = state.setups.slice(0, shared ? 1 : 2).map((_, index) => outputOf(panel, index));
    for (const one of $(".outputs", panel).children) one.hidden = !ones.includes(one);
    $("h3", ones[0]).hidden = ones.length === 1;
    return ones;
}

export function lineOf(verb, setup, one, colours = theme()) {
    const line = commandOf(verb, setup);
    return verb === "plot" ? [...line, ...(page.held === "" ? [] : ["--axes", page.held]), ...drawing(one, colours)] : line;
}
export const axesOf = ({ x, y }) => `${x.text},${y.text}`;
const figures = () => [...document.querySelectorAll("[data-panel=plot]:not([hidden]) .figure:not([hidden])")];
export const axesNow = () => figures()[0]?.axes ?? null;

function ghostOf(one, colours) {
    if (page.before === null || page.before.figure !== state.figure || !SHARED.includes(state.figure) || !one.axes) return null;
    const [a, b] = page.before.setups, line = commandOf("plot", a, b ?? null);
    if (join(line) === join(commandOf("plot", state.setups[0]))) return null;
    return [...line, "--axes", page.held || axesOf(one.axes), ...drawing(one, colours)];
}

function showGhost(one) {
    const line = ghostOf(one), said = line && page.aside.known(line), ghost = $(".ghost", one);
    ghost.hidden = line === null || (said === undefined && ghost.hidden) || said?.status === REFUSED;
    if (!said || said === ghost.said || ghost.hidden) return;
    const { frame: { x, y, w, h }, size: [width, height] } = one.axes, share = (part, all) => `${(100 * part) / all}%`;
    ghost.said = said;
    ghost.src = `data:${TYPE.svg},${encodeURIComponent(said.out)}`;
    ghost.style.clipPath = `inset(${[share(y, height), share(width - x - w, width), share(height - y - h, height), share(x, width)].join(" ")})`;
}

function crossed({ x }) {
    const z = Number(page.crossing);
    return z < x.lo || z > x.hi ? numberAt(x, z < x.lo ? 0 : 1) : page.crossing;
}
const crossLine = (setup, axes) => askedOf("table", setup, { at: lengthFor(setup, crossed(axes)) });
const reachLine = (setup) =>
    askedOf("solve", setup, { for: "distance", separation: lengthFor(setup, state.asked.solve.get("separation") ?? "0"), json: "" });

// Commands that say what lies over a figure.
export function outputsOver(colours) {
    const axes = axesNow(), [one] = figures(), ghost = one && ghostOf(one, colours);
    if (axes === null || axes.x.key !== "z") return [];
    const all = state.setups.map((setup) => ({ line: crossLine(setup, axes), over: true }));
    if (axes.y.key === "interval") all.push(...state.setups.map((setup) => ({ line: reachLine(setup), over: true })));
    return ghost ? [...all, { line: ghost, over: true }] : all;
}

export function crossTo(text) {
    if (page.crossing === text) return;
    page.crossing = text;
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

// The depths up to which each set-up resolves what is required, in A's scene units.
function reaches() {
    const all = [], unit = METRES[unitOf(state.setups[0])] ?? 1;
    state.setups.forEach((setup, i) => {
        const said = page.aside.known(reachLine(setup)), table = page.aside.known(commandOf("table", setup));
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
    const all = state.setups.map((setup) => page.aside.known(crossLine(setup, axes)));
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

export function showOver() {
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
export function showOutput(panel, one, index, said) {
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

export function showSetup(index, said) {
    refuseSetup(index, said.status === REFUSED ? errorOf(said) : "");
    if (drawnRefusals[index] !== refusalOf(state.setups[index])) showPicture();
}
export function showWays() {
    const said = page.aside.known(waysLine());
    if (said === undefined || said === $("#ways").said) return;
    document.documentElement.dataset.answered = "";
    const all = said.status === 0 ? JSON.parse(said.out).filter((one) => one !== null).slice(0, 3) : [];
    $("#ways").said = said;
    $("#ways").hidden = all.length === 0;
    $("#ways").replaceChildren(...all.map(({ text, set: changes, code }) => {
        const button = make("button", { type: "button" }, text);
        button.addEventListener("click", () => ("gap" in changes ? ask("gap", changes.gap) : take(changes)));
        return make("span", {}, button, ...(code ? [" ", make("code", {}, code)] : []));
    }));
}

// Model and arithmetic in force, format and mapping, where nothing was chosen.
export function showForce(facts) {
    for (const [i, one] of facts.slice(0, state.setups.length).entries())
        for (const option of ["model", "arith", "format", "mapping"]) {
            const none = [...fields[i][option].options].find(({ value }) => value === "");
            if (none) none.textContent = one[option] === undefined ? "auto" : `auto: ${one[option]}`;
        }
}

// The promise about gap and distance: at any slant first, then of what faces the camera; of a set-up that is refused, why.
export function showHeadlines(facts) {
    $("#verdicts").replaceChildren(...state.setups.map((_, i) => {
        const { headline, facing, error } = facts[i] ?? {}, letter = state.setups.length > 1 ? [make("b", {}, "AB"[i]), " "] : [];
        return make("p", {}, ...letter, headline ?? error ?? "", ...(facing ? [make("br"), make("span", { class: "facing" }, facing)] : []));
    }));
}
