// SPDX-License-Identifier: GPL-3.0-or-later
// Panels show what the commands say; and what lies over a figure.
import { join, plain, split } from "./command.js";
import { createOver, numberOfStep, readFigure, stepAt } from "./figure.js";
import { ask, fill, refuseSetup, take } from "./form.js";
import { count, drawnRefusals, later, refusalOf, showKnown, showPicture, want } from "./schedule.js";
import { sentences, sheet } from "./sheet.js";
import {
    $, $$, commandOf, errorOf, fields, lengthFor, link, make, page, REFUSED, set, SHARED, state, unitOf, waysLine, world,
} from "./state.js";

// ---- What the panels show -----------------------------------------------------------------------------------------

export const [DARK, NARROW] = ["prefers-color-scheme: dark", "max-width: 40rem"].map((what) => globalThis.matchMedia?.(`(${what})`));
export const theme = () => (page.printing ? "print" : (document.documentElement.dataset.theme ?? (DARK.matches ? "dark" : "light")));

export function save(name, text, type) {
    const anchor = make("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 1000);
}

// The button says that its text is on the clipboard, or that the browser does not let it there.
export async function copy(button, text) {
    const name = button.dataset.name ??= button.textContent;
    try {
        await navigator.clipboard.writeText(text);
        button.textContent = "Copied";
    } catch {
        button.textContent = "The browser does not let this page copy";
    }
    setTimeout(() => (button.textContent = name), 2000);
}

const RUN = { json: ["--json"], csv: ["--csv"] };
export const TYPE = { json: "application/json", csv: "text/csv", svg: "image/svg+xml", png: "image/png" };

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
        for (const kind of drawn ? ["svg", "png", "csv", "json"] : verb === "code" ? ["copy", "json"] : ["csv", "json"]) {
            const name = kind === "copy" ? "Copy" : kind.toUpperCase(), told = { "data-export": kind, "aria-label": `${name} of ${title}` };
            const button = make("button", { type: "button", ...told }, name);
            button.addEventListener("click", async () => {
                if (kind === "copy") return copy(button, one.said.out);
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
    for (const { target: one, contentRect: { width } } of entries) {
        const target = /** @type {any} */ (one);
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
    const whole = left > 0 ? `${plain(text)}\n... and ${Math.ceil(left / 1024)} KiB more: CSV has all\n` : plain(text);
    $("[data-output]", one).replaceChildren(...sheet(whole, narrow()));
    if (verb !== "table") $(".answer", one).textContent = sentences(plain(text));
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
const figures = () => $$("[data-panel=plot][open] .figure:not([hidden])");
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
    return z < x.lo || z > x.hi ? numberOfStep(x, stepAt(x, z)) : page.crossing;
}

// The numbers of a figure, of each pixel column; they lie on the same places where its size is the same.
function numbersLine(one) {
    const line = lineOf("plot", state.setups[[...one.parentElement.children].indexOf(one)], one);
    return [...line.filter((word, i) => !["--type", "-o", "--theme"].some((name) => name === word || name === line[i - 1])), "--csv"];
}

// Commands that say what lies over a figure.
export function outputsOver(colours) {
    const [one] = figures(), ghost = one && ghostOf(one, colours), resting = page.resting === null;
    return [...figures().filter(({ axes }) => axes?.x.key === "z" && resting).map(numbersLine), ...(ghost ? [ghost] : [])].map((line) => ({ line, over: true }));
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

// The gap at the distance, where they lie on A's axes, and up to where each set-up resolves it.
function required() {
    const { gap, distance } = page.facts[0] ?? {}, all = [];
    const known = page.facts.slice(0, state.setups.length).map((one, i) => ({ letter: state.setups.length > 1 ? "AB"[i] : "", ...one }));
    for (const { letter, resolved, enough, limit, distance: own } of known)
        if (enough) all.push({ letter, distance: resolved ? Infinity : limit ? (limit.value * distance.value) / own.value : null,
            says: `${letter} ${resolved ? "holds" : limit ? `fails beyond ${limit.text}` : "fails everywhere"}`.trim() });
    return { at: distance?.value, separation: gap?.value, reach: all, says: `Required: ${world.gap} at ${world.distance}: ${all.map(({ says }) => says).join(", ")}` };
}

const parted = (csv) => csv.trimEnd().split("\n").map((line) => line.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/).map((cell) => cell.replaceAll('"', "")));

// The points of a figure's numbers: each a row of a series, or of each column that has one.
function pointsOf(csv, { x }) {
    const [head, ...rows] = parted(csv), at = head.findIndex((title) => title.startsWith(x.key)), listed = head.includes("series");
    return rows.flatMap((row) => head.slice(at + 1).map((title, i) => ({
        name: [...row.slice(0, at), listed ? "" : title.split(" [")[0]].filter((name) => name !== "").join(": "),
        unit: /\[(.*)\]/.exec(title)?.[1] ?? "", text: row[at + 1 + i], step: stepAt(x, Number(row[at])),
    })).filter(({ text }) => text));
}

// What is drawn at the crosshair, of each curve the nearest point: some of stairs are far away.
function valuesAt(points, step, stairs) {
    const nearest = new Map(), within = stairs ? Infinity : 4;
    for (const point of points) {
        const apart = Math.abs(point.step - step);
        if (apart <= within && !(apart >= nearest.get(point.name)?.apart)) nearest.set(point.name, { ...point, apart });
    }
    return [...nearest.values()];
}

function showCrossed(axes) {
    const unit = unitOf(state.setups[0]), z = crossed(axes), slider = $("#cross"), text = unit === "" ? z : `${z} ${unit}`;
    slider.value = stepAt(axes.x, Number(z));
    slider.setAttribute("aria-valuetext", text);
    $("#cross-is").textContent = text;
    $("#crossed").replaceChildren(...figures().filter((one) => one.axes).map((one, i) => {
        const said = page.aside.known(numbersLine(one)), table = make("table");
        if (said !== undefined && said !== one.numbers)
            [one.numbers, one.of, one.points] = [said, state.figure, said.status === 0 ? pointsOf(said.out, one.axes) : []];
        const points = one.of === state.figure ? one.points : []; // or they are of the figure before
        if (i > 0 || figures().length > 1) table.createCaption().textContent = `Set-up ${"AB"[i]}`;
        for (const { name, unit: of, text: value } of valuesAt(points, Number(slider.value), axes.y.key === "depth")) {
            const row = table.insertRow(), title = make("th", { scope: "row" }, name);
            row.append(title, make("td", { class: "number" }, page.engine.number(Number(value), /codes|%/.test(of) ? 0 : /^per/.test(of) ? -1 : 1)),
                make("td", {}, of.replace(/scene units?/, unit || "$&")));
        }
        return table;
    }));
}

export function showOver() {
    const axes = axesNow()?.x.key === "z" ? axesNow() : null, wanted = required();
    $("#crossing").hidden = axes === null;
    for (const one of figures()) {
        one.over.show(axes && (one.axes ?? null), axes && Number(crossed(axes)), wanted);
        showGhost(one);
    }
    $("#required").textContent = axes?.y.key === "interval" && wanted.reach.length > 0 ? `${wanted.says}.` : "";
    if (axes !== null) showCrossed(axes);
}

// A set-up that is refused as a whole says so beside its controls; what was shown of it stays, paler.
export function showOutput(panel, one, index, said) {
    const form = narrow();
    if (said === one.said && one.form === form) return;
    one.form = form;
    const verb = panel.dataset.panel, drawn = verb === "plot";
    const refused = said.status === REFUSED ? errorOf(said) : "";
    const saidAbove = fields.some((own) => refused === own.said);
    one.classList.toggle("stale", refused !== "" && saidAbove);
    if (refused !== "" && saidAbove && one.said !== undefined) return;
    one.said = said;
    one.dataset.run = join(commandOf(verb, state.setups[index]));
    if (!drawn) showText(one, verb, said);
    else if (refused === "") showFigure(one, said.out);
    $(".refused", one).textContent = plain(refused);
    for (const part of $$(".stage, [data-output], .saves", one)) part.hidden = refused !== "";
}

export function showSetup(index, said) {
    refuseSetup(index, said.status === REFUSED ? errorOf(said) : "");
    if (drawnRefusals[index] !== refusalOf(state.setups[index])) showPicture();
}

// The panel that says which bias does, asked as the way out is.
function askBias(changes) {
    for (const [name, value] of Object.entries({ ...changes, separation: world.gap, at: world.distance })) state.asked.bias.set(name, value);
    state.shown.add("bias");
    fill();
    later();
    $("[data-panel=bias]").scrollIntoView({ block: "nearest" });
}

export function showWays() {
    const said = page.aside.known(waysLine());
    if (said === undefined || said === $("#ways").said) return;
    document.documentElement.dataset.answered = "";
    const all = said.status === 0 ? JSON.parse(said.out).filter((one) => one !== null) : [];
    $("#ways").said = said;
    $("#ways").hidden = all.length === 0;
    $("#ways").replaceChildren(...all.map(({ text, set: changes, code }) => {
        const button = make("button", { type: "button" }, text);
        button.addEventListener("click", () => ("gap" in changes ? ask("gap", changes.gap) : "api" in changes ? askBias(changes) : take(changes)));
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
        return make("p", {}, ...letter, headline ?? plain(error ?? ""), ...(facing ? [make("br"), make("span", { class: "facing" }, facing)] : []));
    }));
}
