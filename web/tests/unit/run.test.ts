import { describe, expect, it } from "vitest";
import { alongKnots, Run } from "../../src/report/run";
import { lastNotAfter, Track } from "../../src/report/track";
import { parseReport, type Shot, type Target } from "../../src/report/types";
import { report } from "./report";

describe("the track", () => {
  const track = new Track([[0, 0, 0, 3, 0, 0], [1, 2, 0, -3, 0, 0], [1, 2, 0, -3, 0, 0], [4, 2, 6, -3, 0, 1]], [0, 0, 0]);

  it("is linear between rows", () => {
    expect(track.at(0.5)).toMatchObject({ x: 1, y: 0 });
    expect(track.at(2.5)).toMatchObject({ x: 2, y: 3, pitch: 0.5 });
  });

  it("turns the shorter way", () => {
    expect(track.at(0.5).heading).toBeCloseTo(Math.PI);  // from 3 to -3 over pi, not over 0
  });

  it("stands still before its start and after its end", () => {
    expect(track.at(-5)).toMatchObject({ x: 0, y: 0 });
    expect(track.at(99)).toMatchObject({ x: 2, y: 6 });
  });

  it("is the start pose where the report has none", () => {
    expect(new Track([], [1, 2, 0.5]).at(3)).toMatchObject({ x: 1, y: 2, heading: 0.5 });
  });

  it("finds rows as a search from the front does", () => {
    const column = [0, 0, 0.5, 2, 2, 3];
    for (let t = -1; t < 4; t += 0.25) {
      const slow = Math.max(0, column.findLastIndex((value) => value <= t));
      expect(lastNotAfter(column, t)).toBe(slow);
    }
  });
});

const shot: Shot = { target: "cat", attempt: 1, time_s: 2, flight_s: 0.5, muzzle: [0, 0, 0.2], velocity_mps: [8, 0, 2], contact: "cat",
  contact_point: [4, 0, -0.025], hit: true, clearance_m: 0.1, profile: [] };
const target: Target = { name: "cat", status: "reached", reason: "", pose: [], pitch_rad: 0, yaw_rad: 0, speed_mps: 0, clearance_m: 0.1, done_s: 2.5,
  shots: 1, centre: [4, 0, 0], size: [0.3, 0.3, 0.3], box_yaw_rad: 0 };

describe("a run", () => {
  it("flies the ball on a parabola from the muzzle to the contact", () => {
    const run = new Run(report({ shots: [shot] }));
    const flight = run.flights[0]!;
    expect(run.ball(flight, 0)).toMatchObject({ x: 0, z: 0.2 });
    expect(run.ball(flight, 0.25).z).toBeCloseTo(0.2 + 2 * 0.25 - 4.9 * 0.0625);
    expect(run.ball(flight, 0.5).x).toBeCloseTo(4);
    expect(run.ball(flight, 0.5).z).toBeCloseTo(-0.025);
  });

  it("flies a shot in air along its path", () => {
    const run = new Run(report({ shots: [{ ...shot, path: [[0, 0, 0.2], [3, 0, 1], [4, 0, 0]] }] }));
    expect(run.ball(run.flights[0]!, 0.25)).toMatchObject({ x: 3, z: 1, s: 3 });
    expect(run.ball(run.flights[0]!, 0.5)).toMatchObject({ x: 4, z: 0 });
  });

  it("lasts until the last thing that happens", () => {
    expect(new Run(report({ shots: [shot], events: [{ time_s: 9, kind: "wait", text: "" }] })).duration).toBe(9);
    expect(new Run(report()).duration).toBeGreaterThan(0);
  });

  it("knows the state of a target at any time", () => {
    const visit = { entrance: "gate", from: [0, 0] as [number, number], enters_s: 1, settles_s: 2 };
    const run = new Run(report({ targets: [target, { ...target, visit }] }));
    const [still, visitor] = run.report.targets as [Target, Target];
    expect([0, 2.4, 2.5].map((t) => run.status(still, t))).toEqual(["waiting", "waiting", "reached"]);
    expect(run.status(visitor, 0.5)).toBe("outside");
    expect(run.place(visitor, 0.5)).toBeNull();
    expect(run.place(visitor, 1.5)).toEqual([2, 0]);
    expect(run.place(visitor, 2.2)).toEqual([4, 0]);
    expect(run.place(visitor, 7)).toBeNull();  // it leaves once it was reached
  });

  it("names the last event", () => {
    const run = new Run(report({ events: [{ time_s: 1, kind: "a", text: "" }, { time_s: 3, kind: "b", text: "" }] }));
    expect([0, 1, 2, 3, 9].map((t) => run.eventIndex(t))).toEqual([-1, 0, 0, 1, 1]);
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

describe("reading a report", () => {
  it("takes one and refuses what is none, with a sentence", () => {
    expect(parseReport(JSON.stringify(report()))).toMatchObject({ job: "guard" });
    expect(parseReport("{")).toMatch(/no JSON/);
    expect(parseReport("{}")).toMatch(/outrider_report is missing/);
    expect(parseReport('{"outrider_report": 2}')).toMatch(/version 2/);
    expect(parseReport('{"outrider_report": 1}')).toMatch(/^world: this key is missing/);
  });
});
