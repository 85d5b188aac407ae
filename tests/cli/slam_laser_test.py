"""`outrider slam` on laser logs: simulated, published where they are, and damaged ones."""
import gzip
import math
import os

import laser_logs
from mcap_log import map_of, xyz
from slam_case import SlamCase, path_of
from tool import DATA, SOURCE, flat, in_soak, main
from well_logged import well_logged


class SlamLaser(SlamCase):
    def test_laser_scenario(self):
        """The bundled log of a simulated robot: the map it makes, beside the truth in the log."""
        found = self.mapped("--scenario", SOURCE / "scenarios/slam/office.yaml", "--out", "out")
        self.assertLess(found["mean_absolute_error_m"], 0.05)
        log = self.check_log(found, "out", self.rows("out"))
        settled, reference = path_of(log.latest("/trajectory")), path_of(log.latest("/reference"))
        self.assertEqual(len(settled), len(reference))
        for (_, belief), true, place in zip(log.read("/belief"), reference, settled):
            self.assertLess(math.dist(true[1:], place[1:]), 0.2)
            self.assertLess(math.dist(xyz(belief.pose.pose.position)[:2], place[1:]), 0.5)
        self.assertEqual(len(log.latest("/loops").loops), found["loops"])
        self.assertEqual(len([one for _, one in log.read("/rosout") if one.name == "loop"]), found["loops"])
        scans = log.read("/scan")
        stamps = [(scan.header.stamp.sec, scan.header.stamp.nanosec) for _, scan in scans]
        self.assertEqual(stamps, sorted(stamps))
        self.assertGreater(len(scans), 50)
        self.assertEqual({len(scan.ranges) for _, scan in scans}, {120})
        for _, known in log.read("/map"):
            self.assertEqual(len(known.data), known.info.width * known.info.height)
        self.assertGreater(log.read("/map_updates")[-1][0], 0.5 * settled[-1][0])

    def test_trusted_odometry_has_a_map(self):
        self.mapped(SOURCE / "scenarios/slam/office.log.gz", "--laser-trust-odometry", "--out", "out")
        size = (self.folder / "out/map.pgm").read_bytes().split()[1:3]
        self.assertTrue(all(int(side) > 50 for side in size))
        info, rows = map_of(self.log_of("out"))
        self.assertAlmostEqual(info.resolution, 0.05, places=6)
        known = [x for x in range(info.width) if any(row[x] >= 0 for row in rows)]
        self.assertLessEqual(abs(known[-1] - known[0] + 1 - int(size[0])), 4)

    def laser_log(self, name, scans=None):
        """A published log, cut after so many scans."""
        path = DATA / "slam" / "lidar" / f"{name}-corrected.log.gz"
        if not path.exists():
            self.skipTest(f"{path} is absent; set OUTRIDER_DATA")
        if scans is None:
            return path
        with gzip.open(path, "rt") as lines:
            kept = []
            for line in lines:
                kept.append(line)
                scans -= line.startswith("FLASER")
                if scans == 0:
                    break
        self.write(f"{name}.log", "".join(kept))
        return f"{name}.log"

    def mapped(self, *args):
        run = self.run_tool("slam", *args, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        return flat(self.json_of(run))

    def test_laser_log(self):
        log = self.laser_log("intel", 120)
        found = self.mapped(log, "--out", "a")
        self.assertEqual((found["steps"], found["steps_matched"]), (120, 119))
        self.assertLess(found["mean_absolute_error_m"], 0.1)
        self.assertLess(found["ate_m"], 0.15)
        self.assertGreater(found["real_time_factor"], 1)
        self.mapped(log, "--out", "b")
        for name in ("track.csv", "run.svg", "map.yaml", "map.pgm"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())
        self.assertEqual(len((self.folder / "a" / "track.csv").read_text().splitlines()), 121)
        graph = self.run_tool("slam", "a/graph.g2o", "--json")
        self.assertIn(graph.returncode, (0, 1), graph.stderr)
        self.assertGreater(flat(self.json_of(graph))["nodes"], 60)
        path = self.run_tool("plan", "a/map.yaml", "--from", "0,0", "--to", "0.5,0", "--json")
        self.assertEqual(path.returncode, 0, path.stderr)

    def test_whole_laser_logs(self):
        if "OUTRIDER_CASES" not in os.environ:
            self.skipTest("long; set OUTRIDER_CASES")
        for name in ("intel", "aces", "csail", "freiburg-079", "freiburg-101"):
            with self.subTest(name):
                self.assertLess(self.mapped(self.laser_log(name))["mean_absolute_error_m"], 0.1)

    def map_damaged(self, name, steps):
        """Maps a damaged log, and returns the result and whether the map is right."""
        self.write(f"{name}.log", laser_logs.text(steps))
        run = self.run_tool("slam", f"{name}.log", "--json")
        found = flat(self.json_of(run))
        self.assertIn((run.returncode, found["status"]), ((0, "done"), (1, "doubtful")), run.stderr)
        return found, found["mean_absolute_error_m"] < 0.5

    def test_ranges_of_a_wrong_scale(self):
        """Odometry tells: the map then moves farther than the wheels counted, and turns no more."""
        cases = [("office", 1.05), ("aces", 0.95)]
        if in_soak():
            cases += [("office", 0.95), ("aces", 1.05), ("csail", 0.95), ("csail", 1.05), ("freiburg-101", 0.95), ("freiburg-101", 1.05)]
        for name, scale in cases:
            log = SOURCE / "scenarios/slam/office.yaml" if name == "office" else self.laser_log(name)
            found = self.doubtful(log, "--faults-range-scale", scale)
            self.assertIn("too short" if scale < 1.0 else "too long", found["reason"])
            self.assertAlmostEqual(found["way_ratio"] / found["turn_ratio"], scale, delta=0.025)

    def test_odometry_that_counts_a_turn_too_many(self):
        """The turn did not happen: mapped right, or doubtful."""
        costly = "OUTRIDER_CASES" in os.environ
        cases = [("aces", 264), ("csail", 243)] + ([("aces", 132)] if costly else [])
        right = 0
        logs = {name: laser_logs.read(self.laser_log(name)) for name, _ in cases}
        for name, at in cases:
            with self.subTest(f"{name} {at}"):
                steps = logs[name]
                found, is_right = self.map_damaged(name, laser_logs.turned_once(steps, at))
                self.assertTrue(is_right or found["status"] == "doubtful", found["mean_absolute_error_m"])
                right += is_right
        self.assertGreater(right, 0)
        self.assertEqual(right < len(cases), costly, "the costly one is so wrong that only its status saves it")

    def check_jump(self, found, is_right):
        self.assertFalse(is_right, "only the status saves it")
        self.assertEqual((found["status"], found["jumps"], found["gaps"]), ("doubtful", 1, 0))
        self.assertEqual(found["scans_contradicted"], 0, "nothing else tells")
        self.assertRegex(found["reason"], r"jumps once, at [0-9.]+ s: it moves by .* odometry counted ")

    def test_a_stretch_that_is_repeated(self):
        """The map returns to where the stretch began, which odometry does not tell: doubtful."""
        cases = [("intel", 109, 849, 370)] + in_soak() * [("freiburg-079", 1020, 2723, 851)]
        for name, first, last, at in cases:
            with self.subTest(name):
                steps = laser_logs.read(self.laser_log(name))[first:last]
                again = laser_logs.repeated(steps, at, laser_logs.driven_after(steps, at, 8.0))
                self.check_jump(*self.map_damaged(name, again))

    def test_a_stretch_that_is_cut_out_of_a_corridor(self):
        """Its walls look the same before and after, and odometry counts a metre; only the clock tells."""
        steps = laser_logs.read(self.laser_log("aces"))
        found, is_right = self.map_damaged("cut", laser_logs.without(steps, 150, 30))
        self.assertFalse(is_right, "only the status saves it")
        self.assertEqual((found["status"], found["jumps"], found["gaps"]), ("doubtful", 1, 0))
        self.assertRegex(found["reason"], r"jumps once, at [0-9.]+ s: after 133 s without a scan it moves by ")

    def test_a_turn_that_odometry_does_not_count(self):
        """The robot turns by 160 degrees in a corridor while scans are missing and odometry stands still."""
        first = 0 if in_soak() else 4300
        steps = laser_logs.read(self.laser_log("freiburg-079"))[first:]
        self.check_jump(*self.map_damaged("still", laser_logs.not_counted(steps, 4489 - first, 39)))

    def test_laser_refusals(self):
        self.write("bad.log", "PARAM a b\nFLASER 2 1 x 0 0 0 0 0 0 0 h 0\n")
        self.refused("slam", "bad.log", says=["bad.log:2: ", "'x'", "FLASER n r1"])
        self.write("none.log", "ODOM 0 0 0 0 0 0 0 h 0\n")
        self.refused("slam", "none.log", says=["none.log: ", "no scan"])
        self.write("nan.log", "FLASER 0 0 0 0 0 0 0 0 h 0\nFLASER 2 nan nan 0 0 0 0 0 0 1 h 1\n")
        found = self.doubtful("nan.log", "--out", "out")
        self.assertEqual((found["steps_matched"], found["reason"]), (0, "the map may be wrong: only 0 of 1 scans matched the map"))

    def mapped_again(self, log, folder):
        run = self.run_tool("slam", log, "--out", folder, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        return flat(self.json_of(run)), (self.folder / folder / "map.pgm").read_bytes()

    def test_the_log_of_an_exploration_is_mapped_again(self):
        run = self.run_tool("run", SOURCE / "scenarios/explore/office.yaml", "--laser-beams", "90", "--out", "r", "--json")
        self.assertIn(run.returncode, (0, 1), run.stderr)  # it may find a gap that is too narrow for it
        well_logged(self, "r")
        explored = flat(self.json_of(run))
        found, image = self.mapped_again("r/run.mcap", "a")
        self.assertEqual(found["steps_lost"], 0)
        self.assertAlmostEqual(found["map_m2"], explored["mapped_free_m2"], delta=0.05 * found["map_m2"])
        self.assertEqual(self.mapped_again("r", "b")[1], image)
        self.refused("slam", "r", "--scan", "/front", says=["--scan", "the log has no topic '/front'", "/scan"])


if __name__ == "__main__":
    main()
