import { describe, expect, it } from "vitest";
import { maze } from "../../src/plan/maze";
import { titleOf } from "../../src/plan/titles";
import { inMetres, inUnit, lengthText, toggleUnits } from "../../src/base/units";

/** Rooms of a maze that are reached from the first, and how many of its free cells that is, by flooding the cells. */
function flooded(cells: Uint8Array, width: number): number {
  const seen = new Set([width + 1]);
  for (const at of seen) for (const next of [at - 1, at + 1, at - width, at + width]) if (cells[next] === 0) seen.add(next);
  return seen.size;
}

describe("a maze", () => {
  it("joins all of its places, by one way each, between walls all round", () => {
    for (const [width, height, wide] of [[64, 44, 1], [31, 21, 2], [200, 90, 5], [7, 7, 1]] as const) {
      const cells = maze(width, height, wide, 3);
      const free = cells.reduce((sum, one) => sum + Number(one === 0), 0);
      expect(flooded(cells, width)).toBe(free);
      const rooms = Math.floor((width - 1) / (wide + 1)) * Math.floor((height - 1) / (wide + 1));
      expect(free).toBe(rooms * wide * wide + (rooms - 1) * wide);  // a tree: one passage less than rooms
      for (let x = 0; x < width; ++x) expect([cells[x], cells[(height - 1) * width + x]]).toEqual([1, 1]);
    }
  });

  it("is the same for the same seed, and nothing where there is no room for one", () => {
    expect(maze(30, 20, 1, 5)).toEqual(maze(30, 20, 1, 5));
    expect(maze(30, 20, 1, 5)).not.toEqual(maze(30, 20, 1, 6));
    expect(maze(2, 9, 4, 1).some((one) => one === 1)).toBe(false);
  });
});

describe("words that people know", () => {
  it("are those of planners", () => {
    expect(["a_star", "theta_star", "lazy_theta_star", "jps_plus", "rrt_star", "dijkstra", "hub_labels", "octile_labels", "visibility_graph_implicit", "hybrid_a_star", "state_lattice", "d_star_lite", "lpa_star", "terrain_a_star", "terrain_theta_star", "terrain_labels"].map(titleOf))
      .toEqual(["A*", "Theta*", "Lazy Theta*", "JPS+", "RRT*", "Dijkstra", "Hub labels", "Octile labels", "Visibility graph, implicit", "Hybrid A*", "State lattice", "D* Lite", "LPA*", "Terrain A*", "Terrain Theta*", "Terrain labels"]);
  });

  it("are metres, or feet where somebody chose them", () => {
    expect(lengthText(1.5)).toBe("1.50 m");
    toggleUnits();
    expect(lengthText(0.3048)).toBe("1.00 ft");
    expect(inMetres(inUnit(7.25))).toBeCloseTo(7.25, 12);
    toggleUnits();
    expect(lengthText(2, 0)).toBe("2 m");
  });
});
