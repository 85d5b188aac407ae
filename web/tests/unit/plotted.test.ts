import { describe, expect, it } from "vitest";
import { valueAt } from "../../src/watch/plotted";

describe("a line of a plot", () => {
  const time = [1, 2, 4];
  const colour = "robot" as const;

  it("of steps never tells what comes later", () => {
    const steps = { name: "reached", colour, values: [4, 5, null], steps: true };
    expect([0.9, 1, 1.99, 2, 3.9, 4, 9].map((t) => valueAt(time, steps, t))).toEqual([null, 4, 4, 5, 5, null, null]);
  });

  it("has the values that are drawn between two others, and its last one from then on", () => {
    const line = { name: "charge", colour, values: [4, 6, 0] };
    expect([0, 1, 1.5, 3, 4, 9].map((t) => valueAt(time, line, t))).toEqual([null, 4, 5, 3, 0, 0]);
    expect(valueAt(time, { ...line, values: [4, null, 0] }, 1.5)).toBe(4);
    expect(valueAt([], { ...line, values: [] }, 1)).toBeNull();
  });
});
