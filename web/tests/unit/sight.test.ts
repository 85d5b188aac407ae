// What the page works out of a report by itself: beams, what a camera sees, the height of the ground.
import { describe, expect, it } from "vitest";
import { nearestOnPolygon, type Vec2 } from "../../src/base/outline";
import { Relief } from "../../src/report/relief";
import { Run } from "../../src/report/run";
import type { Drive, Eye, ReliefGrid, Vec3 } from "../../src/report/types";
import { allAround, Walls } from "../../src/watch/beams";
import { cornerRays, pixelOf, rayThrough, Sight } from "../../src/watch/eye";
import { report } from "./report";

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
    const directions = allAround(0.3, 40);
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

const eye: Eye = { width_px: 640, height_px: 480, fx: 500, fy: 510, cx: 322, cy: 236, ahead_m: 0.1, height_m: 0.3 };

describe("the camera", () => {
  it("has the corners of its picture where their rays come from", () => {
    const at = { x: 2, y: -1, heading: 2.2 };
    const [cos, sin] = [Math.cos(at.heading), Math.sin(at.heading)];
    const pixels = cornerRays(eye).map(([x, y, z]) => {
      const ahead = eye.ahead_m + 3 * x;
      return pixelOf(eye, at, [at.x + ahead * cos - 3 * y * sin, at.y + ahead * sin + 3 * y * cos, eye.height_m + 3 * z])!;
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
    const tag = (id: number, x: number, y: number, facing_rad: number, height_m = 0.3) => ({ id, position: [x, y] as Vec2, facing_rad, size_m: 0.1, height_m });
    const drive: Drive = { loop: "closed", stops: [], beliefs: [], camera: eye,
      tags: [tag(1, 2, 0, Math.PI), tag(2, 2, 0.1, 0), tag(3, -2, 0, 0), tag(4, 2, -0.5, Math.PI), tag(5, 2, 0, Math.PI, 1.5)] };
    const box = { name: "box", kind: "box", low_z_m: 0, high_z_m: 1, blocks_driving: true, footprint: [{ core: [[1, -0.5], [1.1, -0.5], [1.1, -0.15], [1, -0.15]] as Vec2[], radius_m: 0 }] };
    const ids = (high_z_m: number): number[] => {
      const world = { name: "w", bounds: null, gravity_mps2: 9.8, solids: [{ ...box, high_z_m }] };
      return Sight.of(new Run(report({ drive, world })))!.tagsInView({ x: 0, y: 0, heading: 0 }).map((one) => one.id);
    };
    expect(ids(1)).toEqual([1]);       // 2 looks away, 3 is behind, 4 is hidden, 5 is above the picture
    expect(ids(0.2)).toEqual([1, 4]);  // over a box that is lower than the lens
  });
});

describe("the height of the ground", () => {
  const die = dice(3);
  const grid: ReliefGrid = { origin: [-1, 2], spacing_m: [0.5, 0.25], columns: 5, rows: 4, heights_m: Array.from({ length: 20 }, die) };
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
    expect(relief.height(-9, 2)).toBe(grid.heights_m[0]);
    expect(relief.height(99, 99)).toBe(grid.heights_m[19]);
    expect(Relief.of({ ...grid, rows: 7 })).toBeNull();
    expect(Relief.of(undefined)).toBeNull();
  });
});
