// SPDX-License-Identifier: MIT
// depthprec: the library, and the command, a program of its own that is loaded when it is first asked.
import { door, withCommand } from "./camera.js";

export { Camera, DepthprecError, version } from "./camera.js";

let loading;
const program = () => (loading ??= import("./program.js").then((own) => own.begin(door)));
withCommand(program);

export const run = async (args, options) => (await program()).run(args, options);
export const solve = async (options) => (await program()).solve(options);
export const bias = async (options) => (await program()).bias(options);
export const check = async (requirements, options) => (await program()).check(requirements, options);
export const recognise = async (image, options) => (await program()).recognise(image, options);
