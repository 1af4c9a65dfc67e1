import { browser, open, settled } from "./browser.mjs";
const page = await open({ width: 1280 });
console.log(await page.evaluate(() => [...document.querySelectorAll("[data-option],[data-slider]")].map((o) => (o.closest("[data-asks]")?.dataset.asks ?? "") + " " + (o.dataset.option ?? o.dataset.slider) + ": " + o.title).join("\n")));
await browser.close();
