"""The command plan: maps of every kind, answers, refusals, the table and the picture."""
import gzip
import json
import math
import subprocess
import unittest
import xml.etree.ElementTree

from tool import DATA, TOOL, ToolTest, main

PGM = ("P2\n6 4\n255\n" + "254 254 254 0 254 254\n" * 3 + "254 254 254 254 254 254\n")
YAML = "image: m.pgm\nresolution: 0.5\norigin: [10, 20, {yaw}]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
CATALOGUE = json.loads(subprocess.run([TOOL, "list", "--json"], capture_output=True, check=True).stdout)
PLANNERS = [row["name"] for row in CATALOGUE["path_planners"] if "cells" in row["models"]]
assert {"dijkstra", "a_star", "theta_star"} <= set(PLANNERS)


def length(waypoints):
    return sum(math.dist(a, b) for a, b in zip(waypoints, waypoints[1:]))


class Plan(ToolTest):
    def plan(self, *args, status=0):
        result = self.run_tool("plan", *args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        return self.json_of(result)

    def check_answer(self, answer):
        self.assertEqual(answer["status"], "done")
        metrics = answer["metrics"]
        self.assertAlmostEqual(metrics["length_m"], length(answer["waypoints"]), places=9)
        if answer["planner"] == "safest":
            exposed = (metrics["cost_m"] - metrics["length_m"]) / 10
            self.assertAlmostEqual(exposed / metrics["exposure"], 1.0, delta=0.02)
        else:
            self.assertAlmostEqual(metrics["cost_m"], metrics["length_m"], places=9)
        self.assertLessEqual(answer["metrics"]["lower_bound_m"], answer["metrics"]["cost_m"] + 1e-9)

    def test_movingai(self):
        answer = self.plan("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "a_star")
        self.check_answer(answer)
        self.assertEqual((answer["job"], answer["planner"], answer["radius_m"]), ("plan", "a_star", 0.0))
        # (0,3) to (2,0), straight under the wall to (4,0) because corners are not cut, then up to (5,3).
        self.assertAlmostEqual(answer["metrics"]["cost_m"], 3 * math.sqrt(2) + 5, places=9)
        self.write("small.map.gz", gzip.compress((self.folder / "small.map").read_bytes()))
        again = self.plan("small.map.gz", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "a_star")
        self.assertEqual(again["waypoints"], answer["waypoints"])

    def test_cells_blocked_and_freed(self):
        ends = ("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "jps")
        plain = self.plan(*ends)["metrics"]["cost_m"]
        # The wall of column 3 gets a door on top: straight through.
        opened = self.plan(*ends, "--free", "3,3")
        self.check_answer(opened)
        self.assertEqual(opened["metrics"]["cost_m"], 5)
        self.assertEqual(self.plan(*ends, "--block", "3,0,1,4", "--free", "3,3")["waypoints"], opened["waypoints"])
        self.assertEqual(self.plan(*ends, "--block", "3,0", status=1)["code"], "no_path")
        detour = self.plan(*ends, "--block", "1,3", "--block", "1,2")
        self.assertGreater(detour["metrics"]["cost_m"], plain)
        ends = ("plan", *ends)
        self.refused(*ends, "--block", "6,0", says=["--block 6,0", "leaves the grid", "x from 0 to 5"])
        self.refused(*ends, "--free", "0,0,7,1", says=["--free 0,0,7,1", "leaves the grid"])
        self.refused(*ends, "--free", "1.5,2", says=["--free 1.5,2", "1.5 is no good", "whole cells"])
        self.refused(*ends, "--block", "1,2,3", says=["--block 1,2,3", "x,y,width,height"])
        self.refused(*ends, "--block", "1,2,0,1", says=["--block 1,2,0,1", "at least one cell"])
        self.refused("plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--block", "1,1",
                     says=["--block", "exact shapes"])

    def test_map_server_in_its_own_frame_and_turned(self):
        self.write("m.pgm", PGM)
        self.write("m.yaml", YAML.format(yaw=0))
        self.write("turned.yaml", YAML.format(yaw=math.pi / 2))
        straight = self.plan("m.yaml", "--from", "10.25,21.75", "--to", "12.75,21.75", "--radius", "0")
        self.check_answer(straight)
        # A point (u, v) from the origin lies at (-v, u) when the map is turned by 90 degrees.
        turned = self.plan("turned.yaml", "--from", "8.25,20.25", "--to", "8.25,22.75", "--radius", "0")
        self.check_answer(turned)
        for (x, y), (tx, ty) in zip(straight["waypoints"], turned["waypoints"], strict=True):
            self.assertAlmostEqual(tx, 10 - (y - 20), places=9)
            self.assertAlmostEqual(ty, 20 + (x - 10), places=9)

    def test_sdf(self):
        answer = self.plan("yard.sdf", "--from", "0,-2", "--to", "2,2")
        self.check_answer(answer)
        self.assertEqual(answer["radius_m"], 0.26)
        for x, y in answer["waypoints"]:
            self.assertLess(max(abs(x), abs(y)), 2.9 - 0.26 + 1e-9)
            self.assertGreaterEqual(max(abs(x - 1), abs(y - 1)), 0.25 + 0.26 / math.sqrt(2) - 1e-9)

    def test_no_path_is_an_answer(self):
        self.write("shut.map", (self.folder / "small.map").read_text().replace("......", "...@.."))
        question = ["plan", "shut.map", "--from", "0.5,3.5", "--to", "5.5,3.5"]
        self.refused(*question, says=["nothing joins", "goal"], status=1)
        fault = self.plan(*question[1:], status=1)
        self.assertEqual(fault["code"], "no_path")
        self.assertEqual(fault["job"], "plan")
        compared = self.plan(*question[1:], "--compare", status=1)
        self.assertEqual({row["status"] for row in compared["plans"]}, {"not_done"})

    def test_refusals(self):
        self.refused("plan", "small.map", "--from", "3.5,3.5", "--to", "0,0", says=["--from 3.5,3.5", "blocked"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "3.5,3.5", says=["--to 3.5,3.5", "blocked"])
        self.refused("plan", "small.map", "--from", "-1,0", "--to", "3.5,3.5", says=["--from -1,0", "outside"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "99,0", "--compare", says=["--to 99,0", "outside"])
        for value in ["nan,0", "1", "1,2,3", "", "1e99,0"]:
            self.refused("plan", "small.map", "--from", value, "--to", "0,0", says=["--from", f"'{value}'", "1.5,-2"])
        ask = ["plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--svg", "p.svg"]
        for flag, value in [("--radius", "-1"), ("--radius", "nan"), ("--height", "inf"), ("--resolution", "0"),
                            ("--model", "hexagons"), ("--a-star-weight", "0.5"), ("--most-cells", "0")]:
            self.refused(*ask, flag, value, says=[flag, f"'{value}'"])
        self.refused(*ask, "--planner", "thetastar", says=["--planner", "'thetastar'", "'theta_star'"])
        for planner in CATALOGUE["path_planners"]:
            if "corners" not in planner["models"] and not planner["polygons"]:
                self.refused(*ask, "--planner", planner["name"], "--model", "corners",
                             says=["--planner", planner["name"], "corners"])
        self.refused(*ask, "--resolution", "0.0001", says=["resolution", "coarser"])
        self.refused(*ask, "--radius", "3", says=["--from 0,-2", "blocked"])
        self.refused("plan", "yard.doc", "--from", "0,0", "--to", "1,1", says=["yard.doc", ".sdf"])
        self.refused("plan", "none.map", "--from", "0,0", "--to", "1,1", says=["none.map", "no such file"])
        (self.folder / "folder.map").mkdir()
        self.refused("plan", "folder.map", "--from", "0,0", "--to", "1,1", says=["folder.map", "folder"])
        self.write("cut.map.gz", gzip.compress(b"type octile\nheight 4\nwidth 6\nmap\n" + b"......\n" * 4)[:-9])
        self.refused("plan", "cut.map.gz", "--from", "0,0", "--to", "1,1", says=["cut.map.gz", "gzip"])
        self.write("huge.map", "type octile\nheight 99999999\nwidth 99999999\nmap\n")
        self.refused("plan", "huge.map", "--from", "0,0", "--to", "1,1", says=["huge.map", "99999999"])
        self.refused(*ask[:-1], "no/where.svg", says=["no/where.svg", "make it first"])

    def test_compare(self):
        table = self.run_tool("plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--compare")
        self.assertEqual(table.returncode, 0, table.stderr)
        self.assertEqual([row.split()[0] for row in table.stdout.splitlines() if row.strip()], ["planner"] + PLANNERS)
        both = self.plan("yard.sdf", "--from", "0,-2", "--to", "2,2", "--compare")
        self.assertEqual([row["planner"] for row in both["plans"]], PLANNERS)
        for row in both["plans"]:
            self.check_answer(row)
        costs = {row["planner"]: row["metrics"]["cost_m"] for row in both["plans"]}
        self.assertAlmostEqual(costs["dijkstra"], costs["a_star"], places=9)
        self.assertLessEqual(costs["theta_star"], costs["a_star"] + 1e-9)

    def test_options_of_a_planner_have_flags(self):
        hall = "type octile\nheight 41\nwidth 41\nmap\n" + ("." * 20 + "@" + "." * 20 + "\n") * 30 + ("." * 41 + "\n") * 11
        self.write("hall.map", hall)
        ask = ["hall.map", "--from", "0.5,40.5", "--to", "40.5,40.5", "--planner", "a_star"]
        exact = self.plan(*ask)["metrics"]
        fast = self.plan(*ask, "--a-star-weight", "5")["metrics"]
        self.assertLess(fast["expansions"], exact["expansions"])
        self.assertLessEqual(exact["cost_m"], fast["cost_m"] + 1e-9)

    def test_models(self):
        for model in ["cells", "corners"]:
            self.check_answer(self.plan("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--model", model))

    def test_picture(self):
        svg = "{http://www.w3.org/2000/svg}"
        for name, ends in [("small.map", ("0.5,3.5", "5.5,3.5")), ("yard.sdf", ("0,-2", "2,2"))]:
            result = self.run_tool("plan", name, "--from", ends[0], "--to", ends[1], "--compare", "--svg", "p.svg")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("p.svg", result.stdout)
            picture = xml.etree.ElementTree.parse(self.folder / "p.svg").getroot()
            self.assertEqual(len(picture.findall(f"{svg}polyline")), len(PLANNERS))
            texts = [t.text for t in picture.findall(f"{svg}text")]
            for word in PLANNERS + ["from", "to"]:
                self.assertTrue(any(word in t for t in texts), texts)

    @unittest.skipUnless((DATA / "guard" / "maps").is_dir(), "the published data is not here")
    def test_many_goals_from_one_start(self):
        goals = ["5,0", "0,3", "5,3"]
        to = [word for goal in goals for word in ("--to", goal)]
        for planner in ("dijkstra", "a_star"):
            result = self.run_tool("plan", "small.map", "--from", "0,0", *to, "--planner", planner, "--json")
            self.assertEqual(result.returncode, 0, result.stderr)
            plans = self.json_of(result)["plans"]
            for plan, goal in zip(plans, goals):
                single = self.run_tool("plan", "small.map", "--from", "0,0", "--to", goal, "--planner", planner, "--json")
                self.assertEqual(plan["metrics"]["cost_m"], self.json_of(single)["metrics"]["cost_m"])
                self.assertEqual(plan["waypoints"], self.json_of(single)["waypoints"])
                self.assertEqual(",".join(f"{x:g}" for x in plan["goal"]), goal)
        result = self.run_tool("plan", "small.map", "--from", "0,0", "--to", "5,0", "--to", "99,0", "--json")
        self.assertEqual(result.returncode, 1)
        self.assertEqual([plan["status"] for plan in self.json_of(result)["plans"]], ["done", "refused"])

    def test_trace(self):
        question = ("plan", "small.map", "--from", "0,0", "--to", "5,3", "--planner", "a_star", "--trace")
        result = self.run_tool(*question, "--json", "--svg", "trace.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = self.json_of(result)
        self.assertEqual(len(answer["trace"]), answer["metrics"]["expansions"])
        self.assertEqual(answer["trace"][0]["vertex"], answer["trace"][0]["parent"])
        for expansion in answer["trace"]:
            self.assertAlmostEqual(expansion["f"], expansion["g"] + expansion["h"], places=9)
        svg = (self.folder / "trace.svg").read_text()
        self.assertEqual(svg.count('class="label"'), len(answer["trace"]))
        for more, words in {(): "--svg FILE", ("--json", "--compare"): "one search",
                            ("--json", "--to", "1,1"): "one search"}.items():
            refused = self.run_tool(*question, *more)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(words, refused.stderr)

    def test_published_map_turned_by_a_quarter(self):
        self.check_answer(self.plan(DATA / "guard/maps/by_small.yaml", "--from", "0,-9", "--to", "2,2"))


if __name__ == "__main__":
    main()
