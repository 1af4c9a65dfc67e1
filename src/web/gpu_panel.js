// SPDX-License-Identifier: GPL-3.0-or-later
// What the visitor's own GPU does: measured, drawn beside the model's picture, and running a function of the visitor's. All
// of it is a command of the module's in the page's worker, see gpu.js; nothing of it leaves the page.
import { plain } from "./command.js";

let profile = "";
export const profileText = () => profile;

// The page gives $; aside; lines of the set-up as judge and the picture take it; what is in set-up A; take(options)
// changes it; frame() of the picture.
export function createGpuPanel({ $, aside, judged, pictured, setup, take, frame }) {
    const ask = (line) => (aside.forget(line), aside.ask(line)); // a GPU may answer otherwise the next time
    const fault = ({ status, err }) => (status === 0 ? "" : plain(err.trim().replace(/^depthprec: /, "")));

    async function show(button, line, body, refused) {
        $(button).disabled = true;
        const said = await ask(line);
        $(button).disabled = false;
        $(refused).textContent = fault(said);
        $(body).textContent = said.out;
        $(body).hidden = said.status !== 0;
        return said.status === 0;
    }

    // The options of set-up A that the page takes, and what each is here.
    let found = {};
    function compare({ arith, raster, findings }) {
        const stored = findings.filter(({ key, sure }) => key === "stored" && sure === "sure").map(({ format }) => format);
        const format = setup().get("format"), short = format?.replace("unorm", "d");
        const real = ["d16", "d24"].includes(short) && !stored.includes(short) && stored.includes("d32f");
        found = { ...(arith && { model: "float", arith }), ...(raster && { raster, viewport: setup().get("viewport") ?? "1920x1080" }),
            ...(real && { format: "fp32" }) };
        const own = setup().get("model") === "float" ? (setup().get("arith") ?? "ieee") : "an exact model";
        $("#compared").textContent = `Set-up A is computed by ${own}${real ? ` in ${format}` : ""}, this GPU ${
            arith ? `computes as ${arith}` : "as no row that is known"}${real ? ` and stores fp32 for it` : ""}${
            raster ? `, its triangles are those of ${raster}` : ", its triangles of no row that is known"}.`;
        $("#use-gpu").hidden = Object.keys(found).length === 0;
    }

    $("#measure").addEventListener("click", async () => {
        for (const id of ["#profile", "#use-gpu"]) $(id).hidden = true;
        $("#compared").textContent = "";
        if (!(await show("#measure", ["probe"], "#measured", "#unmeasured"))) return;
        const said = await ask(["probe", "--json"]);
        $("#unmeasured").textContent = fault(said);
        if (said.status !== 0) return;
        profile = said.out;
        $("#profile").hidden = false;
        compare(JSON.parse(profile));
    });
    $("#use-gpu").addEventListener("click", () => take(found));

    $("#judging").addEventListener("submit", (event) => {
        event.preventDefault();
        show("#judging button", judged($("#glsl").value), "#judged", "#unjudged");
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
    return { draw };
}
