// SPDX-License-Identifier: GPL-3.0-or-later
// What the page looks like, for eyes: B/web/shots/THEME-WIDTH.png and print.png. Here only whether there is something, and
// whether README's picture is still like the first screen, B/web/shots/page.png, which takes its place where it is not.
import { mkdirSync, readFileSync } from "node:fs";
import { close, open, settled } from "./browser.mjs";
import { demand, test } from "./tap.mjs";

const folder = `${process.env.B ?? "build"}/web/shots`;

// The share of pixels whose colours are far apart, decoded by the browser.
const apart = (page, files) => page.evaluate(async (hrefs) => {
    const [a, b] = await Promise.all(hrefs.map(async (href) => {
        const image = new Image();
        image.src = href;
        await image.decode();
        const { width, height } = image, context = new OffscreenCanvas(width, height).getContext("2d");
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, width, height).data;
    }));
    return a.length === b.length ? a.reduce((sum, one, i) => sum + (Math.abs(one - b[i]) > 64), 0) / a.length : 1;
}, files.map((file) => `data:image/png;base64,${readFileSync(file, "base64")}`));

async function first() {
    const page = await open({ width: 1280, height: 720, motion: "reduce", folded: true });
    await settled(page);
    await page.screenshot({ path: `${folder}/page.png` });
    const share = await apart(page, [`${folder}/page.png`, "plots/page.png"]);
    demand(share < 0.02, `${(100 * share).toFixed(1)} % of plots/page.png differ from ${folder}/page.png`);
    await close(page);
    return `${(100 * share).toFixed(2)} % differ`;
}

export async function shots() {
    mkdirSync(folder, { recursive: true });
    await test("screenshots at 360, 800 and 1600 px in both themes, and in print", async () => {
        for (const theme of ["light", "dark"])
            for (const width of [360, 800, 1600]) {
                const page = await open({ theme, width, height: width === 360 ? 740 : 900, motion: "reduce" });
                await settled(page);
                const bytes = await page.screenshot({ path: `${folder}/${theme}-${width}.png`, fullPage: true });
                demand(bytes.length > 20000, `${theme}, ${width} px: ${bytes.length} bytes`);
                if (theme === "dark" && width === 800) {
                    await page.emulateMedia({ media: "print" });
                    await page.screenshot({ path: `${folder}/print.png`, fullPage: true });
                }
                await close(page);
            }
        return folder;
    });
    await test("README's picture of the page is its first screen", first);
}
