// @vitest-environment jsdom
import { describe, expect, it, vi } from "vitest";
import { beliefFinder, ellipseOf } from "../../src/watch/ellipse";

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

  it("is that of the last belief not after the time", () => {
    const beliefs = [1, 2, 4].map((time_s) => ({ time_s, pose: [0, 0, 0] as [number, number, number], sigma_x_m: 1, sigma_y_m: 1, correlation: 0, sigma_rad: 0, saw_tag: false }));
    const find = beliefFinder(beliefs);
    expect([0, 1, 3.9, 4, 9].map(find)).toEqual([-1, 0, 1, 2, 2]);
    expect(beliefFinder([])(3)).toBe(-1);
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
    }
  });
});
