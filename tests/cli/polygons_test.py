"""The command plan on polygon environments: queries, comparison, pictures, refusals."""
import json
import math
import unittest
import xml.etree.ElementTree

from tool import DATA, SOURCE, ToolTest, in_soak, main

# A room with a wall of two blocks that share an edge; the way is round its end.
ROOM = """(0,0) (8,0)  (8,6) (0,6)
---
(3,0) (4,0) (4,2) (3,2)
(4,2) (3,2) (3,4) (4,4)
---
(1,1) (7,1)
(1, 5) (7,5)
"""


ALL_CURVES = {"visibility_graph", "least_time", "medial_axis"}


class Polygons(ToolTest):
    def plan(self, *args, status=0):
        self.write("room.txt", ROOM.encode())
        result = self.run_tool("plan", *args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        return self.json_of(result), result.stderr

    def check_rows(self, rows, radius):
        for row in rows:
            self.assertEqual(row["status"], "done")
            self.assertGreaterEqual(row["clearance_m"], radius - 3e-9)
            self.assertLessEqual(row["lower_bound"], row["cost"] + 1e-9)
            if row["cost_unit"] == "m":
                self.assertAlmostEqual(row["cost"], row["length_m"], places=9)
            units = {"least_time": "s", "medial_axis": "m eq", "safest": "m eq"}
            self.assertEqual(row["cost_unit"], units.get(row["planner"], "m"))
        for query in {row["query"] for row in rows}:
            exact = [row for row in rows if row["query"] == query and row["guarantee"] == "disk_optimal"]
            self.assertEqual(len(exact), 3)
            wide = next(row for row in rows if row["query"] == query and row["planner"] == "widest")
            for row in (row for row in rows if row["query"] == query and row["planner"] in ALL_CURVES):
                self.assertLessEqual(row["clearance_m"], wide["clearance_m"] * (1 + 1e-6))
            for row in exact:
                self.assertEqual(row["optimal"], 1)
                self.assertAlmostEqual(row["cost"] / exact[0]["cost"], 1.0, places=9)
            for row in rows:
                slack = row["reached_within_m"] + 0.08  # a start moved to the grid's vertex
                if row["query"] == query:
                    self.assertGreaterEqual(row["length_m"], exact[0]["cost"] - slack)

    def test_all_queries_compared_with_pictures(self):
        answer, _ = self.plan("room.txt", "--query", "all", "--compare", "--radius", "0.5", "--out", "out")
        self.assertEqual((answer["status"], answer["job"]), ("done", "plan"))
        self.assertEqual(answer["metrics"]["rows"], len(answer["rows"]))
        self.check_rows(answer["rows"], 0.5)
        self.assertGreaterEqual(len(answer["rows"]), 2 * 6)
        # Two tangents to the circles about (3, 4) and (4, 4), their arcs, and 1 m along the wall's end.
        expected = 1.0
        for aside in (2, 3):
            apart = math.hypot(aside, 3)
            expected += math.sqrt(apart**2 - 0.25) + 0.5 * (math.atan2(3, aside) + math.asin(0.5 / apart))
        first = next(r for r in answer["rows"] if r["planner"] == "visibility_graph" and r["query"] == 1)
        self.assertAlmostEqual(first["cost"], expected, places=9)
        root = xml.etree.ElementTree.parse(self.folder / "out" / "run.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))
        left = json.loads((self.folder / "out" / "run.json").read_text())
        self.assertEqual([row["waypoints"] for row in left["rows"]], [row["waypoints"] for row in answer["rows"]])

    def test_one_query_points_and_polygonal(self):
        one, _ = self.plan("room.txt", "--query", "2")
        points, _ = self.plan("room.txt", "--from", "1,5", "--to", "7,5")
        self.assertEqual(one["rows"][0]["cost"], 6.0)
        self.assertEqual(points["rows"][0]["cost"], 6.0)
        self.assertIsNone(points["rows"][0]["query"])
        arcs, _ = self.plan("room.txt", "--query", "1", "--planner", "visibility_graph_implicit")
        legs, _ = self.plan("room.txt", "--query", "1", "--planner", "visibility_graph_implicit",
                            "--visibility-graph-implicit-polygonal")
        self.assertTrue(any(piece.get("turn_rad") for piece in arcs["rows"][0]["pieces"]))
        self.assertFalse(any(piece.get("turn_rad") for piece in legs["rows"][0]["pieces"]))
        ratio = legs["rows"][0]["cost"] / arcs["rows"][0]["cost"]
        self.assertTrue(1.0 < ratio < 1.0026, ratio)

    def test_no_path_is_an_answer(self):
        answer, _ = self.plan("room.txt", "--from", "1,3", "--to", "7,3", "--radius", "0.999", status=0)
        self.assertEqual(answer["status"], "done")
        answer, _ = self.plan("room.txt", "--from", "1.5,3", "--to", "6,3", "--radius", "1.01", status=1)
        self.assertEqual(answer["rows"][0]["status"], "no_path")
        self.assertIn("nothing joins", answer["reason"])

    def test_one_blocked_query_does_not_stop_the_others(self):
        self.write("blocked.txt", ROOM.encode() + b"(2.9,1) (7,1)\n(1,1) (3.5,1)\n(1,1) (9,9)\n")
        answer, _ = self.plan("blocked.txt", "--query", "all", "--compare", status=1)
        self.assertEqual(answer["status"], "not_done")
        codes = {3: "start_blocked", 4: "goal_blocked", 5: "outside_map"}
        for row in answer["rows"]:
            if row["query"] < 3:
                self.assertEqual(row["status"], "done")
            else:
                self.assertEqual(row["status"], codes[row["query"]])
                if row["query"] == 3:
                    self.assertIn("0.1 m from the nearest edge", row["reason"])
        self.assertIn("query 3", answer["reason"])
        answer, sentence = self.plan("blocked.txt", "--query", "3", status=2)
        self.assertIn("0.1 m from the nearest edge", sentence)

    def test_many_goals_from_one_start(self):
        goals = [(7, 1), (1, 5), (7, 5), (3.5, 1)]
        to = ("--to", " ".join(f"{x},{y}" for x, y in goals))
        for planner in ("visibility_graph", "visibility_graph_implicit", "least_time", "theta_star"):
            many, _ = self.plan("room.txt", "--from", "1,1", *to, "--planner", planner, status=1)
            self.assertEqual([row["query"] for row in many["rows"]], [1, 2, 3, 4])
            self.assertEqual([tuple(row["to"]) for row in many["rows"]], goals)
            self.assertEqual(many["rows"][3]["status"], "goal_blocked")
            for row, (x, y) in zip(many["rows"][:3], goals):
                one, _ = self.plan("room.txt", "--from", "1,1", "--to", f"{x},{y}", "--planner", planner)
                self.assertAlmostEqual(row["cost"], one["rows"][0]["cost"], places=9)

    def test_least_time(self):
        arguments = ("--from", "1,1", "--to", "7,1", "--radius", "0.5", "--planner", "least_time")
        price = ("--least-time-speed", "0.5", "--least-time-turn-price", "2", "--least-time-first-turn")
        row = self.plan("room.txt", *arguments, *price, "--least-time-heading", "180")[0]["rows"][0]
        points = row["waypoints"]
        legs = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:])]
        turned = lambda a, b: abs(math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))
        turns = sum(turned(a, b) for a, b in zip([(-1, 0)] + legs, legs))
        self.assertAlmostEqual(row["cost"], sum(math.hypot(*leg) for leg in legs) / 0.5 + 2 * turns, places=6)
        self.assertEqual((row["cost_unit"], row["guarantee"], row["optimal"]), ("s", "bounded", 0))
        self.assertTrue(row["lower_bound"] < row["cost"] < 1.0026 * row["lower_bound"])

    def test_polygons_of_a_world_of_solids(self):
        yard = SOURCE / "scenarios/yard/yard.sdf"
        for planner in ("visibility_graph", "least_time"):
            answer, _ = self.plan(yard, "--from", "0,-6", "--to", "4,4", "--planner", planner, "--radius", "0.3")
            row = answer["rows"][0]
            self.assertEqual(row["status"], "done")
            self.assertGreaterEqual(row["clearance_m"], 0.3 - 3e-9)
        grid, _ = self.plan(yard, "--from", "0,-6", "--to", "4,4", "--planner", "theta_star", "--radius", "0.3")
        exact, _ = self.plan(yard, "--from", "0,-6", "--to", "4,4", "--planner", "visibility_graph", "--radius", "0.3")
        self.assertLess(exact["rows"][0]["cost"], grid["rows"][0]["cost"] + 0.15)

    def test_refusals(self):
        self.write("crossed.txt", b"(0,0) (4,0) (4,4) (0,4)\n---\n(1,1) (2,2) (2,1) (1,2)\n")
        for args, words in {
            ("room.txt",): "from",
            ("room.txt", "--query", "3"): "has 2",
            ("room.txt", "--query", "1", "--from", "1,1"): "one or the other",
            ("room.txt", "--query", "1", "--radius", "0"): "0.001",
            ("room.txt", "--from", "2.9,1", "--to", "7,1"): "0.1 m from the nearest edge",
            ("room.txt", "--from", "3.5,1", "--to", "7,1"): "inside an obstacle",
            ("room.txt", "--from", "9,1", "--to", "7,1"): "outside the boundary",
            ("room.txt", "--query", "1", "--planner", "a_star", "--resolution", "0.005", "--radius", "100"): "100",
            ("crossed.txt", "--query", "all", "--out", "out"): "crosses or touches itself",
            ("none.txt", "--query", "all"): "no such file",
        }.items():
            answer, sentence = self.plan(*args, status=2)
            self.assertEqual(answer["status"], "refused")
            self.assertIn(words, sentence)
        self.assertFalse((self.folder / "out").exists())

    def test_published_maps(self):
        folder = DATA / "polygons"
        if not folder.exists():
            self.skipTest(f"{folder} is absent; set OUTRIDER_DATA")
        for number in range(1, 8) if in_soak() else (1, 2):
            answer, _ = self.plan(folder / f"map_{number}.txt", "--query", "all", "--compare")
            self.assertEqual(len({row["query"] for row in answer["rows"]}), 10)
            self.check_rows(answer["rows"], 0.18)


if __name__ == "__main__":
    main()
