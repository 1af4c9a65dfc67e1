import { browser, open, settled } from "./browser.mjs";
const page = await open({ width: 1280 }); await settled(page);
await page.screenshot({ path: "/tmp/s0.png" });
const p = await open({ width: 390, height: 844, mobile: true });await settled(p);
await p.screenshot({ path: "/tmp/s2.png", fullPage: true, clip: { x: 0, y: 0, width: 390, height: 2000 } });
await browser.close();
