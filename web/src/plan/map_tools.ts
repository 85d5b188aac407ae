// Tools for a whole map: its size, its cells, metres or feet, a maze, nothing at all.
import { h } from "../base/dom";
import { inMetres, inUnit, lengthUnit, toggleUnits } from "../base/units";
import { fixed } from "../base/numbers";
import type { Ground } from "./ground";

const short = (metres: number): string => fixed(inUnit(metres), 3).replace(/\.?0+$/, "");

/** For example "16 by 11 m, cells of 0.25 m". */
export function sizeText(ground: Ground): string {
  const [x0, y0, x1, y1] = ground.box;
  const cells = ground.kind === "grid" ? `, cells of ${short(ground.grid.resolution_m)} ${lengthUnit()}` : "";
  return `${short(x1 - x0)} by ${short(y1 - y0)} ${lengthUnit()}${cells}`;
}

/** `maze` and `clear` change the whole map; polygons have neither. */
export function mapTools(ground: Ground, acts: { maze: () => void; clear: () => void }): HTMLElement {
  const unit = h("button", { type: "button", class: "link", title: "Metres or feet", onclick: toggleUnits }, lengthUnit() === "m" ? "in feet" : "in metres");
  const button = (name: string, title: string, act: () => void): HTMLElement => h("button", { type: "button", class: "button", title, onclick: act }, name);
  return h("div", { class: "map-tools" }, h("p", { class: "about" }, `${sizeText(ground)} `, unit),
    ground.kind === "grid" && h("div", { class: "row-left" }, button("Maze", "Draw a maze over the whole map", acts.maze), button("Clear", "Erase all walls", acts.clear)));
}

/** The radius of the disk that drives, in the chosen unit. */
export function radiusField(radius_m: number, changed: (radius_m: number) => void): HTMLElement {
  const input = h("input", { type: "number", min: 0, step: 0.05, value: +inUnit(radius_m).toFixed(4), id: "radius" });
  input.addEventListener("change", () => changed(+inMetres(Math.max(0, Number(input.value) || 0)).toFixed(6)));
  return h("label", { class: "radius", title: "Radius of the disk that drives" }, "radius ", input, ` ${lengthUnit()}`);
}
