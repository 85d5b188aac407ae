import { describe, expect, it } from "vitest";
import { Growth } from "../../src/live/growth";
import { faultOfRuns, spread } from "../../src/report/runs";
import { parseReport, type Pursuit, type Explore } from "../../src/report/types";
import { report } from "./report";

const pursuit = (columns: number, rows: number, cost_runs: number[]): Pursuit =>
  ({ columns, rows, cell_m: 1, cost_runs, target: [], robots: [], paid: [], bounds: [] });
const explore = (state_runs: number[], known_runs: number[]): Explore =>
  ({ map: { origin: [0, 0], cell_m: 1, columns: 2, rows: 2, state_runs, step_s: 1, known_runs }, walls: [], beliefs: [], decisions: [], refused: [] });

describe("runs of a map", () => {
  it("spreads values and counts", () => {
    expect([...spread([2, 3, 0, 1], 2, 2, Int16Array)]).toEqual([2, 2, 2, 0]);
    expect([...spread([], 0, 0, Float64Array)]).toEqual([]);
  });

  it("refuses, before it takes memory, what does not fill the map", () => {
    for (const runs of [[], [1], [1, 3], [1, 5], [1, -1, 1, 5], [1, 1.5, 1, 2.5], [1, 4, 2], [1, 2 ** 60], [1, 1e300], [null, 4], [1, "4"], "1,4", null]) {
      expect(faultOfRuns(runs, 2, 2), JSON.stringify(runs)).toMatch(/run the job again/);
    }
    expect(() => spread([1, 1e9], 2, 2, Float64Array)).toThrow(/entry 1 is 1000000000/);
    for (const [columns, rows] of [[1e6, 1e6], [-1, -4], [0.5, 8], [NaN, 1], [Infinity, 1]] as const) {
      expect(() => spread([1, columns * rows], columns, rows, Float64Array)).toThrow(/cells, and a report draws 4000000 at most/);
    }
  });

  it("keeps reports out whose maps are not whole, and names the key", () => {
    const read = (more: object) => parseReport(JSON.stringify(report(more)));
    expect(read({ pursuit: pursuit(3, 2, [1, 2, 7, 4]) })).toMatchObject({ job: "guard" });
    expect(read({ pursuit: pursuit(3, 2, [1, 2, 7, 3]) })).toMatch(/^pursuit\.cost_runs: the counts add up to 5 cells/);
    expect(read({ explore: explore([0, 4], [0, 4]) })).toMatchObject({ job: "guard" });
    expect(read({ explore: explore([0, 5], [0, 4]) })).toMatch(/^explore\.map\.state_runs: entry 1 is 5/);
    expect(read({ slam: { map: explore([0, 4], [0, 2]).map } })).toMatch(/^slam\.map\.known_runs: the counts add up to 2/);
  });

  it("leaves a map out that comes broken while a mission runs", () => {
    const growth = new Growth();
    growth.receive({ type: "scene", report: { ...report(), explore: { walls: [], beliefs: [], decisions: [], refused: [] } } });
    expect(growth.receive({ type: "map", map: explore([0, 4], [0, 9]).map })).toBe(false);
    expect(growth.report!.explore!.map.columns).toBe(0);
    expect(growth.receive({ type: "map", map: explore([0, 4], [0, 4]).map })).toBe(true);
  });
});
