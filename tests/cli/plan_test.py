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
PLANNERS = [row["name"] for row in CATALOGUE["path_planners"] if "cells" in row["models"] and not row["steers"]]
assert {"dijkstra", "a_star", "theta_star"} <= set(PLANNERS)


def length(waypoints):
    return sum(math.dist(a, b) for a, b in zip(waypoints, waypoints[1:]))


class Plan(ToolTest):
    def plan(self, *args, status=0):
        result = self.run_tool("plan", *args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        return self.json_of(result)

    def check_row(self, row):
        self.assertEqual(row["status"], "done")
        self.assertAlmostEqual(row["length_m"], length(row["waypoints"]), places=9)
        if row["planner"] == "safest":
            self.assertEqual(row["cost_unit"], "m eq")
            exposed = (row["cost"] - row["length_m"]) / 10
            self.assertAlmostEqual(exposed / row["exposure"], 1.0, delta=0.02)
        else:
            self.assertEqual(row["cost_unit"], "m eq" if row["planner"].startswith("terrain") else "m")
            self.assertAlmostEqual(row["cost"], row["length_m"], places=9)
        self.assertLessEqual(row["lower_bound"], row["cost"] + 1e-9)

    def check_answer(self, answer):
        """The one row of an answer to a single question."""
        self.assertEqual((answer["status"], answer["job"]), ("done", "plan"))
        (row,) = answer["rows"]
        self.check_row(row)
        self.assertIsNone(row["query"])
        for key in ("cost", "length_m", "lower_bound", "clearance_m", "exposure", "expansions"):
            self.assertEqual(answer["metrics"][key], row[key])
        return row

    def test_movingai(self):
        answer = self.plan("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "a_star")
        row = self.check_answer(answer)
        self.assertEqual((row["planner"], row["from"], row["to"]), ("a_star", [0.5, 3.5], [5.5, 3.5]))
        # (0,3) to (2,0), straight under the wall to (4,0) because corners are not cut, then up to (5,3).
        self.assertAlmostEqual(row["cost"], 3 * math.sqrt(2) + 5, places=9)
        self.write("small.map.gz", gzip.compress((self.folder / "small.map").read_bytes()))
        again = self.plan("small.map.gz", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "a_star")
        self.assertEqual(again["rows"][0]["waypoints"], row["waypoints"])
        self.write("small", (self.folder / "small.map").read_bytes())  # the content tells what it is
        again = self.plan("small", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "a_star")
        self.assertEqual(again["rows"][0]["waypoints"], row["waypoints"])

    def test_cells_blocked_and_freed(self):
        ends = ("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner", "jps")
        plain = self.plan(*ends)["metrics"]["cost"]
        # The wall of column 3 gets a door on top: straight through.
        opened = self.check_answer(self.plan(*ends, "--free", "3,3"))
        self.assertEqual(opened["cost"], 5)
        again = self.check_answer(self.plan(*ends, "--block", "3,0,1,4", "--free", "3,3"))
        self.assertEqual(again["waypoints"], opened["waypoints"])
        self.assertEqual(self.plan(*ends, "--block", "3,0", status=1)["rows"][0]["status"], "no_path")
        detour = self.plan(*ends, "--block", "1,3 1,2")
        self.assertGreater(detour["metrics"]["cost"], plain)
        ends = ("plan", *ends)
        self.refused(*ends, "--block", "6,0", says=["block 6,0", "leaves the grid", "x from 0 to 5"])
        self.refused(*ends, "--free", "0,0,7,1", says=["free 0,0,7,1", "leaves the grid"])
        self.refused(*ends, "--free", "1.5,2", says=["free 1.5,2", "1.5 is not valid", "whole cells"])
        self.refused(*ends, "--block", "1,2,3", says=["block 1,2,3", "x,y,width,height"])
        self.refused(*ends, "--block", "1,2,0,1", says=["block 1,2,0,1", "at least one cell"])
        self.refused("plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--block", "1,1",
                     says=["block", "exact shapes"])

    def test_map_server_in_its_own_frame_and_turned(self):
        self.write("m.pgm", PGM)
        self.write("m.yaml", YAML.format(yaw=0))
        self.write("turned.yaml", YAML.format(yaw=math.pi / 2))
        straight = self.plan("m.yaml", "--from", "10.25,21.75", "--to", "12.75,21.75", "--radius", "0")
        straight = self.check_answer(straight)
        # A point (u, v) from the origin lies at (-v, u) when the map is turned by 90 degrees.
        turned = self.plan("turned.yaml", "--from", "8.25,20.25", "--to", "8.25,22.75", "--radius", "0")
        turned = self.check_answer(turned)
        for (x, y), (tx, ty) in zip(straight["waypoints"], turned["waypoints"], strict=True):
            self.assertAlmostEqual(tx, 10 - (y - 20), places=9)
            self.assertAlmostEqual(ty, 20 + (x - 10), places=9)

    def test_sdf(self):
        answer = self.plan("yard.sdf", "--from", "0,-2", "--to", "2,2")
        for x, y in self.check_answer(answer)["waypoints"]:
            self.assertLess(max(abs(x), abs(y)), 2.9 - 0.26 + 1e-9)
            self.assertGreaterEqual(max(abs(x - 1), abs(y - 1)), 0.25 + 0.26 / math.sqrt(2) - 1e-9)

    def test_no_path_is_an_answer(self):
        self.write("shut.map", (self.folder / "small.map").read_text().replace("......", "...@.."))
        question = ["shut.map", "--from", "0.5,3.5", "--to", "5.5,3.5"]
        result = self.run_tool("plan", *question)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("nothing joins", result.stdout + result.stderr)
        answer = self.plan(*question, status=1)
        self.assertEqual((answer["status"], answer["job"]), ("not_done", "plan"))
        self.assertIn("nothing joins", answer["reason"])
        (row,) = answer["rows"]
        self.assertEqual((row["status"], row["reason"]), ("no_path", answer["reason"]))
        self.assertEqual((row["cost"], row["waypoints"]), (None, []))
        compared = self.plan(*question, "--compare", status=1)
        self.assertEqual(len(compared["rows"]), len(PLANNERS))
        self.assertNotIn("done", {row["status"] for row in compared["rows"]})

    def test_robots_that_steer_take_headings(self):
        poses = ["--from", "0.5,0.5,90", "--to", "5.5,3.5,0"]
        rows = self.json_of(self.run_tool("plan", "small.map", *poses, "--planner", "hybrid_a_star", "--compare", "--json"))["rows"]
        self.assertEqual([row["planner"] for row in rows], ["hybrid_a_star", "state_lattice"])
        for row in rows:
            self.assertEqual((row["status"], row["cost_unit"]), ("done", "m eq"))
            self.assertGreaterEqual(row["cost"], row["lower_bound"] - 1e-9)
            self.assertTrue(row["pieces"])
        self.refused("drive", "--goal", "1,0,0", "--planner", "hybrid_a_star", says=["hybrid_a_star", "turns in place"])

    def test_refusals(self):
        self.refused("plan", "small.map", "--from", "3.5,3.5", "--to", "0,0", says=["from 3.5,3.5", "blocked"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "3.5,3.5", says=["to 3.5,3.5", "blocked"])
        self.refused("plan", "small.map", "--from", "-1,0", "--to", "3.5,3.5", says=["from -1,0", "outside"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "99,0", "--compare", says=["to 99,0", "outside"])
        for value in ["nan,0", "1", "1,2,3,4", "1,2,north", "1e99,0"]:
            self.refused("plan", "small.map", "--from", value, "--to", "0,0", says=["from", f"'{value}'", "1.5,-2"])
        self.refused("plan", "small.map", "--to", "0,0", says=["from", "missing", "1.5,-2"])
        self.refused("plan", "small.map", "--from", "0,0", says=["to", "missing", "1.5,-2"])
        self.refused("plan", "small.map", "--query", "1", says=["query", "polygon"])
        ask = ["plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--out", "out"]
        for flag, value in [("--radius", "-1"), ("--radius", "nan"), ("--height", "inf"), ("--resolution", "0"),
                            ("--model", "hexagons"), ("--a-star-weight", "0.5"), ("--most-cells", "0")]:
            self.refused(*ask, flag, value, says=[flag.split("-")[-1], f"'{value}'"])
        self.refused(*ask, "--planner", "thetastar", says=["planner", "'thetastar'", "'theta_star'"])
        for planner in CATALOGUE["path_planners"]:
            if "corners" not in planner["models"] and not planner["polygons"]:
                self.refused(*ask, "--planner", planner["name"], "--model", "corners",
                             says=["planner", planner["name"], "corners"])
        self.refused(*ask, "--resolution", "0.0001", says=["resolution", "coarser"])
        self.refused(*ask, "--radius", "3", says=["from 0,-2", "blocked"])
        self.write("yard.doc", "no map")
        self.refused("plan", "yard.doc", "--from", "0,0", "--to", "1,1", says=["yard.doc", ".sdf"])
        self.refused("plan", "none.map", "--from", "0,0", "--to", "1,1", says=["none.map", "no such file"])
        (self.folder / "folder.map").mkdir()
        self.refused("plan", "folder.map", "--from", "0,0", "--to", "1,1", says=["folder.map", "folder"])
        self.write("cut.map.gz", gzip.compress(b"type octile\nheight 4\nwidth 6\nmap\n" + b"......\n" * 4)[:-9])
        self.refused("plan", "cut.map.gz", "--from", "0,0", "--to", "1,1", says=["cut.map.gz", "gzip"])
        self.write("huge.map", "type octile\nheight 99999999\nwidth 99999999\nmap\n")
        self.refused("plan", "huge.map", "--from", "0,0", "--to", "1,1", says=["huge.map", "99999999"])

    def test_compare(self):
        table = self.run_tool("plan", "yard.sdf", "--from", "0,-2", "--to", "2,2", "--compare")
        self.assertEqual(table.returncode, 0, table.stderr)
        first = [line.split()[0] for line in table.stdout.splitlines() if line.strip()]
        self.assertEqual([word for word in first if word in ["planner", *PLANNERS]], ["planner", *PLANNERS])
        both = self.plan("yard.sdf", "--from", "0,-2", "--to", "2,2", "--compare")
        self.assertEqual([row["planner"] for row in both["rows"]], PLANNERS)
        for row in both["rows"]:
            self.check_row(row)
        self.assertEqual((both["metrics"]["rows"], both["metrics"]["paths"]), (len(PLANNERS), len(PLANNERS)))
        self.assertAlmostEqual(both["metrics"]["length_m"], min(row["length_m"] for row in both["rows"]), places=8)
        costs = {row["planner"]: row["cost"] for row in both["rows"]}
        self.assertAlmostEqual(costs["dijkstra"], costs["a_star"], places=9)
        self.assertLessEqual(costs["theta_star"], costs["a_star"] + 1e-9)

    def test_options_of_a_planner_have_flags(self):
        hall = "type octile\nheight 41\nwidth 41\nmap\n" + ("." * 20 + "@" + "." * 20 + "\n") * 30 + ("." * 41 + "\n") * 11
        self.write("hall.map", hall)
        ask = ["hall.map", "--from", "0.5,40.5", "--to", "40.5,40.5", "--planner", "a_star"]
        exact = self.plan(*ask)["metrics"]
        fast = self.plan(*ask, "--a-star-weight", "5")["metrics"]
        self.assertLess(fast["expansions"], exact["expansions"])
        self.assertLessEqual(exact["cost"], fast["cost"] + 1e-9)

    def test_models(self):
        for model in ["cells", "corners"]:
            self.check_answer(self.plan("small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--model", model))

    def test_picture(self):
        svg = "{http://www.w3.org/2000/svg}"
        for name, ends in [("small.map", ("0.5,3.5", "5.5,3.5")), ("yard.sdf", ("0,-2", "2,2"))]:
            result = self.run_tool("plan", name, "--from", ends[0], "--to", ends[1], "--compare", "--out", "out")
            self.assertEqual(result.returncode, 0, result.stderr)
            picture = xml.etree.ElementTree.parse(self.folder / "out" / "run.svg").getroot()
            left = json.loads((self.folder / "out" / "run.json").read_text())
            self.assertEqual([row["planner"] for row in left["rows"]], PLANNERS)
            texts = [t.text or "" for t in picture.iter(f"{svg}text")]
            for word in PLANNERS + ["robot at the start", "goal"]:
                self.assertTrue(any(word in t for t in texts), texts)

    def test_many_goals_from_one_start(self):
        goals = ["5,0", "0,3", "5,3"]
        for planner in ("dijkstra", "a_star"):
            rows = self.plan("small.map", "--from", "0,0", "--to", " ".join(goals), "--planner", planner)["rows"]
            self.assertEqual([row["query"] for row in rows], [1, 2, 3])
            for row, goal in zip(rows, goals, strict=True):
                self.check_row(row)
                single = self.check_answer(self.plan("small.map", "--from", "0,0", "--to", goal, "--planner", planner))
                self.assertEqual(row["cost"], single["cost"])
                self.assertEqual(row["waypoints"], single["waypoints"])
                self.assertEqual(",".join(f"{x:g}" for x in row["to"]), goal)
        answer = self.plan("small.map", "--from", "0,0", "--to", "5,0 99,0", status=1)
        self.assertEqual([row["status"] for row in answer["rows"]], ["done", "outside_map"])
        self.assertEqual(answer["status"], "not_done")
        self.assertIn("query 2", answer["reason"])

    def test_trace(self):
        question = ("small.map", "--from", "0,0", "--to", "5,3", "--planner", "a_star", "--trace")
        row = self.check_answer(self.plan(*question, "--out", "out"))
        trace = json.loads((self.folder / "out" / "trace.json").read_text())
        self.assertEqual(len(trace), row["expansions"])
        self.assertEqual(trace[0]["vertex"], trace[0]["parent"])
        for expansion in trace:
            self.assertAlmostEqual(expansion["f"], expansion["g"] + expansion["h"], places=9)
        self.assertIn("expanded; the later, the darker", (self.folder / "out" / "run.svg").read_text())
        self.refused("plan", *question, "--compare", says=["trace", "one search"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "5,3 1,1", "--trace", says=["trace", "one search"])

    def test_index(self):
        for planner, model in (("octile_labels", "cells"), ("hub_labels", "corners")):
            name = f"{planner}.index"
            question = ("small.map", "--model", model, "--from", "0,0", "--to", "5,3", "--planner", planner)
            plain = self.check_answer(self.plan(*question))
            for _ in range(2):  # written, then read
                row = self.check_answer(self.plan(*question, "--index", name))
                self.assertEqual(row["waypoints"], plain["waypoints"])
            content = (self.folder / name).read_bytes()
            self.assertFalse(list(self.folder.glob(".outrider-*")))
            self.refused("plan", *question, "--block", "0,3", "--index", name, says=[name, "another map", "delete it"])
            for flag in (f"--{planner.replace('_', '-')}-hub-memory", "--hub-memory"):
                self.refused("plan", *question, flag, "65", "--index", name, says=[name, "other options", "delete it"])
            self.refused("plan", *question, "--hub-memory", "0", says=["--hub-memory", "'0'", "1 to 65536"])
            self.write(name, content[:-8])
            self.refused("plan", *question, "--index", name, says=[name, "cut or damaged", "delete it"])
            self.write(name, b"a text")
            self.refused("plan", *question, "--index", name, says=[name, "no index file", "delete it"])
            self.refused("plan", *question, "--index", "nowhere/a.index", says=["nowhere/a.index", "folder"])
        self.refused("plan", *question, "--compare", "--index", "a.index", says=["index", "one planner"])
        self.refused("plan", "small.map", "--from", "0,0", "--to", "5,3", "--planner", "jps", "--index", "a.index",
                     says=["index", "jps has no index"])

    @unittest.skipUnless((DATA / "guard" / "maps").is_dir(), "the published data is not here")
    def test_published_map_turned_by_a_quarter(self):
        self.check_answer(self.plan(DATA / "guard/maps/by_small.yaml", "--from", "0,-9", "--to", "2,2"))


if __name__ == "__main__":
    main()
