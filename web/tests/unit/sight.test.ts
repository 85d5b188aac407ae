// The page works out some of a log by itself: scans in the map, what a camera sees, the height of the ground.
import { describe, expect, it } from "vitest";
import { nearestOnPolygon, type Vec2 } from "../../src/base/outline";
import type { Vec3 } from "../../src/log/geometry";
import type { Terrain } from "../../src/log/messages";
import { Relief } from "../../src/log/relief";
import { sensesOf } from "../../src/log/sensed";
import { topic } from "../../src/log/topics";
import { Walls } from "../../src/watch/beams";
import { cornerRays, pixelOf, rayThrough, Sight, type Eye } from "../../src/watch/eye";
import { belief, poses, runOf } from "./made";

/** Numbers from 0 to 1, the same each time. */
function dice(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

describe("beams", () => {
  it("end where a walk along them in small steps first comes to a wall", () => {
    const die = dice(7);
    const outlines = Array.from({ length: 12 }, (): Vec2[] => {
      const [x, y, r] = [8 * die() - 4, 8 * die() - 4, 0.2 + 0.5 * die()];
      return Array.from({ length: 5 }, (_, i): Vec2 => [x + r * Math.cos(1.2566 * i), y + r * Math.sin(1.2566 * i)]);
    }).filter((outline) => nearestOnPolygon(0, 0, outline).distance > 0.05);
    const directions = Float64Array.from({ length: 40 }, (_, i) => 0.3 + (2 * Math.PI * i) / 40);
    const ranges = new Walls(outlines).cast(0, 0, directions, 3.5);
    const step = 0.01;
    directions.forEach((direction, i) => {
      let walked = 0;
      const meets = (): boolean => outlines.some((outline) => nearestOnPolygon(walked * Math.cos(direction), walked * Math.sin(direction), outline).distance === 0);
      while (walked < 3.5 && !meets()) walked += step;
      expect(ranges[i]).toBeLessThanOrEqual(walked + 1e-9);
      if (ranges[i]! < 3.5) expect(edgeDistance(outlines, ranges[i]!, direction)).toBeLessThan(1e-9);  // a walk may step over a corner
    });
    expect(ranges.filter((range) => range < 3.5).length).toBeGreaterThan(5);
  });

  it("are as long as the range where nothing is near, and end at the near wall of two", () => {
    const square = (x: number): Vec2[] => [[x, -1], [x + 0.1, -1], [x + 0.1, 1], [x, 1]];
    const walls = new Walls([square(2), square(1)]);
    expect([...walls.cast(0, 0, [0, Math.PI], 3.5)]).toEqual([1, 3.5]);
    expect(walls.cast(0, 0, [0], 0.5)[0]).toBe(0.5);
    expect(walls.sees([0, 0], [0.9, 0])).toBe(true);
    expect(walls.sees([0, 0], [1.5, 0])).toBe(false);
  });
});

/** From the end of a beam to the nearest edge. */
function edgeDistance(outlines: Vec2[][], range: number, direction: number): number {
  const [x, y] = [range * Math.cos(direction), range * Math.sin(direction)];
  return Math.min(...outlines.flatMap((outline) => outline.map((a, i) =>
    nearestOnPolygon(x, y, [a, outline[(i + 1) % outline.length]!]).distance)));
}

const eye: Eye = { width: 640, height: 480, fx: 500, fy: 510, cx: 322, cy: 236, ahead: 0.1, above: 0.3 };

describe("the camera", () => {
  it("has the corners of its picture where their rays come from", () => {
    const at = { x: 2, y: -1, heading: 2.2 };
    const [cos, sin] = [Math.cos(at.heading), Math.sin(at.heading)];
    const pixels = cornerRays(eye).map(([x, y, z]) => {
      const ahead = eye.ahead + 3 * x;
      return pixelOf(eye, at, [at.x + ahead * cos - 3 * y * sin, at.y + ahead * sin + 3 * y * cos, eye.above + 3 * z])!;
    });
    const corners = [[0, 0], [640, 0], [640, 480], [0, 480]];
    pixels.forEach((pixel, i) => pixel.forEach((value, k) => expect(value).toBeCloseTo(corners[i]![k]!, 6)));
    expect(pixelOf(eye, at, [at.x - cos, at.y - sin, 0.3])).toBeNull();
  });

  it("looks ahead: left in the picture is left, up is up", () => {
    expect(rayThrough(eye, 322.5, 236.5).map((value) => value + 0)).toEqual([1, 0, 0]);
    expect(rayThrough(eye, 0, 236.5)[1]).toBeGreaterThan(0);
    expect(rayThrough(eye, 322.5, 0)[2]).toBeGreaterThan(0);
  });

  it("sees tags that face it, in the picture, with nothing before them", () => {
    const tag = (id: number, x: number, y: number, facing: number, z = 0.3) => ({ id, position: { x, y, z }, facing, size: 0.1 });
    const mount = { child_frame_id: "camera", transform: { translation: { x: eye.ahead, y: 0, z: eye.above }, rotation: { x: 0, y: 0, z: 0, w: 1 } } };
    const topics = { [topic.camera]: [[0, { width: 640, height: 480, k: [500, 0, 322, 0, 510, 236, 0, 0, 1] }]] as [number, unknown][],
      [topic.staticTransforms]: [[0, { transforms: [mount] }]] as [number, unknown][], [topic.pose]: poses([[0, 0, 0, 0]]) };
    const tags = { tags: [tag(1, 2, 0, Math.PI), tag(2, 2, 0.1, 0), tag(3, -2, 0, 0), tag(4, 2, -0.5, Math.PI), tag(5, 2, 0, Math.PI, 1.5)] };
    const points = [[1, -0.5], [1.1, -0.5], [1.1, -0.15], [1, -0.15]].map(([x, y]) => ({ x, y }));
    const ids = (high_z: number): number[] => {
      const solids = { solids: [{ name: "box", kind: "box", low_z: 0, high_z, blocks_driving: true, footprint: [{ points, radius: 0 }] }] };
      return Sight.of(runOf({ ...topics, [topic.tags]: [[0, tags]], [topic.solids]: [[0, solids]] }))!.tagsInView({ x: 0, y: 0, heading: 0 }).map((one) => one.id);
    };
    expect(ids(1)).toEqual([1]);       // 2 looks away, 3 is behind, 4 is hidden, 5 is above the picture
    expect(ids(0.2)).toEqual([1, 4]);  // over a box that is lower than the lens
  });
});

describe("a scan", () => {
  const scan = (...ranges: number[]) => ({ angle_min: -Math.PI / 2, angle_increment: Math.PI / 2, range_min: 0.1, range_max: 5, ranges: Float32Array.from(ranges) });
  const mount = { child_frame_id: "laser", transform: { translation: { x: 0.5, y: 0, z: 0.3 }, rotation: { x: 0, y: 0, z: 0, w: 1 } } };
  const topics = { [topic.staticTransforms]: [[0, { transforms: [mount] }]] as [number, unknown][],
    [topic.scan]: [[1, scan(2, 1, Infinity)], [2, scan(0.01, 5, 3)]] as [number, unknown][], [topic.belief]: [[0, belief(0, 5)], [4, belief(0, 5)]] as [number, unknown][] };
  const rounded = (places: [number, number][]) => places.map(([x, y]) => [Math.round(1e3 * x) / 1e3 + 0, Math.round(1e3 * y) / 1e3 + 0]);

  it("lies where the robot truly was, and is the newest that there is", () => {
    const run = runOf({ ...topics, [topic.pose]: poses([[0, 0, 0, Math.PI / 2], [2, 2, 0, Math.PI / 2]]) });
    expect(sensesOf(run).at(0.5)).toBeNull();
    const first = sensesOf(run).at(1.5)!;
    expect(rounded([first.from])).toEqual([[1, 0.5]]);
    expect(rounded(first.points)).toEqual([[3, 0.5], [1, 1.5]]);     // to the right, ahead
    expect(rounded(first.ends)).toEqual([[3, 0.5], [1, 1.5], [-4, 0.5]]);
    expect(rounded(sensesOf(run).at(3)!.points)).toEqual([[-1, 0.5]]);  // too near, at the end of the range, left
    expect(sensesOf(run).at(99)).toBeNull();  // the mapping is over
  });
  it("lies where the robot was believed to be, where the truth is not known", () => {
    expect(rounded([sensesOf(runOf(topics)).at(1.5)!.from])).toEqual([[0.5, 5]]);
  });
  it("of landmarks has their places alone", () => {
    const run = runOf({ [topic.belief]: topics[topic.belief], [topic.sightings]: [[1, { points: [{ x: 1, y: 2 }] }]] });
    expect(sensesOf(run).at(2)).toEqual({ isLaser: false, from: [0, 5], points: [[1, 7]], ends: [] });
  });
});

describe("the height of the ground", () => {
  const die = dice(3);
  const grid: Terrain = { contours: [], steep: [], origin: { x: -1, y: 2 }, spacing: { x: 0.5, y: 0.25 }, columns: 5, rows: 4, heights: Array.from({ length: 20 }, die) };
  const relief = Relief.of(grid)!;
  const post = (column: number, row: number): Vec3 => relief.post(column, row);

  it("is that of the triangle there", () => {
    for (let n = 0; n < 200; ++n) {
      const [x, y] = [-1 + 2 * die(), 2 + 0.75 * die()];
      // All triangles, by barycentric coordinates.
      const heights: number[] = [];
      for (let row = 0; row < 3; ++row) {
        for (let column = 0; column < 4; ++column) {
          const [low, high] = [post(column, row), post(column + 1, row + 1)];
          for (const third of [post(column + 1, row), post(column, row + 1)]) {
            const [ax, ay, bx, by] = [high[0] - low[0], high[1] - low[1], third[0] - low[0], third[1] - low[1]];
            const area = ax * by - ay * bx;
            const u = ((x - low[0]) * by - (y - low[1]) * bx) / area;
            const v = (ax * (y - low[1]) - ay * (x - low[0])) / area;
            if (u >= 0 && v >= 0 && u + v <= 1) heights.push(low[2] + u * (high[2] - low[2]) + v * (third[2] - low[2]));
          }
        }
      }
      expect(heights.length).toBeGreaterThan(0);
      expect(relief.height(x, y)).toBeCloseTo(heights[0]!, 9);
      const normal = relief.normal(x, y);
      const slope = (relief.height(x + 1e-7, y) - relief.height(x - 1e-7, y)) / 2e-7;
      if (Math.abs(relief.normal(x + 1e-6, y)[0] - relief.normal(x - 1e-6, y)[0]) < 1e-9) expect(normal[0]).toBeCloseTo(-slope, 4);
    }
  });

  it("goes on level beyond the edge, and is not known where numbers are missing", () => {
    expect(relief.height(-9, 2)).toBe(grid.heights[0]);
    expect(relief.height(99, 99)).toBe(grid.heights[19]);
    expect(Relief.of({ ...grid, rows: 7 })).toBeNull();
    expect(Relief.of(undefined)).toBeNull();
  });
});
