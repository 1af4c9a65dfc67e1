// SPDX-License-Identifier: GPL-3.0-or-later
// The flickering pictures: picture.c draws each frame, this shows them while they are seen. What the page gives:
//   views   of each picture { canvas, onStatus(text, drawn) }: a canvas of 640 x 360 with role="img" and a label; text is for
//           a polite live region and told when set-up, gap or what is seen changes, not each frame
//   play    button, pressed while the camera moves (aria-pressed). The camera begins still: what flickers fills much of a
//           screen, and flashes more than three times a second (WCAG 2.2, 2.3.1)
// set(lines) takes for each picture { line, error }: the gap, the distance and the words of a command, and why there can be no
// picture of it, or ""; it returns what is known of each: see picture.c, or { error }. marks(on) paints wrong pixels yellow.
const LATELY = 120; // frames: as long as one of them was wrong, it flickers
const SLOW_MS = 6;  // where all pictures take longer than that, each frame of the page has one of them

function createView({ canvas, onStatus }, engine) {
    const { exports, memory, streams } = engine.instance();
    const context = canvas.getContext("2d");
    let made = "", facts = {}, image = null, quietFor = 0, said = "";

    function told() {
        const text = [streams.text(1), streams.text(2)];
        streams.bytes = [[], [], []];
        return text;
    }

    return {
        set({ line, error }) {
            if (made === `${error}\0${line.join("\0")}`) return facts;
            made = `${error}\0${line.join("\0")}`;
            engine.write(line, { exports, memory });
            const refused = error !== "" || exports.picture_set(line.length) !== 0, [out, err] = told();
            facts = refused ? { error: error || err.replace(/^depthprec: /, "").trim() } : JSON.parse(out);
            quietFor = LATELY + 1; // what was before counts no more
            said = "";
            return facts;
        },
        draws: () => facts.name !== undefined,
        draw(frame, painted, moves) {
            const wrong = facts.error ? -1 : exports.picture_draw(frame, painted ? 1 : 0);
            canvas.hidden = wrong < 0;
            if (wrong >= 0) {
                quietFor = wrong > 0 ? 0 : quietFor + (moves ? 1 : LATELY + 1);
                if (image?.data.buffer !== memory.buffer)
                    image = new ImageData(new Uint8ClampedArray(memory.buffer, exports.picture_pixels(), 640 * 360 * 4), 640, 360);
                context.putImageData(image, 0, 0);
            }
            const now = String(quietFor > LATELY);
            if (now === said) return;
            said = now;
            if (!facts.error) exports.picture_say(quietFor > LATELY ? 1 : 0);
            onStatus(facts.error ?? told()[0], facts.name ?? "");
        },
    };
}

export function createPicture({ views, engine, play }) {
    const reduced = matchMedia("(prefers-reduced-motion: reduce)"), all = views.map((view) => createView(view, engine));
    const due = new Set(); // in the order in which they became so
    let shown = [], painted = false, moves = false, seen = true, frame = 0, begun = 0, waiting = 0, slow = false;

    function draw() {
        const now = [...due].slice(0, slow ? 1 : due.size), start = performance.now();
        for (const view of now) {
            due.delete(view);
            view.draw(frame, painted, moves);
        }
        slow = (performance.now() - start) * shown.length > SLOW_MS * now.length;
    }

    function step(time) {
        waiting = 0;
        const next = Math.floor((time - begun) * 0.06);
        if (next !== frame || !moves) {
            frame = moves ? next : frame;
            draw();
        }
        if (moves && shown.some((view) => view.draws())) soon();
        else if (due.size > 0) wait();
    }

    function wait() {
        if (waiting === 0 && seen) waiting = requestAnimationFrame(step);
    }

    function soon() {
        for (const view of shown) due.add(view);
        if (shown.length > 0) wait();
    }

    function move(on) {
        moves = on;
        begun = performance.now() - frame / 0.06;
        play.setAttribute("aria-pressed", String(on));
        soon();
    }

    play.addEventListener("click", () => move(!moves));
    reduced.addEventListener("change", () => reduced.matches && move(false));
    new IntersectionObserver((entries) => {
        seen = entries.at(-1).isIntersecting;
        begun = performance.now() - frame / 0.06;
        soon();
    }).observe(play.closest("section"));
    move(false);

    return {
        set(lines) {
            shown = all.slice(0, lines.length);
            for (const view of all) if (!shown.includes(view)) due.delete(view);
            const facts = shown.map((view, i) => view.set(lines[i]));
            soon();
            return facts;
        },
        marks: (on) => ((painted = on), soon()),
        frame: () => frame,
    };
}
