// @vitest-environment jsdom
import { describe, expect, it, vi } from "vitest";
import type { Edit, OptionRow } from "../../src/api";
import { optionForm, valueOf, type Values } from "../../src/plan/form";
import { eroded } from "../../src/plan/ends";
import { free, GridGround, groundOf, occupied, PolygonGround } from "../../src/plan/ground";
import { newName, suggestedName } from "../../src/plan/names";
import { pathSvg } from "../../src/plan/path_svg";
import { resultTable } from "../../src/plan/results";
import { SaveForm } from "../../src/plan/save_form";
import type { Shown } from "../../src/plan/shown";

const grid = { origin: [0, 0] as [number, number], resolution_m: 1, width: 8, height: 6, runs: [0, 20, 1, 4, 0, 24] };

describe("a grid", () => {
  it("tells exactly what was changed", () => {
    const ground = new GridGround(grid);
    expect(ground.edits()).toEqual([]);
    ground.paint([1, 1], [5, 4], occupied, 0);
    ground.paint([4, 2], [7, 2], free, 1);
    const again = new GridGround(grid).cells.slice();
    for (const edit of ground.edits()) {
      const [[x, y, width, height], value] = "block" in edit ? [edit.block, 1] : [(edit as { free: number[] }).free, 0];
      for (let v = y!; v < y! + height!; ++v) again.fill(value, v * 8 + x!, v * 8 + x! + width!);
    }
    expect([...again]).toEqual([...ground.cells]);
  });

  it("paints only inside, and forgets what was painted back", () => {
    const ground = new GridGround(grid);
    ground.paint([-3, -3], [20, 20], occupied, 1);
    expect(ground.cells.length).toBe(48);
    ground.paint([0, 0], [7, 5], free, 9);
    for (const edit of ground.edits()) expect(edit).toHaveProperty("free");
    expect(ground.edits()).toEqual([{ free: [4, 2, 4, 1] }]);
  });

  it("puts start and goal where there is room", () => {
    const ground = new GridGround({ ...grid, width: 30, height: 20, runs: [0, 600] });
    const [start, goal] = ground.ends(0.3);
    expect(start[0]).toBeLessThan(5);
    expect(goal[0]).toBeGreaterThan(25);
    const narrow = new GridGround({ ...grid, height: 1, runs: [1, 3, 0, 2, 1, 3] });
    expect(narrow.ends(0)).toEqual([[3.5, 0.5], [4.5, 0.5]]);
  });

  it("puts start and goal where a disk can drive from one to the other", () => {
    // Two rooms, and a door of 3 cells between them; beyond, a corner that nothing leads to.
    const cells = Array.from({ length: 20 * 40 }, (_, at) => Number(at % 40 === 20 && Math.abs(Math.floor(at / 40) - 10) > 1 || at % 40 === 36));
    const runs = cells.flatMap((value) => [value, 1]);
    const rooms = new GridGround({ origin: [0, 0], resolution_m: 0.5, width: 40, height: 20, runs });
    const [start, goal] = rooms.ends(0.2);
    expect(start[0]).toBeLessThan(3);
    expect(goal[0]).toBeGreaterThan(14);
    expect(goal[0]).toBeLessThan(18);  // not in the corner
    const [wide, other] = rooms.ends(1);  // too large for the door
    expect(Math.max(wide[0], other[0])).toBeLessThan(10);
    for (const [x, y] of [wide, other]) expect(Math.min(x, y, 10 - x, 10 - y)).toBeGreaterThan(1);
  });

  it("erodes as a look at every pair of cells says", () => {
    const [width, height] = [17, 13];
    const open = Uint8Array.from({ length: width * height }, (_, at) => Number((at * 7919) % 23 > 1));
    for (const reach of [0.4, 1, 1.5, 2.3]) {
      const slow = open.map((value, at) => {
        for (let v = -1; v <= height; ++v) {
          for (let u = -1; u <= width; ++u) {
            const outside = u < 0 || v < 0 || u >= width || v >= height;
            if ((outside || !open[v * width + u]) && Math.hypot(u - (at % width), v - Math.floor(at / width)) <= reach) return 0;
          }
        }
        return value;
      });
      expect([...eroded({ width, height, open }, reach).open], `${reach}`).toEqual([...slow]);
    }
  });
});

describe("polygons", () => {
  const polygons = { boundary: [] as [number, number][], obstacles: [[[1, 1], [2, 1], [2, 2], [1, 2]], [[4, 4], [5, 4], [5, 5]]] as [number, number][][], queries: [] };

  it("tell what was moved, added and removed, by numbers that stay", () => {
    const ground = new PolygonGround(polygons);
    expect(ground.at([1.5, 1.5])).toBe(0);
    ground.shift(0, [1, 0]);
    const added = ground.add([8, 8], 0.5);
    ground.shift(added, [0, 1]);
    ground.remove(1);
    expect(ground.at([4.6, 4.2])).toBe(-1);
    expect(ground.edits()).toEqual<Edit[]>([
      { set: 0, polygon: [[2, 1], [3, 1], [3, 2], [2, 2]] },
      { add: [[7.5, 8.5], [8.5, 8.5], [8.5, 9.5], [7.5, 9.5]] }, { remove: 1 }]);
    expect(polygons.obstacles[0]![0]).toEqual([1, 1]);  // what was given stays
  });
});

describe("polygons without a query", () => {
  it("put start and goal on the same side of a wall, with the radius to spare", () => {
    const boundary: [number, number][] = [[0, 0], [12, 0], [12, 6], [0, 6]];
    const wall: [number, number][] = [[8, -1], [8.2, -1], [8.2, 7], [8, 7]];
    const ground = new PolygonGround({ boundary, obstacles: [wall], queries: [] });
    for (const [x, y] of ground.ends(0.5)) {
      expect(Math.min(x, y, 8 - x, 6 - y)).toBeGreaterThan(0.5);
    }
  });
});

describe("grounds", () => {
  it("are refused with a sentence", () => {
    expect(groundOf({ id: "", name: "m", radius_m: 0, warnings: [], grid: { ...grid, yaw_rad: 0.3 } })).toMatch(/turned by 0.3 rad/);
    expect(groundOf({ id: "", name: "m", radius_m: 0, warnings: [] })).toMatch(/neither cells nor polygons/);
  });
});

const options: OptionRow[] = [
  { name: "weight", type: "number", unit: "m", low: 1, high: 10, default: 1, sentence: "how much" },
  { name: "turns", type: "integer", unit: "", low: 0, high: 9, default: 4, sentence: "how many" },
  { name: "fast", type: "boolean", unit: "", default: false, sentence: "whether" },
  { name: "word", type: "string", unit: "", default: "a", sentence: "which" }];

describe("the form of options", () => {
  it("takes a value or says what would be right", () => {
    expect(valueOf(options[0]!, "2.5")).toEqual({ value: 2.5 });
    expect(valueOf(options[0]!, "12")).toEqual({ refusal: "weight: '12' is not valid; expected a number from 1 to 10 m" });
    expect(valueOf(options[1]!, "2.5")).toHaveProperty("refusal");
    expect(valueOf(options[1]!, "")).toHaveProperty("refusal");
    expect(valueOf(options[3]!, "b")).toEqual({ value: "b" });
  });

  it("lists the names that a text can be", () => {
    const named: OptionRow = { name: "heuristic", type: "string", unit: "", default: "octile", sentence: "the estimate", choices: ["octile", "euclidean", "chebyshev"] };
    const given: Values = {};
    const select = optionForm([named], given, () => undefined).querySelector("select")!;
    expect([...select.options].map(({ value }) => value)).toEqual(named.choices);
    select.value = "euclidean";
    select.dispatchEvent(new Event("change"));
    expect(given).toEqual({ heuristic: "euclidean" });
  });

  it("keeps what differs from the defaults", () => {
    const given: Values = {};
    const heard: string[] = [];
    const form = optionForm(options, given, (refusal) => heard.push(refusal));
    const set = (name: string, value: string | boolean): void => {
      const input = form.querySelector<HTMLInputElement>(`#option-${name}`)!;
      if (typeof value === "boolean") input.checked = value;
      else input.value = value;
      input.dispatchEvent(new Event("change"));
    };
    set("weight", "3");
    set("fast", true);
    expect(given).toEqual({ weight: 3, fast: true });
    set("weight", "99");
    expect(given.weight).toBe(3);
    expect(heard.at(-1)).toMatch(/weight: '99'/);
    set("weight", "1");
    set("fast", false);
    expect(given).toEqual({});
  });
});

describe("saving a scenario", () => {
  it("suggests a name beside the map that the server takes", () => {
    expect(suggestedName("maps/hall.map.gz", "_plan")).toBe("maps/hall_plan.yaml");
    expect(suggestedName("my hall.v2.txt", "_plan")).toBe("my_hall.v2_plan.yaml");
    expect(suggestedName("drawn", "_plan")).toBe("drawn_plan.yaml");
    expect(suggestedName("yard/yard_changed.yaml", "_changed")).toBe("yard/yard_changed.yaml");
    expect(newName([{ name: "new_1" }, { name: "fox" }, { name: "new_2" }])).toBe("new_3");
  });

  it("replaces only what this page saved, and says what the server says", async () => {
    const asked: [string, string | null][] = [];
    const replies = [new Response(JSON.stringify({ path: "a.yaml", files: ["a_map.txt", "a.yaml"] }), { status: 201 }),
      new Response(JSON.stringify({ path: "a.yaml", files: ["a.yaml"] })), new Response(JSON.stringify({ error: "choose another", where: "b.yaml" }), { status: 412 })];
    vi.stubGlobal("fetch", async (url: string, init: RequestInit) => {
      asked.push([url, new Headers(init.headers).get("If-None-Match")]);
      return replies.shift()!;
    });
    const form = new SaveForm("a", "", () => ({ guard: { scenario: "yard.yaml", start: [0, 0], heading_rad: 0, targets: [], boxes: [], moved: [], removed: [] } }));
    expect(await form.save()).toBe("a.yaml");
    expect(form.element.textContent).toContain("outrider run a.yaml");
    expect(await form.save()).toBe("a.yaml");
    form.element.querySelector("input")!.value = "b.yaml";
    expect(await form.save()).toBeNull();
    expect(form.element.textContent).toContain("b.yaml: choose another");
    expect(asked).toEqual([["api/v1/scenarios/a.yaml", "*"], ["api/v1/scenarios/a.yaml", null], ["api/v1/scenarios/b.yaml", "*"]]);
    vi.unstubAllGlobals();
  });
});

describe("answers", () => {
  const answer: Shown = { status: "done", reason: "", planner: "a_star", cost: 3, cost_unit: "m", waypoints: [[0, 0], [3, 0]], time_s: 0.0005 };

  it("stand side by side", () => {
    const table = resultTable([answer, null, { status: "no_path", planner: "dijkstra", reason: "no way" }, { status: "start_blocked", planner: "safest", reason: "no" }]);
    expect([...table.querySelectorAll('[data-row="answer"]')].map((cell) => cell.textContent)).toEqual(["path found", "no path", "refused"]);
  });

  it("become a drawing", () => {
    const svg = pathSvg({ ground: new GridGround(grid), start: [0, 0], goal: [3, 0], radius_m: 0, selected: null, heading_rad: null }, answer);
    const drawn = new DOMParser().parseFromString(svg, "image/svg+xml");
    expect(drawn.querySelector("polyline")!.getAttribute("points")).toBe("0,0 3,0");
    expect(drawn.querySelectorAll("rect").length).toBe(1);
  });
});
