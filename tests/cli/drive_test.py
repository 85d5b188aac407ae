"""The commands drive, run on a drive, and calibrate: answers, files, replay, refusals."""
import json
import unittest

from tool import SOURCE, ToolTest, costly_cases, flat, main
from well_logged import well_logged

WAYPOINTS = SOURCE / "scenarios/waypoints"
KEYS = ["driven_m", "ideal_m", "turned_rad", "ideal_rad", "tag_fraction", "time_s"]


class Drive(ToolTest):
    def run_json(self, *args, status=0):
        result = self.run_tool(*args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        answer = self.json_of(result)
        return flat(answer) if "metrics" in answer else answer

    def worst(self, answer):
        waypoints = answer["waypoints"]
        return (max(max(abs(w["dx"]), abs(w["dy"])) for w in waypoints),
                max(abs(w["dtheta"]) for w in waypoints))

    def test_closed_loop_with_rendered_images(self):
        for seed in (1, 2)[:costly_cases(1)]:
            answer = self.run_json("run", WAYPOINTS / "closed_loop.yaml", "--seed", seed, "--out", "out")
            well_logged(self, "out")
            self.assertEqual(answer["status"], "done")
            self.assertEqual(len(answer["waypoints"]), 4)
            position, heading = self.worst(answer)
            self.assertLessEqual(position, 0.03)
            self.assertLessEqual(heading, 0.03)
            self.assertLessEqual(answer["driven_m"], 1.05 * answer["ideal_m"])
            for key in KEYS:
                self.assertIsInstance(answer[key], float, key)

    def test_calibration_makes_the_open_loop_three_times_as_good(self):
        open_loop, runs = WAYPOINTS / "open_loop.yaml", WAYPOINTS / "runs.csv"
        self.assertEqual(self.run_tool("calibrate", runs, "--out", "out").returncode, 0)
        self.assertEqual((self.folder / "out/calibration.yaml").read_text(),
                         (WAYPOINTS / "calibration.yaml").read_text(), "the shipped file is what the runs say")
        for seed in (1, 2, 3):
            before = self.worst(self.run_json("run", open_loop, "--seed", seed))
            after = self.worst(self.run_json("drive", "--scenario", open_loop, "--calibration",
                                             "out/calibration.yaml", "--seed", seed))
            self.assertLess(before[0], 0.3048)
            self.assertLess(before[1], 0.5236)
            self.assertGreater(before[0], 0.1)
            self.assertLessEqual(after[0], before[0] / 3)
            self.assertLessEqual(after[1], before[1] / 3)

    def test_recorded_runs_are_calibrated_as_the_file_of_them(self):
        open_loop = WAYPOINTS / "open_loop.yaml"
        recorded = self.run_json("calibrate", "--record", open_loop, "--out", "out")
        read = self.run_json("calibrate", "out/runs.csv")
        self.assertEqual(len(recorded["laws"]), 6)
        for a, b in zip(recorded["laws"] + [{"a": w["gain"], "b": w["gain"]} for w in recorded["wheels"]],
                        read["laws"] + [{"a": w["gain"], "b": w["gain"]} for w in read["wheels"]]):
            for part in ("a", "b"):
                self.assertAlmostEqual(a[part]["value"], b[part]["value"], places=4)
                self.assertGreater(a[part]["half_width"], 0)
        self.assertIn("<svg", (self.folder / "out/calibration.svg").read_text())
        text = self.run_tool("calibrate", "out/runs.csv").stdout
        self.assertIn("distance = a t + b", text)
        self.assertIn("front_left", text)

    def test_a_mistyped_run_is_named_and_left_out(self):
        lines = (WAYPOINTS / "runs.csv").read_text().splitlines()
        clean = self.run_json("calibrate", WAYPOINTS / "runs.csv")
        self.assertEqual(clean["left_out"], [])
        fields = lines[16].split(",")
        fields[4] = "0.798676"  # for 0.978676
        self.write("runs.csv", "\n".join(lines[:16] + [",".join(fields)] + lines[17:]) + "\n")
        result = self.run_tool("calibrate", "runs.csv", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("runs.csv:17", result.stderr)
        answer = self.json_of(result)
        self.assertIn("runs.csv:17", answer["left_out"][0]["where"])
        self.assertAlmostEqual(answer["directions"][0]["gain"], clean["directions"][0]["gain"], delta=0.005)

    def test_files_and_replay(self):
        flags = ["drive", "--scenario", WAYPOINTS / "closed_loop.yaml", "--sight", "modelled", "--out"]
        self.assertEqual(self.run_tool(*flags, "a").returncode, 0)
        self.assertEqual(self.run_tool(*flags, "b").returncode, 0)
        for name in ("run.svg", "run.json", "run.mcap"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())
        replay = self.run_json("replay", "a/run.mcap")
        self.assertEqual(replay["waypoints"], self.run_json(*flags[:-1])["waypoints"])
        self.assertIn("4 of 4 stops reached", self.run_tool("replay", "a/run.mcap", "--svg", "p.svg").stdout)
        self.assertEqual((self.folder / "p.svg").read_bytes(), (self.folder / "a/run.svg").read_bytes())

    def test_a_robot_that_is_lost_stops_and_says_so(self):
        for faults in (["--faults-blind-from", "6"], ["--faults-kidnapped-at", "6", "--faults-kidnapped-turn", "180"]):
            answer = self.run_json("drive", "--scenario", WAYPOINTS / "closed_loop.yaml", "--sight", "modelled",
                                   *faults, status=1)
            self.assertEqual(answer["status"], "not_done")
            self.assertIn("lost", answer["reason"])
            self.assertIsNone(answer["waypoints"][-1]["dx"])

    def test_the_reason_names_the_causes_that_the_images_support(self):
        size, moved = "their places, tag_size and the camera right?", "was the robot moved, or a tag?"
        for words, says, not_says in ((["--faults-tag-scale", "1.3"], size, moved),
                                      (["--map-tags", "1=2,1.9,180 2=1.5,2.8,-90 3=0,2,0"], size, moved),
                                      (["--faults-kidnapped-at", "4", "--rules-relocalise", "1000"], moved, size)):
            answer = self.run_json("drive", "--scenario", WAYPOINTS / "closed_loop.yaml", *words, status=1)
            self.assertIn("lost: ", answer["reason"])
            self.assertIn(says, answer["reason"])
            self.assertNotIn(not_says, answer["reason"])

    def test_a_kidnapped_robot_that_sees_tags_finds_itself(self):
        answer = self.run_json("drive", "--scenario", WAYPOINTS / "closed_loop.yaml", "--sight", "modelled",
                               "--faults-kidnapped-at", "6")
        self.assertGreater(answer["belief_error_m"], 0.7)
        self.assertLessEqual(self.worst(answer)[0], answer["tolerance_m"])

    def test_without_tags_no_stop_of_a_closed_loop_is_reached(self):
        flags = ["drive", "--waypoints", "0.3,0,0 0.3,0.3,0", "--sight", "modelled"]
        result = self.run_tool(*flags, "--json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("there are no tags", result.stderr)
        answer = self.json_of(result)
        self.assertEqual(answer["status"], "unconfirmed")
        self.assertIn("2 of 2 stops unconfirmed", answer["reason"])
        self.assertEqual([w["outcome"] for w in answer["waypoints"]], ["unconfirmed"] * 2)
        self.assertEqual([w["reached_s"] for w in answer["waypoints"]], [None] * 2)
        self.assertIn("0 of 2 stops reached, 2 unconfirmed", self.run_tool(*flags).stdout)
        self.assertEqual(self.run_json(*flags, "--loop", "open")["status"], "done")

    def test_a_stop_without_a_tag_in_view_is_warned_of(self):
        flags = ["drive", "--waypoints", "0.3,0,0 0.3,0,180", "--tags", "1=2,0.5,180 2=2,-0.5,180", "--sight", "modelled", "--json"]
        result = self.run_tool(*flags)
        self.assertEqual(result.returncode, 1)
        self.assertIn("1 of the stops (waypoint 2)", result.stderr)
        self.assertEqual([w["outcome"] for w in self.json_of(result)["waypoints"]], ["reached", "unconfirmed"])

    def test_a_waypoint_where_the_robot_stands_has_no_ratio(self):
        text = self.run_tool("drive", "--waypoints", "0,0,0", "--tags", "1=2,0.5,180 2=2,-0.5,180", "--sight", "modelled").stdout
        self.assertIn("1 of 1 stops reached", text)
        self.assertNotIn("times the", text)

    def test_bench_drive_finds_no_false_claim(self):
        result = self.run_tool("bench", "drive", "--scenarios", WAYPOINTS / "closed_loop.yaml", "--seeds", "1", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = json.loads(result.stdout)
        self.assertEqual(answer["status"], "done")
        followers = ["pid", "pure_pursuit", "time_optimal"]
        faults = [row["fault"] for row in answer["rows"] if "fault" in row]
        self.assertGreaterEqual(len(set(faults)), 16)
        self.assertEqual(len(faults), len(set(faults)) * len(followers), "each fault with each follower")
        self.assertEqual([row["follower"] for row in answer["rows"] if "fault" not in row], followers)
        for row in answer["rows"]:
            self.assertEqual(row["runs"], 1)
            self.assertEqual(row["false_reached"], 0, row)
        self.assertEqual(answer["rows"][0]["reached"], answer["rows"][0]["stops"], "without a fault all are reached")

    def test_a_goal_and_a_planner(self):
        flags = ["drive", "--bounds", "0,0,3,3", "--start", "0.5,0.5,0", "--goal", "2.5,2,0", "--tags",
                 "1=2.9,2.3,180 2=2.9,1.7,180", "--sight", "modelled", "--planner"]
        for planner in ("a_star", "visibility_graph"):
            answer = self.run_json(*flags, planner)
            self.assertGreater(answer["path_m"], 2.49)
            self.assertGreater(answer["clearance_m"], 0.15, "of the robot's middle: more than the radius")

    def test_refusals(self):
        self.write("drive.yaml", "job: drive\nwaypoints: 1,0\n")
        self.refused("run", "drive.yaml", says=["waypoints", "'1,0'", "x,y,heading"])
        self.write("drive.yaml", "job: drive\nwaypoint: 1,0,0\n")
        self.refused("run", "drive.yaml", says=["drive.yaml:2", "did you mean 'waypoints'?"])
        self.write("drive.yaml", "job: drive\nwaypoints: 1,1,0\nworld: yard.sdf\n")
        self.refused("run", "drive.yaml", says=["waypoint 1 at 1,1", "obstacle"])
        self.write("drive.yaml", "job: drive\nwaypoints: 1,0,0\ncamera:\n  fx: 0\n")
        self.refused("run", "drive.yaml", says=["drive.yaml:4", "camera.fx"])
        self.write("drive.yaml", "job: drive\nwaypoints: 1,0,0\n")
        self.refused("run", "drive.yaml", "--robot-radius", "1", says=["--robot-radius", "outrider drive"])
        self.refused("drive", says=["waypoints"])
        self.refused("drive", "--waypoints", "1,0,0", "--tag-size", "0", says=["--tag-size"])
        self.refused("drive", "--goal", "1,0,0", "--planner", "a_starr", says=["did you mean 'a_star'?"])
        self.refused("calibrate", says=["runs", "--record"])
        self.refused("calibrate", "none.csv", says=["none.csv", "no such file"])
        self.write("runs.csv", "ahead_mps,left_mps,turn_dps,time_s,x_m,y_m,heading_deg\n0.2,0,0,fast,0,0,0\n")
        self.refused("calibrate", "runs.csv", says=["runs.csv:2", "'fast'", "time_s"])
        self.write("runs.csv", "ahead_mps,left_mps,turn_dps,time_s,x_m,y_m,heading_deg\n0.2,0,0,1,0.2,0,0\n")
        self.refused("calibrate", "runs.csv", says=["runs.csv:2", "at least 3"])

    def test_the_schema_knows_it(self):
        schema = json.loads(self.run_tool("schema", "--job", "drive").stdout)
        self.assertIn("waypoints", schema["properties"])
        self.assertIn("drive", [job["name"] for job in json.loads(self.run_tool("list", "--json").stdout)["jobs"]])


if __name__ == "__main__":
    main()
