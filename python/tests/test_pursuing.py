"""Robots in Python pursue a target, or fail, and the mission says so."""

import numpy as np
import outrider
import pytest


COSTS = np.random.default_rng(3).integers(1, 9, size=(12, 16))
TARGET = [(min(15, 4 + t // 2), 6) for t in range(40)]


def chase(**changed):
    return outrider.PursuitProblem(**{"costs": COSTS, "threshold": 9, "start": (1, 1), "target": TARGET, **changed})


class Team:
    """Robots that step as they are told, and see the target `known` seconds ahead."""

    def __init__(self, starts, known=100):
        self.robots, self.time, self.told, self.known = list(starts), 0, 0, known

    def sense(self):
        end = min(len(TARGET), self.time + self.known + 1)
        new, self.told = TARGET[self.told:end], end
        grid = outrider.GridObservation(robots=self.robots, target=np.array(new, int).reshape(-1, 2))
        return outrider.Observation(time=self.time, odometry=(0, 0, 0), grid=grid)

    def act(self, command):
        x, y = self.robots[command.robot]
        assert max(abs(command.cell[0] - x), abs(command.cell[1] - y)) <= 1
        self.move(command)
        self.time += 1

    def move(self, command):
        self.robots[command.robot] = command.cell


def test_a_robot_catches_as_cheaply_as_the_planner_says():
    mission = outrider.PursuitMission(chase())
    assert mission.status == ""
    outrider.run_mission(mission, Team([(1, 1)]))
    plan = outrider.PursuitPlanner("optimal").plan(chase())
    assert (mission.status, mission.caught, mission.cost, mission.time) == ("done", True, plan.cost, plan.catch_time_s)
    assert mission.lower_bound == plan.lower_bound and mission.reason == ""
    np.testing.assert_array_equal(mission.paths[0], plan.path)


@pytest.mark.parametrize("options", [{"known": 3, "forecast": "last_velocity"}, {"clock": "wall", "call": 0.05},
                                     {"planner": "anytime"}])
def test_a_team_catches_what_it_sees_little_of(options):
    mission = outrider.PursuitMission(chase(), **options)
    team = Team([(1, 1), (14, 10)], known=options.get("known", 100))
    outrider.run_mission(mission, team)
    assert mission.status == "done" and len(mission.paths) == 2


class Lame(Team):
    """Does not take every third step."""

    def move(self, command):
        if self.time % 3:
            super().move(command)


class Parked(Team):
    def move(self, command):
        pass


def test_a_robot_that_does_not_move_catches_nothing():
    mission = outrider.PursuitMission(chase())
    outrider.run_mission(mission, Parked([(1, 1)]))
    assert mission.status == "not_done" and not mission.caught
    assert "was gone" in mission.reason or "no robot can catch" in mission.reason
    late = outrider.PursuitMission(chase())
    outrider.run_mission(late, Lame([(1, 1)]))
    assert late.status == "done" and late.cost > outrider.PursuitPlanner("optimal").plan(chase()).cost


def test_what_a_pursuit_cannot_work_with_is_refused():
    mission = outrider.PursuitMission(chase())

    def step(**cells):
        mission.step(outrider.Observation(time=0, odometry=(0, 0, 0), grid=outrider.GridObservation(**cells)))

    with pytest.raises(outrider.BadInput, match="GridObservation each second"):
        mission.step(outrider.Observation(time=0, odometry=(0, 0, 0)))
    for cells, words in [({"robots": np.zeros((0, 2), int), "target": TARGET}, "0 robots"),
                         ({"robots": [(99, 0)], "target": TARGET}, "no cell of the map"),
                         ({"robots": [(0, 0)], "target": [(0, -1)]}, "no cell of the map"),
                         ({"robots": [(0, 0)], "target": np.zeros((0, 2), int)}, "0 cells of the target"),
                         ({"robots": [(0, 0)], "target": TARGET * 2}, "80 cells of the target")]:
        with pytest.raises(outrider.BadInput, match=words):
            step(**cells)
    step(robots=[(1, 1)], target=TARGET[:1])
    with pytest.raises(outrider.BadInput, match="2 robots"):
        step(robots=[(1, 1), (2, 2)], target=TARGET[1:2])
    with pytest.raises(outrider.BadInput, match="1 cells of the target are known at second 1"):
        step(robots=[(1, 1)], target=np.zeros((0, 2), int))
    with pytest.raises(outrider.BadInput, match="planner"):
        outrider.PursuitMission(chase(), planner="none")
    walled = np.full((12, 16), 9)
    walled[:2, :2] = 1
    with pytest.raises(outrider.NoPath):
        outrider.run_mission(outrider.PursuitMission(chase(costs=walled)), Team([(1, 1)]))
