"""Pictures by matplotlib: one call each for a path, a run, a search and a tour.

    from outrider import plot

    axes = plot.path(ground, plan)
    axes.figure.savefig("path.png")

Each function draws into `axes`, or into a new figure, and returns the axes: in metres, of equal scale, labelled.
"""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
import numpy.typing as npt

from ._outrider import CoverPlan, CoverProblem, GridMap, OccupancyGrid, Plan, Run

Axes = Any
"""The type of the axes; matplotlib has no types."""
Ground = GridMap | OccupancyGrid

_BLOCKED, _UNKNOWN, _FREE = (0.25, 0.27, 0.3), (0.8, 0.82, 0.85), (1.0, 1.0, 1.0)
_PATH = "#d6336c"


def _module(name: str) -> Any:
    try:
        return importlib.import_module(f"matplotlib.{name}")
    except ImportError as missing:
        raise ImportError("outrider.plot needs matplotlib; install the package python3-matplotlib, or "
                          "'pip install matplotlib'") from missing


def _new_axes(axes: Axes | None) -> Axes:
    if axes is None:
        axes = _module("pyplot").subplots(layout="constrained")[1]
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    return axes


def ground(ground: Ground, *, axes: Axes | None = None) -> Axes:
    """Draws free, blocked and unknown cells."""
    axes = _new_axes(axes)
    cells = ground.marks & 1 if isinstance(ground, GridMap) else ground.cells
    rows, columns = cells.shape
    (x, y), side = ground.origin, ground.resolution
    axes.imshow(np.array([_FREE, _BLOCKED, _UNKNOWN])[cells], origin="lower", interpolation="nearest",
                extent=(x, x + columns * side, y, y + rows * side), zorder=0)
    return axes


def _ends(axes: Axes, points: npt.NDArray[np.float64]) -> None:
    axes.plot(*points[0], "o", color="#2b8a3e", label="start", zorder=4)
    axes.plot(*points[-1], "s", color="#1864ab", label="end", zorder=4)


def path(ground_: Ground, plan: Plan, *, axes: Axes | None = None) -> Axes:
    """Draws the path of a plan on its map."""
    axes = ground(ground_, axes=axes)
    axes.plot(*plan.waypoints.T, color=_PATH, linewidth=1.8, label=f"{plan.length:.2f} m", zorder=3)
    _ends(axes, plan.waypoints)
    axes.legend(loc="best")
    return axes


def search(map: GridMap, plan: Plan, trace: npt.NDArray[Any], *, axes: Axes | None = None) -> Axes:
    """Draws the expansions of PathPlanner.trace() on a grid, coloured by their order, and the path."""
    axes = path(map, plan, axes=axes)
    stride = map.shape[1] + 2
    vertices = np.column_stack([trace["state"] % stride, trace["state"] // stride]) - 1.0
    places = (vertices + (0.5 if map.model == "cells" else 0.0)) * map.resolution + map.origin
    dots = axes.scatter(*places.T, c=np.arange(1, len(places) + 1), s=6, cmap="viridis", zorder=2)
    axes.figure.colorbar(dots, ax=axes, label="expansion", shrink=0.8)
    return axes


def tour(problem: CoverProblem, plan: CoverPlan, *, axes: Axes | None = None) -> Axes:
    """Draws the track of a coverage in its area, coloured by the length driven."""
    axes = _new_axes(axes)
    axes.fill(*problem.boundary.T, facecolor=_FREE, edgecolor=_BLOCKED, linewidth=1.5, zorder=0)
    for hole in problem.holes:
        axes.fill(*hole.T, color=_BLOCKED, zorder=1)
    points = plan.waypoints
    driven = np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))
    legs = axes.add_collection(_module("collections").LineCollection(
        np.stack([points[:-1], points[1:]], axis=1), array=driven, cmap="viridis", linewidths=1.4, zorder=2))
    axes.figure.colorbar(legs, ax=axes, label="driven [m]", shrink=0.8)
    _ends(axes, points)
    axes.legend(loc="best")
    axes.autoscale_view()
    return axes


def _footprints(log: dict[str, npt.NDArray[np.void]]) -> list[npt.NDArray[np.float64]]:
    """The outlines of the solids that stand on the ground."""
    polygons, points = log.get("solids/solids/footprint"), log.get("solids/solids/footprint/points")
    if polygons is None or points is None:
        return []
    corners = np.column_stack([points["x"], points["y"]])
    return [corners[ends["begin"]:ends["end"]] for ends in polygons["points"]]


def run(run: Run, *, axes: Axes | None = None) -> Axes:
    """Draws the solids seen from above and the way of the robot in a run, from its log."""
    axes = _new_axes(axes)
    poses = run.log.get("pose")
    if poses is None or len(poses) == 0:
        raise ValueError(f"the log of this run of '{run.job}' has no poses; its channels are {', '.join(run.log)}")
    position = poses["message"]["pose"]["position"]
    points = np.column_stack([position["x"], position["y"]])
    for outline in _footprints(run.log):
        axes.fill(*outline.T, color=_BLOCKED, alpha=0.8, zorder=1)
    axes.plot(*points.T, color=_PATH, linewidth=1.5, label="robot", zorder=3)
    _ends(axes, points)
    axes.set_title(f"{run.job}: {run.status}")
    axes.legend(loc="best")
    return axes
