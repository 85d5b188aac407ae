// The legend of a map with a search.
import type { PlannerRow } from "../api";
import { h } from "../base/dom";
import type { Ground } from "./ground";
import { tint } from "./painter";

export function legend(ground: Ground, planners: PlannerRow[]): HTMLElement[] {
  const faint = ground.kind !== "polygons";  // cells are tinted, points are not
  const swatch = (name: string, colour: string, opacity: number): HTMLElement => h("li", {}, h("i", { class: "swatch", style: `background:var(--${colour});opacity:${faint ? opacity / 255 : 1}` }), name);
  const line = (name: string, colour: string): HTMLElement => h("li", {}, h("i", { class: "line", style: `border-color:var(--${colour})` }), name);
  const tells = (kind: PlannerRow["tells"]): boolean => planners.some((one) => one.tells === kind);
  const search = tells("search") ? [swatch("closed", "closed", tint.closed), swatch("in the queue", "open", tint.open)] : tells("tree") ? [swatch("tree", "closed", tint.closed)] : [];
  return [line("path", "robot"), ...search, ...(search.length > 0 ? [line("parents", "belief")] : []), ...(ground.kind === "polygons" ? [line(planners.some((one) => one.guarantee.among === "widest_curve" || one.name === "medial_axis") ? "medial axis" : "visibility graph", "open")] : [])];
}
