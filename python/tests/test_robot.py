"""Robots and missions written in Python, and worlds."""

import math

import numpy as np
import outrider
import pytest


class RoomRobot:
    """A robot with wheels and a laser in an empty room, which knows nothing of the mission."""

    def __init__(self, size=(3.0, 2.0), pose=(1.0, 1.0, 0.0)):
        self.size, self.start = size, np.array(pose)
        self.pose, self.time = np.array(pose), 0.0

    def sense(self):
        bearings = self.pose[2] + np.arange(180) * 2 * math.pi / 180
        c, s = np.cos(bearings), np.sin(bearings)
        with np.errstate(divide="ignore"):
            across = np.where(c > 0, self.size[0] - self.pose[0], -self.pose[0]) / np.where(c == 0, 1e-12, c)
            along = np.where(s > 0, self.size[1] - self.pose[1], -self.pose[1]) / np.where(s == 0, 1e-12, s)
        scan = outrider.LaserScan(np.minimum(across, along), first=0.0, step=2 * math.pi / 180, least=0.05, most=3.5,
                                  time=self.time)
        return outrider.Observation(time=self.time, odometry=self.pose - self.start, scan=scan)

    def act(self, command):
        steps = 10
        dt = max(command.until - self.time, 0.0) / steps
        for _ in range(steps):
            self.pose = self.pose + dt * np.array([command.ahead * math.cos(self.pose[2]),
                                                   command.ahead * math.sin(self.pose[2]), command.turn])
        self.time = command.until


def test_a_python_robot_explores_a_room():
    mission = outrider.ExploreMission((1.0, 1.0, 0.0))
    robot = RoomRobot()
    assert outrider.run_mission(mission, robot, most_steps=4000) > 0
    assert mission.stop_reason == "complete" and mission.home, mission.reason
    assert np.hypot(*(robot.pose - robot.start)[:2]) < 0.3
    np.testing.assert_allclose(mission.pose[:2], robot.pose[:2], atol=0.1)
    grid = mission.map
    assert (grid.cells == 0).sum() * grid.resolution**2 == pytest.approx(6.0, rel=0.1)


class Driver:
    """Follows pieces at once."""

    def __init__(self):
        self.time, self.way = 0.0, []

    def sense(self):
        self.time += 1.0
        return outrider.Observation(time=self.time, odometry=(0, 0, 0))

    def act(self, command):
        self.way.append((command.from_point, command.to_point))


def test_a_python_robot_drives_a_coverage():
    problem = outrider.CoverProblem([(0, 0), (2, 0), (2, 2), (0, 2)], width=0.4)
    plan = outrider.CoverPlanner("boustrophedon").plan(problem)
    robot = Driver()
    count = outrider.run_mission(outrider.CoverMission(plan), robot)
    assert count == len(robot.way)
    assert all(a[1] == pytest.approx(b[0]) for a, b in zip(robot.way, robot.way[1:]))


class Circle:
    """A mission in Python."""

    def step(self, observation):
        return outrider.DriveTwist(ahead=0.1, turn=0.1, until=observation.time + 1) if observation.time < 5 else None


def test_a_mission_may_be_python_too():
    robot = RoomRobot()
    assert outrider.run_mission(Circle(), robot) == 5 and robot.time == 5.0
    assert outrider.run_mission(Circle(), RoomRobot(), most_steps=2) == 2


@pytest.mark.parametrize("method, failure, words", [
    ("sense", lambda *_: 1 / 0, "Thrower.sense.. failed: ZeroDivisionError: division by zero"),
    ("act", lambda *_: [][1], "Thrower.act.. failed: IndexError"),
    ("sense", lambda *_: "blind", "Thrower.sense.. gave str, which is no Observation"),
    ("sense", lambda *_: outrider.Observation(time=math.nan, odometry=(0, 0, 0)), "nan is no time"),
])
def test_a_robot_that_fails_is_an_exception_with_its_cause(method, failure, words):
    robot = type("Thrower", (RoomRobot,), {method: failure})()
    with pytest.raises(outrider.RobotFailed, match=words) as failed:
        outrider.run_mission(Circle(), robot)
    if "gave" not in words:
        assert failed.value.__cause__ is not None


def test_a_mission_that_fails_is_an_exception():
    with pytest.raises(outrider.RobotFailed, match="int, which is no command"):
        outrider.run_mission(type("Odd", (), {"step": lambda *_: 7})(), RoomRobot())
    with pytest.raises(outrider.RobotFailed, match="has no attribute 'step'"):
        outrider.run_mission(object(), RoomRobot())


def test_an_interrupt_is_no_failure_of_the_robot():
    def interrupted(*_):
        raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt):
        outrider.run_mission(Circle(), type("Stopped", (RoomRobot,), {"act": interrupted})())


def test_worlds_are_arrays():
    world = outrider.World.load("scenarios/yard/yard.sdf")
    solids = world.solids
    assert solids["bounds"].shape == (len(solids["name"]), 2, 3) and "box" in solids["kind"]
    (low, high) = world.bounds
    points = np.random.default_rng(1).uniform(low, high, size=(300, 2))
    clearances = world.clearances(points)
    ground = world.grid(0.2, resolution=0.1)
    columns, rows = ((points - ground.origin) / ground.resolution).astype(int).T
    free = (ground.marks[rows, columns] & 1) == 0
    assert (clearances[free] >= 0.2 - 1e-9).all() and (clearances[~free] <= 0.2 + 0.15).all()
    assert free.any() and not free.all() and world.outlines()
    with pytest.raises(outrider.BadInput, match="none.sdf"):
        outrider.World.load("none.sdf")
    with pytest.raises(outrider.BadInput):
        world.grid(0.2, resolution=1e-9)
