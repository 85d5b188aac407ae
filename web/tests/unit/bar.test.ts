import { describe, expect, it } from "vitest";
import type { Vec2 } from "../../src/base/outline";
import { barComesOver, hullOf, sweptBetween } from "../../src/log/bar";
import { trackOf } from "./made";

const bar = { width: 1.2, length: 0.3, forward: 0.5 };
/** East, a turn on the spot, north, a quarter of a circle as one row. */
const track = trackOf([[0, 0, 0, 0], [4, 4, 0, 0], [6, 4, 0, 1.57], [9, 4, 3, 1.57], [11, 4, 3, 0]]);

/** A dense look: is the place in the rectangle at that time? */
function isOver(t: number, [px, py]: Vec2, wider = 0): boolean {
  const { x, y, heading } = track.at(t);
  const [dx, dy, c, s] = [px - x, py - y, Math.cos(heading), Math.sin(heading)];
  return Math.abs(dx * c + dy * s - bar.forward) <= bar.length / 2 + wider && Math.abs(dy * c - dx * s) <= bar.width / 2 + wider;
}

describe("a bar", () => {
  it("comes over a place when a dense look says so", () => {
    let covered = 0;
    for (let k = 0; k < 200; ++k) {
      const place: Vec2 = [-1 + ((k * 0.618) % 1) * 7, -1.5 + ((k * 0.382) % 1) * 6];
      const times = Array.from({ length: 11001 }, (_, i) => i / 1000);
      const found = barComesOver(bar, track, ...place).length > 0;
      if (times.some((t) => isOver(t, place))) expect(found, String(place)).toBe(true);
      if (found) expect(times.some((t) => isOver(t, place, 0.01)), String(place)).toBe(true);
      covered += found ? 1 : 0;
    }
    expect(covered).toBeGreaterThan(30);
    expect(covered).toBeLessThan(170);
  });

  it("covers ahead of the robot, not about it", () => {
    const [ring] = sweptBetween(bar, track, 0, 0);
    expect(Math.min(...ring!.map(([x]) => x))).toBeCloseTo(0.35);
    expect(Math.max(...ring!.map(([x]) => x))).toBeCloseTo(0.65);
    expect(Math.max(...ring!.map(([, y]) => y))).toBeCloseTo(0.6);
  });

  it("is told by hulls without corners on their sides", () => {
    expect(hullOf([[0, 0], [1, 0], [2, 0], [2, 2], [0, 2], [1, 1], [0, 1]])).toEqual([[0, 0], [2, 0], [2, 2], [0, 2]]);
  });
});
