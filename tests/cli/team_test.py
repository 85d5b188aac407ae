"""Several robots that share the targets of a yard, from the command line."""
import math
import unittest

from mcap_log import xyz
from tool import SOURCE, ToolTest, main
from well_logged import well_logged


def places_of(log, topic):
    """Times and places of a robot."""
    return [(time, xyz(pose.pose.position)[:2]) for time, pose in log.read(topic)]


def place_at(places, time):
    """Between two poses a robot drives straight; after the last it stands."""
    after = next((i for i, (t, _) in enumerate(places) if t > time), None)
    if after is None:
        return places[-1][1]
    if after == 0:
        return places[0][1]
    (a, p), (b, q) = places[after - 1], places[after]
    share = (time - a) / (b - a)
    return tuple(p[k] + share * (q[k] - p[k]) for k in range(2))


class Team(ToolTest):
    def run_of(self, *args, out="out"):
        result = self.run_tool(*self.guard(*args, "--out", out))
        self.assertIn(result.returncode, [0, 1], result.stderr)
        return self.result_of(out), self.log_of(out), result.stdout

    def check(self, report, log, robots, radius=0.26):
        """Each reached target was hit by a ball, and no two bodies ever overlap."""
        self.assertEqual([row["robot"] for row in report["robots"]], list(range(1, robots + 1)))
        hit = {shot.target for _, shot in log.read("/shots") if shot.hit}
        for target in report["targets"]:
            self.assertEqual(target["status"] == "reached", target["name"] in hit)
            self.assertIn(target["robot"], range(1, robots + 1))
        ways = [places_of(log, "/pose")] + [places_of(log, f"/robot_{r}/pose") for r in range(2, robots + 1)]
        nearest = math.inf
        for i, one in enumerate(ways):
            for other in ways[i + 1:]:
                for time in [step * 0.05 for step in range(int(20 * report["metrics"]["mission_s"]) + 2)]:
                    nearest = min(nearest, math.dist(place_at(one, time), place_at(other, time)))
        self.assertGreaterEqual(nearest, 2 * radius)
        self.assertAlmostEqual(nearest, report["metrics"]["closest_m"], delta=0.06)
        for row, way in zip(report["robots"], ways):
            driven = sum(math.dist(p, q) for (_, p), (_, q) in zip(way, way[1:]))
            self.assertAlmostEqual(driven, row["driven_m"], delta=1e-3)
            self.assertAlmostEqual(way[-1][0], report["metrics"]["mission_s"], delta=1e-8)
            for time, place in way:
                self.assertTrue(time < row["time_s"] - 1e-8 or place == way[-1][1], "who is done stands")
        self.assertEqual(max(row["time_s"] for row in report["robots"]), report["metrics"]["mission_s"])

    def test_two_and_three_robots_share_the_targets(self):
        alone, _, _ = self.run_of(out="alone")
        for robots in (2, 3):
            with self.subTest(robots=robots):
                report, log, said = self.run_of("--robots", robots, out=f"team{robots}")
                self.assertEqual(report["status"], "done", report["reason"])
                metrics = report["metrics"]
                self.assertEqual((metrics["robots"], metrics["reached"]), (robots, 3))
                self.assertLessEqual(metrics["planned_s"], metrics["alone_s"] + 1e-9)
                self.assertLessEqual(metrics["lower_bound_s"], metrics["planned_s"] + 1e-9)
                self.assertAlmostEqual(metrics["alone_s"], alone["metrics"]["planned_s"], places=9)
                self.check(report, log, robots)
                self.assertIn(f"robot {robots}: ", said)
                events = [event.msg for _, event in log.read("/rosout")]
                self.assertTrue(any("chosen beside robot 1" in text for text in events), events[:5])
                self.run_of("--robots", robots, "--threads", "1", out="again")
                self.same_run(f"team{robots}", "again")

    def test_starts_that_are_given(self):
        report, log, _ = self.run_of("--robots", "2", "--robot-starts", "2,-2,180")
        self.assertEqual(report["status"], "done", report["reason"])
        second = report["robots"][1]
        self.assertEqual((second["start_x"], second["start_y"]), (2, -2))
        self.assertAlmostEqual(abs(second["start_heading_rad"]), math.pi)
        self.check(report, log, 2)
        self.assertFalse(any("chosen" in event.msg for _, event in log.read("/rosout")))

    def test_what_combines(self):
        for flags in (["--air-drag", "0.03"], ["--targets-block"], ["--faults-position", "1.2"],
                      ["--plan-shoot-on-the-move=false"]):
            with self.subTest(flags=flags):
                report, log, _ = self.run_of("--robots", "2", *flags, out="-".join(["c", *flags]))
                self.assertIn(report["status"], ["done", "not_done"])
                self.assertEqual(report["status"] == "not_done", report["reason"] != "" and report["metrics"]["reached"] < 3)
                self.check(report, log, 2)

    def test_the_example(self):
        result = self.run_tool("run", SOURCE / "scenarios/yard/two_robots.yaml", "--plan-resolution", "0.2", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        well_logged(self, "out")
        report = self.result_of("out")
        metrics = report["metrics"]
        self.assertEqual((report["status"], metrics["robots"], metrics["reached"], metrics["given_up"]), ("done", 2, 23, 0))
        self.assertLess(metrics["mission_s"], 0.6 * metrics["alone_s"])
        self.check(report, self.log_of("out"), 2)

    def test_starts_that_are_refused(self):
        for starts, words in [("2,-2,0;2,2,0", ["2 starts for 2 robots", "give 1 or none"]),
                              ("2,-2", ["'2,-2' is not valid", "x,y,heading"]), ("nan,0,0", ["'nan,0,0' is not valid"]),
                              ("1,1,0", ["robot 2 at 1.00,1.00", "give another start"]),
                              ("9,9,0", ["robot 2 at 9.00,9.00", "give another start"]),
                              ("0.3,-2,0", ["robots 1 and 2 start 0.30 m apart", "at least 0.74 m apart"])]:
            with self.subTest(starts=starts):
                self.refused(*self.guard("--robots", "2", "--robot-starts", starts), says=["robot_starts", *words])
        self.refused(*self.guard("--robot-starts", "2,-2,0"), says=["robot_starts", "leave robot_starts out or set robots"])
        for robots in ("0", "6", "two", "1.5"):
            self.refused(*self.guard("--robots", robots), says=["--robots", "from 1 to 5"])

    def test_what_does_not_combine_is_refused(self):
        for flags, words in [(["--plan-prove"], ["plan.prove", "leave out robots"]),
                             (["--plan-planner", "tuor"], ["tuor"]),
                             (["--supplies-tank", "3", "--supplies-stations", "well=2,-2,water"], ["robots", "supplies", "stations"]),
                             (["--arrivals-leave", "0.5"], ["robots", "arrivals.leave", "shared out once"]),
                             (["--wander-speed", "0.3"], ["robots", "wander.speed"]),
                             (["--unknown"], ["robots", "scout.unknown", "explores"]),
                             (["--sim", "physics", "--plan-shoot-on-the-move=false"], ["robots", "sim", "one robot"])]:
            with self.subTest(flags=flags):
                self.refused(*self.guard("--robots", "2", *flags), says=words)


if __name__ == "__main__":
    main()
