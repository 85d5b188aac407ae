// @vitest-environment jsdom
import { describe, expect, it, vi } from "vitest";
import { title } from "../../src/banner";
import { GrowingList } from "../../src/base/growing_list";
import { Run } from "../../src/log/run";
import type { RunLog } from "../../src/log/run_log";
import { soFar } from "../../src/log/so_far";
import { topic } from "../../src/log/topics";
import { Clock } from "../../src/watch/clock";
import { EventList } from "../../src/watch/event_list";
import { Facts } from "../../src/watch/facts";
import { seriesOf } from "../../src/watch/series";
import { Tabs } from "../../src/watch/tabs";
import { TargetTable } from "../../src/watch/target_table";
import { append, belief, info, logOf, poses, runOf, summary, type Topics } from "./made";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });

describe("the clock of a run that goes on", () => {
  const growing = (): Clock => {
    const clock = new Clock(10, () => undefined, true);
    clock.follow();
    clock.advance(Infinity);
    return clock;
  };

  it("keeps to the head, and glides there when it leaps", () => {
    const clock = growing();
    expect([clock.t, clock.live, clock.moves]).toEqual([10, true, false]);
    clock.grow(20, true);
    let before = clock.t;
    for (let frame = 0; frame < 120; ++frame) {
      clock.advance(1 / 60);
      expect(clock.t).toBeGreaterThanOrEqual(before);
      before = clock.t;
    }
    expect([clock.t, clock.moves]).toEqual([20, false]);
  });

  it("is left by a seek, a pause and a step; one call comes back", () => {
    for (const leave of [(one: Clock) => one.seek(4), (one: Clock) => one.toggle(), (one: Clock) => one.seek(9.95)]) {
      const clock = growing();
      leave(clock);
      const { t } = clock;
      expect([clock.live, clock.playing]).toEqual([false, false]);
      clock.grow(30, true);
      clock.advance(1);
      expect(clock.t).toBe(t);
      clock.follow();
      clock.advance(Infinity);
      expect([clock.t, clock.live]).toEqual([30, true]);
    }
  });

  it("plays from an earlier time until it has caught up", () => {
    const clock = growing();
    clock.seek(9);
    clock.toggle();
    expect([clock.playing, clock.live]).toEqual([true, false]);
    for (let i = 0; i < 40; ++i) clock.advance(0.05);
    expect([clock.t, clock.playing, clock.live]).toEqual([10, false, true]);
  });

  it("shows a time that was asked for once the run has come there", () => {
    const clock = new Clock(1, () => undefined, true);
    clock.seek(12);
    const shown = [1, 5, 11, 14, 20].map((duration) => {
      clock.grow(duration, true);
      return clock.t;
    });
    expect(shown).toEqual([1, 5, 11, 12, 12]);
  });

  it("stands at the end when the run ends, or where one had gone; a key then leads to no head", () => {
    const [live, back] = [growing(), growing()];
    back.seek(3);
    for (const clock of [live, back]) clock.grow(12, false);
    expect([live.t, live.live, live.playing, back.t]).toEqual([12, false, false, 3]);
    back.follow();
    expect([back.t, back.live]).toEqual([12, false]);
    back.toggle();
    expect([back.t, back.playing]).toEqual([0, true]);
  });

  it("plays as fast as the length of the run asks for, until a speed is chosen", () => {
    const clock = growing();
    expect(clock.speed).toBe(1);
    clock.grow(600, true);
    expect(600 / clock.speed).toBeLessThan(90);
    clock.shift(-1);
    const { speed } = clock;
    clock.grow(6000, true);
    expect(clock.speed).toBe(speed);
  });
});

describe("a list that grows", () => {
  it("keeps the elements at its front that are as they were", () => {
    const parent = document.createElement("ol");
    const list = new GrowingList<string>(parent, (word) => word, (word, i) => Object.assign(document.createElement("li"), { textContent: `${i} ${word}` }));
    const words = (): string[] => [...parent.children].map((one) => one.textContent!);
    list.show(["a", "b"]);
    const [a, b] = list.elements;
    list.show(["a", "b", "c"]);
    expect([list.elements[0], list.elements[1]]).toEqual([a, b]);
    expect(words()).toEqual(["0 a", "1 b", "2 c"]);
    list.show(["a", "x", "c", "d"]);
    expect(list.elements[0]).toBe(a);
    expect(words()).toEqual(["0 a", "1 x", "2 c", "3 d"]);
    list.show(["a"]);
    expect(words()).toEqual(["0 a"]);
  });
});

describe("tabs of a run that grows", () => {
  const made = (): { tabs: Tabs; filled: Set<string>; shown: () => string[] } => {
    const filled = new Set(["Numbers"]);
    const pages = ["Targets", "Plots", "Numbers"].map((name) => ({ name, element: document.createElement("div"), empty: () => !filled.has(name) }));
    const tabs = new Tabs(pages, () => undefined);
    return { tabs, filled, shown: () => pages.filter(({ element }) => !element.hidden).map(({ name }) => name) };
  };

  it("come when there is something on them; the first is open until one is chosen", () => {
    const { tabs, filled, shown } = made();
    tabs.choose("", false);
    expect(shown()).toEqual(["Numbers"]);
    filled.add("Plots");
    tabs.renew();
    expect(shown()).toEqual(["Plots"]);
    tabs.choose("Numbers");
    filled.add("Targets");
    tabs.renew();
    expect(shown()).toEqual(["Numbers"]);
    tabs.next();
    expect(shown()).toEqual(["Targets"]);
  });

  it("open the one of the address as soon as it is there", () => {
    const { tabs, filled, shown } = made();
    tabs.choose("plots", false);
    expect(shown()).toEqual(["Numbers"]);
    filled.add("Targets").add("Plots");
    tabs.renew();
    expect(shown()).toEqual(["Plots"]);
  });
});

const target = (name: string, status: string, shots = 0): Topics[string][number] =>
  [status === "waiting" ? 0 : 2.5, { name, status, reason: "", size: { x: 0.3, y: 0.3, z: 0.3 }, yaw: 0, shots, entrance: "" }];

describe("a run that grows, and what shows it", () => {
  const rows = Array.from({ length: 401 }, (_, i) => [i / 20, 3 * Math.cos(i / 50), 3 * Math.sin(i / 50), i / 50]);
  const all: Topics = { [topic.pose]: poses(rows), [topic.events]: Array.from({ length: 20 }, (_, i) => [i, { name: "drive", msg: `leg ${i}` }]),
    [topic.belief]: rows.map(([t, x, y, heading]) => [t!, belief(x! + 0.01, y!, heading, 0.02, 0.01)]) };

  it("says in parts what it says whole", () => {
    const whole = runOf(all);
    const log: RunLog = logOf();
    const list = new EventList(new Run(log, true), () => undefined);
    for (let from = 0; from < 21; from += 1.85) {
      append(log, Object.fromEntries(Object.entries(all).map(([name, messages]) => [name, messages.filter(([t]) => t >= from && t < from + 1.85)])));
      list.renew(new Run(log, true));
    }
    const grown = new Run(log);
    expect(grown.duration).toBe(whole.duration);
    expect(seriesOf(grown)).toEqual(seriesOf(whole));
    for (let t = 0; t < 20; t += 0.37) expect(grown.track.at(t)).toEqual(whole.track.at(t));
    const fresh = new EventList(whole, () => undefined);
    for (const one of [list, fresh]) one.show(7.5);
    expect(list.element.outerHTML).toBe(fresh.element.outerHTML);
  });

  it("counts what is known by now", () => {
    const numbers = soFar(runOf({ [topic.pose]: all[topic.pose]!, [topic.targets]: [target("a", "waiting"), target("b", "waiting"), target("a", "reached", 1)] }, true));
    expect(numbers).toMatchObject({ targets: 2, reached: 1, failed: 0, shots: 0 });
    expect(numbers.time_s).toBeCloseTo(20);
    expect(numbers.driven_m).toBeCloseTo(24, 2);  // 8 rad of a circle of 3 m
    expect(numbers.turned_rad).toBeCloseTo(8);
  });

  it("keeps the order of the table and which target is selected", () => {
    const log = logOf({ [topic.targets]: [target("a", "waiting"), target("b", "waiting")] });
    const table = new TargetTable(new Run(log), () => undefined);
    const names = (): string[] => [...table.element.querySelectorAll("tbody button")].map((one) => one.textContent!);
    const byShots = table.element.querySelectorAll("th")[2]!.querySelector("button")!;
    byShots.click();
    const rowOfA = table.element.querySelector("tbody");
    append(log, { [topic.events]: [[1, { name: "wait", msg: "" }]] });
    table.renew(new Run(log));
    expect(table.element.querySelector("tbody")).toBe(rowOfA);  // nothing of it has changed
    append(log, { [topic.targets]: [target("a", "reached", 2), target("b", "reached", 1)] });
    table.renew(new Run(log));
    table.show(9, null);
    expect(names()).toEqual(["b", "a"]);
  });

  it("tells of targets only what was known at the time", () => {
    const told = (t: number, status: string, shots: number, reason: string): [number, unknown] => [t, { ...(target("a", status, shots)[1] as object), reason }];
    const log = logOf({ [topic.targets]: [told(0, "waiting", 0, ""), told(3, "failed", 2, "it was missed twice")] });
    const table = new TargetTable(new Run(log), () => undefined);
    const row = (): string[] => [...table.element.querySelectorAll("tbody td")].map((one) => one.textContent!);
    table.show(2, null);
    expect(row()).toEqual(["a", "waiting", "0", "\u2013", "\u2013", "\u2013", ""]);
    table.show(3, null);
    expect(row()).toEqual(["a", "failed", "2", "0:03", "\u2013", "\u2013", "it was missed twice"]);
    table.show(0, null);
    expect(row()[1]).toBe("waiting");
  });

  it("shows the seed of a run that draws numbers at random, of no other", () => {
    const shown = (more: object): string => title(logOf({ [topic.run]: [[0, info(more)]] })).at(-1)!.textContent!;
    expect(shown({ seeded: true, seed: 7n })).toBe("seed 7");
    expect(shown({ seeded: true, seed: 0n })).toBe("seed 0");
    expect(shown({ seeded: false, seed: 0n })).toBe("");
  });

  it("has numbers while it goes on, and its metrics in the end", () => {
    const facts = new Facts();
    const words = (): string[] => [...facts.element.querySelectorAll(".metrics dt")].map((one) => one.textContent!);
    const log = logOf(all);
    facts.renew(new Run(log, true), true);
    expect(words()).toEqual(["time", "driven length", "turned"]);
    log.summary = summary({ settings: { speed: "1 m/s" }, metrics: { mission_s: 20 }, warnings: ["slow"] });
    facts.renew(new Run(log), false);
    expect(words()).toEqual(["mission time"]);
    expect(facts.element.textContent).toMatch(/1 warning.*slow.*1 settings/);
  });
});
