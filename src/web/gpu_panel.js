// SPDX-License-Identifier: GPL-3.0-or-later
// What the visitor's own GPU does: measured, drawn beside the model's picture, and running a function of the visitor's. All
// of it is a command of the module's in the page's worker, see gpu.js; nothing of it leaves the page.
import { plain } from "./command.js";

export const profile = { json: "", brief: "" }; // of this GPU

// A profile in words, where set-up A is otherwise, and where a GPU that is known is.
function createProfile({ $, make, setup, force, take }, place, which) {
    place.append($("#known").content.cloneNode(true));
    const [answer, status] = place.querySelectorAll("[role=status]"), use = $("button", place), select = $("select", place);
    const [body, table] = place.querySelectorAll("[role=region]");
    body.setAttribute("aria-label", `What was measured of ${which}`);
    table.setAttribute("aria-label", `Where ${which} is not as that one`);
    let facts = null, found = {}, known = [];

    // The options of set-up A that the page takes, and what each is of this GPU.
    function follow() {
        const { model, arith: here } = force() ?? {};
        if (facts === null) return;
        const { arith, raster, findings } = facts;
        const stored = findings.filter(({ key, sure }) => key === "stored" && sure === "sure").map(({ format }) => format);
        const format = setup().get("format"), short = format?.replace("unorm", "d");
        const real = ["d16", "d24"].includes(short) && !stored.includes(short) && stored.includes("d32f");
        found = { ...(arith && { model: "float", arith }), ...(raster && { raster, viewport: setup().get("viewport") ?? "1920x1080" }),
            ...(real && { format: "fp32" }) };
        const own = model === "float" ? here : `the ${model} model`; // unknown of a set-up that is not drawn
        answer.textContent = `${model ? `Set-up A is computed by ${own}${real ? ` in ${format}` : ""}, ${which}` : `${which[0].toUpperCase()}${which.slice(1)}`} ${
            arith ? `computes as ${arith}` : "as no row that is known"}${real ? ` and stores fp32 for it` : ""}${
            raster ? `, its triangles are those of ${raster}` : ", its triangles of no row that is known"}.`;
        use.hidden = Object.entries(found).every(([name, value]) => setup().get(name) === value);
    }

    function compare() {
        const { compared, differ } = known[select.selectedIndex], rows = [["Finding", "Expected", "Got"], ...differ];
        status.textContent = differ.length === 0 ? `All ${compared} findings are the same.` : `${differ.length} of ${compared} findings are otherwise:`;
        table.hidden = differ.length === 0;
        const [head, ...lines] = rows.map((row, i) => make("tr", {}, ...row.map((text, k) =>
            i > 0 && k > 0 ? make("td", {}, text) : make("th", { scope: i === 0 ? "col" : "row" }, text))));
        table.replaceChildren(make("table", {}, make("thead", {}, head), make("tbody", {}, ...lines)));
    }
    select.addEventListener("change", compare);
    use.addEventListener("click", () => take(found));

    return {
        follow,
        hide: () => (place.hidden = true),
        // What the module says of a profile: see profile.c.
        show(out) {
            const [text, json, brief, ...words] = out.split("\0").slice(0, -1);
            known = [];
            for (let i = 0; i < words.length;) {
                const [name, compared, count] = words.slice(i, (i += 3)), differ = [];
                while (differ.length < Number(count)) differ.push(words.slice(i, (i += 3)));
                known.push({ name, compared, differ });
            }
            known.sort((a, b) => a.differ.length / a.compared - b.differ.length / b.compared); // the nearest first
            facts = JSON.parse(json);
            body.textContent = text;
            select.replaceChildren(...known.map(({ name }) => make("option", {}, name)));
            place.hidden = false;
            follow();
            compare();
            return { json, brief };
        },
    };
}

// The page gives $ and make; aside; lines of the set-up as judge and the picture take it; what is in set-up A;
// force(), its model and arithmetic; take(options) changes it; frame() of the picture; shared(), the profile that the address has.
export function createGpuPanel({ $, make, aside, judged, pictured, setup, force, take, frame, shared }) {
    const ask = (line) => (aside.forget(line), aside.ask(line)); // a GPU may answer otherwise the next time
    const fault = ({ status, err }) => (status === 0 ? "" : plain(err.trim().replace(/^depthprec: /, "")));
    const [own, others] = [["#own", "this GPU"], ["#shared", "that GPU"]].map(([id, which]) => createProfile({ $, make, setup, force, take }, $(id), which));

    async function show(button, line, refused) {
        $(button).disabled = true;
        const said = await ask(line);
        $(button).disabled = false;
        $(refused).textContent = fault(said);
        return said;
    }

    $("#measure").addEventListener("click", async () => {
        $("#profile").hidden = true;
        own.hide();
        const said = await show("#measure", ["profile"], "#unmeasured");
        if (said.status !== 0) return;
        Object.assign(profile, own.show(said.out));
        $("#profile").hidden = false;
    });

    let carried = "";
    async function follow() {
        for (const one of [own, others]) one.follow();
        if (shared() === carried) return;
        carried = shared();
        others.hide();
        if (carried === "") return;
        const said = await aside.ask(["profile", carried]);
        if (said.status !== 0) return;
        others.show(said.out);
        $("#shared").scrollIntoView();
    }

    $("#judging").addEventListener("submit", async (event) => {
        event.preventDefault();
        const { status, out } = await show("#judging button", judged($("#glsl").value), "#unjudged");
        $("#judged").textContent = out;
        $("#judged").hidden = status !== 0;
    });

    // The picture follows the model's, one frame at a time.
    const figure = $("#by-gpu"), canvas = $("canvas", figure), context = canvas.getContext("2d");
    let draws = false, drawn = "";
    async function draw() {
        const line = ["seen", String(frame()), ...pictured()];
        if (figure.hidden || draws) return;
        if (line.join("\0") === drawn) return void ($("#play").getAttribute("aria-pressed") === "true" && requestAnimationFrame(draw));
        draws = true;
        drawn = line.join("\0");
        const said = await ask(line);
        aside.forget(line);
        draws = false;
        canvas.hidden = said.status !== 0;
        $("span", figure).textContent = fault(said) || said.err;
        if (said.status === 0) {
            const image = new ImageData(canvas.width, canvas.height);
            for (let i = 0; i < image.data.length; i++) image.data[i] = said.out.charCodeAt(i);
            context.putImageData(image, 0, 0);
        }
        draw();
    }
    $("#draw-gpu").addEventListener("click", () => {
        figure.hidden = !figure.hidden;
        $("#draw-gpu").setAttribute("aria-pressed", String(!figure.hidden));
        drawn = "";
        draw();
    });
    $("#play").addEventListener("click", draw);
    follow();
    return { draw, follow };
}
