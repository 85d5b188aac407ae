"""Shooting while driving, from the command line."""
import math
import unittest

from mcap_log import xyz
from tool import PAGE, SOURCE, ToolTest, main
from well_logged import well_logged

LANE = SOURCE / "scenarios" / "driveby" / "driveby.yaml"
QUICK = ["--plan-resolution", "0.2", "--plan-iterations", "200", "--plan-stops", "100"]


def place_at(log, time):
    """Place and velocity of the robot by its poses."""
    track = [(at, pose.pose.position.x, pose.pose.position.y) for at, pose in log.read("/pose")]
    for a, b in zip(track, track[1:]):
        if a[0] < b[0] and b[0] >= time:
            velocity = [(b[k] - a[k]) / (b[0] - a[0]) for k in (1, 2)]
            return [a[k + 1] + (time - a[0]) * velocity[k] for k in range(2)], velocity
    raise ValueError(time)


class DriveBy(ToolTest):
    def run_of(self, *args, out="out"):
        """The metrics and the log of a run."""
        result = self.run_tool(*args, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.result_of(out)["metrics"], self.log_of(out)

    def test_the_lane(self):
        metrics, log = self.run_of("run", LANE, *QUICK, *PAGE)
        well_logged(self, "out")
        self.assertEqual(metrics["reached"], metrics["targets"])
        passing = [shot for _, shot in log.read("/shots") if shot.platform_velocity.x or shot.platform_velocity.y]
        self.assertGreaterEqual(len(passing), 4)
        self.assertEqual(metrics["shots_in_passing"], len(passing))
        self.assertEqual(metrics["hits_in_passing"], sum(shot.hit for shot in passing))
        self.assertLessEqual(metrics["lower_bound_s"], metrics["planned_s"])
        standing, _ = self.run_of("run", LANE, *QUICK, "--plan-shoot-on-the-move=false", out="standing")
        self.assertLess(metrics["planned_s"], standing["planned_s"])
        self.assertLess(metrics["mission_s"], standing["mission_s"])

    def test_flights_begin_at_the_robot_that_drives(self):
        _, log = self.run_of("run", LANE, *QUICK)
        gravity = log.latest("/run").gravity
        for time, shot in log.read("/shots"):
            place, velocity = place_at(log, time)
            platform, muzzle, leaves = xyz(shot.platform_velocity), xyz(shot.muzzle), xyz(shot.velocity)
            self.assertLess(math.dist(platform, velocity), 0.05)
            tip = [muzzle[k] - place[k] for k in range(2)]
            along = [leaves[k] - platform[k] for k in range(2)]
            self.assertAlmostEqual(tip[0] * along[1], tip[1] * along[0], delta=5e-5)
            # The flight, by its closed form, ends where the log says.
            t = shot.flight
            end = [muzzle[k] + t * leaves[k] - (0.5 * gravity * t * t if k == 2 else 0) for k in range(3)]
            self.assertLess(math.dist(end, xyz(shot.contact_point)), 1e-6)

    def test_the_same_bytes_with_one_thread_and_two(self):
        for threads in ["1", "2"]:
            self.run_of("run", LANE, *QUICK, "--threads", threads, out=threads)
        self.same_run("1", "2")

    def test_proven_tours_shoot_from_rest(self):
        metrics, log = self.run_of("run", LANE, *QUICK, "--plan-prove", out="proven")
        self.assertNotIn("shots_in_passing", metrics)
        self.assertFalse(any(shot.platform_velocity.x or shot.platform_velocity.y
                             for _, shot in log.read("/shots")))

    def test_rigid_bodies_shoot_on_the_move(self):
        if self.run_tool(*self.guard("--sim", "physics")).returncode == 2:
            self.skipTest("this build has no physics engine")
        metrics, _ = self.run_of("run", LANE, *QUICK, "--sim", "physics", out="rigid")
        self.assertGreater(metrics["shots_in_passing"], 0)
        self.assertEqual(metrics["hits_in_passing"], metrics["shots_in_passing"])

    def test_a_bad_error_is_refused(self):
        self.refused("run", LANE, "--errors-timing", "-1", "--out", "out",
                     says=["--errors-timing", "'-1'", "from 0 to 1"])


if __name__ == "__main__":
    main()
