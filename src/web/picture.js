// SPDX-License-Identifier: GPL-3.0-or-later
// The flickering picture: picture.c draws each frame, this shows it while it is seen. What the page gives:
//   canvas  640 x 360, role="img" and a label
//   slider  input type=range: its ends are no gap and the largest one; the guarantee is at three quarters of it, where
//           `hasMark` of a state says that it is there (for a datalist or a line)
//   play    button, pressed while the camera moves (aria-pressed); its text may stay. The camera begins still: what
//           flickers fills much of a screen, and flashes more than three times a second (WCAG 2.2, 2.3.1)
//   gapIs   output beside the slider
//   onStatus(text, state)  text for a polite live region: told when set-up, gap or what is seen changes, not each frame.
//           state: { error, gap, drawn, hasMark, guaranteed }; error is the refusal of a set-up that cannot be drawn, or "";
//           drawn says what is drawn by what: for the caption
// slider, play and gapIs may be missing; the canvas may be hidden while there is an error. set(words, place) takes a command and, where given, a place of 0 to 1 on the
// slider; start(), stop() move the camera, still() draws one frame, marks(on) paints wrong pixels yellow.
export function createPicture({ canvas, engine, slider, play, gapIs, onStatus = () => {} }) {
    const { exports, memory, streams } = engine.instance();
    const context = canvas.getContext("2d"), reduced = matchMedia("(prefers-reduced-motion: reduce)");
    const LATELY = 120; // frames: as long as one of them was wrong, it flickers
    let words = null, asked = null, place = 0.4, painted = false, moves = false, seen = true, error = "";
    let image = null, frame = 0, quietFor = 0, begun = 0, waiting = 0, said = "";

    function told(number) {
        const text = streams.text(number);
        streams.bytes = [[], [], []];
        return text;
    }

    function make() {
        const bytes = new TextEncoder().encode(asked.map((word) => word.replaceAll("\0", "\ufffd") + "\0").join(""));
        new Uint8Array(memory.buffer, exports.words(bytes.length), bytes.length).set(bytes);
        error = exports.picture_set(asked.length) === 0 ? "" : told(2).replace(/^depthprec: /, "").trim();
        words = asked;
        said = "";
        if (error !== "") context.clearRect(0, 0, canvas.width, canvas.height);
    }

    function say() {
        if (error === "") exports.picture_say(place, quietFor > LATELY ? 1 : 0);
        const [gap = "", text = error, drawn = ""] = told(1).split("\n"), guaranteed = exports.picture_safe(place) !== 0;
        if (gapIs) gapIs.textContent = gap;
        if (slider) slider.setAttribute("aria-valuetext", gap);
        onStatus(text, { error, gap, drawn, guaranteed, hasMark: exports.picture_marked() !== 0 });
    }

    function draw() {
        if (asked !== words) make();
        if (error === "") {
            const wrong = exports.picture_draw(place, frame, painted ? 1 : 0);
            quietFor = wrong > 0 ? 0 : quietFor + (moves ? 1 : LATELY + 1);
            if (image?.data.buffer !== memory.buffer)
                image = new ImageData(new Uint8ClampedArray(memory.buffer, exports.picture_pixels(), 640 * 360 * 4), 640, 360);
            context.putImageData(image, 0, 0);
        }
        const now = `${place} ${error} ${quietFor > LATELY}`;
        if (now !== said) say();
        said = now;
    }

    function step(time) {
        waiting = 0;
        const next = Math.floor((time - begun) * 0.06);
        if (next !== frame || !moves || asked !== words) {
            frame = moves ? next : frame;
            draw();
        }
        if (moves && error === "") soon();
    }

    function soon() {
        if (waiting === 0 && (seen || error !== "") && asked !== null) waiting = requestAnimationFrame(step);
    }

    function move(on) {
        moves = on;
        begun = performance.now() - frame / 0.06;
        play?.setAttribute("aria-pressed", String(on));
        soon();
    }

    function put(at) {
        place = at;
        quietFor = LATELY + 1; // what the last gap did counts no more
        soon();
    }

    const slide = () => put(Number(slider.value) / Number(slider.max));

    slider?.addEventListener("input", slide);
    play?.addEventListener("click", () => move(!moves));
    reduced.addEventListener("change", () => reduced.matches && move(false));
    new IntersectionObserver((entries) => {
        seen = entries.at(-1).isIntersecting;
        begun = performance.now() - frame / 0.06;
        soon();
    }).observe(canvas);
    if (slider) slide();
    move(false);

    return {
        set(command, at) {
            asked = [...command];
            if (at !== undefined && slider) slider.value = at * Number(slider.max);
            put(at ?? place);
        },
        start: () => move(true),
        stop: () => move(false),
        still: () => (move(false), asked === null ? undefined : draw()),
        marks: (on) => ((painted = on), soon()),
    };
}
