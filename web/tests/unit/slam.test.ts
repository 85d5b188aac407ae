// What the page works out of the report of mapping from a log.
import { describe, expect, it, vi } from "vitest";
import { Camera } from "../../src/base/camera";
import { Run } from "../../src/report/run";
import type { Belief, Report, Slam, Vec2 } from "../../src/report/types";
import type { Pen } from "../../src/watch/layer";
import { onPath, Scans, slam, slamLegend } from "../../src/watch/slam_layer";
import { slamSeries } from "../../src/watch/slam_series";
import { areaOf } from "../../src/watch/area";
import { report } from "./report";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });

const belief = (time_s: number, x: number, y: number): Belief =>
  ({ time_s, pose: [x, y, 0], sigma_x_m: 0.1, sigma_y_m: 0.2, correlation: 0, sigma_rad: 0.01, corrected: false });

/** Along x at 1 m/s, turned to the left; the belief 0.3 m aside from 5 s on. */
function mapped(more: Partial<Slam> = {}, rest: Partial<Report> = {}): Run {
  const times = Array.from({ length: 11 }, (_, i) => i);
  return new Run(report({ job: "slam", track: times.map((t) => [t, t, 1, Math.PI / 2, 0, 0]), slam: {
    engine: "laser", beliefs: times.map((t) => belief(t, t, t < 5 ? 1 : 1.3)), odometry: times.map((t): Vec2 => [t, 1 - 0.1 * t]), reference: [],
    loops: [{ time_s: 6, from: [6, 1], to: [0, 1] }], scans: [{ time_s: 2, points: [[1, 0], [0, 1]] }, { time_s: 5.5, points: [[2, 0]] }],
    landmarks: [{ id: 12, first_s: 3, position: [2, 2], sigma_x_m: 0.3, sigma_y_m: 0.1, correlation: 0, sightings: 4, truth: [2, 2.5] }], ...more }, ...rest }));
}

describe("what was sensed", () => {
  it("lies where the robot was then, and is the newest that there is", () => {
    const run = mapped();
    const scans = new Scans(run, run.report.slam!);
    expect(scans.at(1.9)).toBeNull();
    const first = scans.at(4)!;
    expect(first.from).toEqual([2, 1]);
    expect(first.points[0]![0]).toBeCloseTo(2);  // ahead is +y
    expect(first.points[0]![1]).toBeCloseTo(2);
    expect(first.points[1]![0]).toBeCloseTo(1);
    expect(first.points[1]![1]).toBeCloseTo(1);
    expect(scans.at(9)!.from[0]).toBeCloseTo(5.5);
  });
});

describe("a way of another robot", () => {
  it("is gone along at equal times from its beginning to its end", () => {
    const path = { start_s: 0, end_s: 4, waypoints: [[0, 0], [2, 0], [2, 2]] as Vec2[] };
    expect(onPath(path, -1)).toEqual({ until: 0, at: [0, 0] });
    expect(onPath(path, 1)).toEqual({ until: 0, at: [1, 0] });
    expect(onPath(path, 3)).toEqual({ until: 1, at: [2, 1] });
    expect(onPath(path, 9)).toEqual({ until: 2, at: [2, 2] });
  });
});

describe("the plots", () => {
  const [beside, odometry, known] = slamSeries(mapped());

  it("tell how far belief and odometry lie from the way as settled", () => {
    expect(beside!.lines.map((one) => one.name)).toEqual(["belief", "2 \u03c3"]);
    expect(beside!.lines[0]!.values.slice(4, 6)).toEqual([0, expect.closeTo(0.3)]);
    expect(beside!.lines[1]!.values[0]).toBeCloseTo(0.4);
    expect(odometry!.lines[0]!.values[10]).toBeCloseTo(1);
  });
  it("count landmarks and loops from when they were known", () => {
    expect(known!.time).toEqual([0, 3, 6, 10]);
    expect(known!.lines.map((one) => one.values)).toEqual([[0, 1, 1, 1], [0, 0, 1, 1]]);
  });
  it("say nothing of a way as settled while nothing is", () => {
    const titles = slamSeries(mapped({}, { status: "running" })).map((one) => one.title);
    expect(titles).toEqual(["Uncertainty of the pose", "Odometry alone, off the belief", "Known"]);
    expect(slamLegend(mapped({}, { status: "running" }))[0]![0]).toBe("way believed so far");
  });
  it("have nothing to tell of another job", () => {
    expect(slamSeries(new Run(report()))).toEqual([]);
    expect(slam(new Run(report()))).toBeNull();
  });
});

describe("the layer", () => {
  it("tells of the landmark under the pointer once it is in the map", () => {
    const run = mapped();
    const layer = slam(run)!;
    const camera = { screen: (x: number, y: number) => ({ x: 10 * x, y: -10 * y }) } as unknown as Camera;
    const pen = (t: number): Pen => ({ camera, now: { t, shot: null, target: null, speed: 0 } }) as unknown as Pen;
    expect(layer.find!({ x: 22, y: -19 }, pen(2))).toBeNull();
    expect(layer.find!({ x: 60, y: -19 }, pen(4))).toBeNull();
    const { lines } = layer.find!({ x: 22, y: -19 }, pen(4))!;
    expect(lines).toEqual(["landmark 12, sighted 4 times", "2\u03c3: 0.600 m by 0.200 m", "0.500 m off its true place"]);
  });
  it("never calls the way true, for nothing is", () => {
    const names = slamLegend(mapped({ reference: [[0, 1]] })).map(([name]) => name);
    expect(names).toEqual(["way settled in the end", "believed then, 2\u03c3", "odometry alone", "reference", "loop closed", "landmark, 2\u03c3", "true place \u00d7", "range finder"]);
    expect(slamLegend(mapped({ engine: "ekf", loops: [], landmarks: [] })).map(([name]) => name).at(-1)).toBe("sightings");
    expect(slamLegend(new Run(report()))).toEqual([]);
  });
  it("shows all of the landmarks where the report names no bounds", () => {
    const world = { ...report().world, bounds: null };
    const [x0, y0, x1, y1] = areaOf(mapped({ landmarks: [{ id: 1, first_s: 0, position: [-20, 30], sigma_x_m: 1, sigma_y_m: 1, correlation: 0, sightings: 1 }] }, { world }));
    expect(x0).toBeLessThan(-20);
    expect(y1).toBeGreaterThan(30);
    expect(x1).toBeGreaterThan(10);
    expect(y0).toBeLessThan(1);
  });
});
