import { describe, expect, it } from "vitest";
import type { TraceAnswer } from "../../src/api";
import { Trace } from "../../src/plan/trace";

const frame = { origin: [1, 2] as [number, number], resolution_m: 0.5, width: 4, height: 3 };
const columns = ["x", "y", "parent_x", "parent_y", "f", "g", "h"];
// (0,0) opens (1,0) and (0,1); (1,0) opens (2,0); then (0,1); then (2,0).
const rows = [[0, 0, 0, 0, 3, 0, 3], [1, 0, 0, 0, 3, 1, 2], [0, 1, 0, 0, 4, 1, 3], [2, 0, 1, 0, 3, 2, 1]];
const answer: TraceAnswer = { columns, rows, model: "cells", frame, truncated: false };

describe("a search, step by step", () => {
  const trace = new Trace(answer);

  it("tells closed, queued and unseen vertices", () => {
    const states = (step: number) => rows.map((_, i) => trace.state(i, step));
    expect(states(0)).toEqual(["unseen", "unseen", "unseen", "unseen"]);
    expect(states(1)).toEqual(["closed", "open", "open", "unseen"]);
    expect(states(2)).toEqual(["closed", "closed", "open", "open"]);
    expect(states(4)).toEqual(["closed", "closed", "closed", "closed"]);
  });

  it("agrees with a queue that is kept by hand on a random search", () => {
    let seed = 5;
    const random = (n: number): number => { seed = (seed * 1103515245 + 12345) % 2147483648; return Math.floor(seed / 65536) % n; };
    const made = [[0, 0, 0, 0, 0, 0, 0]];
    for (let i = 1; i < 60; ++i) {
      const parent = made[random(i)]!;
      made.push([i % 8, Math.floor(i / 8), parent[0]!, parent[1]!, i, i, 0]);
    }
    const search = new Trace({ ...answer, rows: made, frame: { ...frame, width: 8, height: 8 } });
    for (let step = 1; step <= made.length; ++step) {
      const closed = new Set(made.slice(0, step).map(([x, y]) => `${x} ${y}`));
      made.forEach(([x, y, px, py], i) => {
        const expected = closed.has(`${x} ${y}`) ? "closed" : closed.has(`${px} ${py}`) ? "open" : "unseen";
        expect(search.state(i, step)).toBe(expected);
      });
    }
  });

  it("knows the whole queue where the planner tells what it put there", () => {
    // As above, and (1,0) opens (1,1), which waits to the end.
    const told = new Trace({ ...answer, openings: [0, 0, 0, 1, 0, 1, 0, 1, 1, 2, 0, 2, 1, 1, 2] });
    expect(told.waiting).toEqual([{ x: 1, y: 1, opened: 2 }]);
    expect(told.findWaiting(1, 1, 1)).toBeNull();
    expect(told.findWaiting(1, 1, 2)).toEqual({ x: 1, y: 1, opened: 2 });
    expect(told.findWaiting(2, 0, 2)).toBeNull();
    for (let step = 0; step <= 4; ++step) rows.forEach((_, i) => expect(told.state(i, step)).toBe(trace.state(i, step)));
    // A vertex that was reached again through another parent has stood there since it was first met.
    const again = rows.map((row) => (row[0] === 2 ? [2, 0, 0, 1, 3, 2, 1] : row));
    expect(new Trace({ ...answer, rows: again }).state(3, 2)).toBe("unseen");
    expect(new Trace({ ...answer, rows: again, openings: [2, 0, 2] }).state(3, 2)).toBe("open");
  });

  it("finds a vertex by its place", () => {
    expect(trace.vertex(1.6, 2.1)).toEqual([1, 0]);
    expect(trace.place(1, 0)).toEqual([1.75, 2.25]);
    expect(trace.find(1, 0, 1)).toEqual({ index: 1, state: "open" });
    expect(trace.find(1, 0, 2)).toEqual({ index: 1, state: "closed" });
    expect(trace.find(3, 2, 4)).toBeNull();
    expect(trace.at(3)).toEqual({ x: 2, y: 0, parent: [1, 0], f: 3, g: 2, h: 1 });
    expect(trace.at(0).parent).toBeNull();
  });

  it("follows parents to the start", () => {
    expect(trace.chain(3)).toEqual([[2, 0], [1, 0], [0, 0]]);
    expect(trace.chain(0)).toEqual([[0, 0]]);
  });

  it("puts corners on the lattice", () => {
    const corners = new Trace({ ...answer, model: "corners" });
    expect(corners.width).toBe(5);
    expect(corners.place(1, 0)).toEqual([1.5, 2]);
    expect(corners.vertex(1.6, 2.1)).toEqual([1, 0]);
  });
});
