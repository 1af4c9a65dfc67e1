import { browser, close, open, settled } from "./browser.mjs";
const page = await open({ width: 390, height: 844, mobile: true });
await settled(page);
const cdp = await page.context().newCDPSession(page);
for (const rate of [1, 4]) {
  await cdp.send("Emulation.setCPUThrottlingRate", { rate });
  for (const what of ["play", "drag gap", "drag near"]) {
    if (what === "play") await page.click("#play");
    const sel = what === "drag gap" ? "#gap" : "#a [data-slider=near]";
    if (what!=="play") await page.locator(sel).scrollIntoViewIfNeeded();
    const r = await page.evaluate(([what, sel]) => new Promise((done) => {
      const t = []; let n = 0; const one = document.querySelector(sel);
      const step = (now) => { t.push(now); if (what !== "play") { one.value = Number(one.max) * (0.3 + 0.3 * Math.abs((n % 40) / 20 - 1)); one.dispatchEvent(new Event("input", { bubbles: true })); }
        if (n++ < 120) requestAnimationFrame(step); else { const d = t.slice(1).map((x, i) => x - t[i]).sort((a, b) => a - b); done({ median: d[60], p95: d[114], worst: d.at(-1), fps: 120000 / (t.at(-1) - t[0]) }); } };
      requestAnimationFrame(step);
    }), [what, sel]);
    if (what === "play") await page.click("#play");
    await settled(page);
    console.log(rate, what, JSON.stringify(r));
  }
}
await browser.close();
