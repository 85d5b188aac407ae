// The signs of the legend: by the name of a layer the states and colours that this run shows in it.
import { h } from "../base/dom";
import { signElement, statuses } from "../base/signs";
import { teamColourNames } from "../base/theme";
import { blockedOf } from "../log/flights";
import { refusalsOf } from "../log/plans";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { teamOf } from "../log/team";
import { topic } from "../log/topics";
import { bodiesOf, slopesOf } from "../log/world";
import { coverLegend } from "./cover_layer";
import { enlargedOf } from "./ellipse";
import { mappingLegend } from "./mapping_layer";

const entry = (mark: Element, name: string): HTMLElement => h("span", { class: "entry" }, mark, name);
const line = (name: string, style: string): HTMLElement => entry(h("i", { class: "line", style }), name);
/** Returns the signs of a mapping, of which some belong to other layers. */
const mapped = (run: Run, which: RegExp): HTMLElement[] => mappingLegend(run).filter(([name]) => which.test(name)).map(([name, style]) => line(name, style));
const swatch = (name: string, style: string): HTMLElement => entry(h("i", { class: "swatch", style }), name);

/** Colour alone tells nothing: each line has its name, each state its sign. */
const signs: Record<string, (run: Run) => HTMLElement[] | null> = {
  "obstacles": (run) => bodiesOf(run).length === 0 && !run.terrain ? null : [swatch("obstacles", "background:var(--solid-high)"),
    ...((slopesOf(run)?.steep.length ?? 0) > 0 ? [swatch("too steep", "background:var(--failed);opacity:.35")] : [])],
  "pursuit": (run) => [line("target", "border-color:var(--failed)"), line((pursuitOf(run)?.robots.length ?? 0) > 1 ? "robots" : "robot", "border-color:var(--water)")],
  "covered area": (run) => coverLegend(run).map(({ name, style, swatch: flat }) => (flat ? swatch : line)(name, style)),
  "map": () => [swatch("map", "background:var(--solid-high);outline:2px solid var(--yard)")],
  "landmarks": (run) => mapped(run, /^(?!way |believed |pose,|range finder)/),
  "firing map": () => [swatch("firing map", "background:var(--water);opacity:.5")],
  "planned tour": () => [entry(h("i", { class: "stop-sign" }, "1"), "planned tour")],
  "path": (run) => [line("path", "border-color:var(--open)"), ...(refusalsOf(run).length > 0 ? [line("frontier refused", "border-color:var(--unreachable)")] : [])],
  "range finder": () => [line("range finder", "border-color:var(--failed);border-top-width:1.5px")],
  "camera": () => [line("camera", "border-color:var(--water);border-top-width:1.5px")],
  "tags": ({ log }) => [line("tags", "border-color:var(--ink)"), ...(log.has(topic.camera) ? [line("camera", "border-color:var(--water);border-top-width:1.5px")] : [])],
  "shots": () => [line("shots", "border-color:var(--water)")],
  "blocked flights": (run) => (blockedOf(run).size > 0 && targetsOf(run).length > 0 ? [line("blocked flights", "border-color:var(--unreachable);border-top-style:dashed")] : null),
  "stations": () => [swatch("stations", "background:var(--water)")],
  "targets": (run) => statuses.filter((status) => status === "waiting" || targetsOf(run).some((one) => one.status === status)).map((status) => entry(signElement(status), status)),
  "names": () => [entry(h("i", { class: "letters-sign" }, "Aa"), "names")],
  "candidates": () => [swatch("candidates", "background:var(--open);border-radius:50%")],
  "robot": (run) => {
    const ways = mapped(run, /^way /);
    const team = teamOf(run);
    if (team.length > 1) return team.map(({ name }, i) => line(name, `border-color:var(--${teamColourNames[i % teamColourNames.length]})`));
    return ways.length > 0 ? ways : [line(run.hasTruth && run.log.has(topic.belief) ? "true" : "robot", "border-color:var(--robot)")];
  },
  "belief": (run) => {
    const enlarged = enlargedOf(run);
    if (!run.hasTruth) return mapped(run, /^(believed |pose,)/);
    return run.log.has(topic.belief) ? [line(`believed, 2\u03c3${enlarged > 1 ? ` \u00d7 ${enlarged}` : ""}`, "border-color:var(--belief);border-top-style:dashed")] : [];
  },
};

/** Returns the signs of a layer in the legend; its name alone if there is nothing to tell apart; null if the layer is empty. */
export function signsOf(run: Run, layer: string): HTMLElement[] | null {
  const made = layer in signs ? signs[layer]!(run) : [];
  return made === null || made.length > 0 ? made : [h("span", { class: "entry" }, layer)];
}
