import { describe, expect, it } from "vitest";
import { beliefsOf } from "../../src/log/beliefs";
import type { Pose } from "../../src/log/geometry";
import { topic } from "../../src/log/topics";
import { ellipseOf, enlargement } from "../../src/watch/ellipse";
import { belief, pose, poses, runOf } from "./made";

describe("the ellipse of a belief", () => {
  it("has the extent of the covariance in every direction", () => {
    const [a, b, correlation] = [0.3, 0.1, 0.7];
    const { major, minor, angle } = ellipseOf({ sigma_x: a, sigma_y: b, correlation });
    for (let direction = 0; direction < Math.PI; direction += 0.1) {
      const [x, y] = [Math.cos(direction), Math.sin(direction)];
      const variance = a * a * x * x + 2 * correlation * a * b * x * y + b * b * y * y;
      expect(Math.hypot(major * Math.cos(direction - angle), minor * Math.sin(direction - angle)) ** 2).toBeCloseTo(variance);
    }
  });

  it("is enlarged where most are small beside the robot", () => {
    const of = (sigma: number) => ({ t: 0, pose: [0, 0, 0] as Pose, sigma_x: sigma, sigma_y: sigma, correlation: 0, sigma_heading: 0, corrected: false });
    expect(enlargement([0.001, 0.002, 0.4].map(of), 0.15)).toBe(10);
    expect(enlargement([0.001, 0.1, 0.4].map(of), 0.15)).toBe(1);
    expect(enlargement([], 0.15)).toBe(10);
  });
});

describe("the belief of an instant", () => {
  const all: [number, unknown][] = [[1, belief(0, 0, 3)], [2, belief(4, 2, -3, 0.3, 0.1, 0.5)], [4, belief(4, 4, -3)]];
  const explored = (until: number) => beliefsOf(runOf({ [topic.pose]: poses([[0, 0, 0, 0], [until, 1, 0, 0]]), [topic.belief]: all, [topic.corrections]: [[2, pose(4, 2)]] }));

  it("is read from the covariance; what corrected it has its time", () => {
    expect(explored(4).all[1]).toMatchObject({ t: 2, sigma_x: expect.closeTo(0.3), sigma_y: expect.closeTo(0.1), correlation: expect.closeTo(0.5), corrected: true });
    expect(explored(4).all[0]!.corrected).toBe(false);
  });

  it("is linear between two, and turns the shorter way", () => {
    const { pose: between } = explored(4).at(1.5)!;
    expect(between[0]).toBe(2);
    expect(between[1]).toBe(1);
    expect(Math.abs(between[2])).toBeCloseTo(Math.PI);
    expect(explored(4).at(3)!.pose).toEqual([4, 3, expect.closeTo(-3)]);
  });

  it("is none before the first, and when the robot goes on without", () => {
    const beliefs = explored(60);
    expect([0, 0.9, 4, 5.4, 5.6, 60].map((t) => beliefs.at(t) !== null)).toEqual([false, false, true, true, false, false]);
    expect([0, 1, 3.9, 4, 9].map((t) => beliefs.index(t))).toEqual([-1, 0, 1, 2, 2]);
  });
});
