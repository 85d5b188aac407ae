// The header of a run: its name, whether it was done, and why not.
import { h, iconButton } from "./base/dom";
import { showHelp } from "./base/help";
import { svg } from "./base/dom";
import { toggleTheme } from "./base/theme";
import type { Report } from "./report/types";

export function emblem(): SVGElement {
  return svg("svg", { class: "emblem", viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("circle", { cx: 12, cy: 14.5, r: 6.2 }),
    svg("path", { d: "M12 14.5 18.6 4.4" }), svg("circle", { class: "dot", cx: 20.4, cy: 2.6, r: 1.6 }));
}

export function tools(): HTMLElement {
  return h("div", { class: "tools" }, iconButton("theme", "Light or dark", toggleTheme, "d"), iconButton("help", "Keys", showHelp, "?"));
}

export const heading = (report: Report): HTMLHeadingElement =>
  h("h1", {}, h("span", { class: "job" }, report.job), report.world.name || "no name");

/** Returns title and verdict, for the header of the viewer and above a run in the app. */
export function title(report: Report, seed: string): HTMLElement[] {
  const done = report.status === "done";
  const reason = report.reason || (report.pursuit && done ? `caught in second ${report.metrics.catch_time_s ?? ""}` : "");
  return [heading(report),
    h("p", { class: "verdict", title: report.reason }, h("b", done ? {} : { class: "not" }, done ? "Done" : "Not done"), reason ? ` ${reason}` : ""),
    h("p", { class: "seed" }, seed ? `seed ${seed}` : "")];
}

export function banner(report: Report, seed: string): HTMLElement {
  return h("header", { class: "top" }, emblem(), ...title(report, seed), tools());
}
