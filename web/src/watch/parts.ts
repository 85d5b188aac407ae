// Small parts of the stage: its legend of the states and colours that this run has.
import { h } from "../base/dom";
import { signElement, statuses } from "../base/signs";
import { plansOf, refusalsOf } from "../log/plans";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { topic } from "../log/topics";
import { slopesOf } from "../log/world";
import { coverLegend } from "./cover_layer";
import { enlargedOf } from "./ellipse";
import { mappingLegend } from "./mapping_layer";

/** Colour alone tells nothing: each line has its name, each state its sign. */
export function signedLegend(run: Run): HTMLElement {
  const { log } = run;
  const items: HTMLElement[] = [];
  const line = (name: string, style: string): void => { items.push(h("li", {}, h("i", { class: "line", style }), name)); };
  const targets = targetsOf(run);
  if (targets.length > 0) {
    const present = statuses.filter((status) => status === "waiting" || targets.some((one) => one.status === status));
    items.push(...present.map((status) => h("li", {}, signElement(status), status)));
  }
  if (run.hasTruth && log.has(topic.belief)) {
    line("true", "border-color:var(--robot)");
    const enlarged = enlargedOf(run);
    line(`believed, 2\u03c3${enlarged > 1 ? ` \u00d7 ${enlarged}` : ""}`, "border-color:var(--belief);border-top-style:dashed");
  }
  for (const [name, style] of mappingLegend(run)) line(name, style);
  if (run.hasTruth && log.has(topic.scan)) line("range finder", "border-color:var(--failed);border-top-width:1.5px");
  if (log.has(topic.camera)) line("camera", "border-color:var(--water);border-top-width:1.5px");
  if (plansOf(run).length > 0) line("path", "border-color:var(--open)");
  if (refusalsOf(run).length > 0) line("frontier refused", "border-color:var(--unreachable)");
  if ((slopesOf(run)?.steep.length ?? 0) > 0) {
    items.push(h("li", {}, h("i", { class: "swatch", style: "background:var(--failed);opacity:.35" }), "too steep"));
  }
  items.push(...coverLegend(run).map(({ name, style, swatch }) => h("li", {}, h("i", { class: swatch ? "swatch" : "line", style }), name)));
  const pursuit = pursuitOf(run);
  if (pursuit) {
    line("target", "border-color:var(--failed)");
    line(pursuit.robots.length > 1 ? "robots" : "robot", "border-color:var(--water)");
  }
  return h("ul", { class: "legend", "aria-label": "Legend" }, ...items);
}
