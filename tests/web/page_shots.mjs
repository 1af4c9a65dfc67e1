// SPDX-License-Identifier: GPL-3.0-or-later
// What the page looks like, for eyes: B/web/shots/THEME-WIDTH.png and print.png. Here only whether there is something.
import { mkdirSync } from "node:fs";
import { close, open, settled } from "./browser.mjs";
import { demand, test } from "./tap.mjs";

const folder = `${process.env.B ?? "build"}/web/shots`;

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
}
