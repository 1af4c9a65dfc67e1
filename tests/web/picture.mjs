// SPDX-License-Identifier: GPL-3.0-or-later
// When picture.js says that a picture flickers: frames come from this file, with as many wrong pixels as it wants.
//     node picture.mjs PICTURE_JS
import assert from "node:assert/strict";

const frames = [];
globalThis.requestAnimationFrame = (work) => frames.push(work);
globalThis.matchMedia = () => ({ matches: false, addEventListener() {} });
globalThis.IntersectionObserver = class { observe() {} };
globalThis.ImageData = class { constructor(data) { this.data = data; } };
const { createPicture } = await import(process.argv[2]);

const element = (more) => ({ listeners: {}, addEventListener(name, work) { this.listeners[name] = work; }, setAttribute() {}, closest: () => null, ...more });
const memory = { buffer: new ArrayBuffer(640 * 360 * 4) }, play = element({ closest: () => null });
let wrong = 0, told = "", quiet, time = 0, drawn = 0;
const exports = { words: () => 0, picture_set: () => ((told = '{"name": "camera"}'), 0), picture_pixels: () => 0,
    picture_draw: () => (drawn++, wrong), picture_say: (still) => { told = `text ${still}`; quiet = still === 1; } };
const engine = { write() {}, instance: () => ({ exports, memory, streams: { text: () => told } }) };
const canvas = { width: 640, height: 360, getContext: () => ({ putImageData() {} }) };
const picture = createPicture({ views: [{ canvas, onStatus() {} }], engine, play });
assert.equal(picture.set([{ line: ["2cm", "200m", "table"], error: "" }])[0].name, "camera", "what is known of it");

// So many frames, 1/60 s apart, each with so many wrong pixels.
function draw(count, pixels) {
    wrong = pixels;
    for (const before = drawn; drawn < before + count;) {
        assert.ok(frames.length > 0, "no frame is drawn");
        frames.shift()((time += 1000 / 60));
    }
}

draw(1, 0);
assert.equal(quiet, true, "a still picture without a wrong pixel does not flicker");
picture.marks(true);
draw(1, 7);
assert.equal(quiet, false, "a still picture with wrong pixels is told at once");
picture.marks(false);
draw(1, 0);
assert.equal(quiet, true, "and that it has none any more, too");
time = performance.now();
play.listeners.click();
draw(1, 7);
assert.equal(quiet, false, "a wrong pixel while the camera moves");
draw(119, 0);
assert.equal(quiet, false, "it counts for 120 frames");
draw(2, 0);
assert.equal(quiet, true, "and no longer");
draw(1, 7);
play.listeners.click();
draw(1, 0);
assert.equal(quiet, true, "a camera that stops says at once what the still picture is");

// A set-up that is refused has no picture, and says why.
assert.equal(picture.set([{ line: ["2cm", "200m", "table"], error: "no" }])[0].error, "no");
const before = drawn;
for (const step of frames.splice(0)) step((time += 1000 / 60));
assert.ok(drawn === before && canvas.hidden, "a picture of a set-up that is refused");
