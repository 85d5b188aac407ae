import { describe, expect, it } from "vitest";
import type { FileRow } from "../../src/api";
import { kindWords } from "../../src/front/kinds";
import { missionsOf, titleOf } from "../../src/front/missions";
import { boxAround, PolygonGround } from "../../src/plan/ground";

const scenario = (path: string, description = ""): FileRow => ({ path, kind: "scenario", job: "guard", description, bytes: 1 });

describe("missions", () => {
  it("are called by their files", () => {
    expect(titleOf("explore/narrow_corridor.yaml")).toBe("Narrow corridor");
    expect(titleOf("court-yard.yml")).toBe("Court yard");
    expect(titleOf("_.yaml")).toBe("_.yaml");
  });

  it("that have the same name tell their folders", () => {
    const titles = missionsOf([scenario("explore/office.yaml"), scenario("slam/office.yaml"), scenario("office.yaml"), scenario("yard/yard.yaml"), scenario("slam/yard.yaml")]).map(({ title }) => title);
    expect(titles.sort()).toEqual(["Office", "Office (explore)", "Office (slam)", "Yard", "Yard (slam)"]);
  });

  it("come in the order of their paths, the one that a folder is named after first in it, and the example first of all", () => {
    const files = ["b/a.yaml", "b/b.yaml", "a/z.yaml", "c/c.yaml"].map((path) => scenario(path));
    expect(missionsOf([...files, { path: "m.map", kind: "map", bytes: 1 }], "c/c.yaml").map(({ path }) => path)).toEqual(["c/c.yaml", "a/z.yaml", "b/b.yaml", "b/a.yaml"]);
  });

  it("say what the server says of them", () => {
    expect(missionsOf([scenario("a.yaml", "Cats.")])[0]!.about).toBe("Cats.");
  });
});

describe("kinds of files", () => {
  it("are named in words", () => {
    expect(kindWords({ path: "a/run.mcap", kind: "log" })).toBe("log of a run");
    expect(kindWords({ path: "cave.yaml", kind: "map" })).toBe("map with an image");
    expect(kindWords({ path: "hall.map.gz", kind: "map" })).toBe("grid map (MovingAI)");
    expect(kindWords({ path: "YARD.SDF", kind: "map" })).toBe("world (SDF)");
    expect(kindWords({ path: "what", kind: "other" })).toBe("other");
  });
});

describe("the picture of a scene", () => {
  it("has room for every area", () => {
    const ground = new PolygonGround({ boundary: [[0, 0], [4, 0], [4, 3]], obstacles: [], queries: [] });
    expect(boxAround([], ground.box)).toEqual([0, 0, 4, 3]);
    expect(boxAround([[6, -1], [9, 5], [-2, 0]], ground.box)).toEqual([-2, -1, 9, 5]);
  });
});
