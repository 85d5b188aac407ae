// @vitest-environment jsdom
import type { Mesh } from "three";
import { describe, expect, it, vi } from "vitest";
import { coverOf } from "../../src/log/cover";
import type { Vec2 } from "../../src/log/geometry";
import { topic } from "../../src/log/topics";
import { comesOver, Way } from "../../src/log/way";
import { info, poses, runOf, trackOf } from "./made";

vi.stubGlobal("matchMedia", () => ({ matches: false, addEventListener: () => undefined }));
const { areaOfOutlines, coverLegend, passAt, storyOf, within } = await import("../../src/watch/cover_layer");
const { coverSeries } = await import("../../src/watch/cover_series");
const { pictureSize, Strip } = await import("../../src/watch/strip");
const { rolesActor } = await import("../../src/watch/space_cover");

/** East with a ramp, a turn, north, back west over the same way again. */
const rows = [[0, 0, 0, 0], [1, 0.5, 0, 0], [2, 2, 0, 0], [5, 2, 0, 1.57], [7, 2, 2, 1.57], [9, 2, 0, -1.57], [11, 0, 0, 3.14]];
const track = trackOf(rows);
const square = (low: number, high: number): Vec2[] => [[low, low], [high, low], [high, high], [low, high]];
const outline = (points: Vec2[]) => ({ points: points.map(([x, y]) => ({ x, y })) });
const area = { area: [outline(square(-1, 4)), outline([...square(3, 3.5)].reverse())], reach: [outline(square(-0.9, 2.9))], missed: [], overlap: [], planned: [] };
const run = runOf({ [topic.run]: [[0, info()]], [topic.pose]: poses(rows), [topic.coverageArea]: [[0, area]],
  [topic.coveragePasses]: [[0, { role: "lap" }], [5, { role: "lane" }]], [topic.coverage]: [[0, { covered: 0, overlap: 0 }], [11, { covered: 7.22, overlap: 3.61 }]] });
const cover = coverOf(run)!;

describe("the way", () => {
  const way = new Way(track);

  it("has the corners alone, at the times when they are reached", () => {
    expect(way.corners).toEqual([[0, 0], [2, 0], [2, 2], [2, 0], [0, 0]]);
    expect(way.time).toEqual([0, 2, 7, 9, 11]);
    expect(new Way(track, [1]).time).toEqual([0, 1, 2, 7, 9, 11]);
  });

  it("is as long between two times as the track is", () => {
    const length = (line: Vec2[]): number => line.reduce((sum, [x, y], i) => sum + (i ? Math.hypot(x - line[i - 1]![0], y - line[i - 1]![1]) : 0), 0);
    for (let from = 0; from < 11; from += 0.7) {
      for (let to = from; to < 11.5; to += 0.9) {
        const fine = Array.from({ length: 1001 }, (_, i): Vec2 => way.at(from + ((to - from) * i) / 1000));
        expect(length(way.between(from, to))).toBeCloseTo(length(fine), 1);
      }
    }
  });
});

describe("the way in space", () => {
  const actors = rolesActor(run, cover, 0, 0.1);

  it("ends a step behind the robot, also while it turns in place", () => {
    for (let t = 0.3; t < 11; t += 0.37) {
      const at = track.at(t);
      let nearest = Infinity;
      for (const { things: [thing], act } of actors) {
        act!({ t, shot: null, target: null, speed: 0 });
        const { geometry } = thing as Mesh;
        const [index, places] = [geometry.getIndex()!, geometry.getAttribute("position")];
        for (let i = 0; i < geometry.drawRange.count; ++i) {
          const k = index.getX(i);
          const [x, y] = [places.getX(k), places.getY(k)];
          expect(rows.some(([from], i) => from! <= t && onLeg(i, x, y, t)), `(${x}, ${y}) at ${t}`).toBe(true);
          nearest = Math.min(nearest, Math.hypot(x - at.x, y - at.y));
        }
      }
      expect(nearest, `at ${t}`).toBeLessThan(0.25);
    }
  });

  /** Returns true if a place lies within half the ribbon of a leg of the track, as far as it is driven at t. */
  function onLeg(i: number, x: number, y: number, t: number): boolean {
    const [from, ax, ay] = rows[i]!;
    const to = rows[i + 1]?.[0] ?? from!;
    const { x: bx, y: by } = track.at(Math.min(t, to));
    const [dx, dy] = [bx - ax!, by - ay!];
    const share = Math.min(1, Math.max(0, ((x - ax!) * dx + (y - ay!) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(ax! + share * dx - x, ay! + share * dy - y) < 0.0751;
  }
});

describe("a place", () => {
  it("is come over when a dense look at the track says so", () => {
    for (let k = 0; k < 24; ++k) {
      const [x, y] = [-0.8 + ((k * 0.618) % 1) * 3.6, -0.8 + ((k * 0.382) % 1) * 3.6];
      const slow: number[] = [];
      let over = false;
      for (let i = 0; i <= 11000; ++i) {
        const at = track.at(i / 1000);
        const now = Math.hypot(at.x - x, at.y - y) <= 0.5;
        if (now && !over) slow.push(i / 1000);
        over = now;
      }
      const found = comesOver(track, x, y, 0.5);
      expect(found.length, `(${x}, ${y})`).toBe(slow.length);
      found.forEach((t, i) => expect(Math.abs(t - slow[i]!)).toBeLessThan(0.0011));
    }
  });

  it("has a story: covered and when, missed, out of reach; none outside and in a hole", () => {
    expect(storyOf(run, cover, 0.1, 0)).toBe("covered at 0:00, 0:10");
    expect(storyOf(run, cover, 0, 2)).toBe("missed");
    expect(storyOf(run, cover, 3.9, 2)).toBe("out of reach");
    expect(storyOf(run, cover, 3.2, 3.2)).toBeNull();
    expect(storyOf(run, cover, 9, 9)).toBeNull();
    expect(within(cover.area, 3.2, 3.2)).toBe(false);
  });
});

describe("what is told of covering", () => {
  it("is the share of the reach, by outlines with holes", () => {
    expect(areaOfOutlines(cover.area)).toBeCloseTo(25 - 0.25);
    const [series] = coverSeries(run);
    const [covered, overlap] = series!.lines.map((line) => line.values[1]);
    expect(covered).toBeCloseTo(50);
    expect(overlap).toBeCloseTo(25);
  });

  it("is the pass that goes on, and none in the end", () => {
    expect([0, 4.9, 5, 10.9].map((t) => passAt(cover, t)!.role)).toEqual(["lap", "lap", "lane", "lane"]);
    expect(passAt(cover, 11)).toBeUndefined();
  });

  it("is named as far as it is there", () => {
    expect(coverLegend(run).map((one) => one.name)).toEqual(["covered", "lap", "lane", "planned", "out of reach"]);
    expect(coverLegend(runOf())).toEqual([]);
  });
});

describe("the strip", () => {
  /** Lines that a canvas shows, in the order of their drawing. */
  const shown = new Map<HTMLCanvasElement, string[]>();
  const lines = (canvas: HTMLCanvasElement): string[] => shown.get(canvas) ?? [];
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockImplementation(function (this: HTMLCanvasElement) {
    let path: string[] = [];
    const add = (...more: string[]): void => { shown.set(this, [...lines(this), ...more]); };
    return { strokeStyle: "", setTransform: () => undefined, beginPath: () => { path = []; }, moveTo: (...p: number[]) => path.push(String(p)), lineTo: (...p: number[]) => path.push(String(p)),
      arc: (x: number, y: number) => path.push(`disk ${x},${y}`), fill: () => add(path.join(" ")), stroke(this: { strokeStyle: string }) { add(`${this.strokeStyle} ${path.join(" ")}`); },
      clearRect: () => shown.set(this, []), drawImage: (other: HTMLCanvasElement) => add(...lines(other)) } as never;
  });
  for (const name of ["width", "height"]) {
    Object.defineProperty(HTMLCanvasElement.prototype, name, { get: () => 0, set(this: HTMLCanvasElement) { shown.set(this, []); } });
  }

  it("shows the same at a time, whatever it showed before", () => {
    const of = (times: number[], view: (t: number) => string = () => "v"): string[] => {
      const strip = new Strip(new Way(track), [(ctx) => { ctx.strokeStyle = "thick"; }, (ctx) => { ctx.strokeStyle = "thin"; }], (leg) => leg % 2);
      for (const t of times) strip.paint(t, { size: [10, 10], name: view(t), px: 1, toPlane: () => undefined }, "");
      return lines(strip.canvas);
    };
    for (const t of [0, 1, 2, 4, 8.3, 11, 99]) {
      const alone = of([t]);
      expect(of([0.5, 1, 3, 6, t].filter((one) => one <= t).concat(t))).toEqual(alone);
      expect(of([11, 9, t])).toEqual(alone);
      expect(of([0, 8, t], String)).toEqual(alone);
    }
    expect(of([8])).toEqual(["thick 0,0 2,0", "thin 2,0 2,2", "thick 2,2 2,1"]);
    expect(of([0])).toEqual(["disk 0,0"]);
  });

  it("is painted in the proportions of the area", () => {
    expect(pictureSize([0, 0, 4, 1], 1000)).toEqual({ size: [1000, 250], scale: 250 });
    expect(pictureSize([1, 2, 2, 12], 500).size).toEqual([50, 500]);
  });
});
