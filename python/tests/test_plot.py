"""Pictures."""

import importlib

import numpy as np
import outrider
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from outrider import plot  # noqa: E402


@pytest.fixture(autouse=True)
def closed():
    yield
    matplotlib.pyplot.close("all")


def judge(axes):
    """In metres, of equal scale, labelled."""
    assert axes.get_aspect() == 1.0
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [m]", "y [m]")
    axes.figure.canvas.draw()


def wall():
    blocked = np.zeros((40, 60), bool)
    blocked[10:, 30] = True
    return outrider.GridMap(blocked, resolution=0.1, origin=(5.0, 2.0))


def test_a_path_and_a_search_are_where_they_are(tmp_path):
    ground, start, goal = wall(), (5.55, 5.55), (10.55, 5.55)
    plan, trace = outrider.PathPlanner("a_star").trace(ground, start, goal)
    judge(plot.path(ground, plan))
    axes = plot.search(ground, plan, trace)
    judge(axes)
    places = axes.collections[0].get_offsets()
    assert len(places) == plan.expansions
    np.testing.assert_allclose(places[0], start)
    assert ((places >= (5, 2)) & (places <= (11, 6))).all()
    columns, rows = ((places - (5.0, 2.0)) / 0.1).astype(int).T
    assert not (ground.marks[rows, columns] & 1).any()
    axes.figure.savefig(tmp_path / "search.png")
    assert (tmp_path / "search.png").stat().st_size > 5000


def test_a_tour_and_a_run_are_drawn():
    problem = outrider.CoverProblem([(0, 0), (6, 0), (6, 4), (0, 4)], holes=[[(2, 1), (3, 1), (3, 2)]], width=0.4)
    judge(plot.tour(problem, outrider.CoverPlanner("spiral").plan(problem)))
    run = outrider.run("scenarios/cover/cover_room.yaml")
    axes = plot.run(run)
    judge(axes)
    assert "cover" in axes.get_title()


def test_axes_may_be_given():
    axes = matplotlib.pyplot.subplots()[1]
    assert plot.ground(outrider.OccupancyGrid(np.array([[0, 1, 2]], np.uint8)), axes=axes) is axes
    judge(axes)


def test_without_matplotlib_there_is_a_remedy(monkeypatch):
    real = importlib.import_module

    def refused(name, *rest):
        if name.startswith("matplotlib"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(importlib, "import_module", refused)
    with pytest.raises(ImportError, match="install the package python3-matplotlib"):
        plot.ground(wall())
