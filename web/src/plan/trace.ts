// The course of a search: the closed states and the queue after each number of expansions. A state is identified by a
// number, its key: that of a grid vertex, or as the planner numbers its states.
import type { GridTrace, PlacedTrace, TraceAnswer } from "../api";
import type { Vec2 } from "../base/outline";
import { fixed } from "../base/numbers";

export interface Expansion { key: number; parent: number | null; f: number; g: number; h: number }

/** Describes a state that stays in the queue until the end; `opened` expansions preceded its entry. */
export interface Waiting { key: number; opened: number }

/** Gives the positions and names of states. */
interface States {
  row(row: number[]): Expansion;
  /** Returns the keys that were queued, each with the number of expansions before that. */
  openings(): Waiting[];
  place(key: number): Vec2;
  name(key: number): string;
  /** The state nearest to a place; -1 for none within reach. */
  at(x: number, y: number, reach: number): number;
}

function reader(columns: string[]): (row: number[], name: string) => number {
  const column = Object.fromEntries(columns.map((name, i) => [name, i]));
  return (row, name) => row[column[name]!] ?? NaN;
}

/** Gives the vertices of a grid: centres of cells, or corners. */
class Vertices implements States {
  readonly width: number;
  readonly height: number;
  private value: ReturnType<typeof reader>;

  constructor(private answer: GridTrace) {
    const more = answer.model === "corners" ? 1 : 0;
    this.width = answer.frame.width + more;
    this.height = answer.frame.height + more;
    this.value = reader(answer.columns);
  }

  key(x: number, y: number): number { return y * this.width + x; }
  cell(key: number): Vec2 { return [key % this.width, Math.floor(key / this.width)]; }

  row(row: number[]): Expansion {
    const value = (name: string): number => this.value(row, name);
    const [x, y, px, py] = [value("x"), value("y"), value("parent_x"), value("parent_y")];
    const root = (px === x && py === y) || px < 0 || Number.isNaN(px);
    return { key: this.key(x, y), parent: root ? null : this.key(px, py), f: value("f"), g: value("g"), h: value("h") };
  }

  openings(): Waiting[] {
    const list = this.answer.openings ?? [];
    return Array.from({ length: Math.floor(list.length / 3) }, (_, i) => ({ key: this.key(list[3 * i]!, list[3 * i + 1]!), opened: list[3 * i + 2]! }));
  }

  place(key: number): Vec2 {
    const { origin, resolution_m } = this.answer.frame;
    const half = this.answer.model === "cells" ? 0.5 : 0;
    const [x, y] = this.cell(key);
    return [origin[0] + (x + half) * resolution_m, origin[1] + (y + half) * resolution_m];
  }

  name(key: number): string { return `(${this.cell(key).join(", ")})`; }

  at(px: number, py: number): number {
    const { origin, resolution_m } = this.answer.frame;
    const round = this.answer.model === "cells" ? Math.floor : Math.round;
    const [x, y] = [round((px - origin[0]) / resolution_m), round((py - origin[1]) / resolution_m)];
    return x >= 0 && y >= 0 && x < this.width && y < this.height ? this.key(x, y) : -1;
  }
}

/** Gives states with positions of their own. If several share a position, the first one met is found. */
class Places implements States {
  private value: ReturnType<typeof reader>;

  constructor(private answer: PlacedTrace) {
    this.value = reader(answer.columns);
  }

  row(row: number[]): Expansion {
    const value = (name: string): number => this.value(row, name);
    const [key, parent] = [value("state"), value("parent")];
    return { key, parent: parent === key ? null : parent, f: value("f"), g: value("g"), h: value("h") };
  }

  openings(): Waiting[] {
    const list = this.answer.openings ?? [];
    return Array.from({ length: Math.floor(list.length / 2) }, (_, i) => ({ key: list[2 * i]!, opened: list[2 * i + 1]! }));
  }

  place(key: number): Vec2 { return this.answer.places[key] ?? [NaN, NaN]; }
  name(key: number): string { return `(${this.place(key).map((one) => fixed(one, 2)).join(", ")}) m`; }

  at(x: number, y: number, reach: number): number {
    let [best, least] = [-1, reach];
    this.answer.places.forEach((place, key) => {
      const away = Math.hypot(place[0] - x, place[1] - y);
      if (away < least) [best, least] = [key, away];
    });
    return best;
  }
}

export class Trace {
  readonly length: number;
  readonly waiting: Waiting[] = [];
  /** The grid if the states are its vertices, else null. */
  readonly grid: Vertices | null;
  private states: States;
  private expansions: Expansion[];
  /** For each expansion, the number of expansions before its state was queued; infinite if unknown. */
  private opened: Float64Array;
  private byKey = new Map<number, number[]>();
  private waitingAt = new Map<number, Waiting>();

  constructor(readonly answer: TraceAnswer) {
    this.grid = answer.model === "places" ? null : new Vertices(answer);
    this.states = answer.model === "places" ? new Places(answer) : this.grid!;
    this.length = answer.rows.length;
    this.expansions = answer.rows.map((row) => this.states.row(row));
    this.opened = new Float64Array(this.length).fill(Infinity);
    this.expansions.forEach(({ key }, i) => {
      const before = this.byKey.get(key);
      if (before) before.push(i);
      else this.byKey.set(key, [i]);
    });
    for (const one of this.states.openings()) {
      const next = this.byKey.get(one.key)?.find((index) => index >= one.opened);
      if (next !== undefined) this.opened[next] = one.opened;
      else {
        this.waitingAt.set(one.key, one);
        this.waiting.push(one);
      }
    }
  }

  at(index: number): Expansion { return this.expansions[index]!; }
  place(key: number): Vec2 { return this.states.place(key); }
  name(key: number): string { return this.states.name(key); }
  /** The state nearest to a place; -1 for none within reach. */
  nearest(x: number, y: number, reach: number): number { return this.states.at(x, y, reach); }

  /** Returns "closed" if the expansion is among the first `step`, "open" if its state was in the queue then. */
  state(index: number, step: number): "closed" | "open" | "unseen" {
    if (index < step) return "closed";
    return this.opened[index]! <= step && step > 0 ? "open" : "unseen";
  }

  /** Returns the expansion known of a state after `step` expansions: its last one so far, else the one it waits for. */
  find(key: number, step: number): { index: number; state: "closed" | "open" } | null {
    const all = this.byKey.get(key) ?? [];
    const closed = all.findLast((index) => index < step);
    if (closed !== undefined) return { index: closed, state: "closed" };
    const waiting = all.find((index) => this.state(index, step) === "open");
    return waiting === undefined ? null : { index: waiting, state: "open" };
  }

  /** Returns the state if it is in the queue after `step` expansions and never leaves it. */
  findWaiting(key: number, step: number): Waiting | null {
    const found = this.waitingAt.get(key);
    return found && step > 0 && found.opened <= step ? found : null;
  }

  /**
   * Returns the positions from the state of an expansion back to the start, in metres. Accepts a parent that came
   * later, as in a tree.
   */
  chain(index: number): Vec2[] {
    const way: Vec2[] = [];
    let present: number | undefined = index;
    while (present !== undefined && way.length <= this.length) {
      const { key, parent }: Expansion = this.at(present);
      way.push(this.place(key));
      if (parent === null) break;
      const before: number = present;
      const all: number[] = this.byKey.get(parent) ?? [];
      present = all.findLast((one) => one < before) ?? all[0];
      if (present === undefined) way.push(this.place(parent));
    }
    return way;
  }
}
