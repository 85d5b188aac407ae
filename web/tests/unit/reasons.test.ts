import { describe, expect, it, vi } from "vitest";
import { lanesOf } from "../../src/watch/lanes";
import { fieldsOf, numberAt, numericPaths } from "../../src/log/fields";
import { channelSeries, channelsOf } from "../../src/watch/channel_series";
import { LayerChoice } from "../../src/watch/layer_choice";
import { likeness } from "../../src/base/palette";
import { reasonsOf } from "../../src/watch/reasons";
import { info, pose, poses, runOf } from "./made";

vi.hoisted(() => { globalThis.matchMedia = (() => ({ matches: false, addEventListener: () => undefined })) as never; });  // colours are asked for as they load

const grid = { origin: { x: 0, y: 0 }, resolution: 1, width: 2, height: 2, costs: [1, 1, 1, 1] };

describe("the reasons of a run", () => {
  it("of a pursuit are its bounds, as they close in", () => {
    const run = runOf({ "/run": [[0, info({ job: "pursue" })]], "/cost_grid": [[0, grid]], "/pose": poses([[0, 0, 0, 0], [3, 1, 0, 0]]), "/target_pose": poses([[0, 1, 1, 0], [3, 1, 1, 0]]),
      "/cost_bounds": [[0, { expansions: 10, cost: NaN, lower_bound: 20 }], [1, { expansions: 90, cost: 50, lower_bound: 40 }], [2, { expansions: 120, cost: 50, lower_bound: 50 }]] });
    expect(reasonsOf(run)[0]!.rows.map(({ text }) => text)).toEqual(["no catch is known yet; none costs less than 20.0", "a catch for 50.0 is known, none costs less than 40.0: at most 25.0 % above the best",
      "a catch for 50.0 is known, none costs less than 50.0: it is the best"]);
  });

  it("of a mission in a yard are the stops of the tour that is planned, and what is proven of it", () => {
    const tour = (cost: number, lower_bound: number) => ({ cost, lower_bound, way: [{ x: 0, y: 0 }, { x: 1, y: 2 }], stops: [{ position: { x: 1, y: 2 }, targets: ["tom", "felix"] }] });
    const run = (goesOn: boolean, ...tours: object[]) => reasonsOf(runOf({ "/run": [[0, info()]], "/tours": tours.map((one) => [0, one]) }, goesOn))[0]!;
    expect(run(true, tour(30, 0), tour(20, 0))).toEqual({ title: "The tour so far", about: "The fastest so far takes 20.0 s.", rows: [{ head: "Stop 1 at (1.00, 2.00)", text: "serves tom, felix" }] });
    expect(run(false, tour(20, 19)).about).toBe("It takes 20.0 s if nothing goes wrong, and none takes less than 19.0 s.");
    expect(run(false, tour(20, 20)).about).toBe("It takes 20.0 s if nothing goes wrong, and none is faster.");
  });

  it("of a decision are the places that it compared, with what each is worth", () => {
    const candidate = (x: number, cost: number, value: number, chosen = false) => ({ position: { x, y: 0 }, cost, gain: 2, value, chosen });
    const decision = { kind: "frontier", frontiers: 3, value_of: "s of the round that begins there", most_is_best: false, candidates: [candidate(1, 4, 20, true), candidate(2, 3, 25.5), candidate(3, 5, NaN)] };
    const run = runOf({ "/run": [[0, info({ job: "explore" })]], "/decisions": [[1, decision], [2, { ...decision, value_of: "m2/s", most_is_best: true }]] });
    const [first, second] = reasonsOf(run)[0]!.rows.map(({ table }) => table!);
    expect(first!.head.at(-1)).toBe("of the round that begins there, least is best");
    expect(first!.rows.map(({ cells }) => cells.join(" | "))).toEqual(["1 | (1.00, 0.00) | 4.0 s | 2.00 m\u00b2 | 20.0 s", "2 | (2.00, 0.00) | 3.0 s | 2.00 m\u00b2 | 25.5 s", "3 | (3.00, 0.00) | 5.0 s | 2.00 m\u00b2 | \u2013"]);
    expect(first!.rows.map(({ chosen }) => chosen)).toEqual([true, false, false]);
    expect([second!.head.at(-1), second!.rows[0]!.cells.at(-1)]).toEqual(["value, most is best", "20.0 m\u00b2/s"]);
  });

  it("of an exploration are its decisions and what it left", () => {
    const run = runOf({ "/run": [[0, info({ job: "explore" })]], "/pose": poses([[0, 0, 0, 0], [9, 1, 0, 0]]), "/goal_pose": [[1, pose(2, 3)], [8, pose(0, 0)]],
      "/decisions": [[1, { kind: "frontier", frontiers: 4 }], [8, { kind: "home", frontiers: 1 }]], "/refusals": [[9, { position: { x: 1, y: 1 }, reason: "a crack: 0.01 m2 behind it" }]] });
    expect(reasonsOf(run)[0]!.rows.map(({ head, text }) => `${head}: ${text}`)).toEqual(["0:01 to a frontier at (2.00, 3.00): 4 frontiers were open", "0:08 goes home: 1 frontier was open",
      "left over at (1.00, 1.00): a crack: 0.01 m\u00b2 behind it"]);
  });
});

describe("what can be looked at", () => {
  const run = runOf({ "/run": [[0, info()]], "/pose": poses([[0, 0, 0, 0], [1, 1, 2, 0], [2, 4, 5, 0]]), "/stores": [[0, { water: 3n, names: ["a"] }], [2, { water: 2n, names: ["a"] }]] });

  it("are the numbers of all channels, but for stamps", () => {
    expect(channelsOf(run)).toEqual([{ topic: "/pose", paths: ["pose.position.x", "pose.position.y", "pose.position.z", "pose.orientation.x", "pose.orientation.y", "pose.orientation.z", "pose.orientation.w"] },
      { topic: "/stores", paths: ["water"] }]);
    const [series] = channelSeries(run, ["/pose:pose.position.y", "/absent:x"]);
    expect(series).toMatchObject({ time: [0, 1, 2], key: "/pose:pose.position.y", lines: [{ values: [0, 2, 5] }] });
    expect(channelSeries(run, ["/absent:x"])).toEqual([]);
  });

  it("are the fields of a message, long arrays in part", () => {
    const message = { a: 1n, b: { c: "x", d: [true] }, e: Float32Array.from({ length: 40 }, (_, i) => i) };
    expect(fieldsOf(message).slice(0, 5).map(({ path, depth, value }) => [path, depth, value])).toEqual([["a", 0, 1], ["b", 0, ""], ["b.c", 1, "x"], ["b.d", 1, "1 items"], ["b.d.0", 2, true]]);
    expect(fieldsOf(message)).toHaveLength(5 + 1 + 12);
    expect(numericPaths(message)).toContain("e.3");
    expect([numberAt(message, "a"), numberAt(message, "e.39"), numberAt(message, "b.c"), numberAt(message, "x.y")]).toEqual([1, 39, null, null]);
  });

  it("has no lanes where nothing has a state", () => expect(lanesOf(run)).toEqual([]));

  it("is drawn as strongly as somebody chose", () => {
    const choice = new LayerChoice("shots:0,map:0.4,targets:7,odd");
    expect(["shots", "map", "targets", "odd"].map((name) => choice.of(name))).toEqual([0, 0.4, 1, 1]);
    choice.set("shots", 1);
    expect(choice.text).toBe("map:0.4");
    const planned = new LayerChoice();
    expect([planned.of("firing map"), planned.of("shots")]).toEqual([0, 1]);
    planned.set("firing map", 1);
    expect([planned.text, new LayerChoice(planned.text).of("firing map")]).toEqual(["firing map:1", 1]);
    planned.set("firing map", 0);
    expect(planned.text).toBe("");
  });

  it("is found by letters in their order, closer ones first", () => {
    expect(likeness("follow the robot", "flw rob")).not.toBeNull();
    expect(likeness("follow the robot", "xyz")).toBeNull();
    expect(likeness("runs", "run")!).toBeLessThan(likeness("return", "run")!);
  });
});
