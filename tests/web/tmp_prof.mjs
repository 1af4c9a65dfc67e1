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
for (const e of events) if (e.ph === "X" && e.dur) { const k = `${names[`${e.pid}.${e.tid}`]} ${e.name}`; sum[k] ??= [0, 0]; sum[k][0] += e.dur / 1000; sum[k][1]++; }
for (const [k, v] of Object.entries(sum).sort((a, b) => b[1][0] - a[1][0]).slice(0, 34)) console.log((v[0] / 120).toFixed(2), "ms/frame", v[1], k);

const RATE = 1;
const prof = {};
for (const e of events) if (e.name === "ProfileChunk" || e.name === "Profile") { const p = (prof[e.id] ??= { nodes: new Map(), samples: [], pid: e.pid, tid: e.tid }); const c = e.args.data.cpuProfile ?? {};
  if (e.name === "Profile") p.name = names[`${e.pid}.${e.tid}`];
  for (const n of c.nodes ?? []) p.nodes.set(n.id, n);
  (c.samples ?? []).forEach((x, k) => p.samples.push([x, e.args.data.timeDeltas[k] / 1000])); }
for (const p of Object.values(prof)) { const inc = {};
  for (const [id, d] of p.samples) { const seen = new Set(); for (let n = p.nodes.get(id); n; n = p.nodes.get(n.parent)) { const k = `${n.callFrame.functionName}:${n.callFrame.lineNumber}:${n.callFrame.columnNumber}`; if (!seen.has(k)) { seen.add(k); inc[k] = (inc[k] ?? 0) + d; } } }
  console.log("---", p.name); for (const [k, v] of Object.entries(inc).sort((a, b) => b[1] - a[1]).slice(0, 45)) console.log((v / 120).toFixed(2), k); }
await browser.close();
