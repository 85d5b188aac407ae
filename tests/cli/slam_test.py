"""`outrider slam` and `bench slam` on small files and, where it is, on published data."""
import gzip
import math
import os
import unittest

from tool import DATA, SOURCE, ToolTest, main

EDGE = "EDGE_SE2 {} {} 1 0 {} 100 0 0 100 0 400\n"
SQUARE = "".join(EDGE.format(i, (i + 1) % 4, math.pi / 2 + 0.02 * i) for i in range(4))
KEYS = {"landmark_rmse_m", "landmark_rmse_aligned_m", "ate_m", "cost", "steps", "time_s", "max_step_s"}


def freiburg_log():
    """Once round a square of 2 m with a post in its middle and one outside, seen without error."""
    posts = {1: (1.0, 1.0), 2: (3.0, 1.0)}
    x, y, heading, lines = 0.0, 0.0, 0.0, []
    for step in range(16):
        turn = math.pi / 2 if step and step % 4 == 0 else 0.0
        heading += turn
        x, y = x + 0.5 * math.cos(heading), y + 0.5 * math.sin(heading)
        lines.append(f"ODOMETRY {turn} 0.5 0")
        for number, (px, py) in posts.items():
            lines.append(f"SENSOR {number} {math.hypot(px - x, py - y)} {math.atan2(py - y, px - x) - heading}")
    return "\n".join(lines) + "\n", "".join(f"{n} {x} {y}\n" for n, (x, y) in posts.items())


class Slam(ToolTest):
    def result(self, *args):
        run = self.run_tool("slam", *args, "--json", timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        found = self.json_of(run)
        self.assertEqual((found["status"], found["job"]), ("done", "slam"))
        self.assertLessEqual(KEYS, set(found))
        return found

    def test_graph(self):
        self.write("square.g2o", SQUARE)
        found = self.result("square.g2o", "--out", "out")
        self.assertEqual((found["nodes"], found["edges"]), (4, 4))
        self.assertLess(found["cost"], found["start_cost"] + 1e-9)
        for name in ("track.csv", "graph.g2o", "slam.svg"):
            self.assertTrue((self.folder / "out" / name).exists(), name)
        again = self.result("out/graph.g2o", "--graph-start", "given")
        self.assertAlmostEqual(again["start_cost"], found["cost"], places=9)
        self.assertAlmostEqual(again["cost"], found["cost"], places=9)
        self.assertIn("4 nodes, 4 edges", self.run_tool("slam", "square.g2o").stdout)

    def test_example(self):
        found = self.result(SOURCE / "scenarios" / "slam" / "yard.g2o", "--out", "out")
        self.assertEqual(found["nodes"], 28)
        self.assertIn("<ellipse", (self.folder / "out" / "slam.svg").read_text())

    def test_landmarks(self):
        log, world = freiburg_log()
        self.write("log.dat", log)
        self.write("world.dat", world)
        for engine in ("kalman", "ekf", "graph"):
            found = self.result("log.dat", "--slam-engine", engine, "--out", engine)
            self.assertEqual((found["steps"], found["landmarks"]), (16, 2))
            self.assertLess(found["landmark_rmse_m"], 1e-6)
            self.assertIn("<ellipse", (self.folder / engine / "slam.svg").read_text())
        self.assertEqual(len((self.folder / "ekf" / "track.csv").read_text().splitlines()), 18)
        self.assertEqual((self.folder / "graph" / "landmarks.csv").read_text().splitlines()[0],
                         "id,x,y,xx,xy,yy,sightings")

    def test_state_continues(self):
        log, _ = freiburg_log()
        self.write("log.dat", log)
        lines = log.splitlines(keepends=True)
        half = len(lines) // 2 // 3 * 3
        self.write("first.dat", "".join(lines[:half]))
        self.write("second.dat", "".join(lines[half:]))
        self.result("log.dat", "--slam-engine", "ekf", "--out", "whole")
        self.result("first.dat", "--slam-engine", "ekf", "--out", "first")
        self.result("second.dat", "--resume", "first/state.txt", "--out", "second")
        self.assertEqual((self.folder / "second" / "state.txt").read_bytes(),
                         (self.folder / "whole" / "state.txt").read_bytes())

    def test_same_bytes(self):
        log, _ = freiburg_log()
        self.write("log.dat", log)
        self.result("log.dat", "--out", "a")
        self.result("log.dat", "--out", "b")
        for name in ("track.csv", "landmarks.csv", "state.txt", "slam.svg"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())

    def test_refusals(self):
        self.write("bad.g2o", SQUARE + "EDGE_SE2 3 9 nan 0 0 1 0 0 1 0 1\n")
        self.refused("slam", "bad.g2o", says=["bad.g2o:5: ", "EDGE_SE2 from to x y heading"])
        self.write("apart.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nVERTEX_SE2 2 1 0 0\n" + EDGE.format(0, 1, 0))
        self.refused("slam", "apart.g2o", says=["apart.g2o: ", "falls apart", "node 2"])
        self.write("flat.g2o", "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 0\n")
        self.refused("slam", "flat.g2o", says=["flat.g2o:1: ", "positive definite"])
        self.write("log.dat", "ODOMETRY 0 1 0\nSENSOR 1 inf 0\n")
        self.refused("slam", "log.dat", says=["log.dat:2: ", "'inf'"])
        self.write("what.txt", "hello\n")
        self.refused("slam", "what.txt", says=["what.txt", "no graph"])
        self.write("Robot1_Odometry.dat", "0 1 0\n")
        self.refused("slam", "Robot1_Odometry.dat", says=["Robot1_Measurement.dat"])
        self.write("good.g2o", SQUARE)
        self.refused("slam", "good.g2o", "--graph-kernel", "tukey", says=["tukey", "cauchy"])
        self.write("ok.dat", "ODOMETRY 0 1 0\nSENSOR 1 1 0\n")
        self.refused("slam", "ok.dat", "--slam-engine", "fast", says=["fast", "kalman"])
        self.refused("slam", "ok.dat", "--resume", "what.txt", says=["what.txt", "no state"])
        found = self.run_tool("bench", "slam", "--data", "out")
        self.assertEqual((found.returncode, found.stdout), (2, ""))
        self.assertIn(".g2o", self.sentence(found))

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
        run = self.run_tool("slam", *args, "--json", timeout=900)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.json_of(run)

    def test_laser_log(self):
        log = self.laser_log("intel", 120)
        found = self.mapped(log, "--out", "a")
        self.assertEqual((found["engine"], found["steps"], found["steps_matched"]), ("laser", 120, 119))
        self.assertLess(found["mean_absolute_error_m"], 0.1)
        self.assertLess(found["ate_m"], 0.15)
        self.assertGreater(found["real_time_factor"], 1)
        self.mapped(log, "--out", "b")
        for name in ("track.csv", "slam.svg", "map.yaml", "map.pgm"):
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())
        self.assertEqual(len((self.folder / "a" / "track.csv").read_text().splitlines()), 121)
        path = self.run_tool("plan", "a/map.yaml", "--from", "0,0", "--to", "0.5,0", "--json")
        self.assertEqual(path.returncode, 0, path.stderr)

    def test_whole_laser_logs(self):
        if "OUTRIDER_CASES" not in os.environ:
            self.skipTest("long; set OUTRIDER_CASES")
        for name in ("intel", "aces", "csail", "freiburg-079", "freiburg-101"):
            with self.subTest(name):
                self.assertLess(self.mapped(self.laser_log(name))["mean_absolute_error_m"], 0.1)

    def test_laser_refusals(self):
        self.write("bad.log", "PARAM a b\nFLASER 2 1 x 0 0 0 0 0 0 0 h 0\n")
        self.refused("slam", "bad.log", says=["bad.log:2: ", "'x'", "FLASER n r1"])
        self.write("none.log", "ODOM 0 0 0 0 0 0 0 h 0\n")
        self.refused("slam", "none.log", says=["none.log: ", "no scan"])
        self.write("nan.log", "FLASER 0 0 0 0 0 0 0 0 h 0\nFLASER 2 nan nan 0 0 0 0 0 0 1 h 1\n")
        self.assertEqual(self.mapped("nan.log", "--out", "out")["steps_matched"], 0)

    def test_published(self):
        folder = DATA / "slam"
        if not folder.exists():
            self.skipTest(f"{folder} is absent; set OUTRIDER_DATA")
        self.assertAlmostEqual(self.result(folder / "posegraph" / "intel.g2o.gz")["cost"], 44.417808, delta=0.004)
        found = self.result(folder / "posegraph" / "CSAIL.g2o.gz", "--graph-measured-frame")
        self.assertAlmostEqual(found["cost"], 40.555129, delta=0.004)
        log = folder / "landmark" / "freiburg_ekf" / "sensor_data.dat"
        self.assertLessEqual(self.result(log, "--slam-engine", "ekf")["landmark_rmse_aligned_m"], 0.022)
        self.assertLessEqual(self.result(log)["landmark_rmse_aligned_m"], 0.019)
        log = folder / "landmark" / "mrclam_dataset1" / "Robot1_Odometry.dat.gz"
        self.assertLessEqual(self.result(log, "--slam-engine", "ekf")["landmark_rmse_aligned_m"], 0.087)
        found = self.result(folder / "landmark" / "mrclam5a_multirobot_with_gt.pyfg.gz")
        self.assertLess(found["landmark_rmse_aligned_m"], 0.1)


if __name__ == "__main__":
    main()
