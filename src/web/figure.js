// SPDX-License-Identifier: GPL-3.0-or-later
// What lies over a figure: a crosshair at a depth, a requirement that is dragged, what fails of it, and the curves of
// before. Where things lie the figure says itself: its metadata hold its axes, its first clip the frame.
import { page } from "./state.js";

const SVG_NS = "http://www.w3.org/2000/svg", GRID = 1000;

// { frame: { x, y, w, h }, size: [w, h], x, y }: of each axis { key, log, lo, hi, text }; null where a figure has none.
export function readFigure(svg) {
    const axes = /\naxes: (\S+) (\S+) (\S+) (\S+), (\S+) (\S+) (\S+) (\S+)\n/.exec(svg)?.slice(1);
    const at = /<rect x="([^"]+)" y="([^"]+)" width="([^"]+)" height="([^"]+)"\/><\/clipPath>/.exec(svg)?.slice(1).map(Number);
    if (!axes || !at) return null;
    const axis = (/** @type {string[]} */ [key, scale, lo, hi]) => ({ key, log: scale === "log", lo: Number(lo), hi: Number(hi), text: `${lo}:${hi}` });
    return {
        frame: { x: at[0], y: at[1], w: at[2] - 1, h: at[3] - 1 }, // the clip is a pixel wider
        size: /width="(\d+)" height="(\d+)"/.exec(svg).slice(1).map(Number),
        x: axis(axes.slice(0, 4)), y: axis(axes.slice(4)),
    };
}

const shareOf = ({ log, lo, hi }, value) => (log ? Math.log(value / lo) / Math.log(hi / lo) : (value - lo) / (hi - lo));
const within = (t) => Math.min(Math.max(t, 0), 1);

const numberAt = ({ log, lo, hi }, t) => page.engine.numberAt(lo, hi, log, within(t));

export const stepAt = (axis, value) => Math.round(within(shareOf(axis, value)) * GRID);
export const numberOfStep = (axis, step) => numberAt(axis, step / GRID);

export function createOver(stage, { onCross, onAsk }) {
    const over = document.createElementNS(SVG_NS, "svg"), handle = document.createElement("button");
    over.setAttribute("aria-hidden", "true");
    handle.type = "button";
    handle.className = "handle";
    handle.setAttribute("aria-describedby", "handle-keys");
    stage.append(over, handle);
    let is = null, asked = null;

    const px = (value) => is.frame.x + within(shareOf(is.x, value)) * is.frame.w;
    const py = (value) => is.frame.y + (1 - within(shareOf(is.y, value))) * is.frame.h;
    const put = (name, attributes) => {
        const one = document.createElementNS(SVG_NS, name);
        for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
        over.append(one);
        return one;
    };
    const line = (kind, x1, y1, x2, y2) => put("line", { class: kind, x1, y1, x2, y2 });

    // Shares of the frame at a pointer.
    const at = ({ clientX, clientY }) => {
        const box = stage.getBoundingClientRect(), scale = is.size[0] / box.width;
        return [((clientX - box.left) * scale - is.frame.x) / is.frame.w, 1 - ((clientY - box.top) * scale - is.frame.y) / is.frame.h];
    };
    const ask = (x, y) => {
        const [depth, separation] = [numberAt(is.x, x), numberAt(is.y, y)];
        asked = { ...asked, at: Number(depth), separation: Number(separation) }; // the next key may come before it is shown
        onAsk(depth, separation);
    };
    stage.addEventListener("pointermove", (event) => {
        if (is === null) return;
        if (handle.hasPointerCapture(event.pointerId)) ask(...at(event));
        else if (event.target !== handle) onCross(numberAt(is.x, at(event)[0]));
    });
    stage.addEventListener("pointerdown", (event) => is !== null && event.target !== handle && onCross(numberAt(is.x, at(event)[0])));
    handle.addEventListener("pointerdown", (event) => (handle.setPointerCapture(event.pointerId), event.preventDefault(), handle.focus()));
    handle.addEventListener("keydown", (event) => {
        const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key] ?? [];
        if (x === undefined || asked === null) return;
        event.preventDefault();
        ask(shareOf(is.x, asked.at) + x / 50, shareOf(is.y, asked.separation) + y / 50);
    });

    // A requirement: a line up to its depth, and a bar for each set-up from where it fails.
    function showAsked() {
        const { at: depth, separation, reach } = asked, x = px(depth), y = py(separation), { x: left } = is.frame;
        line("asked", left, y, x, y);
        reach.filter(({ distance }) => !(distance >= depth)).forEach(({ letter, distance }, i) => {
            const from = distance === null ? left : px(distance);
            put("rect", { class: "fails", x: from, y: y + 11 * i - 2, width: x - from, height: 5 });
            put("text", { x: from + (distance === null ? 4 : -12), y: y + 11 * i + (distance === null ? 12 : 5) }).textContent = letter;
        });
        handle.style.left = `${(100 * x) / is.size[0]}%`;
        handle.style.top = `${(100 * y) / is.size[1]}%`;
        handle.setAttribute("aria-label", asked.says);
    }

    return {
        // Takes what readFigure() returned, or null; a depth; a requirement { at, separation, says, reach: [{ letter, distance }] }.
        show(figure, depth, wanted) {
            is = figure;
            asked = figure !== null && figure.y.key === "interval" && wanted.at > 0 && wanted.separation > 0 ? wanted : null;
            over.replaceChildren();
            handle.hidden = asked === null;
            over.toggleAttribute("hidden", is === null);
            if (is === null) return;
            over.setAttribute("viewBox", `0 0 ${is.size.join(" ")}`);
            line("cross", px(depth), is.frame.y, px(depth), is.frame.y + is.frame.h);
            if (asked !== null) showAsked();
        },
    };
}
