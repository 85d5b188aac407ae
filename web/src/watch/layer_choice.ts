// How strongly each layer is drawn: 1 unless somebody chose otherwise, 0 where it is off. In the address as "shots:0,map:0.4".
import { clamp } from "../base/numbers";

export class LayerChoice {
  private chosen = new Map<string, number>();

  constructor(text = "") {
    for (const [name, value] of text.split(",").map((one) => one.split(":"))) {
      if (name && Number.isFinite(Number(value))) this.set(name, Number(value));
    }
  }

  of(name: string): number { return this.chosen.get(name) ?? 1; }

  set(name: string, opacity: number): void {
    if (opacity >= 1) this.chosen.delete(name);
    else this.chosen.set(name, clamp(opacity, 0, 1));
  }

  get text(): string { return [...this.chosen].map(([name, opacity]) => `${name}:${+opacity.toFixed(2)}`).join(","); }
}
