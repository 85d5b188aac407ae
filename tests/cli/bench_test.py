"""The command bench path: what it measures, what it finds wrong, refusals, the table for people."""
import gzip
import json
import math
import subprocess
import unittest

from tool import MAP, TOOL, ToolTest, main

KEYS = {"map", "planner", "guarantee", "index", "queries", "mean_us", "median_us", "worst_us", "expansions",
        "ratio_to_optimum_mean", "ratio_to_optimum_max", "build_s", "memory_mib"}
CATALOGUE = json.loads(subprocess.run([TOOL, "list", "--json"], capture_output=True, check=True).stdout)
ON_GRIDS = [row["name"] for row in CATALOGUE["path_planners"] if row["models"] and row["cost_unit"] == "m"]

# On the map of tool.py, whose wall hangs from the top: round it, across on the left, and from a point to itself.
OCTILE = [3 * math.sqrt(2) + 5, 2 + math.sqrt(2), 0.0]
ENDS = [(0, 0, 5, 0), (0, 0, 1, 3), (4, 1, 4, 1)]
# Between the top left corners of the same cells: over (3, 1) and (4, 1) counted from below, straight, nowhere.
ANY_ANGLE = [3 * math.sqrt(2) + 1 + math.sqrt(10), math.sqrt(10), 0.0]


def scenario(lengths=OCTILE, ends=ENDS, size="6 4"):
    rows = [f"0 small.map {size} {sx} {sy} {gx} {gy} {length:.8f}"
            for (sx, sy, gx, gy), length in zip(ends, lengths)]
    return "version 1\n" + "\n".join(rows) + "\n"


def table(lengths=ANY_ANGLE):
    rows = [f"{sx},{sy},{gx},{gy},{octile:.9f},{length:.9f}"
            for (sx, sy, gx, gy), octile, length in zip(ENDS, OCTILE, lengths)]
    return "sx,sy,gx,gy,octile_cells,anyangle_opt\n" + "\n".join(rows) + "\n"


class Bench(ToolTest):
    def setUp(self):
        super().setUp()
        for name in ("maps", "maps/anyangle"):
            (self.folder / name).mkdir()
        self.write("maps/small.map", MAP)
        self.write("maps/small.map.scen", scenario())

    def bench(self, *args, status=0):
        result = self.run_tool("bench", "path", "--data", "maps", *args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        answer = self.json_of(result)
        self.assertEqual(answer["job"], "bench path")
        self.assertEqual(answer["status"], "not_done" if status else "done")
        if status == 0:
            self.assertEqual(result.stderr, "")
        return {row["planner"]: row for row in answer["rows"]}, result.stderr

    def refused_bench(self, *args, says):
        """Status 2 and one sentence that holds all of `says`, as text and as JSON."""
        for json_flag in ([], ["--json"]):
            result = self.run_tool("bench", "path", *args, *json_flag)
            self.assertEqual(result.returncode, 2, result.stderr)
            sentence = self.sentence(result)
            for word in says:
                self.assertIn(word, sentence)
            if json_flag:
                fault = self.json_of(result)
                self.assertEqual(fault["status"], "refused")
                self.assertIn(fault["reason"], sentence)
            else:
                self.assertEqual(result.stdout, "")

    def test_every_planner_on_grids_is_measured(self):
        self.write("maps/anyangle/small.csv", table())
        rows, _ = self.bench()
        self.assertEqual(set(rows), set(ON_GRIDS))
        for name, row in rows.items():
            self.assertLessEqual(KEYS, set(row), name)
            self.assertEqual((row["map"], row["queries"], row["unanswered"], row["mismatches"]),
                             ("small", len(ENDS), 0, 0), name)
            self.assertGreater(row["mean_us"], 0)
            self.assertLessEqual(row["median_us"], row["worst_us"])
            self.assertLessEqual(row["mean_us"], row["worst_us"])
            self.assertGreaterEqual(row["build_s"], 0)
            self.assertGreaterEqual(row["memory_mib"], 0)
            self.assertGreaterEqual(row["expansions"], 0)
            self.assertLessEqual(row["ratio_to_optimum_mean"], row["ratio_to_optimum_max"])
            if row["guarantee"] == "none":
                self.assertGreaterEqual(row["ratio_to_optimum_mean"], 1 - 1e-6)
            else:
                self.assertAlmostEqual(row["ratio_to_optimum_max"], 1, places=6)
        self.assertEqual({name: rows[name]["guarantee"] for name in ("a_star", "theta_star", "polyanya")},
                         {"a_star": "grid_optimal", "theta_star": "none", "polyanya": "any_angle_optimal"})
        self.assertTrue(rows["jps_plus"]["index"])
        self.assertFalse(rows["a_star"]["index"])

    def test_without_a_table_only_lengths_along_the_moves_are_compared(self):
        rows, _ = self.bench("--planners", "a_star,polyanya")
        self.assertEqual(set(rows), {"a_star", "polyanya"})
        self.assertAlmostEqual(rows["a_star"]["ratio_to_optimum_mean"], 1, places=6)
        self.assertIsNone(rows["polyanya"]["ratio_to_optimum_mean"])

    def test_compressed_files_and_a_sample(self):
        for name in ("small.map", "small.map.scen"):
            content = (self.folder / "maps" / name).read_bytes()
            (self.folder / "maps" / name).unlink()
            self.write(f"maps/{name}.gz", gzip.compress(content))
        rows, _ = self.bench("--planners", "jps", "--queries", 2, "--repeat", 3, "--maps", "small")
        self.assertEqual(rows["jps"]["queries"], 2)

    def test_a_published_length_that_is_contradicted(self):
        for wrong in (0.9, 1.1):
            self.write("maps/small.map.scen", scenario([wrong * OCTILE[0], *OCTILE[1:]]))
            rows, stderr = self.bench("--planners", "dijkstra,jps", status=1)
            for name in ("dijkstra", "jps"):
                self.assertEqual(rows[name]["mismatches"], 1)
                self.assertIn(f"{name} on small: 1 of 3 answers are wrong", stderr)
            self.assertIn("is published", stderr)

    def test_a_published_length_in_any_direction_that_is_contradicted(self):
        # Longer than the true one: every answer below it is wrong. Shorter: only the optimal planner's.
        for factor, wrong in ((1.1, {"theta_star", "polyanya"}), (0.9, {"polyanya"})):
            self.write("maps/anyangle/small.csv", table([factor * ANY_ANGLE[0], *ANY_ANGLE[1:]]))
            rows, _ = self.bench("--planners", "theta_star,polyanya,a_star", status=1)
            self.assertEqual({name for name, row in rows.items() if row["mismatches"]}, wrong)
        # With all rows those of the scenario are asked, which are right.
        self.bench("--planners", "theta_star,polyanya,a_star", "--all-rows")

    def test_a_query_without_a_path(self):
        walled = MAP.replace("......\n", "...@..\n")
        self.write("maps/small.map", walled)
        rows, stderr = self.bench("--planners", "a_star", status=1)
        self.assertEqual((rows["a_star"]["queries"], rows["a_star"]["unanswered"]), (2, 1))
        self.assertIn("nothing joins the start and the goal", stderr)

    def test_table_for_people(self):
        result = self.run_tool("bench", "path", "--data", "maps", "--planners", "a_star,jps_plus")
        self.assertEqual(result.returncode, 0, result.stderr)
        head, *lines = result.stdout.splitlines()
        for word in ("map", "planner", "queries", "mean us", "median us", "worst us", "expansions", "ratio",
                     "build s", "MiB"):
            self.assertIn(word, head)
        self.assertEqual([line.split()[:3] for line in lines],
                         [["small", "a_star", "3"], ["small", "jps_plus", "3"]])
        self.assertEqual({len(line) for line in lines}, {len(head)})

    def test_refusals(self):
        self.refused_bench("--data", "nowhere", says=["nowhere", ".map"])
        (self.folder / "empty").mkdir()
        self.refused_bench("--data", "empty", says=["empty", ".map.scen"])
        self.refused_bench("--data", "maps", "--maps", "smal", says=["--maps", "'smal'", "'small'"])
        self.refused_bench("--data", "maps", "--planners", "a_stra", says=["--planners", "a_stra", "a_star"])
        self.refused_bench("--data", "maps", "--planners", "visibility_graph", says=["visibility_graph", "grids"])
        self.refused_bench("--data", "maps", "--planners", "safest", says=["safest", "short paths"])
        self.refused_bench("--data", "maps", "--queries", "0", says=["--queries"])
        self.refused_bench("--data", "maps", "--repeat", "many", says=["--repeat"])
        self.refused_bench(says=["--data"])
        self.refused_bench("--data", "maps/small.map", says=["small.map", "folder"])

    def test_broken_files(self):
        def broken(name, content, *says):
            with self.subTest(name=name, says=says):
                path = self.folder / name
                before = path.read_bytes() if path.exists() else None
                self.write(name, content)
                self.refused_bench("--data", "maps", says=[name, *says])
                path.unlink() if before is None else path.write_bytes(before)

        broken("maps/small.map", MAP.replace("height 4", "height 5"), "cut short")
        broken("maps/small.map", MAP.replace("width 6", "width 7"), ":5", "6 letters")
        broken("maps/small.map", MAP.replace("width 6", "width 99999"), "cut short")
        broken("maps/small.map", MAP.replace("type octile", "type tile"), ":1", "type octile")
        broken("maps/small.map", b"\x00\xff" * 40, ":1")
        broken("maps/small.map.scen", scenario(size="6 5"), "6 x 5", "6 x 4")
        broken("maps/small.map.scen", scenario(ends=[(0, 0, 6, 0)]), ":2", "outside the map")
        broken("maps/small.map.scen", scenario(ends=[(-1, 0, 5, 0)]), ":2", "'-1'")
        broken("maps/small.map.scen", scenario(lengths=[math.nan]), ":2", "length")
        broken("maps/small.map.scen", "version 2\n", ":1", "version 1")
        broken("maps/anyangle/small.csv", table() + "1,2,3\n", ":5", "anyangle_opt")
        broken("maps/anyangle/small.csv", table() + "0,0,6,0,1,1\n", ":5", "outside the map")
        broken("maps/anyangle/small.csv", table([math.inf]), ":2", "anyangle_opt")


class BenchExplore(ToolTest):
    def test_compares_strategies_over_a_bound(self):
        result = self.run_tool("bench", "explore", "--grids", "--maps", "maze1", "--strategies", "tour", "--seeds", "2", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = {(row["group"], row["strategy"]): row for row in self.json_of(result)["rows"]}
        self.assertEqual(set(rows), {(group, name) for group in ("maze", "all") for name in ("nearest", "tour")})
        for row in rows.values():
            self.assertEqual((row["maps"], row["runs"], row["complete"]), (1, 2, 2))
            value, low, high = row["median_time_over_bound"]
            self.assertGreaterEqual(low, 1.0)
            self.assertLessEqual(low, value)
            self.assertLessEqual(value, high)
        self.assertEqual(rows["maze", "nearest"]["mean_time_over_nearest"], [1.0, 1.0, 1.0])

    def test_refuses_maps_that_are_not_there(self):
        result = self.run_tool("bench", "explore", "--grids", "--maps", "castle")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'castle'", self.sentence(result))


if __name__ == "__main__":
    main()
