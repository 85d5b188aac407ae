"""`outrider slam` and `bench slam` on small files and, where it is, on published data."""
import math

from mcap_log import xyz
from slam_case import SlamCase, path_of
from tool import DATA, SOURCE, flat, main

EDGE = "EDGE_SE2 {} {} 1 0 {} 100 0 0 100 0 400\n"
SQUARE = "".join(EDGE.format(i, (i + 1) % 4, math.pi / 2 + 0.02 * i) for i in range(4))
UNIT3 = "4 0 0 0 0 0 4 0 0 0 0 4 0 0 0 9 0 0 9 0 9"
SPACE = "".join(f"EDGE_SE3:QUAT {i} {(i + 1) % 4} 1 0 {0.1 * i} 0 0 0.7 0.71414284285 {UNIT3}\n" for i in range(4))


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


class Slam(SlamCase):
    def test_log_of_landmarks(self):
        log, world = freiburg_log()
        self.write("log.dat", log)
        self.write("world.dat", world)
        for engine in ("ekf", "graph"):
            found = self.result("log.dat", "--slam-engine", engine, "--out", engine)
            log = self.check_log(found, engine, self.rows(engine)[1:])
            self.assertEqual([time for time, _ in log.read("/belief")], [round(0.1 * i, 6) for i in range(16)])
            landmarks = log.latest("/landmarks").landmarks
            self.assertEqual([one.id for one in landmarks], [1, 2])
            for one in landmarks:
                self.assertLess(math.dist(xyz(one.position), xyz(one.truth)), 1e-5)
                self.assertEqual((one.first_seen, one.sightings), (0.1, 16 if engine == "graph" else 15))
            self.assertEqual([time for time, _ in log.read("/rosout")], [0.1, 0.1])
            sightings = log.read("/sightings")
            self.assertEqual((len(sightings), len(sightings[0][1].points)), (16, 2))
            self.assertEqual(log.of("/map"), [])

    def test_log_of_a_graph(self):
        found = self.result(SOURCE / "scenarios/slam/yard.g2o", "--out", "out")
        log = self.check_log(found, "out", [pose for i, pose in enumerate(self.rows("out")) if i < 25])
        landmarks = log.latest("/landmarks").landmarks
        self.assertEqual([one.id for one in landmarks], [100, 101, 102])
        edges = [line.split() for line in (SOURCE / "scenarios/slam/yard.g2o").read_text().splitlines() if line.startswith("EDGE")]
        ends = [tuple(map(int, edge[1:3])) for edge in edges if edge[0] == "EDGE_SE2"]
        loops = sorted(0.1 * max(a, b) for a, b in ends if abs(a - b) > 1)
        self.assertEqual([round(loop.closed, 6) for loop in log.latest("/loops").loops], [round(t, 6) for t in loops])
        for one in landmarks:
            self.assertEqual(one.sightings, sum(edge[2] == str(one.id) for edge in edges))
        self.assertEqual(log.of("/robot_2/trajectory"), [])
        text = self.run_tool("replay", "out", "--svg", "moving.svg")
        self.assertEqual(text.returncode, 0, text.stderr)
        self.assertIn("yard: ", text.stdout)
        self.assertIn("landmarks  3\n", text.stdout)
        self.assertIn("settled track", (self.folder / "moving.svg").read_text())
        again = self.json_of(self.run_tool("replay", "out", "--json"))
        self.assertEqual((again["job"], again["metrics"]["cost"]), ("slam", found["cost"]))

    def test_several_robots_are_not_joined(self):
        """Two ways through one graph: no leg leads from the end of the one to the start of the other."""
        away = "".join(EDGE.format(i, i + 1, 0) for i in range(10, 13))
        self.write("two.g2o", "".join(EDGE.format(i, i + 1, 0) for i in range(5)) + away +
                   "EDGE_SE2 2 11 0 8 0 100 0 0 100 0 400\nEDGE_SE2 3 12 0 8 0 100 0 0 100 0 400\n")
        self.result("two.g2o", "--out", "out")
        log = self.log_of("out")
        ways = [path_of(log.latest(topic)) for topic in ("/trajectory", "/robot_2/trajectory")]
        self.assertEqual([len(way) for way in ways], [6, 4])
        self.assertEqual(log.of("/robot_3/trajectory"), [])
        for way in ways:
            self.assertTrue(all(math.dist(a[1:], b[1:]) < 1.5 for a, b in zip(way, way[1:])))
        self.assertEqual([round(loop.closed, 6) for loop in log.latest("/loops").loops], [0.2, 0.3])

    def test_scenario(self):
        by_file = flat(self.json_of(self.run_tool("run", SOURCE / "scenarios/slam/posts.yaml", "--json", "--out", "a")))
        self.assertEqual((by_file["status"], by_file["landmarks"]), ("done", 16))
        self.assertLess(by_file["landmark_rmse_aligned_m"], 0.05)
        flags = ["--truth", SOURCE / "scenarios/slam/posts_world.dat", "--noise-distance", "0.03",
                 "--noise-turn-per-distance", "2", "--noise-turn", "0.03", "--noise-range", "0.05", "--noise-bearing", "1"]
        self.result(SOURCE / "scenarios/slam/posts.dat", *flags, "--out", "b")
        self.result("--scenario", SOURCE / "scenarios/slam/posts.yaml", "--out", "c")
        for folder in "bc":
            self.assertEqual((self.folder / "a/landmarks.csv").read_bytes(), (self.folder / folder / "landmarks.csv").read_bytes())
        by_flag = self.result(SOURCE / "scenarios/slam/posts.yaml", "--slam-engine", "ekf", "--out", "d")
        self.assertEqual(self.log_of("d").latest("/run").engine, "ekf")

    def test_scenario_refusals(self):
        def refused(text, says, *flags):
            self.write("bad.yaml", text)
            self.refused("run", "bad.yaml", *flags, says=says)
        refused("job: slam\n", ["log", "missing", "name the file"])
        refused("job: slam\nlog: none.g2o\n", ["none.g2o"])
        refused("job: slam\nlogs: x\n", ["bad.yaml:2", "'logs'", "did you mean 'log'"])
        refused("job: slam\nlog: x\nlaser: {reach: -1}\n", ["bad.yaml:3", "laser.reach", "-1"])
        refused("job: slam\nlog: x\nslam: {gates: 1}\n", ["bad.yaml:3", "slam.gates", "'gate'"])
        refused("job: slam\nlog: x\n", ["--perfect-pose", "slam"], "--perfect-pose", "true")
        self.refused("slam", says=["log", "missing"])

    def test_a_file_chooses_what_a_log_would(self):
        """A chain log needs no gate; a gate in the file holds, though it is the usual one."""
        chain = "".join(f"ODOMETRY {i} {i + 1} 1 0 0 0.01 0 0 0.01 0 0.001\nLANDMARK {i + 1} 1 {2 - i} 1 0.01 0 0.01\n" for i in range(6))
        self.write("chain.txt", chain.replace("LANDMARK 4 1 -1 1", "LANDMARK 4 1 9 9"))
        self.write("free.yaml", "job: slam\nlog: chain.txt\n")
        self.write("gated.yaml", "job: slam\nlog: chain.txt\nslam: {gate: 0.9999, patience: 1}\n")
        free = self.doubtful("free.yaml")
        self.assertEqual((free["sightings_refused"], free["reason"][:6]), (0, "errors"))
        self.assertGreater(self.doubtful("gated.yaml")["sightings_refused"], 0)

    def test_graph(self):
        self.write("square.g2o", SQUARE)
        found = self.result("square.g2o", "--out", "out")
        self.assertEqual((found["nodes"], found["edges"]), (4, 4))
        self.assertLess(found["cost"], found["start_cost"] + 1e-9)
        for name in ("track.csv", "graph.g2o", "run.svg"):
            self.assertTrue((self.folder / "out" / name).exists(), name)
        again = self.result("out/graph.g2o", "--graph-start", "given")
        self.assertAlmostEqual(again["start_cost"], found["cost"], places=9)
        self.assertAlmostEqual(again["cost"], found["cost"], places=9)
        self.assertIn("4 nodes, 4 edges", self.run_tool("slam", "square.g2o").stdout)

    def test_graph_in_space(self):
        self.write("space.g2o", SPACE)
        found = self.result("space.g2o", "--out", "out")
        self.assertEqual((found["nodes"], found["edges"], found["loops"]), (4, 4, 1))
        self.assertLessEqual(found["cost_bound"], found["cost"] + 1e-9)
        self.assertIn("<svg", (self.folder / "out" / "run.svg").read_text())
        again = self.result("out/graph.g2o", "--graph-start", "given")
        self.assertAlmostEqual(again["start_cost"], found["cost"], places=9)
        self.write("coupled.g2o", SPACE.replace("4 0 0 0 0 0", "4 0 0 0 0 9", 1))
        self.refused("slam", "coupled.g2o", says=["coupled.g2o:1: ", "not positive definite", "diagonal"])
        self.result("coupled.g2o", "--graph-information", "isotropic")
        self.refused("slam", "space.g2o", "--graph-information", "some", says=["'some'", "isotropic"])

    def test_false_edges(self):
        """Three rounds of a square with a false edge: doubtful, or found and refused."""
        lines = []
        for i in range(1, 25):
            lines.append(f"EDGE_SE2 {i - 1} {i} 1 0 {math.pi / 2 if i % 2 else 0} 400 0 0 400 0 2500")
            if i >= 8:
                lines.append(f"EDGE_SE2 {i - 8} {i} 0.01 0 0 400 0 0 400 0 2500")
        self.write("false.g2o", "\n".join([*lines, "EDGE_SE2 3 20 5 5 1 400 0 0 400 0 2500"]) + "\n")
        run = self.run_tool("slam", "false.g2o", "--json")
        found = self.json_of(run)
        self.assertEqual((run.returncode, found["status"]), (1, "doubtful"), found)
        self.assertIn("edge from 3 to 20 contradicts", found["reason"])
        found = self.result("false.g2o", "--graph-robust", "gnc", "--out", "out")
        self.assertEqual(found["edges_refused"], 1)
        kept = self.result_of("out")["refused_edges"]
        self.assertEqual([(row["from"], row["to"]) for row in kept], [("3", "20")])
        self.refused("slam", "false.g2o", "--graph-robust", "sometimes", says=["'sometimes'", "gnc"])

    def test_example(self):
        found = self.result(SOURCE / "scenarios" / "slam" / "yard.g2o", "--out", "out")
        self.assertEqual(found["nodes"], 28)
        self.assertIn('class="landmark', (self.folder / "out" / "run.svg").read_text())

    def test_landmarks(self):
        log, world = freiburg_log()
        self.write("log.dat", log)
        self.write("world.dat", world)
        for engine in ("kalman", "ekf", "graph"):
            found = self.result("log.dat", "--slam-engine", engine, "--out", engine)
            self.assertEqual((found["steps"], found["landmarks"]), (16, 2))
            self.assertLess(found["landmark_rmse_m"], 1e-6)
            self.assertIn('class="landmark', (self.folder / engine / "run.svg").read_text())
        self.assertEqual(len((self.folder / "ekf" / "track.csv").read_text().splitlines()), 18)
        self.assertEqual((self.folder / "graph" / "landmarks.csv").read_text().splitlines()[0],
                         "id,x,y,xx,xy,yy,sightings")

    def test_a_carried_robot_is_doubtful(self):
        """Its odometry knows nothing of the 3 m by which it was carried half-way."""
        log, _ = freiburg_log()
        lines = log.splitlines()
        half = len(lines) // 2 // 3 * 3
        for i, line in enumerate(lines[half:], half):
            if line.startswith("SENSOR"):
                number, distance, bearing = map(float, line.split()[1:])
                lines[i] = f"SENSOR {number:.0f} {distance + 3.0} {bearing}"
        self.write("log.dat", "\n".join(lines) + "\n")
        for engine in ("kalman", "ekf", "graph"):
            found = self.doubtful("log.dat", "--slam-engine", engine, "--slam-lost-after", "3")
            self.assertGreater(found["steps_lost"], 0)
            self.assertIn("the robot was lost in", found["reason"])
            self.assertIn("sightings of the map contradict it", found["reason"])

    def test_errors_beyond_the_stated_noise_are_doubtful(self):
        """Ranges are off by 5 cm to and fro, and the options speak of 1 cm."""
        log, _ = freiburg_log()
        lines = log.splitlines()
        for i, line in enumerate(lines):
            if line.startswith("SENSOR"):
                number, distance, bearing = map(float, line.split()[1:])
                lines[i] = f"SENSOR {number:.0f} {distance + (0.05 if i // 3 % 2 else -0.05)} {bearing}"
        self.write("log.dat", "\n".join(lines) + "\n")
        noise = ("--noise-range", "0.01", "--slam-gate", "1")
        for engine in ("kalman", "ekf", "graph"):
            found = self.doubtful("log.dat", "--slam-engine", engine, *noise)
            self.assertIn("times as large as the noise options say", found["reason"])
            self.assertGreater(found["chi2_per_dof"], 4)
            self.result("log.dat", "--slam-engine", engine, "--noise-range", "0.05", "--slam-gate", "1")

    def test_landmarks_without_ids(self):
        """Without ids, MR.CLAM has places in the map twice: doubtful. The log of Freiburg is mapped right."""
        folder = DATA / "slam" / "landmark"
        if not folder.exists():
            self.skipTest(f"{folder} is absent; set OUTRIDER_DATA")
        flags = ("--slam-engine", "ekf", "--slam-unknown-ids")
        found = self.result(folder / "freiburg_ekf" / "sensor_data.dat", *flags)
        self.assertEqual((found["landmarks"], found["landmarks_moved"]), (9, 0))
        for robot in (1, 3):
            log = folder / "mrclam_dataset1" / f"Robot{robot}_Odometry.dat.gz"
            for patience in ("2", "5"):
                found = self.doubtful(log, *flags, "--slam-patience", patience, "--out", f"{robot}-{patience}")
                self.assertGreater(found["landmarks"], 15, "else nothing is wrong with it")
                self.assertEqual((found["steps_lost"], found["chi2_per_dof"] < 4), (0, True), "nothing else tells")
                self.assertRegex(found["reason"], r"moved \d+ of \d+ landmarks farther .* landmark \d+ at x .* since .* s")
                doubts = [one for _, one in self.log_of(f"{robot}-{patience}").read("/rosout") if one.name == "doubt"]
                self.assertEqual(len(doubts), found["landmarks_moved"])

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
        for name in ("run.json", "run.mcap", "track.csv", "landmarks.csv", "state.txt", "run.svg"):
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

    def test_faults(self):
        """Faults of a recording that spoil the map are not done, those that do not are; the same seed, the same run."""
        folder = SOURCE / "scenarios/slam"
        doubts = {
            "posts": {"bias": 0.12, "kidnapped_at": 12, "frozen_from": 5, "latency": 0.5, "wrong_ids": 0.3, "slip": 0.3},
            "yard": {"bias": 0.17, "outliers": 0.3, "slip": 0.2, "wrong_ids": 0.2},
            "office": {"bias": 0.2, "outliers": 0.1, "frozen_from": 100, "blind_from": 200},
        }
        for name, faults in doubts.items():
            for key, value in faults.items():
                found = self.doubtful(folder / f"{name}.yaml", f"--faults-{key.replace('_', '-')}", value)
                self.assertGreater(found["changes"], 0, key)
                self.assertEqual(found["false_done"], 0, key)
        for name, key, value in (("posts", "missed", 0.5), ("posts", "blind_from", 20), ("office", "missed", 0.3), ("office", "slip", 0.1)):
            found = self.done(folder / f"{name}.yaml", f"--faults-{key.replace('_', '-')}", value, "--seed", 3)
            self.assertGreater(found["changes"], 0, key)
            self.assertEqual(found["wrong"], 0, key)
        self.assertNotIn("changes", self.done(folder / "posts.yaml"))
        one, same, other = (self.doubtful(folder / "posts.yaml", "--faults-outliers", 0.2, "--seed", seed)["cost"] for seed in (1, 1, 2))
        self.assertEqual(one, same)
        self.assertNotEqual(one, other)
        pairs = {"yard": ({"slip": 0.06, "bias": 0.17}, {"slip": 0.03, "bias": 0.19}, {"range_scale": 0.95, "bias": -0.09},
                          {"range_scale": 1.07, "bias": -0.05}, {"range_scale": 0.945}),
                 "posts": ({"missed": 0.8, "slip": 0.1}, {"missed": 0.7, "bias": 0.2}, {"missed": 0.7, "range_scale": 0.92},
                           {"range_scale": 0.935, "bias": -0.013}, {"range_scale": 0.9})}
        for name, some in pairs.items():
            for faults in some:
                flags = [word for key, value in faults.items() for word in (f"--faults-{key.replace('_', '-')}", value)]
                self.doubtful(folder / f"{name}.yaml", *flags)
        for name, key, word in (("yard", "latency", "no times"), ("office", "wrong_ids", "have no ids")):
            refused = self.run_tool("run", folder / f"{name}.yaml", f"--faults-{key.replace('_', '-')}", "0.1")
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f"faults.{key}", refused.stderr)
            self.assertIn(word, refused.stderr)

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
        self.assertIn("the robot was lost", self.doubtful(log, "--slam-engine", "kalman")["reason"])
        found = self.result(folder / "landmark" / "mrclam5a_multirobot_with_gt.pyfg.gz")
        self.assertLess(found["landmark_rmse_aligned_m"], 0.1)


if __name__ == "__main__":
    main()
