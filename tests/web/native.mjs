// SPDX-License-Identifier: GPL-3.0-or-later
// The native program, many commands at once.
import { execFile } from "node:child_process";
import { availableParallelism } from "node:os";

const program = process.env.DEPTHPREC ?? "build/depthprec";

function one(words) {
    return new Promise((done) => {
        execFile(program, words, { argv0: "depthprec", maxBuffer: 1 << 28, env: { PATH: process.env.PATH } }, (error, out, err) =>
            done({ status: error ? (error.code ?? `signal ${error.signal}`) : 0, out, err }));
    });
}

// The program's answer to each command line, in order: [{ status, out, err }].
export async function native(commands) {
    const results = new Array(commands.length);
    let next = 0;
    const worker = async () => {
        while (next < commands.length) {
            const at = next++;
            results[at] = await one(commands[at]);
        }
    };
    await Promise.all(Array.from({ length: availableParallelism() }, worker));
    return results;
}

// How two results differ, in a line; "" where they are the same. The page knows fewer commands that would take an option.
export function difference(...results) {
    const [here, there] = results.map((said) => ({ ...said, err: said.err.replace(/(is not an option of \w+), but of .*/, "$1") }));
    for (const part of ["status", "err", "out"]) {
        if (here[part] === there[part]) continue;
        const a = String(here[part]).split("\n"), b = String(there[part]).split("\n"), line = a.findIndex((text, i) => text !== b[i]);
        return `${part}: native ${JSON.stringify(a[line] ?? a.length)}, here ${JSON.stringify(b[line] ?? b.length)}`;
    }
    return "";
}
