// SPDX-License-Identifier: GPL-3.0-or-later
// The page in Chromium, without a window and without a network. All that the page says on the console, and all that it
// asks for, is kept: none is allowed.
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const folder = process.env.B ?? "build";
const require = createRequire(resolve(folder, "web", "tests.js"));
const { chromium } = require("playwright-core");

export const axe = require.resolve("axe-core/axe.min.js");
export const address = pathToFileURL(resolve(folder, "depthprec.html")).href;
export const said = [], asked = [], dialogs = [];

const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
export const browser = await chromium.launch({ executablePath, headless: true, args: ["--no-sandbox", "--disable-gpu"] });

function listen(page) {
    page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
    page.on("pageerror", (error) => said.push(`uncaught: ${error.message}`));
    page.on("crash", () => said.push("the page crashed"));
    page.on("dialog", (dialog) => (dialogs.push(dialog.message()), dialog.dismiss()));
    page.on("request", (request) => {
        const url = request.url();
        if (url.split("#")[0] !== address && !url.startsWith("blob:") && !url.startsWith("data:")) asked.push(url);
    });
}

// What a page that was opened at no link has folded.
export const FOLDS = ["plot", "table", "solve", "bias", "code"];
const unfold = (page) => page.evaluate((names) => {
    if (document.querySelector("[data-panel][open]") === null) for (const name of names) document.querySelector(`[data-panel=${name}]`).open = true;
}, FOLDS);

// The page at a fragment, once it is ready, or at once; unfolded where all is folded.
export async function open({ fragment = "", theme = "light", width = 1600, height = 900, motion = "no-preference", mobile = false, wait = true, folded = false } = {}) {
    const context = await browser.newContext({ viewport: { width, height }, colorScheme: theme, reducedMotion: motion, hasTouch: mobile });
    const page = await context.newPage();
    listen(page);
    await page.goto(`${address}${fragment === "" ? "" : "#"}${fragment}`);
    if (wait) await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined, null, { timeout: 30000 });
    if (wait && !folded) {
        await unfold(page);
        await page.evaluate(() => new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 50)));
        await settled(page);
    }
    return page;
}

export const close = (page) => page.context().close();

// The page as it is shown: its error, its commands, and each output with the words that made it.
export const shown = (page) => page.evaluate(() => {
    const error = document.querySelector("#error");
    return {
        error: error.hidden ? "" : error.textContent,
        link: document.querySelector("#link").textContent,
        runs: [...document.querySelectorAll("[data-run]")].filter((one) => one.checkVisibility()).map((one) => ({
            panel: one.closest("[data-panel]").dataset.panel,
            run: one.dataset.run,
            text: one.querySelector("[data-output=text]")?.textContent ?? null,
            refused: one.querySelector(".refused")?.textContent ?? "",
        })),
    };
});

// Until all panels have followed, and the address.
export const settled = (page) => page.waitForFunction(() => {
    const { updates, settled } = document.documentElement.dataset;
    return updates === settled;
});

// Goes to a fragment as a person does who changes the address, and waits until all is there.
export async function go(page, fragment) {
    await page.evaluate((to) => new Promise((done) => {
        const { dataset } = document.documentElement, before = dataset.updates;
        if (location.hash.slice(1) === to) return done();
        location.hash = to;
        const wait = () => (dataset.updates !== before && dataset.updates === dataset.settled ? done() : setTimeout(wait, 1));
        wait();
    }), fragment);
}
