import { describe, expect, it } from "vitest";
import { GridGround, PolygonGround } from "../../src/plan/ground";
import { History } from "../../src/plan/history";

describe("steps that can be undone", () => {
  it("go back and forth over any number of changes, at most so many", () => {
    let value = 0;
    const history = new History(() => { const kept = value; return () => { value = kept; }; }, 3);
    for (let i = 1; i <= 5; ++i) {
      history.remember();
      value = i;
    }
    const back: number[] = [];
    while (history.undo()) back.push(value);
    expect(back).toEqual([4, 3, 2]);
    while (history.undo(true)) back.push(value);
    expect(back.slice(3)).toEqual([3, 4, 5]);
    history.undo();
    history.remember();
    value = 9;
    expect(history.undo(true)).toBe(false);
  });

  it("take cells back, those that nobody has seen too", () => {
    const ground = new GridGround({ origin: [0, 0], resolution_m: 1, width: 4, height: 3, runs: [0, 5, 1, 2, 2, 5] });
    const history = new History(() => ground.snapshot());
    const seen = [[...ground.cells]];
    for (const [from, to, value] of [[[0, 0], [3, 0], 1], [[1, 1], [3, 2], 0], [[3, 2], [3, 2], 1]] as const) {
      history.remember();
      ground.paint([from[0], from[1]], [to[0], to[1]], value, 0);
      seen.push([...ground.cells]);
    }
    for (let i = seen.length - 1; i > 0; --i) {
      expect([...ground.cells]).toEqual(seen[i]);
      history.undo();
    }
    expect(ground.edits()).toEqual([]);
    for (let i = 1; i < seen.length; ++i) {
      history.undo(true);
      expect([...ground.cells]).toEqual(seen[i]);
    }
  });

  it("take polygons back", () => {
    const ground = new PolygonGround({ boundary: [], obstacles: [[[0, 0], [1, 0], [1, 1]], [[4, 4], [5, 4], [5, 5]]], queries: [] });
    const history = new History(() => ground.snapshot());
    const seen = [JSON.stringify(ground.edits())];
    for (const change of [() => ground.shift(0, [1, 0]), () => void ground.add([3, 3], 0.5), () => ground.remove(1), () => ground.remove(2)]) {
      history.remember();
      change();
      seen.push(JSON.stringify(ground.edits()));
    }
    for (let i = seen.length - 1; i > 0; --i) {
      expect(JSON.stringify(ground.edits())).toBe(seen[i]);
      history.undo();
    }
    expect(ground.edits()).toEqual([]);
  });
});
