// SPDX-License-Identifier: GPL-3.0-or-later
// When what is asked of the program, and when it is shown.
import { limitOf } from "./aside.js";
import { join } from "./command.js";
import { fitQuestions, showWorld } from "./form.js";
import { axesNow, axesOf, lineOf, outputsOf, outputsOver, showForce, showHeadlines, showOutput, showOver, showSetup, showWays } from "./outputs.js";
import {
    $, $$, commandOf, errorOf, fields, MOST, page, pictureLines, refuse, REFUSED, SHARED, showAddress, shown, state, supersede, waysLine,
} from "./state.js";

function hold() {
    const axes = axesNow();
    page.before = page.steady;
    page.held = axes !== null && SHARED.includes(state.figure) && page.steady?.figure === state.figure ? axesOf(axes) : "";
}

export function release() {
    page.held = "";
    count();
    showKnown();
}

export function count() {
    const { dataset } = document.documentElement;
    dataset.updates = String(Number(dataset.updates ?? 0) + 1);
}

// The page shows the set-ups' tables first, which say above what is resolved, then the panels, those on the screen
// first.
export const onScreen = new Set();
/** @returns {{ panel?: any, one?: any, index?: number, line: string[], over?: boolean }[]} */
export function outputs(colours = undefined) {
    /** @type {ReturnType<outputs>} */
    const all = state.setups.map((setup, index) => ({ index, line: commandOf("table", setup) }));
    if (all.length === 0) return []; // the first answer comes before the first set-up
    const panels = $$("[data-panel][open]");
    for (const panel of panels.sort((a, b) => Number(onScreen.has(b)) - Number(onScreen.has(a))))
        for (const [index, one] of outputsOf(panel).entries())
            all.push({ panel, one, index, line: lineOf(panel.dataset.panel, state.setups[index], one, colours) });
    all.splice(state.setups.length, 0, { panel: $("#ways"), line: waysLine(), over: true });
    return [...all, ...outputsOver(colours)];
}

// Shows what is known; what is not is paler until it comes.
export function showKnown() {
    const late = new Set();
    for (const { panel, one, index, line, over } of outputs()) {
        if (over) continue;
        const said = page.aside.known(line);
        if (said === undefined) late.add(panel);
        else if (panel === undefined) showSetup(index, said);
        else showOutput(panel, one, index, said);
    }
    for (const panel of $$("[data-panel]")) panel.classList.toggle("stale", late.has(panel));
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
export function heard(line, ms) {
    cost[costOf(line)] = ms;
    if (page.resting === null) follow();
    else following ||= requestAnimationFrame(follow);
}

// While something is dragged, what took long the last time waits until the hand rests, as does what is not on the screen.
const LONG_MS = 80, REST_MS = 200, cost = {};
const costOf = (/** @type {string[]} */ [verb, figure]) => (verb === "plot" ? `${verb} ${figure}` : verb);
const atMost = ({ line }) => [line, line[0] === "plot" ? Infinity : MOST];

export function want() {
    const urgent = (/** @type {{ panel?: any, line: string[] }} */ { panel, line }) => panel === undefined || (onScreen.has(panel) && !(cost[costOf(line)] > LONG_MS));
    page.aside.want(outputs().filter((one) => page.resting === null || urgent(one)).map(atMost));
}

export function update(dragged = false) {
    fitQuestions();
    for (const own of fields) own.showPlain();
    for (const panel of $$("details[data-panel]")) panel.open = state.shown.has(panel.dataset.panel);
    $("#why").hidden = state.figure !== "staircase" || state.setups.some((setup) => setup.has("ortho"));
    $("#link").textContent = shown().map((line) => `depthprec ${join(line)}`).join("\n");
    showPicture();
    clearTimeout(page.resting);
    page.resting = !dragged ? null : setTimeout(() => {
        page.resting = null;
        if (!page.pressed) release();
        want();
    }, REST_MS);
    count();
    showKnown();
    want();
}
// All is there: the address, what a screen reader says, and the figures as they are printed, which can't be waited for.
function settle() {
    const { dataset } = document.documentElement, said = $("#verdicts").textContent;
    if (!page.opened || page.resting !== null || dataset.settled === dataset.updates) return;
    showAddress();
    if ($("#said").textContent !== said) $("#said").textContent = said;
    dataset.settled = dataset.updates;
    dataset.ready = "";
    page.steady = { figure: state.figure, setups: state.setups.map((setup) => new Map(setup)) };
    page.aside.want([...outputs(), ...outputs("print")].map(atMost));
}

// An answer that takes a second is named, with a way out.
const NAMED_MS = 1000;
let naming = null;
export function showRun(line) {
    clearInterval(naming);
    $("#busy").hidden = true;
    if (line === null) return settle();
    const begun = performance.now();
    naming = setInterval(() => {
        $("#busy").hidden = false;
        $("#busy span").textContent = `${line[0]} takes ${Math.round((performance.now() - begun) / 1000)} s, of ${limitOf(line)} at most.`;
    }, NAMED_MS);
}

let waiting = false;
export function later() {
    supersede();
    page.linked = false;
    if (waiting) return;
    if (page.resting === null && page.held === "") hold();
    waiting = true;
    requestAnimationFrame(() => {
        waiting = false;
        refuse(null);
        update(true);
    });
}
export let drawnRefusals = []; // as the pictures know them
export function refusalOf(setup) {
    const said = page.aside.known(commandOf("table", setup));
    return said?.status === REFUSED ? errorOf(said) : "";
}

export function showPicture() {
    const lines = pictureLines(), [, second] = $$("#picture figure");
    second.hidden = lines.length === 1;
    drawnRefusals = state.setups.map(refusalOf);
    const facts = page.facts = page.picture.set(lines.map((line, i) => ({ line, error: drawnRefusals[i] ?? "" })));
    showWorld(facts);
    showForce(facts);
    showHeadlines(facts);
    page.gpuPanel?.draw();
    page.gpuPanel?.follow();
    page.imagePanel?.follow();
    page.checkPanel?.follow();
}
