// SPDX-License-Identifier: GPL-3.0-or-later
// Commands run beside the page, in a worker that has the same script and the same compiled module, one at a time and each
// once. A page from file:// may load no other file, so that the worker's is a blob of the page's own.
import { load } from "./engine.js";
import { gpu } from "./gpu.js";
import { answer } from "./image.js";

export const inWorker = typeof document === "undefined";

// The worker's side: the module, then a line, answered by what the command says, or by what a file says of it.
export function serve(measure) {
    let engine;
    onmessage = async ({ data: { module, line, most, file } }) => {
        engine ??= await load(module);
        engine.measure = measure;
        engine.gpu = gpu;
        const said = file ? await answer(engine, file, line.slice(line.lastIndexOf("--") + 1)) : engine.run(line, most, true);
        postMessage(said, { transfer: said.values ? [said.values.buffer] : [] });
    };
}

// A driver may take long, so that a GPU has the time that the program gives it.
const LIMITS_S = { profile: 60, judge: 60 };
export const limitOf = ([verb]) => LIMITS_S[verb] ?? 10;
const PATIENCE_MS = 60, REMEMBERED = 24;
const keyOf = (line) => line.join("\0");
const refusal = (text) => ({ status: 2, out: "", err: `depthprec: ${text}; the program itself has no limit` });

// The page's side. `here` runs a line on the page's own thread, where no worker can be made; onSaid(line, ms) is told of
// each answer, onRun(line) of each that begins, null where none is left.
export function createAside(module, { here, onSaid, onRun }) {
    const source = document.querySelector("script[type=module]").textContent;
    const last = new Map(); // what the last commands said
    let address = null, worker = null, works = true, now = null, wanted = [], asked = [];

    function remember(key, said) {
        last.delete(key);
        last.set(key, said);
        if (last.size > REMEMBERED) last.delete(last.keys().next().value);
    }

    function halt() {
        worker?.terminate();
        worker = null;
    }

    function drop() {
        for (const timer of now.timers) clearTimeout(timer);
        now = null;
        halt();
    }

    function end(said) {
        const { key, line, begun, timers } = now, ms = performance.now() - begun;
        for (const timer of timers) clearTimeout(timer);
        now = null;
        remember(key, said);
        for (const one of asked) if (one.key === key) one.resolve(said);
        asked = asked.filter((one) => one.key !== key);
        onSaid(line, ms);
        next();
    }

    function refuse(text) {
        halt();
        end(refusal(text));
    }

    function fail() {
        works = false;
        halt();
        if (now !== null) setTimeout(() => end(now.file ? refusal("cannot be read here: this browser makes no worker") : here(now.line, now.most)));
    }

    function make() {
        address ??= URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
        worker = new Worker(address); // no module: from file:// none loads as a blob
        worker.onmessage = ({ data }) => end(data);
        for (const what of ["error", "messageerror"]) worker.addEventListener(what, (event) => (event.preventDefault(), fail()));
    }

    function next() {
        if (now !== null) return;
        const one = asked[0] ?? wanted.find(({ key }) => !last.has(key));
        onRun(one?.line ?? null);
        if (one === undefined) return;
        now = { ...one, begun: performance.now(), timers: [] };
        if (!works) return fail();
        const limit = limitOf(one.line);
        now.timers.push(setTimeout(() => refuse(`takes longer than ${limit} s here`), limit * 1000));
        try {
            if (worker === null) make();
            worker.postMessage({ module, line: one.line, most: one.most, file: one.file });
        } catch {
            fail();
        }
    }

    const needed = () => [...asked, ...wanted].some(({ key }) => key === now.key);

    return {
        known(line) {
            const key = keyOf(line), said = last.get(key);
            if (said !== undefined) remember(key, said); // again
            return said;
        },

        // The lines that the page shows and the most bytes of each, the first most urgent. What runs for nobody any more
        // has a moment left.
        want(lines) {
            wanted = lines.map(([line, most]) => ({ key: keyOf(line), line, most }));
            if (now !== null && works && !needed())
                now.timers.push(setTimeout(() => needed() || (drop(), next()), Math.max(0, PATIENCE_MS + now.begun - performance.now())));
            next();
        },

        // Asks what a line says, or what a file { id, file, words } says of it, before all that is wanted.
        ask: (line, most = Infinity, file = undefined) => new Promise((resolve) => {
            const key = keyOf(line), said = last.get(key);
            if (said !== undefined && !(said.left > 0)) return resolve(said);
            asked.push({ key, line, most, file, resolve });
            next();
        }),

        // The answer to a line counts no more.
        forget: (line) => last.delete(keyOf(line)),

        // Nobody wants to know that line any more: it is refused at once, and ends unless it is wanted.
        leave(line) {
            const key = keyOf(line);
            for (const one of asked) if (one.key === key) one.resolve(refusal("was left"));
            asked = asked.filter((one) => one.key !== key);
        },

        // Ends what runs, as if it took too long.
        cancel: () => now !== null && works && refuse("was cancelled"),
    };
}
