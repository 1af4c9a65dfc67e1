// SPDX-License-Identifier: GPL-3.0-or-later
// The page for everybody: what axe-core finds, the keyboard alone, reduced motion, print.
import { readFileSync } from "node:fs";
import { axe, close, go, open, settled, shown } from "./browser.mjs";
import { demand, test } from "./tap.mjs";

const rules = readFileSync(axe, "utf8");
const TWO = encodeURIComponent("table -n 0.1 -F d24 -m d3d ; table -F fp32 -m reversed ; plot error ; solve --separation 1cm --at 10 ; budget ; zfight --range 1:1.001");

async function judged(options) {
    const page = await open(options);
    await page.evaluate(rules);
    const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    await close(page);
    return found.violations.flatMap(({ id, help, nodes }) => nodes.map((node) => `${id}: ${help}: ${node.html.slice(0, 150)} ${node.failureSummary?.split("\n")[1] ?? ""}`));
}

// The controls that the Tab key has to reach, marked by their place; of radio buttons the chosen one.
const mark = (page) => page.evaluate(() => {
    const all = [...document.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex='0']")].filter((one) =>
        one.checkVisibility() && !one.disabled && !(one.type === "radio" && !one.checked));
    all.forEach((one, i) => (one.dataset.stop = i));
    return all.map((one) => one.id || one.dataset.option || one.dataset.slider || one.getAttribute("aria-label") || one.outerHTML.slice(0, 60));
});

// Where the focus is, and whether a person sees that.
const focus = (page) => page.evaluate(() => {
    const one = document.activeElement;
    if (one === null || one === document.body) return null;
    const { outlineStyle, outlineWidth, outlineColor, boxShadow } = getComputedStyle(one), box = one.getBoundingClientRect();
    const ringed = (outlineStyle !== "none" && parseFloat(outlineWidth) >= 1 && outlineColor !== "rgba(0, 0, 0, 0)") || boxShadow !== "none";
    const inside = box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth;
    return { stop: one.dataset.stop, seen: ringed && inside, html: one.outerHTML.slice(0, 120) };
});

async function walk(page, key, stops) {
    const met = [];
    for (let i = 0; i <= stops + 2; i++) {
        await page.keyboard.press(key);
        const at = await focus(page);
        if (at === null) break;
        demand(at.seen, `the focus is not seen on ${at.html}`);
        demand(at.stop !== undefined, `the focus is on ${at.html}`);
        met.push(Number(at.stop));
    }
    return met;
}

async function tabs(options) {
    const page = await open(options);
    await settled(page); // what comes from the worker moves what is below it
    const names = await mark(page), there = await walk(page, "Tab", names.length);
    const missed = names.filter((_, i) => !there.includes(i));
    demand(missed.length === 0, `Tab never reaches ${missed.join(", ")}`);
    demand(there.length === names.length, `${there.length} stops for ${names.length} controls`);
    demand(there.every((stop, i) => i === 0 || stop > there[i - 1]), `not in the order of the page: ${there}`);
    await page.locator("[data-stop]").last().focus();
    const back = await walk(page, "Shift+Tab", names.length);
    const first = back.indexOf(0); // behind it a browser goes to the end again
    demand(first === names.length - 2 && back.slice(0, first).every((stop, i) => stop === names.length - 2 - i), `back: ${back}`);
    await close(page);
    return names.length;
}

const waitFor = async (page, what, act) => {
    const before = await page.evaluate(() => document.documentElement.dataset.updates);
    await act();
    await page.waitForFunction((old) => document.documentElement.dataset.updates !== old, before, { timeout: 5000 }).catch(() => demand(false, `${what}: nothing happened`));
};

async function keys() {
    const page = await open(), link = async () => (await shown(page)).link;
    const press = async (selector, key, what) => {
        const before = await link();
        await page.locator(selector).first().focus();
        await waitFor(page, what, () => page.keyboard.press(key));
        demand((await link()) !== before, `${what} changed nothing: ${before}`);
    };
    await page.locator("#command").focus();
    await page.keyboard.type("table -n 0.5 -f 300 -F fp32 -m reversed");
    await waitFor(page, "Enter in the field", () => page.keyboard.press("Enter"));
    demand((await link()).startsWith("depthprec table -n 0.5 -f 300 -F fp32 -m reversed"), await link());
    for (const key of ["ArrowRight", "ArrowLeft", "PageUp", "Home", "End"]) await press("#a [data-slider=near]", key, `${key} on near`);
    await press("#a [data-slider=far]", "ArrowLeft", "an arrow on far");
    await press("#a select[data-option=format]", "ArrowUp", "an arrow on the formats");
    await press("#a [data-option=ortho]", "Space", "Space on orthographic");
    await press("[name=figure]:checked", "ArrowRight", "an arrow on the figures");
    for (const key of ["Space", "Enter"]) {
        await press("#add-b", key, `${key} on the second set-up`);
        await page.waitForTimeout(50);
    }
    await page.locator("#a input[type=text][data-option=near], #a [data-option=near]").first().focus();
    await page.keyboard.press("Control+A");
    await page.keyboard.type("25cm");
    await page.waitForFunction(() => document.querySelector("#link").textContent.includes("-n 25cm"), null, { timeout: 5000 });
    await close(page);
}

const still = async (page) => {
    const view = page.locator("#picture canvas").first();
    if (!(await view.isVisible())) return true;
    await view.scrollIntoViewIfNeeded();
    await settled(page);
    const first = await view.screenshot();
    await page.waitForTimeout(500);
    return first.equals(await view.screenshot());
};

// No large area flashes before a person has asked for it, whatever the system says (WCAG 2.2, 2.3.1 and 2.2.2).
async function motion(reduced) {
    const page = await open({ motion: reduced });
    demand(await still(page), "the picture moves, unasked");
    const moving = await page.evaluate(() => document.getAnimations().length + [...document.querySelectorAll("*")].filter((one) => {
        const { transitionDuration, animationName } = getComputedStyle(one);
        return animationName !== "none" || transitionDuration.split(",").some((time) => parseFloat(time) > 0.01);
    }).length);
    demand(reduced === "no-preference" || moving === 0, `${moving} animations`);
    const play = page.locator("#play");
    if (await play.isVisible()) {
        await play.click();
        demand(!(await still(page)), "asked to move, the picture does not");
        await play.click();
        demand(await still(page), "stopped, the picture moves");
        await play.click();
        await page.emulateMedia({ reducedMotion: "no-preference" });
        await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
        await page.emulateMedia({ reducedMotion: "reduce" });
        demand(await still(page), "the system asks for less motion, the picture moves on");
        await page.emulateMedia({ reducedMotion: "no-preference" });
        demand(await still(page), "the system allows motion, the picture moves unasked");
    }
    await close(page);
}

async function print() {
    for (const theme of ["light", "dark"]) {
        const page = await open({ theme, fragment: TWO });
        await page.emulateMedia({ media: "print", colorScheme: theme });
        const { ink, paper, controls, texts } = await page.evaluate(() => {
            const style = getComputedStyle(document.body);
            const seen = (selector) => [...document.querySelectorAll(selector)].filter((one) => one.checkVisibility()).length;
            return { ink: style.color, paper: style.backgroundColor, controls: seen("button, input[type=range]"), texts: seen("[data-output=text]") };
        });
        const light = (colour) => colour.match(/[\d.]+/g).slice(0, 3).reduce((sum, x) => sum + Number(x), 0);
        demand(controls === 0, `${theme}: ${controls} buttons and sliders are printed`);
        demand(texts > 1 && light(ink) < 150 && (/, 0\)/.test(paper) || light(paper) > 700), `${theme}: ${texts} texts, ${ink} on ${paper}`);
        demand((await page.pdf({ format: "A4" })).length > 10000, "no PDF");
        await close(page);
    }
}

export async function people() {
    await test("axe-core finds nothing, in both themes, at 360 and 1600 px, with one set-up, two, and an error", async () => {
        const found = [];
        for (const theme of ["light", "dark"])
            for (const width of [360, 1600])
                for (const fragment of ["", TWO, "tabel"]) found.push(...(await judged({ theme, width, fragment })));
        demand(found.length === 0, [...new Set(found)].slice(0, 12).join("\n"));
    });
    await test("Tab reaches every control in order, and back, and the focus is seen", async () => {
        const stops = [await tabs({}), await tabs({ fragment: TWO }), await tabs({ width: 360, theme: "dark" })];
        return `${stops.join(", ")} controls`;
    });
    await test("Enter, Space, arrows and letters do what the mouse does", keys);
    await test("the picture moves when asked, and only then", () => motion("no-preference"));
    await test("reduced motion: the same, and nothing else moves", () => motion("reduce"));
    await test("print: dark on white, no controls", print);
    await test("nothing is wider than a phone of 360 px", async () => {
        const page = await open({ width: 360, height: 740, fragment: TWO });
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        await close(page);
        demand(wide <= 360, `${wide} px`);
    });
    await test("nothing that is read moves while the page opens", async () => {
        for (const [width, fragment] of [[360, ""], [1280, ""], [1280, TWO]]) {
            const page = await open({ width, height: 740, fragment });
            const shift = await page.evaluate(() => new Promise((done) => {
                let sum = 0;
                new PerformanceObserver((list) => list.getEntries().forEach(({ value }) => (sum += value)))
                    .observe({ type: "layout-shift", buffered: true });
                setTimeout(() => done(sum), 500);
            }));
            await close(page);
            demand(shift < 0.05, `${width} px: layout shift ${shift}`);
        }
    });
    await test("colours follow the system while the page is open", async () => {
        const page = await open({ theme: "light" }), colour = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const light = await colour();
        await page.emulateMedia({ colorScheme: "dark" });
        demand((await colour()) !== light, light);
        await go(page, "table%20-n%201");
        await close(page);
    });
}
