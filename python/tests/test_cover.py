"""Covering areas."""

import numpy as np
import outrider
import pytest

ROOM = [(0, 0), (6, 0), (6, 4), (0, 4)]
HOLE = [(2, 1.5), (4, 1.5), (4, 2.5), (2, 2.5)]


def covered_fraction(waypoints, radius, room, hole):
    """The part of a fine lattice in the free area that the disk comes over, by distances to the legs."""
    x, y = np.meshgrid(np.arange(0.2, 5.8, 0.05), np.arange(0.2, 3.8, 0.05))
    points = np.column_stack([x.ravel(), y.ravel()])
    (low, _, high, _) = hole
    points = points[~((points >= np.array(low) - 0.2) & (points <= np.array(high) + 0.2)).all(axis=1)]
    nearest = np.full(len(points), np.inf)
    for a, b in zip(waypoints[:-1], waypoints[1:]):
        leg = b - a
        length2 = max(leg @ leg, 1e-18)
        along = np.clip((points - a) @ leg / length2, 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(points - a - along[:, None] * leg, axis=1))
    return (nearest <= radius + 1e-9).mean()


@pytest.mark.parametrize("method", outrider.cover_methods())
def test_a_track_covers_what_it_says(method):
    problem = outrider.CoverProblem(ROOM, holes=[HOLE], width=0.4, tracking_error=0.01)
    plan = outrider.CoverPlanner(method).plan(problem)
    outrider.check(plan, problem)
    proof = outrider.prove(plan, problem)
    assert proof.complete and proof.sure_fraction > 0.95 and len(proof.missed) == 0
    assert proof.planned_fraction >= proof.sure_fraction
    assert covered_fraction(plan.waypoints, 0.2, ROOM, HOLE) > 0.99
    legs = np.linalg.norm(np.diff(plan.waypoints, axis=0), axis=1)
    assert legs.sum() == pytest.approx(plan.length, rel=1e-3) and plan.length >= proof.length_bound
    assert proof.clearance >= 0.2 - 1e-6


def test_a_track_of_another_area_is_refused():
    problem = outrider.CoverProblem(ROOM, width=0.4)
    plan = outrider.CoverPlanner("boustrophedon").plan(problem)
    with pytest.raises(outrider.BadInput):
        outrider.check(plan, outrider.CoverProblem(ROOM, holes=[HOLE], width=0.4))


def test_options_are_read_and_set():
    problem = outrider.CoverProblem(np.array(ROOM)[::-1], width=0.4, tool_shape="bar", tool_width=0.5, pace_speed=0.3)
    assert problem.options["tool_width"] == 0.5 and problem.options["pace_speed"] == 0.3
    assert outrider.CoverPlanner("spiral", directions=2).options["directions"] == 2
    with pytest.raises(outrider.BadInput, match="did you mean"):
        outrider.CoverProblem(ROOM, widht=0.4)


@pytest.mark.parametrize("changed", [
    {"boundary": [(0, 0), (1, 1), (1, 0), (0, 1)]}, {"boundary": [(0, 0), (1, 0)]}, {"holes": [[(9, 9), (10, 9), (9, 10)]]},
    {"width": 9.0}, {"start": (20, 20, 0)}, {"overlap": 0.95}, {"boundary": [(0, 0), (np.nan, 0), (1, 1)]},
    {"start": (1, 1)}, {"holes": [(1, 2)]}, {"boundary": "room"}, {"width": np.nan},
])
def test_what_is_no_area_is_refused(changed):
    with pytest.raises(outrider.Fault):
        outrider.CoverPlanner("spiral").plan(outrider.CoverProblem(**{"boundary": ROOM, "width": 0.4, **changed}))
