"""Whatever is given to the package: an exception with a sentence, never a crash."""

import itertools
import math

import numpy as np
import outrider
import pytest

ODD = [None, math.nan, math.inf, -1, 2**70, "text", b"\xff", [], [[]], [[1.0, 2.0], [3.0]], {}, object(),
       np.zeros((0, 0)), np.zeros((3, 3, 3)), np.array([1j]), np.array(["a"]), np.array([None]), np.full((4, 4), np.nan),
       np.zeros((8, 8), np.float16)[::2, ::-2], np.zeros((4, 4), np.int8)[:, ::2], np.zeros(3, "M8[s]"),
       np.zeros(3, [("x", float)]), np.ma.masked_all((2, 2)), np.broadcast_to(np.float64(0), (3, 3))]


def ground():
    return outrider.GridMap(np.zeros((8, 8), bool))


def pursuit(**changed):
    return outrider.PursuitProblem(**{"costs": np.ones((4, 4), int), "threshold": 9, "start": (0, 0),
                                      "target": [(3, 3), (3, 3)], **changed})


CALLS = {
    "GridMap": lambda a: outrider.GridMap(a),
    "GridMap.resolution": lambda a: outrider.GridMap(np.zeros((2, 2), bool), resolution=a),
    "GridMap.origin": lambda a: outrider.GridMap(np.zeros((2, 2), bool), origin=a),
    "plan": lambda a: outrider.PathPlanner("jps").plan(ground(), a, (1.5, 1.5)),
    "polygons": lambda a: outrider.PolygonMap(a),
    "polygons.obstacles": lambda a: outrider.PolygonMap([(0, 0), (9, 0), (9, 9)], obstacles=[a]),
    "polygons.radius": lambda a: outrider.PolygonMap([(0, 0), (9, 0), (9, 9)], radius=a),
    "plan.map": lambda a: outrider.PathPlanner("jps").plan(a, (1.5, 1.5), (1.5, 1.5)),
    "costs": lambda a: outrider.PathPlanner("jps").costs(ground(), a, a),
    "budget": lambda a: outrider.PathPlanner("jps").plan(ground(), (0.5, 0.5), (5.5, 7.5), most_expansions=a),
    "option": lambda a: outrider.CoverProblem([(0, 0), (6, 0), (6, 4)], width=a),
    "name": lambda a: outrider.PathPlanner(a),
    "check": lambda a: outrider.check(a, ground(), (0, 0), (1, 1)),
    "pursuit.costs": lambda a: pursuit(costs=a),
    "pursuit.start": lambda a: pursuit(start=a),
    "pursuit.target": lambda a: pursuit(target=a),
    "pursuit.start_s": lambda a: pursuit(start_s=a),
    "cover.boundary": lambda a: outrider.CoverPlanner("spiral").plan(outrider.CoverProblem(a, width=0.4)),
    "cover.holes": lambda a: outrider.CoverPlanner("spiral").plan(
        outrider.CoverProblem([(0, 0), (6, 0), (6, 4)], width=0.4, holes=[a])),
    "add_pose": lambda a: outrider.PoseGraph().add_pose(a),
    "add_edge": lambda a: outrider.PoseGraph().add_edge(0, 1, (1, 0, 0), a),
    "cost": lambda a: outrider.PoseGraph().cost(a),
    "add_pose3": lambda a: outrider.PoseGraph3().add_pose(a),
    "scan": lambda a: outrider.LaserSlam().advance((0, 0, 0), a),
    "motion": lambda a: outrider.LaserSlam().advance(a, outrider.LaserScan([1.0], first=0, step=1, least=0, most=2)),
    "landmarks": lambda a: outrider.LandmarkSlam().advance((0, 0, 0), np.eye(3), positions=a, covariances=a, ids=a),
    "covariance": lambda a: outrider.LandmarkSlam().advance((0, 0, 0), a, positions=np.zeros((0, 2)),
                                                            covariances=np.zeros((0, 2, 2))),
    "frontiers": lambda a: outrider.FrontierMap(0.2).update(a),
    "radius": lambda a: outrider.FrontierMap(a).update(outrider.OccupancyGrid(a)),
    "odometry": lambda a: outrider.Observation(time=0.0, odometry=a),
    "explore": lambda a: outrider.ExploreMission(a),
    "robot": lambda a: outrider.run_mission(outrider.ExploreMission(), a),
    "gun": lambda a: outrider.Observation(time=0.0, odometry=(0, 0, 0), gun=a),
    "shots": lambda a: outrider.Observation(time=0.0, odometry=(0, 0, 0), shots=a),
    "image": lambda a: outrider.TagImage(taken=0.0, corners={1: a}),
    "corners": lambda a: outrider.TagImage(taken=a, corners=a),
    "level": lambda a: outrider.StoreLevels(water=a),
    "arrival": lambda a: outrider.TargetReport(arrivals=[a]),
    "seen": lambda a: outrider.TargetObservation(target=0, time=0.0, position=a),
    "team": lambda a: outrider.GridObservation(robots=a, target=[(0, 0)]),
    "wheels": lambda a: outrider.DriveWheels(speeds=a, until=1.0),
    "twist": lambda a: outrider.DriveMission("scenarios/waypoints/open_loop.yaml").twist(a),
    "step": lambda a: outrider.StepToCell(a),
    "waypoints": lambda a: outrider.FollowWaypoints(a),
    "guard": lambda a: outrider.GuardMission(a),
    "guard.set": lambda a: outrider.GuardMission("scenarios/driveby/driveby.yaml", set={"robot.radius": a}),
    "drive": lambda a: outrider.DriveMission(a),
    "pursue": lambda a: outrider.PursuitMission(a),
    "pursue.known": lambda a: outrider.PursuitMission(pursuit(), known=a),
    "pursue.step": lambda a: outrider.PursuitMission(pursuit()).step(a),
    "follow": lambda a: outrider.FrontierMap(0.2).update(a),
    "plan.radius": lambda a: outrider.PathPlanner("visibility_graph").plan(
        outrider.World.load("scenarios/arena/arena.sdf"), (1, 1), (2, 2), radius=a),
    "world.polygons": lambda a: outrider.World.load("scenarios/arena/arena.sdf").polygons(a),
    "world.height": lambda a: outrider.World.load("scenarios/arena/arena.sdf").polygons(0.1, height=a),
    "run": lambda a: outrider.run(a),
    "read_log": lambda a: outrider.read_log(a),
    "world": lambda a: outrider.World.load(a),
}


@pytest.mark.parametrize("call", CALLS)
def test_an_odd_value_is_refused_with_a_sentence(call):
    refused = 0
    for value in ODD:
        try:
            CALLS[call](value)
        except Exception as exception:  # noqa: BLE001
            refused += 1
            assert str(exception), (call, value)
    assert refused >= len(ODD) // 2


def test_what_a_value_points_at_stays():
    view = outrider.GridMap(np.ones((50, 50), np.uint8)).marks
    cells = outrider.OccupancyGrid(np.ones((50, 50), np.uint8)).cells
    costs = pursuit(costs=np.full((4, 4), 5)).costs
    junk = [np.zeros((50, 50), np.uint8) for _ in range(100)]
    assert (view & 1).all() and (cells == 1).all() and (costs == 5).all() and junk
    for array, _ in itertools.product((view, cells, costs), range(1)):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 0
