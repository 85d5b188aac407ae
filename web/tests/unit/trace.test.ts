import { describe, expect, it } from "vitest";
import type { GridTrace, PlacedTrace } from "../../src/api";
import { Trace } from "../../src/plan/trace";

const frame = { origin: [1, 2] as [number, number], resolution_m: 0.5, width: 4, height: 3 };
const columns = ["x", "y", "parent_x", "parent_y", "f", "g", "h"];
// (0,0) opens (1,0) and (0,1); (1,0) opens (2,0) and (1,1), which waits to the end; then (0,1); then (2,0).
const rows = [[0, 0, 0, 0, 3, 0, 3], [1, 0, 0, 0, 3, 1, 2], [0, 1, 0, 0, 4, 1, 3], [2, 0, 1, 0, 3, 2, 1]];
const openings = [0, 0, 0, 1, 0, 1, 0, 1, 1, 2, 0, 2, 1, 1, 2];
const answer: GridTrace = { columns, rows, openings, model: "cells", frame, truncated: false };

describe("a search, step by step", () => {
  const trace = new Trace(answer);
  const key = (x: number, y: number): number => trace.grid!.key(x, y);

  it("tells closed, queued and unseen vertices", () => {
    const states = (step: number) => rows.map((_, i) => trace.state(i, step));
    expect(states(0)).toEqual(["unseen", "unseen", "unseen", "unseen"]);
    expect(states(1)).toEqual(["closed", "open", "open", "unseen"]);
    expect(states(2)).toEqual(["closed", "closed", "open", "open"]);
    expect(states(4)).toEqual(["closed", "closed", "closed", "closed"]);
  });

  it("knows what waits to the end", () => {
    expect(trace.waiting).toEqual([{ key: key(1, 1), opened: 2 }]);
    expect(trace.findWaiting(key(1, 1), 1)).toBeNull();
    expect(trace.findWaiting(key(1, 1), 2)).toEqual({ key: key(1, 1), opened: 2 });
    expect(trace.findWaiting(key(2, 0), 2)).toBeNull();
  });

  it("agrees with a queue that is kept by hand on a random search", () => {
    let seed = 5;
    const random = (n: number): number => { seed = (seed * 1103515245 + 12345) % 2147483648; return Math.floor(seed / 65536) % n; };
    const made = [[0, 0, 0, 0, 0, 0, 0]];
    const told = [0, 0, 0];
    for (let i = 1; i < 60; ++i) {
      const from = random(i);
      const parent = made[from]!;
      made.push([i % 8, Math.floor(i / 8), parent[0]!, parent[1]!, i, i, 0]);
      told.push(i % 8, Math.floor(i / 8), from + 1);
    }
    const search = new Trace({ ...answer, rows: made, openings: told, frame: { ...frame, width: 8, height: 8 } });
    for (let step = 1; step <= made.length; ++step) {
      const closed = new Set(made.slice(0, step).map(([x, y]) => `${x} ${y}`));
      made.forEach(([x, y, px, py], i) => {
        const expected = closed.has(`${x} ${y}`) ? "closed" : closed.has(`${px} ${py}`) ? "open" : "unseen";
        expect(search.state(i, step)).toBe(expected);
      });
    }
  });

  it("guesses nothing where no queue is told", () => {
    const silent = new Trace({ ...answer, openings: [] });
    expect(rows.map((_, i) => silent.state(i, 2))).toEqual(["closed", "closed", "unseen", "unseen"]);
    expect(silent.waiting).toEqual([]);
  });

  it("finds a vertex by its place", () => {
    expect(trace.nearest(1.6, 2.1, 0)).toBe(key(1, 0));
    expect(trace.nearest(0.9, 2.1, 9)).toBe(-1);
    expect(trace.place(key(1, 0))).toEqual([1.75, 2.25]);
    expect(trace.name(key(1, 0))).toBe("(1, 0)");
    expect(trace.find(key(1, 0), 1)).toEqual({ index: 1, state: "open" });
    expect(trace.find(key(1, 0), 2)).toEqual({ index: 1, state: "closed" });
    expect(trace.find(key(3, 2), 4)).toBeNull();
    expect(trace.at(3)).toEqual({ key: key(2, 0), parent: key(1, 0), f: 3, g: 2, h: 1 });
    expect(trace.at(0).parent).toBeNull();
  });

  it("follows parents to the start", () => {
    expect(trace.chain(3)).toEqual([[2.25, 2.25], [1.75, 2.25], [1.25, 2.25]]);
    expect(trace.chain(0)).toEqual([[1.25, 2.25]]);
  });

  it("puts corners on the lattice", () => {
    const corners = new Trace({ ...answer, model: "corners" });
    expect(corners.grid!.width).toBe(5);
    expect(corners.place(corners.grid!.key(1, 0))).toEqual([1.5, 2]);
    expect(corners.nearest(1.6, 2.1, 0)).toBe(corners.grid!.key(1, 0));
  });
});

describe("a search on polygons", () => {
  // The start opens two legs that end at the same place; the second waits to the end.
  const placed: PlacedTrace = { columns: ["state", "parent", "f", "g", "h"], model: "places", truncated: false,
    rows: [[0, 0, 5, 0, 5], [1, 0, 5.5, 2, 3.5]], openings: [0, 0, 1, 1, 2, 1], places: [[0, 0], [2, 0], [2, 0]] };

  it("is told by states that have places", () => {
    const trace = new Trace(placed);
    expect(trace.grid).toBeNull();
    expect(trace.nearest(2.1, 0, 0.5)).toBe(1);
    expect(trace.nearest(1, 0, 0.5)).toBe(-1);
    expect(trace.find(1, 1)).toEqual({ index: 1, state: "open" });
    expect(trace.waiting).toEqual([{ key: 2, opened: 1 }]);
    expect(trace.chain(1)).toEqual([[2, 0], [0, 0]]);
    expect(trace.name(1)).toBe("(2.00, 0.00) m");
  });

  it("follows a parent that came later, in a tree", () => {
    const tree = new Trace({ ...placed, openings: [], rows: [[0, 0, 0, 0, 0], [1, 2, 0, 2, 0], [2, 0, 0, 1, 0]], places: [[0, 0], [2, 0], [1, 0]] });
    expect(tree.chain(1)).toEqual([[2, 0], [1, 0], [0, 0]]);
    expect(tree.state(1, 1)).toBe("unseen");
  });
});
