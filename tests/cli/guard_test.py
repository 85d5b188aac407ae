"""The job guard from the command line: what it says, writes and returns."""
import base64
import json
import pathlib
import re
import unittest

from mcap_log import targets_of
from tool import DATA, NO_PAGE, PAGE, SOURCE, TARGETS, ToolTest, main
from well_logged import well_logged

METRICS = ["targets", "reached", "failed", "unreachable", "reached_by_reference_rule", "planning_s", "mission_s",
           "driven_m", "turned_rad", "shots", "lower_bound_s", "gap"]
TARGET_KEYS = ["name", "status", "reason", "shots", "done_s", "x", "y", "heading_rad", "pitch_rad", "yaw_rad",
               "speed_mps", "clearance_m"]
YARD_WORLDS = DATA / "guard" / "worlds"


class Guard(ToolTest):
    def check_summary(self, summary):
        for key in ["status", "job", "metrics", "targets", "files"]:
            self.assertIn(key, summary)
        self.assertEqual(summary["job"], "guard")
        metrics = summary["metrics"]
        for key in METRICS:
            self.assertIn(key, metrics)
            self.assertIsInstance(metrics[key], (int, float), key)
        for key in ["targets", "reached", "failed", "unreachable", "shots"]:
            self.assertIsInstance(metrics[key], int, key)
        self.assertEqual(metrics["targets"], len(summary["targets"]))
        self.assertEqual(metrics["targets"], metrics["reached"] + metrics["failed"] + metrics["unreachable"])
        self.assertLessEqual(metrics["lower_bound_s"], metrics["mission_s"])
        self.assertAlmostEqual(metrics["gap"], 1 - metrics["lower_bound_s"] / metrics["expected_s"])
        for target in summary["targets"]:
            self.assertEqual(list(target)[:len(TARGET_KEYS)], TARGET_KEYS)
            self.assertIn(target["status"], ["reached", "failed", "unreachable"])
            self.assertTrue(target["reason"])
            if target["status"] == "reached":
                self.assertIsInstance(target["heading_rad"], (int, float))
                self.assertGreater(target["speed_mps"], 0)
                self.assertGreaterEqual(target["clearance_m"], 0)

    def test_json_is_one_object_and_names_the_files(self):
        result = self.run_tool(*self.guard("--json", "--out", "out", *PAGE))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        summary = self.json_of(result)
        self.check_summary(summary)
        self.assertEqual(summary["status"], "done")
        self.assertEqual([t["status"] for t in summary["targets"]], ["reached"] * 3)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["guard.html", "run.json", "run.mcap", "run.svg"][not PAGE:])
        self.assertEqual(summary["files"]["result"], "out/run.json")
        self.assertEqual(summary["files"]["log"], "out/run.mcap")
        result = self.result_of("out")
        self.assertEqual(result["status"], "done")
        self.assertEqual(len(result["targets"]), 3)
        self.assertEqual(list(targets_of(self.log_of("out"))), [target["name"] for target in result["targets"]])

    def test_prove_makes_the_gap_no_larger(self):
        gaps = [self.json_of(self.run_tool(*self.guard("--json", *flags)))["metrics"]["gap"]
                for flags in [["--plan-shoot-on-the-move=false"], ["--prove"], ["--plan-prove"]]]
        self.assertEqual(gaps[1], 0)
        self.assertLessEqual(gaps[1], gaps[0])
        self.assertEqual(gaps[1], gaps[2])

    def test_without_a_folder_nothing_is_written(self):
        before = self.tree()
        summary = self.json_of(self.run_tool(*self.guard("--json")))
        self.assertEqual(summary["files"], {})
        self.assertEqual(self.tree(), before)

    def test_text_is_for_people(self):
        result = self.run_tool(*self.guard("--out", "deep/er/out", *PAGE))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stdout.startswith("court: 3 of 3 targets reached in "), result.stdout)
        self.assertNotIn("{", result.stdout)
        for word in ["fox", "deep/er/out/run.json", "planning took"] + ["deep/er/out/guard.html"] * len(PAGE):
            self.assertIn(word, result.stdout)

    def test_warnings_go_to_standard_error(self):
        broken = (self.folder / "yard.sdf").read_text().replace("0.5 0 0 0</pose>", "0.5</pose>", 1)
        self.write("yard.sdf", broken)
        result = self.run_tool(*self.guard("--json"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stderr.startswith("outrider: warning: yard.sdf:"), result.stderr)
        self.assertEqual(len(self.json_of(result)["warnings"]), len(result.stderr.splitlines()))

    def test_same_bytes_for_any_number_of_threads(self):
        for out, threads in [("a", "1"), ("b", "2"), ("c", "1")]:
            self.run_tool(*self.guard("--out", out, "--threads", threads, "--seed", "5"))
        self.same_run("a", "b")
        self.same_run("a", "c")
        self.run_tool(*self.guard("--out", "other", "--seed", "6"))
        self.assertNotEqual(self.log_of("a").of("/shots"), self.log_of("other").of("/shots"))

    def test_a_target_that_fails_is_exit_status_1(self):
        wild = self.guard("--errors-gun", "1", "--errors-speed", "0.5", "--tries", "1", "--json", "--seed", "3")
        result = self.run_tool(*wild)
        summary = self.json_of(result)
        self.check_summary(summary)
        self.assertGreater(summary["metrics"]["failed"], 0)
        self.assertEqual(summary["status"], "not_done")
        self.assertIn("failed", summary["reason"])
        self.assertEqual(result.returncode, 1)

    def test_a_target_out_of_reach_has_a_proof_and_no_pose(self):
        self.write("targets.txt", TARGETS + "name=kite type=1 x=0 y=0 z=40\n")
        result = self.run_tool(*self.guard("--json"))
        summary = self.json_of(result)
        self.check_summary(summary)
        kite = summary["targets"][-1]
        self.assertEqual((kite["name"], kite["status"]), ("kite", "unreachable"))
        for key in ["x", "y", "heading_rad", "pitch_rad", "yaw_rad", "speed_mps", "clearance_m"]:
            self.assertIsNone(kite[key])
        self.assertEqual(summary["metrics"]["unreachable"], 1)

    def test_flags_win_over_the_scenario_and_paths_are_beside_it(self):
        (self.folder / "missions").mkdir()
        self.write("missions/m.yaml", "job: guard\nworld: ../yard.sdf\ntargets: ../targets.txt\nstart: 0,-2,90\n"
                   "seed: 4\nplan:\n  resolution: 0.2\n  iterations: 50\n  refinements: 0\n")
        first = self.json_of(self.run_tool("run", "missions/m.yaml", "--json", "--out", "a"))
        self.run_tool("run", "missions/m.yaml", "--out", "b", "--seed", "4", "--targets", "targets.txt")
        self.run_tool("guard", "--scenario", "missions/m.yaml", "--out", "c", "--seed", "5")
        seeds = {name: self.log_of(name).latest("/run").seed for name in "abc"}
        self.assertEqual(seeds, {"a": 4, "b": 4, "c": 5})
        self.check_summary(first)


class Replay(ToolTest):
    def setUp(self):
        super().setUp()
        self.summary = self.json_of(self.run_tool(*self.guard("--json", "--out", "out", *PAGE)))

    def test_tells_what_the_run_told(self):
        result = self.run_tool("replay", "out/run.mcap", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        again = self.json_of(result)
        del self.summary["metrics"]["planning_s"]  # no file holds it: it differs from run to run
        self.summary["files"] = {"log": self.summary["files"]["log"]}  # a replay knows of no other
        self.assertEqual(again, self.summary)
        text = self.run_tool("replay", "out/run.mcap").stdout
        self.assertTrue(text.startswith("court: 3 of 3 targets reached in "), text)

    def test_makes_the_picture(self):
        result = self.run_tool("replay", "out/run.mcap", "--svg", "picture.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "picture.svg").read_bytes(), (self.folder / "out/run.svg").read_bytes())
        self.assertTrue((self.folder / "picture.svg").read_text().startswith("<svg"))

    @unittest.skipIf(PAGE, "this tool has a page")
    def test_says_that_it_has_no_page(self):
        self.refused("replay", "out/run.mcap", "--html", "page.html", says=["--html", NO_PAGE, "npm"])
        self.refused(*self.guard("--out", "more", "--html"), says=["--html", NO_PAGE, "npm"])

    @unittest.skipUnless(PAGE, f"this tool was {NO_PAGE}")
    def test_makes_the_page(self):
        result = self.run_tool("replay", "out/run.mcap", "--html", "page.html")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "page.html").read_bytes(), (self.folder / "out/guard.html").read_bytes())
        page = (self.folder / "page.html").read_text()
        self.assertTrue(page.lstrip().lower().startswith("<!doctype html"))
        self.assertIn(base64.b64encode((self.folder / "out/run.mcap").read_bytes()).decode(), page)
        self.assertIsNone(re.search(r"""(src|href)\s*=\s*["']?(https?:)?//""", page), "it loads something")

    def test_reads_compressed_results(self):
        import gzip
        self.write("r.json.gz", gzip.compress((self.folder / "out/run.json").read_bytes()))
        self.assertEqual(self.run_tool("replay", "r.json.gz").returncode, 0)

    def test_refuses_what_is_no_run(self):
        self.write("guard.json", '{"outrider_report": 1, "status": "done", "job": "guard", "metrics": {}}')
        self.refused("replay", "guard.json", says=["guard.json", "older version", "--out DIR", "run.mcap"])
        result = (self.folder / "out/run.json").read_text()
        self.refused("replay", "out/run.json", "--svg", "p.svg", says=["out/run.json", "run.mcap"])
        self.write("cut.json", result[:len(result) // 2])
        self.refused("replay", "cut.json", "--svg", "p.svg", says=["cut.json", "JSON"])
        self.write("other.json", '{"type": "FeatureCollection"}')
        self.refused("replay", "other.json", says=["other.json", "run.json", "run the job again"])
        self.write("list.json", "[]")
        self.refused("replay", "list.json", says=["list.json"])
        self.refused("replay", "none.json", says=["none.json", "no such file"])
        (self.folder / "bare").mkdir()
        self.refused("replay", "bare", says=["bare", "folder", "run.mcap"])
        for path in ("out", "out/run.json"):
            self.assertIn("3 of 3 targets reached", self.run_tool("replay", path).stdout)

    def test_refuses_to_write_where_it_cannot(self):
        self.refused("replay", "out/run.mcap", "--svg", "nowhere/p.svg", says=["nowhere/p.svg", "make it first"])
        self.refused("replay", "out/run.mcap", "--svg", "out", says=["out", "folder"])
        self.refused("replay", "out/run.mcap", "--svg", "", says=["empty"])


class Reference(ToolTest):
    """The two worlds of the reference report; a coarse plan, so that it is quick."""

    @unittest.skipUnless(YARD_WORLDS.is_dir(), "the published data is not here")
    def test_both_worlds_run(self):
        for name in ["by_small", "by_small2"]:
            result = self.run_tool("guard", "--world", YARD_WORLDS / f"{name}.sdf", "--targets",
                                   DATA / "guard" / "goals_params.txt", "--start", "0,-9.5,90", "--seed", "1", "--json",
                                   "--out", name, "--plan-resolution", "0.25", "--plan-iterations", "200")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("outrider: warning: ", result.stderr)
            summary = self.json_of(result)
            Guard.check_summary(self, summary)
            self.assertEqual(summary["metrics"]["targets"], 24)
            self.assertEqual(self.run_tool("replay", name).returncode, 0)

    def test_the_bundled_scenario_loads(self):
        result = self.run_tool("run", SOURCE / "scenarios/yard/yard.yaml", "--json", "--plan-resolution", "0.4",
                               "--plan-iterations", "20", "--plan-aim-step", "0.3", "--plan-pitch-step", "10", "--out", "out")
        self.assertIn(result.returncode, [0, 1], result.stderr)
        well_logged(self, "out")
        self.assertGreaterEqual(self.json_of(result)["metrics"]["targets"], 20)


if __name__ == "__main__":
    main()
