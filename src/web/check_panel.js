// SPDX-License-Identifier: GPL-3.0-or-later
// A requirement file, judged as it is typed. Until somebody writes in it, it asks of set-up A what the page asks.
import { NEED } from "./engine.js";
import { copy, save } from "./outputs.js";
import { $, errorOf, page, pictureLines } from "./state.js";

export function createCheckPanel() {
    const text = $("#need"), panel = $("#check");
    let own = "", asked = [];

    // The answer to a line, where no other was asked for meanwhile.
    async function answer(line) {
        page.aside.leave(asked);
        asked = line;
        const said = await page.aside.ask(line);
        return line === asked ? said : null;
    }

    async function judge() {
        $("#own-need").hidden = text.value === own;
        const said = await answer(["judged", text.value]);
        if (said === null) return;
        $("#checked").textContent = said.out;
        $("#checked").hidden = said.out === "";
        $("#unchecked").textContent = said.status > 1 ? errorOf(said) : "";
    }

    async function follow() {
        if (!panel.open) return;
        const said = await answer(["need", ...pictureLines()[0]]);
        if (said === null || said.status !== 0) return; // the controls say what is wrong
        if (text.value === own) text.value = said.out;
        own = said.out;
        judge();
    }

    text.addEventListener("input", judge);
    panel.addEventListener("toggle", follow);
    $("#own-need").addEventListener("click", () => {
        text.value = own;
        judge();
    });
    $("#save-need").addEventListener("click", () => save(NEED, text.value, "text/plain"));
    $("#copy-need").addEventListener("click", ({ target }) => copy(target, text.value));
    return { follow };
}
