"""Missions of jobs with their robot in another process, and the jobs whose robot cannot be there.

    run_test.py OUTRIDER SOURCES
"""
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest

TOOL, SOURCES = sys.argv.pop(1), sys.argv.pop(1)


def scenario(name):
    return os.path.join(SOURCES, "scenarios", name)


class Run(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        os.environ["ROS_DOMAIN_ID"] = str(60 + os.getpid() % 10)

    def tearDown(self):
        self.folder.cleanup()

    def run_mission(self, file, robot, *words):
        """Returns the exit status of the mission, what it said, and what the robot said in the end."""
        with open(os.path.join(self.folder.name, "sim"), "w+", encoding="utf-8") as said:
            sim = subprocess.Popen([TOOL, "ros", "sim", scenario(file)] + robot, stdout=said, stderr=said)
            time.sleep(1)
            try:
                run = subprocess.run([TOOL, "ros", "run", scenario(file), "--sim-time"] + list(words),
                                     capture_output=True, text=True, timeout=400)
            finally:
                sim.terminate()
                sim.wait(timeout=20)
            said.seek(0)
            return run.returncode, run.stderr, said.read()

    def test_drive_to_waypoints_by_tags(self):
        status, said, robot = self.run_mission("waypoints/closed_loop.yaml", ["--rate", "2"])
        self.assertEqual(status, 0, said)
        off_m = float(re.search(r"is ([\d.]+) m from its last waypoint", robot).group(1))
        self.assertLess(off_m, 0.05, robot)

    def test_guard_a_yard_with_a_gun(self):
        status, said, robot = self.run_mission("yard/yard.yaml", ["--rate", "2", "--delay", "0.05"])
        self.assertEqual(status, 0, said)
        self.assertIn("done: 23 of 24 targets are told to be hit", said)
        found = re.search(r"(\d+) contacts; (\d+) of 24 targets were hit", robot.splitlines()[-1])
        self.assertEqual(found.groups(), ("0", "23"), robot)

    def test_explore_in_a_namespace(self):
        status, said, robot = self.run_mission("explore/office.yaml", ["--rate", "3", "--ns", "robot_1"], "--ns", "robot_1")
        last = said.strip().splitlines()[-1]
        self.assertRegex(last, r"(complete: |left_over: .*because: too narrow \(\d+ places?, [^;]*\); the robot)", said)
        self.assertEqual(status, 0 if "complete: " in last else 1)
        found = re.search(r"(\d+) contacts; the robot is ([\d.]+) m from its start", robot)
        self.assertEqual(found.group(1), "0", robot)
        self.assertLess(float(found.group(2)), 0.3, robot)

    def test_jobs_without_a_robot_behind_topics_are_told_why(self):
        for file, job, why in [("fleet/warehouse.yaml", "fleet", "give each robot a planner and a follower"),
                               ("slam/office.yaml", "slam", "`outrider ros mapper` does with scans"),
                               ("terrain/terrain.yaml", "plan", "`outrider ros planner` plans paths")]:
            with self.subTest(job):
                run = subprocess.run([TOOL, "ros", "run", scenario(file)], capture_output=True, text=True, timeout=60)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn(f"the job {job} cannot have its robot behind topics", run.stderr)
                self.assertIn(why, run.stderr)


if __name__ == "__main__":
    unittest.main()
