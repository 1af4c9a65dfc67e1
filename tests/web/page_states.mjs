// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says is what the program says, to the byte: random commands in the browser's own WebAssembly, and by the
// way of a person: a link opened, a command pasted, a number read, a file saved.
import { readFileSync } from "node:fs";
import { address, close, go, open, settled, shown } from "./browser.mjs";
import { difference, native } from "./native.mjs";
import { plain } from "./plain.mjs";
import { named, random, state } from "./states.mjs";
import { demand, note, test } from "./tap.mjs";

const FORMS = ["--json", "--csv", "--full", "-v"]; // what the page leaves to its own buttons, or to the program

// The words of a shell's line as --link and the page write it.
export const words = (line) => line.match(/(?:'[^']*'|\\.|[^\s'\\])+/g).map((word) => word.replace(/'([^']*)'|\\(.)/g, "$1$2"));

async function engines(page, r, count) {
    let fine = 0, different = 0;
    const first = [];
    for (let done = 0; done < count;) {
        const batch = Array.from({ length: Math.min(250, count - done) }, () => state(r));
        const [there, here] = await Promise.all([native(batch),
            page.evaluate((list) => list.map((line) => window.depthprec.engine.run(line)), batch)]);
        batch.forEach((line, i) => {
            const what = difference(there[i], here[i]);
            fine += there[i].status < 2 ? 1 : 0;
            if (what !== "" && different++ < 5) first.push(`depthprec ${line.join(" ")}\n    ${what}`);
        });
        done += batch.length;
    }
    demand(different === 0, `${different} of ${count} differ:\n${first.join("\n")}`);
    demand(fine > count / 3, `only ${fine} of ${count} run`);
    return `${count} commands, ${fine} of them run, the others are refused alike`;
}

// The sentence of a refusal, in the page without the name of the program.
const refusal = ({ status, err }) => (status === 2 ? err.trim().replace(/^depthprec: /, "") : "");

// A command that its time ended: how much of it there is, a busy machine decides.
export const isEnded = (error) => error.includes("takes longer than 10 s here");

// Each text that is shown is what the program prints for the words beside it; so is what it refuses.
async function compareShown(page, what) {
    const now = await shown(page), runs = now.runs.filter((one) => one.panel !== "plot");
    const there = await native(runs.map((one) => words(one.run)));
    runs.forEach((one, i) => {
        const here = { out: one.text, err: one.refused };
        const wrong = isEnded(one.refused) ? "" : difference({ out: plain(there[i].out), err: plain(refusal(there[i])) }, here);
        demand(wrong === "", `${what}: depthprec ${one.run}\n    ${wrong}`);
    });
    return { now, count: runs.filter((one) => !isEnded(one.refused)).length };
}

// One command, by its link or pasted: the page shows it, or refuses it in the program's words and stays as it is.
async function setOne(page, line, link, there, byLink) {
    const verb = line[0], what = line.join(" "), before = await shown(page);
    await (byLink && link.status === 0 ? go(page, link.out.trim().split("#")[1]) : paste(page, line));
    const refused = link.status !== 0 || (verb !== "plot" && there.status === 2);
    if (refused) {
        const now = await shown(page), why = refusal(link.status !== 0 ? link : there);
        demand(now.error !== "" && now.link === before.link, `refused by the program, not by the page: ${what}`);
        demand(why.startsWith("--link: ") || now.error === why, `${what}: ${why}\n${now.error}`);
        return 0;
    }
    const { now, count } = await compareShown(page, what);
    demand(now.error === "" || isEnded(now.error), `${what}: ${now.error}`);
    const own = now.runs.find((one) => one.panel === verb);
    demand(own !== undefined, `${what}: there is no panel ${verb}`);
    if (verb !== "plot" && !isEnded(own.refused)) demand(own.text === plain(there.out), `${what}: shown is ${own.run}`);
    return count;
}

async function people(page, r, count) {
    const lines = Array.from({ length: count }, () => state(r).filter((word) => !FORMS.includes(word)));
    const links = await native(lines.map((line) => [`--link=${address}`, ...line]));
    const plain = await native(lines);
    let set = 0, compared = 0;
    for (let i = 0; i < count; i++) {
        const some = await setOne(page, lines[i], links[i], plain[i], i % 2 === 0);
        set += some > 0 ? 1 : 0;
        compared += some;
    }
    demand(set > count / 4, `only ${set} of ${count} set the page`);
    return `${set} commands set the page, ${count - set} are refused; ${compared} texts compared`;
}

// A state without pairs of depths and maps, which take seconds.
function quick(r) {
    const line = state(r).filter((word) => !FORMS.includes(word));
    return line[0] === "zfight" || line.includes("map") ? quick(r) : line;
}

const quoted = (line) => line.map((word) => (/^[\w.,:=%+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`)).join(" ");

export async function paste(page, line) {
    await page.evaluate((text) => new Promise((done) => {
        const field = document.querySelector("#command"), { dataset } = document.documentElement, before = dataset.updates;
        field.value = JSON.parse(text); // halves of characters, too
        field.form.requestSubmit();
        const wait = () => (dataset.updates !== before && dataset.updates === dataset.settled ? done() : setTimeout(wait, 1));
        wait();
    }), JSON.stringify(typeof line === "string" ? line : quoted(line)));
}

// The link and the commands that the page shows bring it back, and the program takes them.
const commandsOf = (hash) => decodeURIComponent(hash.slice(1)).split(" ; ");

async function thereAndBack(page, r, count) {
    let refused = 0;
    for (let i = 0; i < count; i++) {
        await paste(page, quick(r));
        const before = await shown(page);
        if (before.error !== "") {
            i--;
            continue;
        }
        await settled(page);
        const { hash } = new URL(page.url());
        const said = commandsOf(hash).map((text) => `depthprec ${text}`), all = before.link.split("\n");
        demand(said.every((text) => all.includes(text) || text.startsWith("depthprec page ")) || said[0] !== all[0],
            `the link says what the page does not: ${hash}`);
        if (said[0] !== all[0]) { // a set-up that is refused has no link
            demand(++refused < 10 * count, "hardly a state has a link");
            i--;
            continue;
        }
        const other = await open({ fragment: hash.slice(1) });
        const after = await shown(other);
        await close(other);
        for (const part of ["error", "link", "runs"])
            demand(JSON.stringify(before[part]) === JSON.stringify(after[part]),
                `${part}: ${hash}\n${JSON.stringify(before[part], null, 1)}\n${JSON.stringify(after[part], null, 1)}`);
        const taken = await native(before.link.split("\n").map((text) => ["--link", ...words(text).slice(1)]));
        demand(taken.every((one) => one.status === 0), `${before.link}: ${taken.map((one) => one.err).join("")}`);
    }
    return `${count} links`;
}

// Files saved: the bytes that the program prints.
async function files(r, count) {
    let saved = 0;
    for (let i = 0; i < count; i++) {
        const page = await open(), ten = i % 2 === 0 ? [0, 10] : [-10]; // a browser asks before a page saves more
        await paste(page, quick(r));
        for (const button of (await page.locator("[data-export]:not([data-export=copy]):visible").all()).slice(...ten)) {
            const kind = await button.getAttribute("data-export");
            const run = await button.evaluate((one) => one.closest("[data-run]").dataset.run);
            const [download] = await Promise.all([page.waitForEvent("download"), button.click()]).catch(() => demand(false, `${run} --${kind}: nothing is saved`));
            const bytes = readFileSync(await download.path(), "utf8");
            if (kind === "png") {
                const png = readFileSync(await download.path()), width = png.readUInt32BE(16);
                demand(png.toString("latin1", 1, 4) === "PNG" && width >= 640 && png.length > 1000, `${run}: no PNG`);
            } else if (kind === "svg") {
                const root = await page.evaluate((text) => new DOMParser().parseFromString(text, "image/svg+xml").documentElement.nodeName, bytes);
                demand(root === "svg" && bytes.length > 1000, `${run}: no SVG`);
            } else {
                const [there] = await native([[...words(run), `--${kind}`]]);
                demand(there.out === bytes, `${run} --${kind}: ${difference(there, { ...there, out: bytes })}`);
            }
            demand(download.suggestedFilename().endsWith(`.${kind}`), download.suggestedFilename());
            saved++;
        }
        await close(page);
    }
    demand(saved >= 2 * count, `only ${saved} files`);
    return `${saved} files`;
}

export async function states(seed, share) { // a share of all cases
    const r = random(seed), cases = (all) => Math.ceil(all * share);
    let page = await open();
    named();
    note(`seed ${seed}`);
    await test("random commands in the browser are the program's, to the byte", () => engines(page, r, cases(10000)));
    await test("a link or a command sets the page, and what is shown is what the program prints", () => people(page, r, cases(100)));
    await close(page);
    page = await open(); // what was asked before stays shown
    await test("the page's own link and commands bring it back", () => thereAndBack(page, r, cases(10)));
    await test("what is saved is what the program prints", () => files(r, cases(8)));
    await close(page);
}
