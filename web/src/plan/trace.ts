// A search as it went: what was closed and what stood in the queue after so many expansions. Where the planner tells
// what it put into the queue that is the queue as it was; else what waits until the end is not known of.
import type { TraceAnswer } from "../api";

export interface Expansion {
  x: number;
  y: number;
  parent: [number, number] | null;
  f: number;
  g: number;
  h: number;
}

/** A vertex that waits in the queue until the end, since so many expansions. */
export interface Waiting { x: number; y: number; opened: number }

export class Trace {
  readonly length: number;
  readonly width: number;
  readonly height: number;
  readonly waiting: Waiting[] = [];
  /** By expansion: after how many expansions its vertex stood in the queue. */
  private opened: Int32Array;
  private byVertex = new Map<number, number[]>();
  private waitingAt = new Map<number, number>();
  private column: Record<string, number>;

  constructor(readonly answer: TraceAnswer) {
    this.column = Object.fromEntries(answer.columns.map((name, i) => [name, i]));
    this.length = answer.rows.length;
    const more = answer.model === "corners" ? 1 : 0;
    this.width = answer.frame.width + more;
    this.height = answer.frame.height + more;
    this.opened = new Int32Array(this.length);
    for (let i = 0; i < this.length; ++i) {
      const { x, y, parent } = this.at(i);
      // A vertex is expanded after its parent: the parent's last expansion before put it into the queue.
      this.opened[i] = parent ? 1 + (this.byVertex.get(this.key(...parent))?.at(-1) ?? -1) : 0;
      const key = this.key(x, y);
      const before = this.byVertex.get(key);
      if (before) before.push(i);
      else this.byVertex.set(key, [i]);
    }
    this.readOpenings(answer.openings ?? []);
  }

  private readOpenings(openings: number[]): void {
    for (let i = 0; i + 2 < openings.length; i += 3) {
      const [x, y, opened] = [openings[i]!, openings[i + 1]!, openings[i + 2]!];
      const next = this.byVertex.get(this.key(x, y))?.find((index) => index >= opened);
      if (next !== undefined) this.opened[next] = opened;
      else {
        this.waitingAt.set(this.key(x, y), this.waiting.length);
        this.waiting.push({ x, y, opened });
      }
    }
  }

  private key(x: number, y: number): number { return y * this.width + x; }

  at(index: number): Expansion {
    const row = this.answer.rows[index]!;
    const value = (name: string): number => row[this.column[name]!] ?? NaN;
    const [x, y, px, py] = [value("x"), value("y"), value("parent_x"), value("parent_y")];
    const root = (px === x && py === y) || px < 0 || Number.isNaN(px);
    return { x, y, parent: root ? null : [px, py], f: value("f"), g: value("g"), h: value("h") };
  }

  /** "closed" when the expansion was among the first `step`, "open" when its vertex stood in the queue then. */
  state(index: number, step: number): "closed" | "open" | "unseen" {
    if (index < step) return "closed";
    return this.opened[index]! <= step && step > 0 ? "open" : "unseen";
  }

  /** What is known of a vertex after `step` expansions: its last one before, else the one it waits for. */
  find(x: number, y: number, step: number): { index: number; state: "closed" | "open" } | null {
    const all = this.byVertex.get(this.key(x, y)) ?? [];
    const closed = all.findLast((index) => index < step);
    if (closed !== undefined) return { index: closed, state: "closed" };
    const waiting = all.find((index) => this.state(index, step) === "open");
    return waiting === undefined ? null : { index: waiting, state: "open" };
  }

  /** The vertex when it stands in the queue after `step` expansions and will never leave it. */
  findWaiting(x: number, y: number, step: number): Waiting | null {
    const found = this.waiting[this.waitingAt.get(this.key(x, y)) ?? -1];
    return found && step > 0 && found.opened <= step ? found : null;
  }

  /** Vertices from that of an expansion back to the start. */
  chain(index: number): [number, number][] {
    const way: [number, number][] = [];
    let present: number | undefined = index;
    while (present !== undefined && way.length <= this.length) {
      const { x, y, parent }: Expansion = this.at(present);
      way.push([x, y]);
      const before: number = present;
      present = parent ? this.byVertex.get(this.key(...parent))?.findLast((one) => one < before) : undefined;
      if (parent && present === undefined) way.push(parent);
    }
    return way;
  }

  /** In metres: the centre of a cell, or the corner. */
  place(x: number, y: number): [number, number] {
    const { origin, resolution_m } = this.answer.frame;
    const half = this.answer.model === "cells" ? 0.5 : 0;
    return [origin[0] + (x + half) * resolution_m, origin[1] + (y + half) * resolution_m];
  }

  /** The vertex nearest to a place. */
  vertex(px: number, py: number): [number, number] {
    const { origin, resolution_m } = this.answer.frame;
    const round = this.answer.model === "cells" ? Math.floor : Math.round;
    return [round((px - origin[0]) / resolution_m), round((py - origin[1]) / resolution_m)];
  }

  get counts(): { reexpanded: number } {
    return { reexpanded: this.length - this.byVertex.size };
  }
}
