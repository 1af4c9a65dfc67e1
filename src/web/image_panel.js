// SPDX-License-Identifier: GPL-3.0-or-later
// A depth image of the visitor's: chosen or dropped anywhere on the page, shown, recognised, and what a pixel of it means to
// set-up A. image.js reads it, in the worker; what a depth means is said by the command.
import { sheet } from "./sheet.js";

// The page gives $; aside; setup() and line(depth) of set-up A, and take(options), which changes it; narrow(), whether there
// is no room; otherWay, mappings that are turned round.
export function createImagePanel({ $, aside, setup, line, take, narrow, otherWay }) {
    const canvas = $("#image canvas"), context = canvas.getContext("2d");
    let image = null, at = [0, 0], asked = [], files = 0;

    // Holes are left out.
    function paint() {
        const { width, height, values, lo, hi } = image;
        canvas.width = Math.min(width, 640);
        canvas.height = Math.max(1, Math.round((canvas.width * height) / width));
        const pixels = new ImageData(canvas.width, canvas.height);
        for (let y = 0, to = 0; y < canvas.height; y++)
            for (let x = 0; x < canvas.width; x++, to += 4) {
                const v = values[Math.floor(((y + 0.5) * height) / canvas.height) * width + Math.floor(((x + 0.5) * width) / canvas.width)];
                pixels.data.fill(255 * ((v - lo) / (hi - lo || 1)), to, to + 3);
                pixels.data[to + 3] = Number.isNaN(v) ? 0 : 255;
            }
        context.putImageData(pixels, 0, 0);
    }

    async function showPixel() {
        const [x, y] = at, v = image.values[y * image.width + x], name = `Pixel ${x},${y}`, mine = line(String(v));
        const tell = (text, ...more) => mine === asked && $("#pixel").replaceChildren(text, ...more);
        aside.leave(asked);
        asked = mine;
        if (Number.isNaN(v)) return tell(`${name} is a hole.`);
        if (!image.depth) return tell(`${name} holds ${v}.`);
        const said = await aside.ask(mine);
        if (said.status !== 0) return tell(`${name} holds ${v}. ${said.err.trim().replace(/^depthprec: /, "")}`);
        const coarse = image.exact ? "" : " Its samples are not the buffer’s codes, and so may be off by more than the cell says: texture --pixel of the program counts that.";
        tell(`${name}, by set-up A:${coarse}`, ...sheet(said.out, narrow()).filter(({ tagName }) => tagName === "TABLE"));
    }

    function move(x, y) {
        const inside = (v, size) => Math.max(0, Math.min(size - 1, v));
        at = [inside(x, image.width), inside(y, image.height)];
        showPixel();
    }

    async function open(file) {
        const mine = ++files, key = ["image", String(mine)], said = await aside.ask(key, Infinity, file);
        aside.forget(key);
        if (mine !== files) return;
        $("#unread").textContent = said.status === 0 ? "" : `${file.name} ${said.err.trim()}`;
        for (const id of ["#recognised", "#pixel", "#image canvas"]) $(id).hidden = said.status !== 0;
        $("#image").scrollIntoView({ block: "nearest" });
        if (said.status !== 0) return;
        image = said;
        paint();
        $("#recognised").textContent = `${file.name}, ${image.width} x ${image.height}: ${image.why}.`;
        const { format, mapping } = Object.fromEntries(setup()), turned = image.reversed >= 0 && /reversed/.test(mapping) !== (image.reversed > 0);
        if (image.depth && (format !== image.format || (turned && mapping in otherWay)))
            take({ format: image.format, ...(turned && mapping in otherWay && { mapping: otherWay[mapping] }) });
        move(image.width >> 1, image.height >> 1);
    }

    canvas.addEventListener("pointermove", ({ offsetX, offsetY }) =>
        move(Math.floor((offsetX * image.width) / canvas.clientWidth), Math.floor((offsetY * image.height) / canvas.clientHeight)));
    canvas.addEventListener("keydown", (event) => {
        const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key] ?? [];
        if (x === undefined) return;
        event.preventDefault();
        move(at[0] + x, at[1] + y);
    });
    $("#file").addEventListener("change", () => $("#file").files[0] && open($("#file").files[0]));
    for (const when of ["dragover", "drop"])
        addEventListener(when, (event) => {
            if (!event.dataTransfer.types.includes("Files")) return;
            event.preventDefault();
            if (when === "drop") open(event.dataTransfer.files[0]);
        });
    return { follow: () => image !== null && showPixel() };
}
