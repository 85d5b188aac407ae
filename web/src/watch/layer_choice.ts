// How strongly each layer is drawn: as is usual for it unless somebody chose otherwise, 0 where it is off. In the address as
// "shots:0,map:0.4".
import { clamp } from "../base/numbers";

/** Layers of planning: they are drawn while the robot plans, and after that for who switches them on. */
export const ofPlanning: ReadonlySet<string> = new Set(["firing map", "planned tour"]);

export class LayerChoice {
  /** The robot plans now. */
  planning = false;
  private chosen = new Map<string, number>();

  constructor(text = "") {
    for (const [name, value] of text.split(",").map((one) => one.split(":"))) {
      if (name && Number.isFinite(Number(value))) this.set(name, Number(value));
    }
  }

  of(name: string): number { return this.chosen.get(name) ?? this.usual(name); }

  /** Returns the opacity of a layer that nobody has chosen. */
  usual(name: string): number { return ofPlanning.has(name) && !this.planning ? 0 : 1; }

  set(name: string, opacity: number): void {
    if (clamp(opacity, 0, 1) === this.usual(name)) this.chosen.delete(name);
    else this.chosen.set(name, clamp(opacity, 0, 1));
  }

  get text(): string { return [...this.chosen].map(([name, opacity]) => `${name}:${+opacity.toFixed(2)}`).join(","); }
}
