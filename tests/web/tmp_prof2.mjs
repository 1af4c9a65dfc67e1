import { browser, close, open, settled } from "./browser.mjs";
const page = await open({ width: 390, height: 844, mobile: true });
await settled(page);
const cdp = await page.context().newCDPSession(page);
await cdp.send("Emulation.setCPUThrottlingRate", { rate: Number(process.argv[3] ?? 4) });
const events = [];
cdp.on("Tracing.dataCollected", ({ value }) => events.push(...value));
const sel = process.argv[2];
await page.locator(sel).scrollIntoViewIfNeeded();
await cdp.send("Tracing.start", { traceConfig: { includedCategories: ["devtools.timeline", "v8", "blink", "cc","disabled-by-default-v8.cpu_profiler"] }, transferMode: "ReportEvents" });
await page.evaluate(([sel]) => new Promise((done) => {
  let n = 0; const one = document.querySelector(sel);
  const step = () => { one.value = Number(one.max) * (0.3 + 0.3 * Math.abs((n % 40) / 20 - 1)); one.dispatchEvent(new Event("input", { bubbles: true })); n++ < 120 ? requestAnimationFrame(step) : done(); };
  requestAnimationFrame(step);
}), [sel]);
const end = new Promise((d) => cdp.once("Tracing.tracingComplete", d));
await cdp.send("Tracing.end"); await end;
const names = {}; for (const e of events) if (e.name === "thread_name") names[`${e.pid}.${e.tid}`] = e.args.name;
const sum = {};
for (const e of events) if (e.ph === "X" && e.tdur) { const k = `${names[`${e.pid}.${e.tid}`]} ${e.name}`; sum[k] ??= [0, 0]; sum[k][0] += e.tdur / 1000; sum[k][1]++; }
for (const [k, v] of Object.entries(sum).sort((a, b) => b[1][0] - a[1][0]).filter(([k])=>k.startsWith("CrR")).slice(0, 44)) console.log((v[0] / 120).toFixed(2), "ms/frame", v[1], k);

await browser.close();
