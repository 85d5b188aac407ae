"""Robots in Python guard and drive, or fail, and the mission says so; a robot of any mission may throw."""

import math

import numpy as np
import outrider
import pytest
from test_pursuing import Team, chase


COARSE = {"plan.resolution": 0.2, "plan.iterations": 100, "plan.stops": 60}  # what matters here is not the plan


@pytest.fixture(name="lane", scope="module")
def _lane():
    """A lane between hedges with few targets, whose gun does not err."""
    keys = outrider.jobs()["guard"]["options"]
    return "scenarios/driveby/driveby.yaml", COARSE | {key: 0 for key in keys if key.startswith("errors.")}


class Gardener:
    """A robot with a water gun that errs in nothing."""

    hits = True

    def __init__(self, mission):
        self.pose, self.time, self.gun = np.array(mission.start), 0.0, (0.0, 0.0)
        self.shots, self.driven, self.fired, self.levels = [], 0.0, 0, None
        self.stations = mission.stations

    def sense(self):
        shots, self.shots = self.shots, []
        return outrider.Observation(time=self.time, odometry=self.pose, gun=self.gun, shots=shots, stores=self.levels)

    def shoot(self, target):
        self.fired += 1
        self.shots.append(outrider.ShotResult(target=target, hit=self.hits, landed=self.time))
        if self.levels:
            self.levels = outrider.StoreLevels(water=self.levels.water - 1, charge=self.levels.charge)

    def act(self, command):
        self.time += 1.0
        match command:
            case outrider.FollowWaypoints():
                assert command.waypoints[0] == pytest.approx(self.pose[:2], abs=1e-6)
                for a, b in zip(command.waypoints, command.waypoints[1:]):
                    self.driven += math.dist(a, b)
                    self.pose = np.array([*b, math.atan2(*(b - a)[::-1])])
                for shot in command.shots:
                    self.shoot(shot.target)
            case outrider.AimGun():
                self.gun = (command.yaw - self.pose[2], command.pitch)
            case outrider.Fire():
                self.shoot(command.target)
            case outrider.Fill():
                station = self.stations[command.station]
                assert station[command.store] and math.dist(station["position"], self.pose[:2]) < 1e-6
                self.levels = outrider.StoreLevels(water=2, charge=self.levels.charge)
            case outrider.Wait():
                self.time = max(self.time, min(command.until, self.time + 60))


def test_a_robot_guards_as_the_simulated_one_does(lane):
    scenario, exact = lane
    mission = outrider.GuardMission(scenario, set=exact)
    assert mission.status == "" and {one["status"] for one in mission.targets} == {"waiting"}
    robot = Gardener(mission)
    outrider.run_mission(mission, robot)
    assert mission.status == "done" and mission.reason == ""
    run = outrider.run(scenario, set=exact)
    assert (run.status, len(mission.targets)) == ("done", run.metrics["targets"])
    assert robot.driven == pytest.approx(run.metrics["driven_m"], abs=1e-6)
    assert robot.fired == run.metrics["shots"]
    assert mission.cost == run.metrics["planned_s"] >= mission.lower_bound == run.metrics["lower_bound_s"]
    assert mission.step(robot.sense()) is None


def test_a_robot_with_a_small_tank_fills_it(lane):
    scenario, exact = lane
    mission = outrider.GuardMission(scenario, set=exact | {"plan.shoot_on_the_move": False, "supplies.tank": 2,
                                                           "supplies.stations": "well=-11,0,water"})
    robot = Gardener(mission)
    robot.levels = outrider.StoreLevels(water=2)
    outrider.run_mission(mission, robot)
    assert mission.status == "done" and robot.fired == len(mission.targets) > 2
    with pytest.raises(outrider.BadInput, match="StoreLevels"):
        again = outrider.GuardMission(scenario, set={"plan.shoot_on_the_move": False, "supplies.tank": 2})
        outrider.run_mission(again, Gardener(again))


class Watchman(Gardener):
    """Tells of intruders as the scenario says."""

    def __init__(self, mission):
        super().__init__(mission)
        self.to_come = list(enumerate(mission.intruders))

    def sense(self):
        seen = super().sense()
        come = [pair for pair in self.to_come if pair[1]["enters"] <= self.time]
        self.to_come = self.to_come[len(come):]
        report = outrider.TargetReport(more_to_come=bool(self.to_come), arrivals=[
            outrider.TargetArrival(target=i, place=who["place"], settles=who["settles"]) for i, who in come])
        return outrider.Observation(time=seen.time, odometry=seen.odometry, gun=seen.gun, shots=seen.shots, targets=report)

    def act(self, command):
        super().act(command)
        if isinstance(command, outrider.Wait) and self.to_come:
            self.time = min(command.until, max(self.time, self.to_come[0][1]["enters"]))


COMING = {"plan.shoot_on_the_move": False, "arrivals.count": 5, "arrivals.entrances": "gate=-11,0", "arrivals.rate": 0.5}


def test_a_robot_guards_against_intruders_that_come(lane):
    mission = outrider.GuardMission(lane[0], seed=2, set=lane[1] | COMING)
    robot = Watchman(mission)
    assert len(mission.intruders) == 5
    outrider.run_mission(mission, robot, most_steps=500)
    assert mission.status == "done" and robot.fired == 5, mission.reason


class Meadow(Gardener):
    """Sees walkers, all of which stand still in truth."""

    def __init__(self, mission):
        super().__init__(mission)
        self.places = [one["position"] for one in mission.targets]

    def sense(self):
        seen = super().sense()
        report = outrider.TargetReport(seen=[outrider.TargetObservation(target=i, time=self.time, position=place[:2])
                                             for i, place in enumerate(self.places)])
        return outrider.Observation(time=seen.time, odometry=seen.odometry, gun=seen.gun, shots=seen.shots, targets=report)


def test_a_robot_guards_against_walkers():
    mission = outrider.GuardMission("scenarios/wander/wander.yaml")
    outrider.run_mission(mission, Meadow(mission), most_steps=2000)
    assert mission.status == "done", mission.reason


class Blind(Gardener):
    hits = False


class Stuck(Gardener):
    """Never arrives."""

    def act(self, command):
        if isinstance(command, outrider.FollowWaypoints):
            self.time += 1.0
        else:
            super().act(command)


@pytest.mark.parametrize("kind, reason", [(Blind, "missed"), (Stuck, "no shot")])
def test_a_robot_that_cannot_ends_with_the_reason(lane, kind, reason):
    mission = outrider.GuardMission(lane[0], set=lane[1])
    outrider.run_mission(mission, kind(mission), most_steps=2000)
    assert mission.status == "not_done" and "targets reached" in mission.reason
    failed = [one["reason"] for one in mission.targets if one["status"] == "failed"]
    assert failed and any(reason in sentence for sentence in failed), failed


def refused(mission, words, **seen):
    given = {"time": 1.0, "odometry": mission.start, "gun": (0, 0)} | seen
    with pytest.raises(outrider.BadInput, match=words):
        mission.step(outrider.Observation(**given))


def test_what_a_guard_cannot_work_with_is_refused(lane):
    mission = outrider.GuardMission(lane[0], set=lane[1])
    refused(mission, "no gun", gun=None)
    assert mission.step(outrider.Observation(time=5.0, odometry=mission.start, gun=(0, 0))) is not None
    refused(mission, "time goes on")
    mission = outrider.GuardMission(lane[0], set=lane[1] | COMING)
    refused(mission, "TargetReport")
    report = outrider.TargetReport(arrivals=[outrider.TargetArrival(target=99, place=0, settles=1)], more_to_come=True)
    refused(mission, "intruder 99 at place 0: there are 5", targets=report)
    report = outrider.TargetReport(arrivals=[outrider.TargetArrival(target=0, place=0, settles=1)], more_to_come=True)
    mission.step(outrider.Observation(time=1, odometry=mission.start, gun=(0, 0), targets=report))
    refused(mission, "inside already", targets=report)
    with pytest.raises(outrider.BadInput, match="explored first"):
        outrider.GuardMission(lane[0], set={"plan.shoot_on_the_move": False, "scout.unknown": True})
    with pytest.raises(outrider.BadInput, match="robots: a robot that is not simulated and several robots"):
        outrider.GuardMission(lane[0], set={"robots": 2})
    with pytest.raises(outrider.BadInput, match="of the job drive; give one of guard"):
        outrider.GuardMission("scenarios/waypoints/open_loop.yaml")
    walkers = outrider.GuardMission("scenarios/wander/wander.yaml")
    for when in (9.0, 0.5, 0.5):
        report = outrider.TargetReport(seen=[outrider.TargetObservation(target=0, time=when, position=(0, 0))])
        if when == 0.5 and walkers.status == "":
            walkers.step(outrider.Observation(time=1, odometry=walkers.start, gun=(0, 0), targets=report))
            refused(walkers, "once, in the order", targets=report)
            break
        refused(walkers, "was seen at 9", targets=report)


class Rover:
    """Wheels that do as they are told at once, and a camera that sees tags as they are."""

    def __init__(self, mission, sees=True):
        self.mission, self.pose, self.time, self.sees = mission, np.array(mission.start), 0.0, sees
        self.camera = mission.camera

    def corners(self):
        matrix, (x, y, heading) = self.camera["matrix"], self.pose
        seen = {}
        for tag, corners in self.mission.tags.items():
            c, s = math.cos(heading), math.sin(heading)
            dx, dy = corners[:, 0] - x, corners[:, 1] - y
            ahead, left = c * dx + s * dy - self.camera["ahead"], c * dy - s * dx
            up = corners[:, 2] - self.camera["above"]
            if ahead.min() < 0.2:
                continue
            u = matrix[0, 0] * -left / ahead + matrix[0, 2] + 0.5
            v = matrix[1, 1] * -up / ahead + matrix[1, 2] + 0.5
            inside = u.min() > 0 and v.min() > 0 and u.max() < self.camera["width"] and v.max() < self.camera["height"]
            if inside and u[1] > u[0] + 12:  # it faces the camera
                seen[tag] = np.stack([u, v], axis=1)
        return seen

    def sense(self):
        image = outrider.TagImage(taken=self.time, corners=self.corners()) if self.sees else None
        return outrider.Observation(time=self.time, odometry=(0, 0, 0), image=image)

    def act(self, command):
        ahead, left, turn = self.mission.twist(command.speeds)
        steps = 10
        dt = max(0.0, command.until - self.time) / steps
        for _ in range(steps):
            heading = self.pose[2] + turn * dt / 2
            self.pose = self.pose + dt * np.array([ahead * math.cos(heading) - left * math.sin(heading),
                                                   ahead * math.sin(heading) + left * math.cos(heading), turn])
        self.time = command.until


WAYS = "scenarios/waypoints/open_loop.yaml"
EXACT_WHEELS = {"reckoning.delay": 0, "reckoning.lag": 0}


def test_a_robot_drives_open_loop_by_time():
    mission = outrider.DriveMission(WAYS)
    robot = Rover(mission, sees=False)
    outrider.run_mission(mission, robot, most_steps=20000)
    assert mission.status == "done" and len(mission.arrivals) == len(mission.waypoints) == 4
    assert np.hypot(*(robot.pose - mission.waypoints[-1])[:2]) < 0.02


def test_a_robot_drives_by_the_tags_that_it_sees():
    mission = outrider.DriveMission(WAYS, set={"loop": "closed"} | EXACT_WHEELS)
    robot = Rover(mission)
    outrider.run_mission(mission, robot, most_steps=20000)
    assert mission.status == "done", mission.reason
    assert all(one["doubt"] == "" for one in mission.arrivals) and len(mission.arrivals) == 4
    np.testing.assert_allclose(mission.pose[:2], robot.pose[:2], atol=0.01)
    assert np.hypot(*(robot.pose - mission.waypoints[-1])[:2]) < 0.02


class Immobile(Rover):
    def act(self, command):
        self.time = command.until


def test_a_robot_whose_wheels_do_not_turn_is_told_so():
    mission = outrider.DriveMission(WAYS, set={"loop": "closed", "rules.patience": 20} | EXACT_WHEELS)
    outrider.run_mission(mission, Immobile(mission), most_steps=20000)
    assert mission.status in ("stuck", "lost", "unconfirmed") and mission.reason
    blind = outrider.DriveMission(WAYS, set={"loop": "closed"})
    outrider.run_mission(blind, Rover(blind, sees=False), most_steps=20000)
    assert blind.status in ("lost", "unconfirmed") and blind.reason


def test_what_a_drive_cannot_work_with_is_refused():
    mission = outrider.DriveMission(WAYS)
    mission.step(outrider.Observation(time=1, odometry=(0, 0, 0)))
    with pytest.raises(outrider.BadInput, match="time goes on"):
        mission.step(outrider.Observation(time=0, odometry=(0, 0, 0)))
    with pytest.raises(outrider.BadInput, match="corners"):
        outrider.TagImage(taken=0, corners={1: [(0, 0)]})
    line = outrider.TagImage(taken=2, corners={1: [(0, 0), (1, 1), (2, 2), (3, 3)], 10**6: np.eye(4, 2)})
    assert mission.step(outrider.Observation(time=2, odometry=(0, 0, 0), image=line)) is not None


MISSIONS = {
    "guard": (lambda: outrider.GuardMission("scenarios/driveby/driveby.yaml", set=COARSE), Gardener),
    "drive": (lambda: outrider.DriveMission(WAYS), Rover),
    "pursue": (lambda: outrider.PursuitMission(chase()), lambda _: Team([(1, 1)])),
    "explore": (outrider.ExploreMission, lambda _: Explorer()),
    "cover": (lambda: outrider.CoverMission(outrider.CoverPlanner("spiral").plan(
        outrider.CoverProblem([(0, 0), (2, 0), (2, 2), (0, 2)], width=0.4))), lambda _: Explorer()),
}


class Explorer:
    def sense(self):
        scan = outrider.LaserScan(np.ones(90), first=0.0, step=2 * math.pi / 90, least=0.05, most=3.5)
        return outrider.Observation(time=0.0, odometry=(0, 0, 0), scan=scan)

    def act(self, command):
        pass


@pytest.mark.parametrize("job", MISSIONS)
@pytest.mark.parametrize("method", ["sense", "act"])
def test_a_robot_that_throws_ends_any_mission(job, method):
    make, kind = MISSIONS[job]
    mission = make()
    robot = kind(mission)

    def fails(*_):
        raise OSError("no cable")
    setattr(robot, method, fails)
    with pytest.raises(outrider.RobotFailed, match="OSError: no cable") as failed:
        outrider.run_mission(mission, robot)
    assert isinstance(failed.value.__cause__, OSError)
