// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that take long run beside the page, in a worker that has the same script and the same compiled module. A page
// from file:// may load no other file, so that the worker's is a blob of the page's own.
import { load } from "./engine.js";

export const inWorker = typeof document === "undefined";

// The worker's side: the module comes first, then lines, each answered by what the command said.
export function serve(measure) {
    let engine;
    onmessage = async ({ data: { module, line } }) => {
        engine ??= await load(module);
        engine.measure = measure;
        postMessage(engine.run(line));
    };
}

// The page's side. run(line) tells in time what the command says, or null: where no worker can be made, where it fails,
// or where stop() came first. One line at a time.
export function createAside(module) {
    const source = document.querySelector("script[type=module]").textContent;
    let address = null, worker = null, answer = null, works = true;

    function end(said) {
        const to = answer;
        answer = null;
        to?.(said);
    }

    function fail() {
        works = false;
        worker?.terminate();
        worker = null;
        end(null);
    }

    function make() {
        address ??= URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
        worker = new Worker(address); // no module: from file:// none loads as a blob
        worker.onmessage = ({ data }) => end(data);
        worker.onerror = worker.onmessageerror = (event) => (event.preventDefault(), fail());
    }

    return {
        run: (line) => new Promise((resolve) => {
            if (!works) return resolve(null);
            answer = resolve;
            try {
                if (worker === null) make();
                worker.postMessage({ module, line });
            } catch {
                fail();
            }
        }),

        // Leaves what runs: nobody waits for it any more.
        stop() {
            if (answer === null) return;
            worker?.terminate();
            worker = null;
            end(null);
        },
    };
}
