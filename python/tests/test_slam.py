"""Pose graphs, mapping with a laser and with landmarks, and frontiers."""

import math
import threading

import numpy as np
import outrider
import pytest


def composed(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return np.array([a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]])


def ring(count=12, noise=0.0, seed=1):
    """A graph whose poses stand on a ring, and the true poses."""
    rng = np.random.default_rng(seed)
    move = np.array([1.0, 0.0, 2 * math.pi / count])
    truth = [np.zeros(3)]
    for _ in range(count - 1):
        truth.append(composed(truth[-1], move))
    graph = outrider.PoseGraph()
    for pose in truth:
        assert graph.add_pose(pose + [0, 0, 0]) == len(graph.poses) - 1
    for i in range(count):
        graph.add_edge(i, (i + 1) % count, move + noise * rng.normal(size=3), np.diag([50.0, 50.0, 200.0]))
    return graph, np.array(truth)


def test_an_exact_graph_is_solved_exactly():
    graph, truth = ring()
    assert graph.edges.shape == (12, 2)
    solution = graph.optimise(start="odometry")
    np.testing.assert_allclose(solution.poses[:, :2], truth[:, :2], atol=1e-6)
    assert solution.status == "converged" and solution.cost < 1e-9


def test_a_solution_is_proven_to_be_the_least():
    graph, _ = ring(noise=0.05)
    solution = graph.optimise()
    assert graph.cost(solution.poses) == pytest.approx(solution.cost)
    assert graph.lower_bound(solution.poses) == pytest.approx(solution.cost, rel=1e-4)
    assert graph.lower_bound(graph.poses) <= solution.cost
    assert graph.covariances(solution.poses).shape == (12, 3, 3)
    with pytest.raises(outrider.BadInput, match="2 poses for 12"):
        graph.cost(solution.poses[:2])


def test_graphs_are_written_and_read(tmp_path):
    graph, _ = ring(noise=0.05)
    (tmp_path / "ring.g2o").write_text(graph.g2o(graph.poses))
    again = outrider.PoseGraph.load(tmp_path / "ring.g2o")
    assert again.cost(graph.poses) == pytest.approx(graph.cost(graph.poses))
    with pytest.raises(outrider.BadInput, match="none.g2o"):
        outrider.PoseGraph.load("none.g2o")


def test_graphs_in_space():
    graph = outrider.PoseGraph3()
    turn = np.array([[0.0, -1, 0, 1], [1, 0, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]])
    poses = [np.eye(4)]
    for _ in range(3):
        poses.append(poses[-1] @ turn)
    for pose in poses:
        graph.add_pose(pose)
    for i in range(3):
        graph.add_edge(i, i + 1, turn, np.eye(6))
    solution = graph.optimise(start="given")
    np.testing.assert_allclose(solution.poses, poses, atol=1e-9)
    with pytest.raises(outrider.BadInput, match="rotation"):
        graph.add_pose(2 * np.eye(4))


@pytest.mark.parametrize("arguments", [
    (0, 50, (1, 0, 0), np.eye(3)), (0, 0, (1, 0, 0), np.eye(3)), (0, 1, (1, 0, 0), -np.eye(3)),
    (0, 1, (1, 0, np.nan), np.eye(3)), (0, 1, (1, 0), np.eye(3)), (0, 1, (1, 0, 0), np.eye(2)),
    (0, 1, (1, 0, 0), np.full((3, 3), np.inf)),
])
def test_what_is_no_edge_is_refused(arguments):
    graph, _ = ring()
    with pytest.raises(outrider.BadInput):
        graph.add_edge(*arguments)
        graph.optimise()
    with pytest.raises((outrider.BadInput, TypeError)):
        outrider.PoseGraph().optimise()


def scan_of_room(pose, size=(6.0, 4.0), beams=180):
    """Returns the ranges of a laser in an empty room with a step in its wall, by rays against the four walls."""
    bearings = pose[2] + np.arange(beams) * 2 * math.pi / beams
    c, s = np.cos(bearings), np.sin(bearings)
    with np.errstate(divide="ignore"):
        across = np.where(c > 0, (size[0] - pose[0]) / c, np.where(c < 0, -pose[0] / c, np.inf))
        along = np.where(s > 0, (size[1] - pose[1]) / s, np.where(s < 0, -pose[1] / s, np.inf))
    return np.minimum(across, along)


def laser_scan(pose):
    return outrider.LaserScan(scan_of_room(pose), first=0.0, step=2 * math.pi / 180, least=0.05, most=10.0)


def test_a_room_is_mapped():
    slam = outrider.LaserSlam((1.0, 1.0, 0.0), map_resolution=0.1)
    pose = np.array([1.0, 1.0, 0.0])
    for step in range(30):
        motion = np.array([0.1, 0.0, 0.02])
        pose = composed(pose, motion)
        told = slam.advance(motion * [1.1, 1.0, 0.9], laser_scan(pose))  # odometry that counts wrong
        assert told["pose"].shape == (3,)
    slam.settle()
    np.testing.assert_allclose(slam.pose, pose, atol=0.03)
    assert slam.trajectory.shape == (31, 3) and slam.covariance.shape == (3, 3)
    grid = slam.map
    rows, columns = np.nonzero(grid.cells == 1)
    walls = np.column_stack([columns, rows]) * grid.resolution + grid.origin + 0.5 * grid.resolution
    off = np.min(np.abs([walls[:, 0], walls[:, 0] - 6, walls[:, 1], walls[:, 1] - 4]), axis=0)
    assert len(walls) > 150 and off.max() < 0.2
    assert len(slam.graph.poses) > 1
    with pytest.raises(outrider.BadInput):
        slam.advance((np.nan, 0, 0), laser_scan(pose))
    with pytest.raises(outrider.BadInput):
        outrider.LaserSlam((0, 0, 0), map_resolution=-1)


@pytest.mark.parametrize("changed", [{"ranges": [[1.0]]}, {"ranges": "far"}, {"ranges": np.ones(200_000)},
                                     {"step": np.nan}, {"least": 2.0, "most": 1.0}])
def test_what_is_no_scan_is_refused(changed):
    with pytest.raises(outrider.BadInput):
        outrider.LaserScan(**{"ranges": [1.0], "first": 0.0, "step": 0.1, "least": 0.1, "most": 5.0, **changed})


def test_landmarks_are_mapped():
    truth = np.array([[2.0, 1.0], [3.0, -1.0], [1.0, 2.0]])
    slam = outrider.LandmarkSlam(engine="graph")
    pose = np.zeros(3)
    for _ in range(10):
        motion = np.array([0.1, 0.0, 0.05])
        pose = composed(pose, motion)
        c, s = math.cos(pose[2]), math.sin(pose[2])
        seen = (truth - pose[:2]) @ np.array([[c, -s], [s, c]])
        told = slam.advance(motion, np.diag([1e-4, 1e-4, 1e-4]), positions=seen,
                            covariances=np.tile(1e-4 * np.eye(2), (3, 1, 1)), ids=[7, 8, 9])
    assert told["used"] == 3
    slam.settle()
    estimates = slam.landmarks
    np.testing.assert_array_equal(estimates["id"], [7, 8, 9])
    np.testing.assert_allclose(estimates["position"], truth, atol=1e-6)
    np.testing.assert_allclose(slam.pose, pose, atol=1e-6)
    again = outrider.LandmarkSlam.load(slam.state)
    np.testing.assert_array_equal(again.trajectory, slam.trajectory)
    for wrong in ({"ids": [1, 2]}, {"ids": [0.5, 1, 2]}, {"positions": truth[:2]}):
        with pytest.raises(outrider.BadInput):
            slam.advance(motion, np.eye(3), **{"positions": truth, "covariances": np.tile(np.eye(2), (3, 1, 1)), **wrong})
    with pytest.raises(outrider.BadInput):
        outrider.LandmarkSlam.load("no state")


def test_frontiers_are_those_of_a_full_computation():
    cells = np.full((40, 60), 2, np.uint8)
    cells[10:30, 10:30] = 0
    cells[10:30, 10] = 1
    grid = outrider.OccupancyGrid(cells, resolution=0.1, origin=(1.0, 2.0))
    assert not grid.cells.flags.writeable
    frontiers = outrider.FrontierMap(0.1)
    frontiers.update(grid)
    found = np.vstack([frontier["points"] for frontier in frontiers.frontiers])
    free = np.pad(cells == 0, 1)
    unknown = np.pad(cells == 2, 1, constant_values=True)
    beside = unknown[:-2, 1:-1] | unknown[2:, 1:-1] | unknown[1:-1, :-2] | unknown[1:-1, 2:]
    rows, columns = np.nonzero(free[1:-1, 1:-1] & beside)
    expected = np.column_stack([columns, rows]) * 0.1 + [1.05, 2.05]
    assert {tuple(p) for p in found.round(6)} == {tuple(p) for p in expected.round(6)}
    plan = outrider.PathPlanner("jps").plan(frontiers.ground, (2.5, 3.5), (3.5, 4.5))
    assert plan.cost == pytest.approx(math.sqrt(2))
    with pytest.raises(outrider.BadInput, match="7 is no state"):
        outrider.OccupancyGrid(np.full((2, 2), 7, np.uint8))
    with pytest.raises(outrider.BadInput, match="radius"):
        outrider.FrontierMap(math.nan)


def test_frontiers_follow_a_map_by_its_changes():
    slam = outrider.LaserSlam((0.6, 1.0, 0.0), map_resolution=0.05)
    followed, told, late = (outrider.FrontierMap(0.1) for _ in range(3))
    x = 0.6
    for step in range(25):
        slam.advance((0.05, 0.0, 0.02), laser_scan((x := x + 0.05, 1.0, 0.02 * step)))
        if step == 15:
            slam.settle()
        followed.update(slam)
        told.update(slam.map)
        if step % 7 == 3:
            late.update(slam)
            same = {tuple(p) for one in late.frontiers for p in one["points"].round(6)}
            assert same == {tuple(p) for one in told.frontiers for p in one["points"].round(6)}
        assert len(followed.frontiers) == len(told.frontiers)
        for mine, other in zip(followed.frontiers, told.frontiers):
            np.testing.assert_array_equal(mine["points"], other["points"])
        assert (followed.ground.marks == told.ground.marks).all()
    followed.update(outrider.OccupancyGrid(np.zeros((9, 9), np.uint8)))
    followed.update(slam)
    assert len(followed.frontiers) == len(told.frontiers)
    other = outrider.LaserSlam((0.6, 1.0, 0.0), map_resolution=0.05)
    other.advance((0, 0, 0), laser_scan((0.6, 1.0, 0.0)))
    followed.update(other)
    fresh = outrider.FrontierMap(0.1)
    fresh.update(other.map)
    assert len(followed.frontiers) == len(fresh.frontiers)


def test_a_map_that_is_held_stays_and_is_copied_only_where_it_changes():
    slam = outrider.LaserSlam((1.0, 1.0, 0.0))
    slam.advance((0, 0, 0), laser_scan((1.0, 1.0, 0.0)))
    held = slam.map
    assert slam.map is held
    before = held.cells.copy()
    for _ in range(5):
        slam.advance((0.1, 0.0, 0.3), laser_scan((1.0, 1.0, 0.0)))
        whole = outrider.OccupancyGrid(slam.map.cells, origin=slam.map.origin)
        np.testing.assert_array_equal(whole.cells, slam.map.cells)
    assert (held.cells == before).all() and slam.map is not held
    view = slam.map.cells
    slam.advance((0.1, 0.0, 0.3), laser_scan((1.2, 1.1, 0.3)))
    assert slam.map.cells is not view


def test_two_threads_on_one_map_are_refused_or_served():
    slam = outrider.LaserSlam((1.0, 1.0, 0.0))
    wrong = []

    def drive():
        for _ in range(15):
            try:
                slam.advance((0.0, 0.0, 0.0), laser_scan((1.0, 1.0, 0.0)))
            except outrider.BadInput as refusal:
                if "another thread" not in refusal.sentence:
                    wrong.append(refusal)

    threads = [threading.Thread(target=drive) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong and 1 < len(slam.trajectory) <= 46
