// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that print as those of tests/tap.sh do:  await test("what holds", async () => { throws where it does not });
let tests = 0, failures = 0;

export const note = (text) => console.log(String(text).replaceAll(/^/gm, "# "));

// The value that the check returns, if any, is noted: what was measured.
// With NAMED=WORDS those alone whose names have these words.
export async function test(name, check) {
    if (process.env.NAMED && !name.includes(process.env.NAMED)) return;
    tests++;
    try {
        const said = await check();
        console.log(`ok ${tests} - ${name}`);
        if (said !== undefined) note(said);
    } catch (error) {
        failures++;
        console.log(`not ok ${tests} - ${name}`);
        note(error.message.slice(0, 4000));
        if (!(error instanceof Refusal)) note(error.stack.split("\n").slice(1, 4).join("\n"));
    }
}

class Refusal extends Error {}

export function demand(truth, message) {
    if (!truth) throw new Refusal(message);
}

export function finish() {
    console.log(`1..${tests}`);
    process.exitCode = failures === 0 ? 0 : 1;
}
