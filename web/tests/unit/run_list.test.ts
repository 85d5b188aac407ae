// @vitest-environment jsdom
import { describe, expect, it } from "vitest";
import type { RunRow } from "../../src/api";
import { ageText, tookText } from "../../src/base/ages";
import { runList, type ListActs } from "../../src/live/run_list";

const run = (more: Partial<RunRow>): RunRow => ({ id: "a-1", state: "done", scenario: "yard.yaml", job: "guard", seed: 7, began_s: 1000, took_s: 9.44, progress: null, error: "", where: "", has_log: true, summary: null, ...more });

const acts = (again: (run: RunRow) => void = () => undefined): ListActs => ({ again, chosen: new Set(["a-1"]), choose: () => undefined });

describe("times for people", () => {
  it("of how long something took", () => {
    expect([0.04, 9.44, 9.96, 59.4, 125, 3725, null].map(tookText)).toEqual(["0.0 s", "9.4 s", "10 s", "59 s", "2:05 min", "1:02:05 h", "\u2013"]);
    expect(tookText(3600)).toBe("1:00:00 h");
  });

  it("of how long ago it was", () => {
    expect([0, 59, 60, 7199, 7200, 86400, 400000].map((age) => ageText(1000, 1000 + age))).toEqual(["just now", "just now", "1 minute ago", "1 hour ago", "2 hours ago", "1 day ago", "4 days ago"]);
    expect(ageText(1000, 900)).toBe("just now");
  });
});

describe("the list of runs", () => {
  const texts = (one: Partial<RunRow>): string => runList([run(one)], 1061, acts())[0]!.textContent!;

  it("tells scenario, seed, verdict, duration, age and reason", () => {
    expect(texts({ summary: { reason: "23 of 24 targets reached" } })).toBe("yard.yamlguardDoneseed 7 \u00b7 9.4 s1 minute ago23 of 24 targets reachedRun again");
    expect(texts({ state: "cut_short", took_s: null, error: "the server ended", where: "" })).toContain("Cut shortseed 71 minute agothe server ended");
    expect(texts({ state: "running", took_s: null, seed: null })).toContain("Running1 minute ago");
  });

  it("runs a scenario again with its seed; a text that is no file cannot be", () => {
    const asked: RunRow[] = [];
    const [row] = runList([run({})], 1000, acts((one) => asked.push(one)));
    row!.querySelector("button")!.click();
    expect(asked[0]).toMatchObject({ scenario: "yard.yaml", seed: 7 });
    expect(runList([run({ scenario: "unsaved" })], 1000, acts())[0]!.querySelector("button")).toBeNull();
    expect(runList([], 1000, acts())[0]!.textContent).toBe("None yet.");
  });
});
