// The card of a mission: what it looks like, what it is, and to run or to watch it at once.
import type { RunRow } from "../api";
import { h } from "../base/dom";
import { formatAddress } from "../base/url";
import { editorOf } from "../plan/editors";
import { exampleScenario } from "./example";
import type { Mission } from "./missions";

const to = (view: string, path = "", query: Record<string, string> = {}): string => formatAddress({ view, path, query });
const going = new Set<RunRow["state"]>(["queued", "running"]);

/** Returns the address where a run of the mission can be watched: the newest one, or the example. */
function watchAddress(path: string, runs: readonly RunRow[]): string | null {
  const run = runs.find((one) => one.scenario === path && (one.has_log || going.has(one.state)));
  if (run) return to("live", run.id);
  return path === exampleScenario ? "#example" : null;
}

export function missionCard(mission: Mission, runs: readonly RunRow[], picture: HTMLElement, start: (path: string) => void): HTMLElement {
  const { path, title, job, about } = mission;
  const editor = editorOf({ path, kind: "scenario", job, bytes: 0 });
  const change = to("change", path);
  const watch = watchAddress(path, runs);
  const acts = editor === "question" ? [h("a", { class: "button primary", href: change }, "Open")] : [
    h("button", { type: "button", class: "button primary", title: "Run it, and watch it while it runs", onclick: () => start(path) }, "Run"),
    watch && h("a", { class: "button", href: watch, title: "Watch its newest run" }, "Watch"),
    editor === "yard" && h("a", { class: "change", href: change, title: "Move its robot and its targets" }, "Change"),
  ];
  return h("li", { class: "card panel", "data-path": path }, picture,
    h("div", { class: "card-words" }, h("h3", {}, title, h("span", { class: "job" }, job)), h("p", { class: "card-about" }, about)),
    h("div", { class: "card-acts", role: "group", "aria-label": title }, ...acts));
}
