// SPDX-License-Identifier: GPL-3.0-or-later
// A message of the program as the page says it: options have the names of their controls, commands stay commands.
const NAMES = { near: "Near", far: "Far", format: "Format", mapping: "Mapping", model: "Model", arith: "Arithmetic", viewport: "Viewport",
    slant: "Slant", at: "Depths", unit: "Unit", preset: "Engine", ortho: "orthographic" };

const one = (line) => (line.split(" ").some((word, i, all) => word === "depthprec" && /^[a-z]/.test(all[i + 1] ?? "")) ? line
    : line.replaceAll(/(^|[^\w-])--([a-z][a-z-]*)/g, (_, before, name) => before + (NAMES[name] ?? name)));
export const plain = (text) => text.replace(/ *--full\s+prints codes, errors,\s+intervals,\s+worst\s+cases\./, "").split("\n").map(one).join("\n");
