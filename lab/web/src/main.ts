// SPDX-License-Identifier: Apache-2.0
// Starts the lab: loads the engine, builds the page, and hides nothing if that fails. html[data-ready] becomes "1" with
// the first picture, and "error" if there will be none.
import { h } from "../../../report/web/src/dom";
import { start_theme } from "../../../report/web/src/theme";
import type { Tables } from "./answers";
import { Engine, type Files } from "./engine";
import type { Lab } from "./lab_state";
import { link_request, state_of } from "./link";
import { Page } from "./page";
import { load_program } from "./program";
import { Shelf } from "./shelf";
import "uplot/dist/uPlot.min.css";
import "../../../report/web/src/report.css";
import "../../../report/web/src/viewer/viewer.css";
import "../lab.css";

async function start(): Promise<void> {
  start_theme();
  const main = document.getElementById("lab") as HTMLElement;
  main.replaceChildren(h("p", { class: "note" }, "Starting the engine\u2026"));
  try {
    const program = await load_program();
    const files: Files = new Map();
    let notice = (_message: string): void => undefined;
    const quick = new Engine(program, files, (message) => notice(message));
    const tables = await quick.ask<Tables>("tables", { ask: "tables" });
    tables.json.settings.push(...tables.json.gaussian_settings);
    let wrong = "";
    const linked = quick.ask<Lab>("link", link_request(location.hash)).catch((error: Error) => {
      wrong = error.message;
      return quick.ask<Lab>("link", link_request(""));
    });
    const { lab, notice: ignored } = state_of((await linked).json);
    const slow = new Engine(program, files, (message) => notice(message));
    const page = new Page(tables.json, lab, quick, slow, new Shelf(files, [quick, slow], tables.json.limits.most_bytes));
    notice = (message) => page.notice(message);
    page.begin();
    if (wrong || ignored) page.notice(wrong || ignored);
  } catch (error) {
    main.replaceChildren(h("p", { class: "broken", role: "alert" }, `The lab cannot start: ${(error as Error).message}`));
    document.documentElement.dataset.ready = "error";
  }
}

void start();
