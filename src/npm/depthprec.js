#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// The command: npx depthprec table -n 0.1
import fs from "node:fs";
import { command } from "./program.js";

try {
    const { status, out, err } = await command(process.argv.slice(2), { fs, env: process.env, input: () => fs.readFileSync(0) });
    fs.writeSync(2, err);
    for (let at = 0; at < out.length;) at += fs.writeSync(1, out, at);
    process.exitCode = status;
} catch (error) {
    if (error.code !== "EPIPE") fs.writeSync(2, `depthprec: ${error.code === undefined ? `this is a fault of the program: ${error.message}` : error.message}\n`);
    process.exitCode = 3;
}
