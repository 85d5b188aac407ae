// The page works out the log of a mapping.
import { describe, expect, it, vi } from "vitest";
import type { Camera } from "../../src/base/camera";
import { landmarksAt, loopsAt } from "../../src/log/mapping";
import type { Run } from "../../src/log/run";
import { topic } from "../../src/log/topics";
import { areaOf } from "../../src/watch/area";
import type { Pen } from "../../src/watch/layer";
import { belief, pose, runOf, type Topics } from "./made";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });
const { mapping, mappingLegend } = await import("../../src/watch/mapping_layer");
const { mappingSeries } = await import("../../src/watch/mapping_series");

const times = Array.from({ length: 11 }, (_, i) => i);
const nowhere = { x: NaN, y: NaN };
const landmark = (id: bigint, first_seen: number, x: number, y: number, truth = nowhere) =>
  ({ id, first_seen, position: { x, y }, sigma_x: 0.3, sigma_y: 0.1, correlation: 0, sightings: 4, truth });
const odometry = times.map((t): [number, unknown] => [t, { pose: { pose: pose(t, 1 - 0.1 * t).pose } }]);
const loops = { loops: [{ closed: 6, from: { x: 6, y: 1 }, to: { x: 0, y: 1 } }] };

/** Along x at 1 m/s; the belief 0.3 m aside from 5 s on; all settled in the end. */
function mapped(more: Topics = {}): Run {
  return runOf({ [topic.belief]: times.map((t) => [t, belief(t, t < 5 ? 1 : 1.3, 0, 0.1, 0.2)]), [topic.odometry]: odometry, [topic.loops]: [[10, loops]],
    [topic.trajectory]: [[10, { poses: times.map((t) => pose(t, 1, 0, t)) }]], [topic.landmarks]: [[4, { landmarks: [landmark(12n, 3, 2.1, 2)] }],
      [10, { landmarks: [landmark(12n, 3, 2, 2, { x: 2, y: 2.5 }), landmark(13n, 5, 7, 2)] }]], ...more });
}
const live: Topics = { [topic.trajectory]: [], [topic.landmarks]: [[4, { landmarks: [landmark(12n, 3, 2, 2)] }]], [topic.loops]: [] };

describe("the map of landmarks at a time", () => {
  const seen = (t: number) => landmarksAt(mapped(), t).map(({ id, position }) => [id, position.x]);
  it("is the latest one, and what came since", () => {
    expect([2, 3, 4, 5, 10].map(seen)).toEqual([[], [[12n, 2]], [[12n, 2.1]], [[12n, 2.1], [13n, 7]], [[12n, 2], [13n, 7]]]);
  });
  it("has loops from when they were closed", () => {
    expect([5, 6, 10].map((t) => loopsAt(mapped(), t).length)).toEqual([0, 1, 1]);
  });
});

describe("the plots", () => {
  const [beside, odometryPlot, known] = mappingSeries(mapped());

  it("tell how far belief and odometry lie from the way as settled", () => {
    expect(beside!.lines.map((one) => one.name)).toEqual(["belief", "2 \u03c3"]);
    expect(beside!.lines[0]!.values.slice(4, 6)).toEqual([0, expect.closeTo(0.3)]);
    expect(beside!.lines[1]!.values[0]).toBeCloseTo(0.4);
    expect(odometryPlot!.lines[0]!.values[10]).toBeCloseTo(1);
  });
  it("count landmarks and loops from when they were known", () => {
    expect(known!.time).toEqual([0, 3, 5, 6, 10]);
    expect(known!.lines.map((one) => one.values)).toEqual([[0, 1, 2, 2, 2], [0, 0, 0, 1, 1]]);
  });
  it("show a reference that has a pose for each of the path", () => {
    const [one] = mappingSeries(mapped({ [topic.reference]: [[10, { poses: times.map((t) => pose(t, 2)) }]] }));
    expect(one!.lines[2]).toMatchObject({ name: "reference off the way", values: times.map(() => 1) });
  });
  it("say nothing of a way as settled while nothing is", () => {
    expect(mappingSeries(mapped(live)).map((one) => one.title)).toEqual(["Uncertainty of the pose", "Odometry alone, off the belief", "Known"]);
    expect(mappingLegend(mapped(live))[0]![0]).toBe("way believed so far");
  });
  it("have nothing to tell where the truth is known", () => {
    const run = mapped({ [topic.pose]: [[0, pose(0, 0)]] });
    expect([mappingSeries(run), mappingLegend(run), mapping(run)]).toEqual([[], [], null]);
    expect([mappingSeries(runOf()), mappingLegend(runOf()), mapping(runOf())]).toEqual([[], [], null]);
  });
});

describe("the layer", () => {
  it("tells of the landmark under the pointer once it is in the map", () => {
    const layer = mapping(mapped())!;
    const camera = { screen: (x: number, y: number) => ({ x: 10 * x, y: -10 * y }) } as unknown as Camera;
    const pen = (t: number): Pen => ({ camera, now: { t, shot: null, target: null, speed: 0 } }) as unknown as Pen;
    expect(layer.find!({ x: 22, y: -19 }, pen(2))).toBeNull();
    expect(layer.find!({ x: 60, y: -19 }, pen(4))).toBeNull();
    const { lines } = layer.find!({ x: 22, y: -19 }, pen(10))!;
    expect(lines).toEqual(["landmark 12, sighted 4 times", "2\u03c3: 0.600 m by 0.200 m", "0.500 m off its true place"]);
  });
  it("never calls the way true, for nothing is", () => {
    const scan: Topics = { [topic.scan]: [[1, {}]], [topic.reference]: [[10, { poses: [pose(0, 1)] }]] };
    const names = (run: Run) => mappingLegend(run).map(([name]) => name);
    expect(names(mapped(scan))).toEqual(["way settled in the end", "believed then, 2\u03c3", "odometry alone", "reference", "loop closed", "landmark, 2\u03c3", "true place \u00d7", "range finder"]);
    expect(names(mapped({ [topic.loops]: [], [topic.landmarks]: [], [topic.sightings]: [[1, { points: [] }]] })).at(-1)).toBe("sightings");
    expect(names(mapped({ [topic.belief]: times.map((t) => [t, belief(t, 1)]) }))[1]).toBe("pose, 2\u03c3");
  });
  it("shows all of the landmarks where the run names no bounds", () => {
    const [x0, y0, x1, y1] = areaOf(mapped({ [topic.landmarks]: [[0, { landmarks: [landmark(1n, 0, -20, 30)] }]] }));
    expect(x0).toBeLessThan(-20);
    expect(y1).toBeGreaterThan(30);
    expect(x1).toBeGreaterThan(10);
    expect(y0).toBeLessThan(1);
  });
});
