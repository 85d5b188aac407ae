import { describe, expect, it } from "vitest";
import { ballOf, flightsOf } from "../../src/log/flights";
import type { Shot, Target } from "../../src/log/messages";
import { planAt, plansOf } from "../../src/log/plans";
import { Run } from "../../src/log/run";
import { alongKnots, targetsOf } from "../../src/log/targets";
import { topic } from "../../src/log/topics";
import { lastNotAfter, Track } from "../../src/log/track";
import { belief, info, logOf, pose, poses, runOf, trackOf } from "./made";

describe("the track", () => {
  const track = trackOf([[0, 0, 0, 3, 0, 0], [1, 2, 0, -3, 0, 0], [1, 2, 0, -3, 0, 0], [4, 2, 6, -3, 0, 1]]);

  it("is linear between poses", () => {
    expect(track.at(0.5)).toMatchObject({ x: 1, y: 0 });
    expect(track.at(2.5)).toMatchObject({ x: 2, y: 3, pitch: 0.5 });
  });

  it("turns the shorter way", () => {
    expect(track.at(0.5).heading).toBeCloseTo(Math.PI);  // from 3 to -3 over pi, not over 0
  });

  it("stands still before its start and after its end", () => {
    expect(track.at(-5)).toMatchObject({ x: 0, y: 0 });
    expect(track.at(99)).toMatchObject({ x: 2, y: 6 });
    expect(new Track({ time: [], poses: [] }).at(3)).toMatchObject({ x: 0, y: 0 });
  });

  it("looks ahead with its gun until that moves", () => {
    const gun = { time: [2, 4], yaw: [1, 2], pitch: [0.2, 0.4] };
    const aimed = new Track({ time: [0, 4], poses: [[0, 0, 0.5], [4, 0, 0.5]] }, gun);
    expect(aimed.at(1)).toMatchObject({ yaw: 0.5, pitch: 0 });
    expect(aimed.at(3).yaw).toBeCloseTo(2.0);  // 1.5 from where it looks
    expect(aimed.at(9).pitch).toBeCloseTo(0.4);
  });

  it("finds poses as a search from the front does", () => {
    const column = [0, 0, 0.5, 2, 2, 3];
    for (let t = -1; t < 4; t += 0.25) {
      const slow = Math.max(0, column.findLastIndex((value) => value <= t));
      expect(lastNotAfter(column, t)).toBe(slow);
    }
  });

  it("is of true poses; else as it was settled, else as it was believed", () => {
    const believed = { [topic.belief]: [[0, belief(0, 1)], [2, belief(2, 1)]] as [number, unknown][] };
    expect(runOf(believed).track.at(1)).toMatchObject({ x: 1, y: 1 });
    const settled = { ...believed, [topic.trajectory]: [[2, { poses: [pose(0, 3, 0, 0), pose(2, 3, 0, 2)] }]] as [number, unknown][] };
    expect(runOf(settled).track.at(1)).toMatchObject({ x: 1, y: 3 });
    expect(runOf({ ...settled, [topic.pose]: poses([[0, 7, 7, 0]]) }).track.at(1)).toMatchObject({ x: 7, y: 7 });
  });
});

const at = (x: number, y: number, z = 0) => ({ x, y, z });
const shot: Shot = { target: "cat", attempt: 1, flight: 0.5, gun_pitch: 0.2, muzzle: at(0, 0, 0.2), velocity: at(8, 0, 2), contact: "cat", contact_point: at(4, 0, -0.025),
  hit: true, clearance: 0.1, path: [], profile: [] };
const target = (status: string, more: Partial<Target> = {}): Target => ({ name: "cat", status, reason: "", size: at(0.3, 0.3, 0.3), yaw: 0, shots: 1, entrance: "", ...more });
const position = (x: number, y: number, seen = { x, y }) => ({ name: "cat", centre: at(x, y, 0.15), believed: seen });

describe("a shot", () => {
  it("flies on a parabola from the muzzle to the contact", () => {
    const run = runOf({ [topic.run]: [[0, info()]], [topic.shots]: [[2, shot]] });
    const [flight] = flightsOf(run);
    expect(ballOf(run, flight!, 0)).toMatchObject({ x: 0, z: 0.2 });
    expect(ballOf(run, flight!, 0.25).z).toBeCloseTo(0.2 + 2 * 0.25 - 4.9 * 0.0625);
    expect(ballOf(run, flight!, 0.5).x).toBeCloseTo(4);
    expect(ballOf(run, flight!, 0.5).z).toBeCloseTo(-0.025);
  });

  it("in air flies along its path", () => {
    const run = runOf({ [topic.shots]: [[2, { ...shot, path: [at(0, 0, 0.2), at(3, 0, 1), at(4, 0, 0)] }]] });
    expect(ballOf(run, flightsOf(run)[0]!, 0.25)).toMatchObject({ x: 3, z: 1, s: 3 });
    expect(ballOf(run, flightsOf(run)[0]!, 0.5)).toMatchObject({ x: 4, z: 0 });
  });
});

describe("a run", () => {
  it("lasts until the last thing that happens", () => {
    const topics = { [topic.shots]: [[2, shot]] as [number, unknown][] };
    expect(runOf(topics).duration).toBe(2.5);
    expect(runOf({ ...topics, [topic.events]: [[9, { name: "wait", msg: "" }]] }).duration).toBe(9);
    expect(runOf().duration).toBeGreaterThan(0);
  });

  it("has its head where the robot is known to be while it goes on", () => {
    const topics = { [topic.pose]: poses([[0, 0, 0, 0], [5, 1, 1, 0]]), [topic.events]: [[8, { name: "wait", msg: "" }]] as [number, unknown][] };
    expect(runOf(topics, true).duration).toBe(5);
    expect(runOf(topics).duration).toBe(8);
    expect(new Run(logOf({ [topic.events]: topics[topic.events]! }), true).duration).toBe(8);
  });

  it("names the last event", () => {
    const run = runOf({ [topic.events]: [[1, { name: "a", msg: "x" }], [3, { name: "b", msg: "y" }]] });
    expect([0, 1, 2, 3, 9].map((t) => run.eventIndex(t))).toEqual([-1, 0, 0, 1, 1]);
    expect(run.eventText(2)).toBe("x");
  });

  it("has bounds only where it names them", () => {
    expect(runOf({ [topic.run]: [[0, info()]] }).bounds).toEqual([[0, 0], [4, 4]]);
    expect(runOf({ [topic.run]: [[0, info({ low: { x: NaN, y: NaN } })]] }).bounds).toBeNull();
    expect(runOf().bounds).toBeNull();
  });

  it("has a robot that is a disk, or has corners", () => {
    expect(runOf({ [topic.run]: [[0, info()]] }).outline).toEqual([]);
    expect(runOf({ [topic.footprint]: [[0, { polygon: { points: [{ x: 1, y: 2, z: 0 }] } }]] }).outline).toEqual([[1, 2]]);
  });

  it("drives a path until the next, or until an empty one ends it", () => {
    const path = (...places: [number, number][]) => ({ poses: places.map(([x, y]) => pose(x, y)) });
    const run = runOf({ [topic.plan]: [[1, path([0, 0], [1, 0])], [3, path([1, 0], [1, 1])], [5, path()]], [topic.goal]: [[3, pose(1, 1, 0.5)]], [topic.pose]: poses([[9, 0, 0, 0]]) });
    expect(plansOf(run).map(({ start, end, goal }) => [start, end, goal?.[2] ?? null])).toEqual([[1, 3, null], [3, 5, expect.closeTo(0.5)]]);
    expect([0, 1, 3, 5].map((t) => planAt(run, t)?.start)).toEqual([undefined, 1, 3, undefined]);
  });
});

describe("a target", () => {
  const of = (states: [number, Target][], places: [number, unknown][]) => targetsOf(runOf({ [topic.targets]: states, [topic.targetPositions]: places, [topic.shots]: [[2, shot]] }))[0]!;

  it("has the state of its latest message at any time", () => {
    const still = of([[0, target("waiting")], [1, target("waiting", { shots: 1 })], [2.5, target("reached", { reason: "hit" })]], [[0, position(4, 0)]]);
    expect([0, 2.4, 2.5].map((t) => still.statusAt(t))).toEqual(["waiting", "waiting", "reached"]);
    expect([still.doneAt, still.pitchBy(9), still.clearanceBy(9), still.last.reason]).toEqual([2.5, 0.2, 0.1, "hit"]);
    expect(still.placeAt(1)).toEqual([4, 0]);
    expect(still.believedAt(1)).toBeNull();
  });

  it("that comes is outside, comes in straight, and leaves once it was reached", () => {
    const visitor = of([[0, target("outside", { entrance: "gate" })], [1, target("waiting", { entrance: "gate" })], [2.5, target("reached", { entrance: "gate" })]],
      [[1, position(0, 0)], [2, position(4, 0)]]);
    expect([0.5, 1.5].map((t) => visitor.statusAt(t))).toEqual(["outside", "waiting"]);
    expect([0.5, 1.5, 2.2, 7].map((t) => visitor.placeAt(t))).toEqual([null, [2, 0], [4, 0], null]);
  });

  it("that walks is believed elsewhere", () => {
    const walker = of([[0, target("waiting")], [4, target("reached")]], [[0, position(0, 0)], [2, position(2, 0, { x: 2, y: 1 })]]);
    expect(walker.believedAt(1)).toEqual([1, 0.5]);
    expect(walker.placeAt(1)).toEqual([1, 0]);
    expect(walker.believedAt(5)).toBeNull();
  });
});

describe("knots", () => {
  it("goes straight between knots", () => {
    const knots = [{ t: 1, at: [0, 0] as [number, number] }, { t: 3, at: [2, 4] as [number, number] }];
    expect(alongKnots(knots, 0)).toEqual([0, 0]);
    expect(alongKnots(knots, 2)).toEqual([1, 2]);
    expect(alongKnots(knots, 5)).toEqual([2, 4]);
    expect(alongKnots([], 1)).toBeNull();
  });
});
