import { describe, expect, it } from "vitest";
import { keyOf } from "../../src/base/keys";
import { headingTo, turned, wrapAngle } from "../../src/plan/turning";
import { placed, Yard, type YardScenario } from "../../src/plan/yard";

const square: [number, number][] = [[1, 1], [3, 1], [3, 2], [1, 2]];
const scenario: YardScenario = {
  path: "yard.yaml", start: [0, -2], heading_rad: 1, fixed: [],
  map: { id: "1", name: "yard", radius_m: 0, warnings: [], polygons: { boundary: [], obstacles: [square], queries: [] } },
  targets: [{ name: "fox", position: [4, 4, 0.3], size: [0.5, 0.2, 0.3], heading_rad: 0 }, { name: "cat", position: [-4, 4, 0], size: [0.5, 0.2, 0.3], heading_rad: 0 }],
  things: [{ name: "bench", middle: [2, 1.5], polygons: [square], place: [2, 1.5], turn_rad: 0, removed: false },
    { name: "post", middle: [2, 1.5], polygons: [[[1.9, 1.4], [2.1, 1.4], [2, 1.6]]], place: [2, 1.5], turn_rad: 0, removed: false }],
};
const bench = { what: "thing", index: 0 } as const;

describe("a yard that is changed", () => {
  it("asks for nothing that was not changed", () => {
    const { moved, removed, boxes, start, heading_rad, targets } = new Yard(scenario).request;
    expect({ moved, removed, boxes, start, heading_rad }).toEqual({ moved: [], removed: [], boxes: [], start: [0, -2], heading_rad: 1 });
    expect(targets.map(({ name }) => name)).toEqual(["fox", "cat"]);
  });

  it("moves and turns a thing about its middle, and knows it where it stands", () => {
    const yard = new Yard(scenario);
    yard.moveTo(bench, [10, 0]);
    yard.turnTo(bench, Math.PI / 2);
    const [corner] = yard.outlines(bench)[0]!;
    expect(corner![0]).toBeCloseTo(10.5);
    expect(corner![1]).toBeCloseTo(-1);
    expect(yard.at([10, 0.9], 0.1)).toEqual(bench);
    expect(yard.at([3, 1.9], 0.1)).toBeNull();
    expect(yard.request.moved).toEqual([{ name: "bench", place: [10, 0], turn_rad: Math.PI / 2 }]);
    yard.putBack(bench);
    expect(yard.request.moved).toEqual([]);
    expect(placed(square, [2, 1.5], [2, 1.5], 0)).toEqual(square);
  });

  it("takes the robot and targets before what stands below them, and the smaller of two things", () => {
    const yard = new Yard(scenario);
    expect(yard.at([0.1, -2], 0.2)).toEqual({ what: "robot", index: 0 });
    expect(yard.at([4, 4.1], 0.2)).toEqual({ what: "target", index: 0 });
    expect(yard.at([2, 1.5], 0.2)).toEqual({ what: "thing", index: 1 });
    expect(yard.at([1.2, 1.1], 0.2)).toEqual(bench);
    expect(yard.nextObstacle(bench)).toEqual({ what: "thing", index: 1 });
    expect(yard.nextTarget(null)).toEqual({ what: "target", index: 0 });
  });

  it("takes things away and brings them back; targets and boxes go", () => {
    const yard = new Yard(scenario);
    expect(yard.remove(bench)).toEqual(bench);
    expect(yard.request.removed).toEqual(["bench"]);
    yard.moveTo(yard.addBox([5, 5]), [6, 6]);
    yard.turnTo({ what: "box", index: 0 }, 0.5);
    expect(yard.request.boxes).toEqual([[5.5, 5.5, 6.5, 6.5, 0.5]]);
    yard.remove({ what: "target", index: 0 });
    expect(yard.request.targets.map(({ name }) => name)).toEqual(["cat"]);
    yard.remove(bench);
    expect(yard.request.removed).toEqual([]);
    expect(scenario.things[0]!.removed).toBe(false);  // what was given stays
  });

  it("takes every step back, and does it again", () => {
    const yard = new Yard(scenario);
    const said = [JSON.stringify(yard.request)];
    const steps = [() => yard.moveTo(bench, [7, 7]), () => yard.turnTo({ what: "robot", index: 0 }, 2), () => yard.remove({ what: "target", index: 0 }),
      () => { yard.addTarget([1, 1]); }, () => yard.remove({ what: "thing", index: 1 }), () => { yard.addBox([0, 0]); }];
    for (const step of steps) {
      yard.remember();
      step();
      said.push(JSON.stringify(yard.request));
    }
    for (let i = steps.length - 1; i >= 0; --i) {
      expect(yard.undo()).toBe(true);
      expect(JSON.stringify(yard.request)).toBe(said[i]);
    }
    expect(yard.undo()).toBe(false);
    for (let i = 1; i <= steps.length; ++i) {
      expect(yard.undo(true)).toBe(true);
      expect(JSON.stringify(yard.request)).toBe(said[i]);
    }
    yard.undo();
    yard.remember();
    expect(yard.undo(true)).toBe(false);
  });
});

describe("turning", () => {
  it("halts at round angles, and goes from one to the next by the keyboard", () => {
    const degree = Math.PI / 180;
    expect(headingTo([1, 1.02], [0, 0])).toBeCloseTo(45 * degree, 12);
    expect(headingTo([1, 0.64], [0, 0])).toBeCloseTo(Math.atan2(0.64, 1), 12);
    expect(turned(43 * degree, 1)).toBeCloseTo(45 * degree, 12);
    expect(turned(45 * degree, 1)).toBeCloseTo(50 * degree, 12);
    expect(turned(45 * degree, -1)).toBeCloseTo(40 * degree, 12);
    expect(turned(178 * degree, 1)).toBeCloseTo(180 * degree, 12);
    expect(wrapAngle(3 * Math.PI / 2)).toBeCloseTo(-Math.PI / 2, 12);
  });

  it("is undone by ctrl and z", () => {
    expect(keyOf({ key: "z", shiftKey: false, ctrlKey: true })).toBe("Ctrl+z");
    expect(keyOf({ key: "z", shiftKey: false, metaKey: true })).toBe("Ctrl+z");
    expect(keyOf({ key: "ArrowLeft", shiftKey: true })).toBe("Shift+ArrowLeft");
  });
});
