from collections.abc import Sequence
from os import PathLike
from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

__version__: str

Point = Sequence[float] | npt.NDArray[np.float64]
Points = Sequence[Sequence[float]] | npt.NDArray[np.float64]
Value = bool | int | float | str

class Guarantee(TypedDict):
    complete: bool
    most_ratio: float
    sentence: str

class GridMap:
    """Ground as a grid of free and blocked cells, read-only.

    `blocked` has shape (rows, columns) and dtype bool or uint8; row 0 has the lowest y; what is not 0 is blocked.
    `origin` is the lowest corner of the first cell. Vertices of the model "cells" are centres of cells, of "corners"
    their corners.
    """

    def __init__(
        self,
        blocked: npt.NDArray[np.bool_] | npt.NDArray[np.uint8],
        *,
        resolution: float = 1.0,
        origin: Point = (0.0, 0.0),
        model: str = "cells",
    ) -> None: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def resolution(self) -> float: ...
    @property
    def origin(self) -> tuple[float, float]: ...
    @property
    def model(self) -> str: ...
    @property
    def marks(self) -> npt.NDArray[np.uint8]:
        """A view of the cells, of shape (rows, columns). Bit 0 is set where a cell is blocked."""

class Plan:
    """A path with its cost and a proven lower bound."""

    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """Start, points where the path turns, and goal; shape (n, 2)."""
    @property
    def cost(self) -> float: ...
    @property
    def lower_bound(self) -> float:
        """Proven: no path of the planner's class costs less."""
    @property
    def length(self) -> float: ...
    @property
    def expansions(self) -> int: ...

class PathPlanner:
    """A planner of the catalogue with its options and its memory. One thread at a time; others are refused."""

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def sentence(self) -> str: ...
    @property
    def paper(self) -> str: ...
    @property
    def guarantee(self) -> Guarantee: ...
    @property
    def options(self) -> dict[str, Value]: ...
    def set(self, option: str, value: Value) -> None: ...
    def plan(self, map: GridMap, start: Point, goal: Point, *, most_expansions: int | None = None) -> Plan: ...
    def trace(
        self, map: GridMap, start: Point, goal: Point, *, most_expansions: int | None = None
    ) -> tuple[Plan, npt.NDArray[np.void]]:
        """Plans, and returns the expansions in their order, as records (state, parent, f, g, h)."""
    def costs(self, map: GridMap, starts: Points, goals: Points) -> npt.NDArray[np.float64]:
        """The cost from each start to its goal; NaN where it is proven that there is no path."""

class Run:
    """A finished run of a job."""

    @property
    def status(self) -> str: ...
    @property
    def job(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def metrics(self) -> dict[str, float]: ...
    @property
    def settings(self) -> dict[str, str]: ...
    @property
    def tables(self) -> dict[str, dict[str, list[Any]]]:
        """By name: a list of values for each column, as pandas.DataFrame takes it."""
    @property
    def log(self) -> dict[str, npt.NDArray[np.void]]:
        """Messages as records, by topic; sequences as arrays of their own, such as "scan/ranges"."""
    @property
    def result(self) -> str:
        """The text of run.json."""
    def save(self, folder: str | PathLike[str]) -> dict[str, str]:
        """Writes run.json, run.mcap, run.svg and the files of the job, and returns their paths by name."""

def run(scenario: str | PathLike[str], *, seed: int | None = None, set: dict[str, Value] = ...) -> Run:
    """Runs the job of a scenario file, with options set by key, such as {"robot.radius": 0.2}."""

def jobs() -> dict[str, str]:
    """The jobs, with a sentence for each."""

def path_planners() -> list[str]:
    """The names of the path planners."""

def check(plan: Plan, map: GridMap, start: Point, goal: Point) -> None:
    """Verifies a plan by code that shares nothing with the planners; raises BadInput if it is wrong."""

def read_log(path: str | PathLike[str], *, topics: Sequence[str] = ...) -> dict[str, npt.NDArray[np.void]]:
    """The messages of a log (MCAP, ROS 1 bag, ROS 2 db3) as Run.log has them. Warns if the end of the file is missing."""
