// SPDX-License-Identifier: GPL-3.0-or-later
// The flickering pictures: picture.c draws each frame, this shows them while they are seen. What the page gives:
//   views   of each picture { canvas, onStatus(text, state) }: a canvas of 640 x 360 with role="img" and a label; text is for
//           a polite live region and told when set-up, gap or what is seen changes, not each frame. state: { error, drawn,
//           hasMark }; error is the refusal of a set-up that cannot be drawn, or ""; drawn says what is drawn by what
//   slider  input type=range: its ends are no gap and the largest one of the first picture, whose guarantee is at three
//           quarters of it, where `hasMark` says that it is there
//   play    button, pressed while the camera moves (aria-pressed). The camera begins still: what flickers fills much of a
//           screen, and flashes more than three times a second (WCAG 2.2, 2.3.1)
//   gapIs   output beside the slider
// set(lines) takes the words of a command for each picture, fewer where fewer are seen: the same things at the same distance
// and gap. marks(on) paints wrong pixels yellow.
const LATELY = 120; // frames: as long as one of them was wrong, it flickers
const SLOW_MS = 6;  // where all pictures take longer than that, each frame of the page has one of them

function createView({ canvas, onStatus }, engine) {
    const { exports, memory, streams } = engine.instance();
    const context = canvas.getContext("2d");
    let made = "", error = "", image = null, quietFor = 0, said = "";

    function told(number) {
        const text = streams.text(number);
        streams.bytes = [[], [], []];
        return text;
    }

    return {
        exports,
        set(line) {
            if (made === line.join("\0")) return;
            made = line.join("\0");
            const bytes = new TextEncoder().encode(line.map((word) => word.replaceAll("\0", "\ufffd") + "\0").join(""));
            const room = exports.words(bytes.length); // may move the memory
            new Uint8Array(memory.buffer, room, bytes.length).set(bytes);
            error = exports.picture_set(line.length) === 0 ? "" : told(2).replace(/^depthprec: /, "").trim();
            said = "";
            if (error !== "") context.clearRect(0, 0, canvas.width, canvas.height);
        },
        loud: () => (quietFor = LATELY + 1), // what the last gap did counts no more
        draws: () => error === "",
        draw(gap, frame, painted, moves) {
            if (error === "") {
                const wrong = exports.picture_draw(gap, frame, painted ? 1 : 0);
                quietFor = wrong > 0 ? 0 : quietFor + (moves ? 1 : LATELY + 1);
                if (image?.data.buffer !== memory.buffer)
                    image = new ImageData(new Uint8ClampedArray(memory.buffer, exports.picture_pixels(), 640 * 360 * 4), 640, 360);
                context.putImageData(image, 0, 0);
            }
            const now = `${gap} ${error} ${quietFor > LATELY}`;
            if (now === said) return undefined;
            said = now;
            if (error === "") exports.picture_say(gap, quietFor > LATELY ? 1 : 0);
            const [as = "", text = error, drawn = ""] = told(1).split("\n");
            onStatus(text, { error, drawn, hasMark: exports.picture_marked() !== 0 });
            return as;
        },
    };
}

export function createPicture({ views, engine, slider, play, gapIs }) {
    const reduced = matchMedia("(prefers-reduced-motion: reduce)"), all = views.map((view) => createView(view, engine));
    const due = new Set(); // in the order in which they became so
    let shown = [], lines = [], place = 0, painted = false, moves = false, seen = true, frame = 0, begun = 0, waiting = 0, slow = false;

    function draw() {
        const [first] = all, gap = first.exports.picture_gap(place), now = [...due].slice(0, slow ? 1 : due.size), start = performance.now();
        for (const view of now) {
            due.delete(view);
            if (view !== first) view.set([...lines[all.indexOf(view)], "--at", String(first.exports.picture_z())]);
            const as = view.draw(gap, frame, painted, moves);
            if (view !== first || as === undefined) continue;
            gapIs.textContent = as;
            slider.setAttribute("aria-valuetext", as);
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

    function slide() {
        place = Number(slider.value) / Number(slider.max);
        for (const view of all) view.loud();
        soon();
    }

    slider.addEventListener("input", slide);
    play.addEventListener("click", () => move(!moves));
    reduced.addEventListener("change", () => reduced.matches && move(false));
    new IntersectionObserver((entries) => {
        seen = entries.at(-1).isIntersecting;
        begun = performance.now() - frame / 0.06;
        soon();
    }).observe(slider.closest("section"));
    slide();
    move(false);

    return {
        set(wanted) { // the others when it is their turn
            lines = wanted;
            all[0].set(lines[0]);
            shown = all.slice(0, all[0].draws() ? lines.length : 1);
            for (const view of all) if (!shown.includes(view)) due.delete(view);
            slide();
        },
        marks: (on) => ((painted = on), soon()),
        frame: () => frame,
        z: () => all[0].exports.picture_z(), // how far things are, 0 where nothing is drawn
    };
}
