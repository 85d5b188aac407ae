"""Catalogues, and catching a moving target."""

import numpy as np
import outrider
import pytest


def least_catch(costs, threshold, start, target):
    """The least cost of a catch, by dynamic programming over all cells in all seconds."""
    rows, columns = costs.shape
    least = np.full(costs.shape, np.inf)
    least[start[1], start[0]] = 0.0
    best = np.inf
    for x, y in target[1:]:
        left = np.pad(least + costs, 1, constant_values=np.inf)
        least = np.min([left[dy:dy + rows, dx:dx + columns] for dy in range(3) for dx in range(3)], axis=0)
        least[costs >= threshold] = np.inf
        best = min(best, least[y, x])
        least[y, x] = np.inf  # caught: what goes on from there is no catch of this path
    return best


def random_pursuit(seed, side=14, seconds=25):
    rng = np.random.default_rng(seed)
    costs = rng.integers(1, 30, size=(side, side))
    costs[rng.random(costs.shape) < 0.2] = 100
    costs[0, 0] = 1
    steps = rng.integers(-1, 2, size=(seconds, 2))
    target = np.clip(np.cumsum(np.vstack([[side - 1, side - 1], steps]), axis=0), 0, side - 1)
    return costs, target


@pytest.mark.parametrize("seed", range(8))
def test_a_catch_costs_what_another_program_finds(seed):
    costs, target = random_pursuit(seed)
    problem = outrider.PursuitProblem(costs, threshold=100, start=(0, 0), target=target)
    expected = least_catch(costs, 100, (0, 0), target)
    planner = outrider.PursuitPlanner("optimal")
    if np.isinf(expected):
        with pytest.raises(outrider.NoPath):
            planner.plan(problem)
        return
    plan = planner.plan(problem)
    assert plan.cost == plan.lower_bound == expected and plan.optimal
    assert tuple(plan.path[0]) == (0, 0) and tuple(plan.path[-1]) == tuple(target[plan.catch_time_s])
    outrider.check(plan, problem)
    other = outrider.PursuitProblem(costs + 1, threshold=101, start=(0, 0), target=target)
    with pytest.raises(outrider.BadInput):
        outrider.check(plan, other)


def test_every_planner_of_a_pursuit_is_checked():
    costs, target = random_pursuit(0)
    problem = outrider.PursuitProblem(costs, threshold=100, start=(0, 0), target=target)
    outrider.PursuitPlanner("optimal").plan(problem)  # the premise: there is a catch
    for name in outrider.pursuit_planners():
        planner = outrider.PursuitPlanner(name)
        assert planner.sentence and planner.guarantee["sentence"]
        try:
            outrider.check(planner.plan(problem), problem)
        except outrider.BudgetExhausted:
            assert not planner.guarantee["complete"]


def test_costs_are_a_view_that_stays():
    costs, target = random_pursuit(2)
    view = outrider.PursuitProblem(costs[::-1][::-1], threshold=100, start=(0, 0), target=target).costs
    assert not view.flags.writeable
    np.testing.assert_array_equal(view, costs)


def test_pursuit_maps_are_read():
    problem = outrider.PursuitProblem.load("scenarios/pursuit/park.txt")
    assert problem.costs.ndim == 2 and len(problem.target) > 1
    with pytest.raises(outrider.BadInput, match="none.txt"):
        outrider.PursuitProblem.load("none.txt")


@pytest.mark.parametrize("changed, words", [
    ({"costs": np.ones((4, 4))}, "dtype"), ({"costs": np.ones(4, int)}, "shape"),
    ({"costs": np.full((4, 4), -1)}, "-1"), ({"costs": np.full((4, 4), 2**40)}, "1099511627776"),
    ({"costs": "costs"}, "integers"), ({"start": (0.5, 0.0)}, "dtype"), ({"start": (9, 9)}, ""),
    ({"start": (2**40, 0)}, "no cell"), ({"start": (0, 0, 0)}, "shape"), ({"target": [(0, 0, 1)]}, "shape"),
    ({"target": [(7, 7)]}, ""), ({"target": np.zeros((0, 2), int)}, ""), ({"start_s": -1}, ""),
])
def test_what_is_no_pursuit_is_refused(changed, words):
    arguments = {"costs": np.ones((4, 4), int), "threshold": 9, "start": (0, 0), "target": [(3, 3), (3, 3)]}
    with pytest.raises(outrider.Fault, match=words):
        outrider.PursuitProblem(**{**arguments, **changed})


@pytest.mark.parametrize("catalogue", ["path_planners", "pursuit_planners", "cover_methods", "explore_strategies",
                                       "guard_planners", "jobs"])
def test_catalogues_are_listed(catalogue):
    rows = getattr(outrider, catalogue)()
    assert len(rows) >= 1
    for name, row in rows.items():
        assert row.keys() == {"sentence", "source", "guarantee", "options", "help"} and row["sentence"], name
        assert row["help"].keys() == row["options"].keys() and all(row["help"].values()), name
        assert row["guarantee"] or catalogue == "jobs"
    assert any(row["options"] for row in rows.values()) or catalogue == "pursuit_planners"
