// Small parts of the stage: its legend of the states and colours that this run has.
import { h } from "../base/dom";
import { signElement, statuses } from "../base/signs";
import type { Run } from "../report/run";
import { coverLegend } from "./cover_layer";
import { Beliefs } from "./ellipse";
import { slamLegend } from "./slam_layer";

export { h, iconButton } from "../base/dom";

/** Colour alone tells nothing: each line has its name, each state its sign. */
export function signedLegend(run: Run): HTMLElement {
  const { report } = run;
  const items: HTMLElement[] = [];
  const line = (name: string, style: string): void => { items.push(h("li", {}, h("i", { class: "line", style }), name)); };
  if (report.targets.length > 0) {
    const present = statuses.filter((status) => status === "waiting" || report.targets.some((one) => one.status === status));
    items.push(...present.map((status) => h("li", {}, signElement(status), status)));
  }
  if (report.drive || report.explore) {
    line("true", "border-color:var(--robot)");
    const { enlarged } = Beliefs.of(run);
    line(`believed, 2\u03c3${enlarged > 1 ? ` \u00d7 ${enlarged}` : ""}`, "border-color:var(--belief);border-top-style:dashed");
  }
  for (const [name, style] of slamLegend(run)) line(name, style);
  if (report.explore?.laser) line("range finder", "border-color:var(--failed);border-top-width:1.5px");
  if (report.drive?.camera) line("camera", "border-color:var(--water);border-top-width:1.5px");
  if (report.explore) line("way chosen", "border-color:var(--open)");
  if (report.explore && report.explore.refused.length > 0) line("frontier refused", "border-color:var(--unreachable)");
  if (report.world.terrain && report.world.terrain.steep.length > 0) {
    items.push(h("li", {}, h("i", { class: "swatch", style: "background:var(--failed);opacity:.35" }), "too steep"));
  }
  items.push(...coverLegend(run).map(({ name, style, swatch }) => h("li", {}, h("i", { class: swatch ? "swatch" : "line", style }), name)));
  if (report.pursuit) {
    line("target", "border-color:var(--failed)");
    line(report.pursuit.robots.length > 1 ? "robots" : "robot", "border-color:var(--water)");
  }
  return h("ul", { class: "legend", "aria-label": "Legend" }, ...items);
}
