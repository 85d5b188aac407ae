// @vitest-environment jsdom
import { describe, expect, it, vi } from "vitest";
import { Run } from "../../src/report/run";
import type { Belief, Pose } from "../../src/report/types";
import { Beliefs, ellipseOf, enlargement } from "../../src/watch/ellipse";
import { report } from "./report";

const belief = (time_s: number, pose: Pose): Belief => ({ time_s, pose, sigma_x_m: 1, sigma_y_m: 1, correlation: 0, sigma_rad: 0, corrected: false });

describe("the ellipse of a belief", () => {
  it("has the extent of the covariance in every direction", () => {
    const [a, b, correlation] = [0.3, 0.1, 0.7];
    const { major, minor, angle } = ellipseOf({ sigma_x_m: a, sigma_y_m: b, correlation });
    for (let direction = 0; direction < Math.PI; direction += 0.1) {
      const [x, y] = [Math.cos(direction), Math.sin(direction)];
      const variance = a * a * x * x + 2 * correlation * a * b * x * y + b * b * y * y;
      expect(Math.hypot(major * Math.cos(direction - angle), minor * Math.sin(direction - angle)) ** 2).toBeCloseTo(variance);
    }
  });

  it("is enlarged where most are small beside the robot", () => {
    const of = (sigma: number) => ({ ...belief(0, [0, 0, 0]), sigma_x_m: sigma, sigma_y_m: sigma });
    expect(enlargement([0.001, 0.002, 0.4].map(of), 0.15)).toBe(10);
    expect(enlargement([0.001, 0.1, 0.4].map(of), 0.15)).toBe(1);
    expect(enlargement([], 0.15)).toBe(10);
  });
});

describe("the belief of an instant", () => {
  const all = [belief(1, [0, 0, 3]), belief(2, [4, 2, -3]), belief(4, [4, 4, -3])];
  const explored = (until: number) => new Beliefs(new Run(report({ track: [[0, 0, 0, 0, 0, 0], [until, 1, 0, 0, 0, 0]],
    drive: { loop: "closed", tags: [], stops: [], beliefs: all } })));

  it("is linear between two, and turns the shorter way", () => {
    const { pose } = explored(4).at(1.5)!;
    expect(pose[0]).toBe(2);
    expect(pose[1]).toBe(1);
    expect(Math.abs(pose[2])).toBeCloseTo(Math.PI);
    expect(explored(4).at(3)!.pose).toEqual([4, 3, -3]);
  });

  it("is none before the first, and when the robot goes on without", () => {
    const beliefs = explored(60);
    expect([0, 0.9, 4, 5.4, 5.6, 60].map((t) => beliefs.at(t) !== null)).toEqual([false, false, true, true, false, false]);
    expect([0, 1, 3.9, 4, 9].map((t) => beliefs.index(t))).toEqual([-1, 0, 1, 2, 2]);
  });
});

describe("the map as it is discovered", () => {
  it("knows as many cells at any time as were known until then", async () => {
    vi.stubGlobal("matchMedia", () => ({ matches: false, addEventListener: () => undefined }));
    const { Discovery } = await import("../../src/watch/explore_layer");
    const known = [5, 2, 2, 9, 0, 7, 7, 1, 3, 3, 8, 4];
    const state = [0, 1, 0, 2, 0, 0, 1, 0, 2, 0, 0, 1];
    const runs = (values: number[]): number[] => values.flatMap((value) => [value, 1]);
    const discovery = new Discovery({ origin: [0, 0], cell_m: 1, columns: 4, rows: 3, state_runs: runs(state), step_s: 0.5, known_runs: runs(known) });
    for (let t = 0; t < 6; t += 0.25) {
      expect(discovery.knownAt(t)).toBe(known.filter((step, i) => state[i] !== 2 && step * 0.5 <= t).length);
      expect(discovery.knownAt(t, discovery.occupied())).toBe(known.filter((step, i) => state[i] === 1 && step * 0.5 <= t).length);
    }
  });
});
