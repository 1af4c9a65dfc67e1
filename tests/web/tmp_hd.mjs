import { browser, open, settled } from "./browser.mjs";
const page = await open({ width: 1280 }); await settled(page);
await page.evaluate(() => { window.held = []; new PerformanceObserver((l) => window.held.push(...l.getEntries().map((e) => Math.round(e.duration)))).observe({ type: "longtask" }); });
for (const f of ["hd.png", "hd.npy"]) {
  const t = Date.now();
  await page.setInputFiles("#file", "/tmp/img/" + f);
  await page.waitForFunction((f) => document.querySelector("#recognised").textContent.startsWith(f) || document.querySelector("#unread").textContent.startsWith(f), f, { timeout: 20000 });
  console.log(f, Date.now() - t, await page.evaluate(() => document.querySelector("#recognised").textContent + document.querySelector("#unread").textContent), await page.evaluate(() => window.held.splice(0)));
  const box = await page.locator("#image canvas").boundingBox();
  for (let i = 0; i < 60; i++) await page.mouse.move(box.x + 3 * i, box.y + 2 * i);
  await page.waitForTimeout(500);
  console.log(await page.evaluate(() => [document.querySelector("#pixel").innerText, window.held.splice(0)]));
}
await page.locator("#image").screenshot({ path: "/tmp/s1.png" });
await browser.close();
