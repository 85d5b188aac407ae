"""Grid maps and path planners."""

import gc
import heapq
import math
import threading

import numpy as np
import outrider
import pytest


def random_map(seed, rows=30, columns=40):
    rng = np.random.default_rng(seed)
    blocked = rng.random((rows, columns)) < 0.25
    blocked[0, 0] = blocked[-1, -1] = False
    return blocked


def dijkstra(blocked, start, goal):
    """The least cost along the eight moves, by code that shares nothing with Outrider."""
    rows, columns = blocked.shape
    free = lambda x, y: 0 <= x < columns and 0 <= y < rows and not blocked[y, x]
    least, queue = {start: 0.0}, [(0.0, start)]
    while queue:
        cost, (x, y) = heapq.heappop(queue)
        if (x, y) == goal:
            return cost
        if cost > least[x, y]:
            continue
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                if (dx, dy) == (0, 0) or not (free(x + dx, y) and free(x, y + dy) and free(x + dx, y + dy)):
                    continue
                further = cost + math.hypot(dx, dy)
                if further < least.get((x + dx, y + dy), math.inf):
                    least[x + dx, y + dy] = further
                    heapq.heappush(queue, (further, (x + dx, y + dy)))
    return math.nan


@pytest.mark.parametrize("seed", range(8))
def test_plans_cost_what_another_program_finds(seed):
    blocked = random_map(seed)
    ground = outrider.GridMap(blocked)
    planner = outrider.PathPlanner("a_star")
    free = np.argwhere(~blocked)
    rng = np.random.default_rng(seed)
    starts, goals = (free[rng.integers(len(free), size=20)][:, ::-1] for _ in range(2))
    costs = planner.costs(ground, starts + 0.5, goals + 0.5)
    expected = [dijkstra(blocked, tuple(s), tuple(g)) for s, g in zip(starts, goals)]
    np.testing.assert_allclose(costs, expected, rtol=1e-12)
    assert np.isfinite(costs).any()
    for start, goal, cost in zip(starts + 0.5, goals + 0.5, costs):
        if np.isnan(cost):
            with pytest.raises(outrider.NoPath):
                planner.plan(ground, start, goal)
        else:
            plan = planner.plan(ground, start, goal)
            assert plan.cost == cost == plan.lower_bound
            outrider.check(plan, ground, start, goal)


def test_a_plan_is_checked_against_its_problem():
    ground = outrider.GridMap(np.zeros((5, 5), bool))
    plan = outrider.PathPlanner("a_star").plan(ground, (0.5, 0.5), (4.5, 0.5))
    assert plan.length == 4.0
    np.testing.assert_array_equal(plan.waypoints, [(0.5, 0.5), (4.5, 0.5)])
    with pytest.raises(outrider.BadInput):
        outrider.check(plan, ground, (0.5, 0.5), (4.5, 1.5))


def test_a_trace_has_the_expansions():
    ground = outrider.GridMap(np.zeros((20, 20), np.uint8))
    plan, trace = outrider.PathPlanner("dijkstra").trace(ground, (0.5, 0.5), (19.5, 19.5))
    assert len(trace) == plan.expansions
    assert trace.dtype.names == ("state", "parent", "f", "g", "h")
    assert (np.diff(trace["g"]) >= -1e-9).all()


def test_marks_are_a_view_that_keeps_its_map():
    blocked = random_map(3)
    ground = outrider.GridMap(blocked)
    marks = ground.marks
    assert marks.base is not None and not marks.flags.writeable
    del ground
    gc.collect()
    np.testing.assert_array_equal(marks & 1, blocked)


def test_any_strides_are_read():
    blocked = random_map(4)
    sparse = np.zeros((60, 80), bool)
    sparse[::2, ::2] = blocked
    for same in (blocked, np.asfortranarray(blocked), sparse[::2, ::2], blocked[::-1][::-1]):
        np.testing.assert_array_equal(outrider.GridMap(same).marks & 1, blocked)


def test_options_are_read_and_set():
    with_options = [name for name in outrider.path_planners() if outrider.PathPlanner(name).options]
    assert with_options, "the premise: some planner has options"
    for name in outrider.path_planners():
        planner = outrider.PathPlanner(name)
        assert planner.sentence and planner.guarantee["sentence"]
        for option, value in planner.options.items():
            planner.set(option, value)
            assert outrider.PathPlanner(name, **{option: value}).options[option] == value
        with pytest.raises(outrider.BadInput, match="no_such_option"):
            planner.set("no_such_option", 1)


def test_the_budget_is_kept():
    ground = outrider.GridMap(np.zeros((50, 50), bool))
    with pytest.raises(outrider.BudgetExhausted):
        outrider.PathPlanner("dijkstra").plan(ground, (0.5, 0.5), (49.5, 49.5), most_expansions=10)


@pytest.mark.parametrize("start, words", [
    ((math.nan, 1.0), "finite"), ((math.inf, 1.0), "finite"), ((1.0,), "shape"), ("ab", "numbers"),
    ([[1.0, 2.0]], "shape"), (None, "numbers"), ((1j, 2.0), "numbers"),
])
def test_what_is_no_point_is_refused(start, words):
    ground = outrider.GridMap(np.zeros((5, 5), bool))
    with pytest.raises(outrider.BadInput, match=words) as refused:
        outrider.PathPlanner("a_star").plan(ground, start, (4.5, 4.5))
    assert refused.value.where == "start"
    assert isinstance(refused.value, ValueError)


@pytest.mark.parametrize("blocked, words", [
    (np.zeros(5, bool), "shape"), (np.zeros((2, 2, 2), bool), "shape"), (np.zeros((5, 5)), "dtype"),
    (np.zeros((5, 5), np.int64), "dtype"), (np.zeros((0, 5), bool), ""), (np.array([["a"]]), "dtype"),
])
def test_what_is_no_grid_is_refused(blocked, words):
    with pytest.raises(outrider.BadInput, match=words):
        outrider.GridMap(blocked)


@pytest.mark.parametrize("keys", [{"resolution": math.nan}, {"resolution": 0.0}, {"resolution": -1.0},
                                  {"origin": (math.nan, 0.0)}, {"origin": 1.0}, {"model": "hexagons"}])
def test_what_is_no_frame_is_refused(keys):
    with pytest.raises(outrider.BadInput):
        outrider.GridMap(np.zeros((5, 5), bool), **keys)


def test_what_does_not_fit_together_is_refused():
    ground = outrider.GridMap(np.zeros((5, 5), bool))
    planner = outrider.PathPlanner("a_star")
    with pytest.raises(outrider.BadInput, match="2 goals for 1 starts"):
        planner.costs(ground, [(0.5, 0.5)], [(1.5, 1.5), (2.5, 2.5)])
    with pytest.raises(outrider.OutsideMap) as outside:
        planner.costs(ground, [(0.5, 0.5), (0.5, 0.5)], [(1.5, 1.5), (9.5, 9.5)])
    assert outside.value.where == "query 1"
    with pytest.raises(outrider.BadInput, match="did you mean"):
        outrider.PathPlanner("a_starr")


def test_two_threads_on_one_planner_are_refused():
    ground = outrider.GridMap(np.zeros((300, 300), bool))
    planner = outrider.PathPlanner("dijkstra")
    starts, goals = np.full((40, 2), 0.5), np.full((40, 2), 299.5)
    refused = []

    def ask(question, *words):
        try:
            question(ground, *words)
        except outrider.BadInput as refusal:
            refused.append(refusal.sentence)

    while not refused:  # until both ask at the same time
        working = threading.Thread(target=ask, args=(planner.costs, starts, goals))
        working.start()
        while working.is_alive():
            ask(planner.plan, (0.5, 0.5), (1.5, 0.5))
    assert all("another thread" in sentence for sentence in refused)
    assert planner.plan(ground, (0.5, 0.5), (1.5, 0.5)).cost == 1.0


def test_polygons_are_ground():
    ground = outrider.PolygonMap([(0, 0), (10, 0), (10, 10), (0, 10)], obstacles=[[(4, 2), (6, 2), (6, 8), (4, 8)]],
                                 radius=0.5)
    start, goal = (2.0, 5.0), (8.0, 5.0)
    off, sight = math.hypot(2, 3), math.asin(0.5 / math.hypot(2, 3))  # the corner (4, 2) as the start sees it
    shortest = 2 * (math.sqrt(off**2 - 0.5**2) + 0.5 * (math.atan2(3, 2) + sight)) + 2  # tangent, arc, and along the edge
    costs = {}
    for name in outrider.path_planners():
        planner = outrider.PathPlanner(name)
        if "iterations" in planner.options:  # of those that draw points
            planner.set("iterations", 500)
        try:
            plan = planner.plan(ground, start, goal)
        except outrider.BadInput:
            continue  # a planner of grids
        costs[name] = plan.cost
        outrider.check(plan, ground, start, goal)
        assert plan.cost >= plan.lower_bound - 1e-9 and plan.length >= shortest - 1e-9
        np.testing.assert_allclose(planner.costs(ground, [start], [goal]), [plan.cost])
        traced, expansions = planner.trace(ground, start, goal)
        assert traced.cost == pytest.approx(plan.cost) and expansions.dtype.names[0] == "state"
        with pytest.raises(outrider.BadInput):
            outrider.check(plan, ground, start, (8.0, 6.0))
    for name in ("visibility_graph", "visibility_graph_reduced", "visibility_graph_implicit"):
        assert costs[name] == pytest.approx(shortest, rel=1e-9)
    assert {"least_time", "widest", "medial_axis", "safest"} <= costs.keys()
    with pytest.raises(outrider.BadInput):
        outrider.PolygonMap([(0, 0), (1, 1), (1, 0), (0, 1)])
    with pytest.raises(outrider.BadInput, match="a GridMap, a PolygonMap or a World"):
        outrider.PathPlanner("a_star").plan(None, start, goal)


def test_a_world_is_ground_as_polygons():
    world = outrider.World.load("scenarios/yard/yard.sdf")
    planner = outrider.PathPlanner("visibility_graph_reduced")
    start, goal = (0.0, -6.3), (3.0, 5.0)
    plan = planner.plan(world, start, goal, radius=0.2)
    outrider.check(plan, world, start, goal, radius=0.2)
    ground = world.polygons(0.2)
    assert ground.radius == 0.2 and planner.plan(ground, start, goal).cost == plan.cost
    between = np.linspace(plan.waypoints[:-1], plan.waypoints[1:], 200).reshape(-1, 2)
    assert (world.clearances(between) >= 0.2 - 1e-6).all()
    grid = outrider.PathPlanner("theta_star").plan(world.grid(0.2, resolution=0.1), start, goal)
    assert plan.cost <= grid.cost + 1e-9
    np.testing.assert_array_equal(planner.costs(world, [start], [goal], radius=0.2), [plan.cost])
    assert planner.plan(world, start, goal, radius=0.2, height=5.0).cost >= plan.cost
    with pytest.raises(outrider.BadInput, match="radius: missing"):
        planner.plan(world, start, goal)
    with pytest.raises(outrider.BadInput, match="only with a World"):
        planner.plan(ground, start, goal, radius=0.2)
    with pytest.raises(outrider.BadInput):
        planner.plan(world, start, goal, radius=math.nan)
    with pytest.raises(outrider.BadInput, match="grid"):
        outrider.PathPlanner("jps").plan(world, start, goal, radius=0.2)
