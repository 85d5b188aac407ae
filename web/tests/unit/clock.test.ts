import { describe, expect, it } from "vitest";
import { Clock, neighbour } from "../../src/watch/clock";
import { marksOf } from "../../src/watch/marks";
import { topic } from "../../src/log/topics";
import { runOf } from "./made";

describe("the clock", () => {
  it("plays to the end, stops there, and starts over", () => {
    const clock = new Clock(1, () => undefined);
    clock.speed = 1;
    clock.toggle();
    for (let i = 0; i < 30; ++i) clock.advance(0.05);
    expect(clock.t).toBe(1);
    expect(clock.playing).toBe(false);
    clock.toggle();
    expect(clock.t).toBe(0);
  });

  it("does not leap over a pause of the browser", () => {
    const clock = new Clock(100, () => undefined);
    clock.speed = 2;
    clock.toggle();
    clock.advance(30);
    expect(clock.t).toBeCloseTo(0.2);
  });

  it("keeps within the run and shows a long one in about a minute", () => {
    const clock = new Clock(600, () => undefined);
    clock.seek(-3);
    expect(clock.t).toBe(0);
    clock.seek(1e9);
    expect(clock.t).toBe(600);
    expect(600 / clock.speed).toBeLessThan(90);
  });
});

describe("marks", () => {
  it("steps to what is next in time, either way", () => {
    const marks = [{ t: 1 }, { t: 2 }, { t: 2 }, { t: 5 }];
    expect(neighbour(marks, 2, 1)).toEqual({ t: 5 });
    expect(neighbour(marks, 2, -1)).toEqual({ t: 1 });
    expect(neighbour(marks, 5, 1)).toBeUndefined();
  });

  it("leaves out events that a shot tells already", () => {
    const zero = { x: 0, y: 0, z: 0 };
    const shot = { target: "cat", attempt: 1, flight: 1, gun_pitch: 0, muzzle: zero, velocity: zero, contact: "cat", contact_point: zero, hit: true, clearance: 1, path: [], profile: [] };
    const events = ["drive", "shot", "hit", "enter"].map((name, i): [number, unknown] => [i, { name, msg: name }]);
    expect(marksOf(runOf({ [topic.shots]: [[2, shot]], [topic.events]: events })).map((mark) => mark.kind)).toEqual(["drive", "hit", "enter"]);
    expect(marksOf(runOf({ [topic.events]: events })).length).toBe(4);
  });
});
