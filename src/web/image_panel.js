// SPDX-License-Identifier: GPL-3.0-or-later
// A depth image of the visitor's: chosen or dropped anywhere on the page, and asked what the command texture asks: what its
// samples are. What it holds, and how far a pixel may be off, is said by the module; image.js opens it there, in the worker.
import { plain, split } from "./command.js";

const WINDOW = "window", SIDE = 640;
const HOLDS = [
    ["", "as they are recognised"], [WINDOW, "window depth of set-up A’s camera"], ["--metric mm", "millimetres"],
    ["--metric tum", "lengths, 5000 to the metre"], ["--metric kitti", "lengths, 256 to the metre"], ["--metric 1m", "metres"],
];

// The page gives $ and make; aside; setup() of set-up A, and camera(names), those of its options as words; take(options),
// which changes it; otherWay, mappings that are turned round; packings, by name.
export function createImagePanel({ $, make, aside, setup, camera, take, otherWay, packings }) {
    const canvas = $("#image canvas"), context = canvas.getContext("2d"), holds = $("#holds");
    const option = (value, text) => make("option", { value }, text);
    holds.append(...HOLDS.map(([value, text]) => option(value, text)), ...packings.map((name) => option(`--packing ${name}`, `packed: ${name}`)));
    let file = null, files = 0, facts = null, bare = null, at = [0, 0], asked = [], shown = [];

    // Where nothing is said, the command looks whether they can be lengths alone; a camera says that they are not.
    function words() {
        const planes = camera(["near", "far", "ortho", "unit"]);
        if (holds.value === "") return facts?.window && facts.units.length === 0 ? [...planes, ...direction()] : [];
        if (holds.value === WINDOW) return [...planes, ...direction()];
        return [...(holds.value.startsWith("--metric") || holds.value.startsWith("--stereo") ? camera(["unit"]) : planes), ...split(holds.value)];
    }

    // Nobody has said what the samples are, and they may be lengths.
    const isOpen = () => facts.units.length > 0 && holds.value === "";

    // Set-up A's mapping, or the other way round where the image shows that.
    function direction() {
        const mapping = new Map(setup()).get("mapping"), turned = bare?.direction && /reversed/.test(mapping) !== bare.reversed;
        return mapping === undefined ? [] : ["-m", (turned && otherWay[mapping]) || mapping];
    }

    const lineOf = (said, ...what) => ["image", String(files), ...said, "--", ...what.map(String)];
    const ask = (said, ...what) => {
        const line = lineOf(said, ...what);
        return { line, answer: aside.ask(line, Infinity, { id: files, file, words: ["texture", file.name, ...said] }) };
    };
    const fault = ({ err }) => plain(err.trim().replace(`${file.name}: `, ""));

    async function paint() {
        const mine = shown, width = Math.min(facts.width, SIDE), height = Math.max(1, Math.round((width * facts.height) / facts.width));
        const said = await ask(mine, "paint", width, height, Number($("#errors").checked)).answer;
        if (mine !== shown || said.status !== 0) return;
        [canvas.width, canvas.height] = [width, height];
        context.putImageData(new ImageData(new Uint8ClampedArray(said.values), width, height), 0, 0);
        $("#painted").textContent = isOpen() ? "" : said.out;
    }

    async function showPixel() {
        aside.leave(asked);
        if (isOpen()) return void ($("#pixel").textContent = "");
        const { line, answer } = ask(shown, "pixel", ...at);
        asked = line;
        const said = await answer;
        if (asked === line && said.status === 0) $("#pixel").textContent = said.out;
    }

    function move(x, y) {
        const inside = (v, size) => Math.max(0, Math.min(size - 1, v));
        at = [inside(x, facts.width), inside(y, facts.height)];
        showPixel();
    }

    // What would be set in set-up A, which only this button does.
    function showUse() {
        const own = new Map(setup()), [, mapping] = direction(), other = { format: facts.format, ...(mapping && { mapping }) };
        const differs = facts.window && facts.differ && !isOpen() && Object.entries(other).some(([name, value]) => own.get(name) !== value);
        $("#use-image").hidden = !differs;
        $("#use-image").textContent = `Use ${Object.values(other).join(" ")} in set-up A`;
        $("#use-image").onclick = () => take(other);
    }

    function showFacts() {
        $("#recognised").textContent = `${file.name}, ${facts.width} x ${facts.height}: ${facts.says}`;
        $("#units").replaceChildren(...facts.units.map(({ option: value, text }) => {
            const button = make("button", { type: "button" }, `${value.replace(/^--/, "")}: ${text}`);
            button.addEventListener("click", () => {
                if (![...holds.options].some((one) => one.value === value)) holds.append(option(value, value.replace(/^--/, "")));
                holds.value = value;
                follow();
            });
            return button;
        }));
        for (const id of ["#recognised", "#seen"]) $(id).hidden = false;
        $("#seen").hidden = !facts.seen;
        $("#unread").textContent = "";
        showUse();
        paint();
        showPixel();
    }

    async function look(said) {
        const mine = (shown = said), answer = await ask(said, "says").answer;
        if (mine !== shown) return;
        if (answer.status !== 0) {
            facts = null;
            $("#unread").textContent = `${file.name}: ${fault(answer)}`;
            for (const id of ["#recognised", "#seen"]) $(id).hidden = true;
            return;
        }
        const first = facts === null;
        facts = JSON.parse(answer.out);
        bare ??= facts; // of no words: what the samples show by themselves
        if (first) at = [facts.width >> 1, facts.height >> 1];
        if (first && words().join("\0") !== said.join("\0")) return look(words()); // now that it is known to be window depth
        showFacts();
    }

    function follow() {
        if (file === null) return;
        const said = words();
        if (facts === null || said.join("\0") !== shown.join("\0")) look(said);
        else showUse();
    }

    function open(chosen) {
        [file, facts, bare] = [chosen, null, null];
        files++;
        holds.value = "";
        $("#samples").hidden = false;
        $("#image").scrollIntoView({ block: "nearest" });
        look(words());
    }

    holds.addEventListener("change", () => {
        facts = null;
        follow();
    });
    $("#errors").addEventListener("change", () => facts !== null && paint());
    canvas.addEventListener("pointermove", ({ offsetX, offsetY }) =>
        move(Math.floor((offsetX * facts.width) / canvas.clientWidth), Math.floor((offsetY * facts.height) / canvas.clientHeight)));
    canvas.addEventListener("keydown", (event) => {
        const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key] ?? [];
        if (x === undefined) return;
        event.preventDefault();
        move(at[0] + x, at[1] + y);
    });
    $("#file").addEventListener("change", () => $("#file").files[0] && open($("#file").files[0]));
    for (const when of ["dragover", "drop"])
        addEventListener(when, (/** @type {any} */ event) => {
            if (!event.dataTransfer.types.includes("Files")) return;
            event.preventDefault();
            if (when === "drop") open(event.dataTransfer.files[0]);
        });
    return { follow };
}
