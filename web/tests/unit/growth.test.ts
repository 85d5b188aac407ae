import { describe, expect, it } from "vitest";
import { Growth } from "../../src/live/growth";
import { Run } from "../../src/report/run";
import type { Message } from "../../src/live/socket";
import { report } from "./report";

const told = (messages: Message[]): Growth => {
  const growth = new Growth();
  for (const message of messages) growth.receive(message);
  return growth;
};
const scene = (more: object): Message => ({ type: "scene", report: { ...report(), status: "running", ...more } });
const map = { origin: [0, 0], cell_m: 1, columns: 2, rows: 1, state_runs: [0, 2], step_s: 1, known_runs: [0, 2] };
const target = (status: string) => ({ name: "cat", status, reason: "", pose: [0, 0, 0], centre: [1, 1, 0], size: [1, 1, 1], done_s: 0, shots: 0 });

describe("a report that grows", () => {
  it("is nothing before the scene, and then what the scene says", () => {
    const growth = new Growth();
    expect(growth.receive({ type: "samples", rows: [[0, 0, 0, 0, 0, 0]] })).toBe(false);
    expect(growth.receive({ type: "progress", step: 1 })).toBe(false);
    expect(growth.report).toBeNull();
    expect(growth.receive(scene({ job: "drive" }))).toBe(true);
    expect(growth.report).toMatchObject({ job: "drive", track: [], world: { name: "w" } });
    expect(new Run(growth.report!).duration).toBeGreaterThan(0);
  });

  it("goes on in its lists, in any parts", () => {
    const rows = Array.from({ length: 40 }, (_, i) => [i, i, 0, 0, 0, 0]);
    const events = rows.map(([t]) => ({ time_s: t, kind: "drive", text: "" }));
    for (const step of [1, 7, 40]) {
      const parts: Message[] = [scene({})];
      for (let i = 0; i < 40; i += step) {
        parts.push({ type: "samples", rows: rows.slice(i, i + step) }, { type: "events", events: events.slice(i, i + step) },
          { type: "growth", report: { paths: rows.slice(i, i + step) } });
      }
      expect(told(parts).report).toMatchObject({ track: rows, events, paths: rows });
    }
  });

  it("takes the targets and the map as they are by now", () => {
    const growth = told([scene({ targets: [target("waiting")], explore: { walls: [[[0, 0]]], beliefs: [], decisions: [], refused: [] } }),
      { type: "growth", report: { targets: [target("reached")] } }]);
    expect(growth.report!.targets).toMatchObject([{ status: "reached" }]);
    expect(growth.report!.explore!.map.columns).toBe(0);
    growth.receive({ type: "map", map });
    growth.receive({ type: "map", map: { ...map, columns: 3, state_runs: [0, 3], known_runs: [0, 3] } });
    growth.receive({ type: "growth", report: { explore: { beliefs: [{ time_s: 1 }] } } });
    growth.receive({ type: "growth", report: { explore: { beliefs: [{ time_s: 2 }] } } });
    expect(growth.report!.explore).toMatchObject({ map: { columns: 3 }, walls: [[[0, 0]]], beliefs: [{ time_s: 1 }, { time_s: 2 }] });
  });

  it("lets each robot of a pursuit go on", () => {
    const growth = told([scene({ job: "pursue", pursuit: { columns: 1, rows: 1, cell_m: 1, cost_runs: [1, 1], target: [[0, 0], [1, 0]], robots: [[[0, 0]], [[5, 5]]], paid: [0], bounds: [] } }),
      { type: "growth", report: { pursuit: { robots: [[[1, 1], [2, 2]], []], paid: [3, 4] } } }]);
    expect(growth.report!.pursuit).toMatchObject({ robots: [[[0, 0], [1, 1], [2, 2]], [[5, 5]]], paid: [0, 3, 4], target: [[0, 0], [1, 0]], cost_runs: [1, 1] });
  });

  it("keeps what was found when exploring is over and another job begins", () => {
    const growth = told([scene({ job: "explore", explore: { walls: [], beliefs: [], decisions: [], refused: [] } }), { type: "map", map },
      { type: "samples", rows: [[0, 0, 0, 0, 0, 0]] }, scene({ job: "guard", targets: [target("waiting")], explore: { walls: [], beliefs: [], decisions: [], refused: [] } }),
      { type: "samples", rows: [[1, 0, 0, 0, 0, 0]] }]);
    expect(growth.report).toMatchObject({ job: "guard", explore: { map: { columns: 2 } }, targets: [{ name: "cat" }] });
    expect(growth.report!.track).toHaveLength(2);
  });
});
