// SPDX-License-Identifier: GPL-3.0-or-later
// The page in a browser:  B=build DEPTHPREC=build/depthprec node page.mjs
// A minute of it: bad input, and a tenth of the random commands. All with DEPTHPREC_FULL.
import { asked, browser, dialogs, said } from "./browser.mjs";
import { agrees } from "./page_agrees.mjs";
import { bad } from "./page_bad.mjs";
import { figures } from "./page_figures.mjs";
import { controls } from "./page_controls.mjs";
import { gpu } from "./page_gpu.mjs";
import { image } from "./page_image.mjs";
import { people } from "./page_people.mjs";
import { redraw } from "./page_redraw.mjs";
import { shots } from "./page_shots.mjs";
import { states } from "./page_states.mjs";
import { walks } from "./page_walks.mjs";
import { seed } from "./states.mjs";
import { demand, finish, test } from "./tap.mjs";

const full = Boolean(process.env.DEPTHPREC_FULL);
const parts = { agrees, figures, redraw, controls, gpu, image, people, bad, shots, walks, states: () => states(seed(), full ? 1 : 0.1) };
const only = process.env.ONLY?.split(",") ?? (full ? Object.keys(parts) : ["agrees", "figures", "bad", "gpu", "image", "walks", "states"]);
for (const name of only) await parts[name]();
await test("nothing was said on the console", () => demand(said.length === 0, [...new Set(said)].slice(0, 20).join("\n")));
await test("nothing but the page itself was asked for", () => demand(asked.length === 0, asked.join("\n")));
await test("no script of a fragment ran", () => demand(dialogs.length === 0, dialogs.join("\n")));
await browser.close();
finish();
