from collections.abc import Iterable, Sequence
from os import PathLike
from typing import Any, TypedDict, overload

import numpy as np
import numpy.typing as npt

__version__: str

Point = Sequence[float] | npt.NDArray[np.float64]
Points = Sequence[Sequence[float]] | npt.NDArray[np.float64]
Value = bool | int | float | str

Cell = Sequence[int] | npt.NDArray[np.integer[Any]]
"""Column and row, which count from 0."""
Cells = Sequence[Sequence[int]] | npt.NDArray[np.integer[Any]]
Pose = Sequence[float] | npt.NDArray[np.float64]
"""x, y in m and heading in rad."""

class Row(TypedDict):
    """A row of a catalogue."""

    sentence: str
    source: str
    guarantee: str
    options: dict[str, Value]

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

def jobs() -> dict[str, Row]:
    """The jobs by name; options by the keys that `set` of run() takes."""

def path_planners() -> dict[str, Row]:
    """The path planners by name."""

def pursuit_planners() -> dict[str, Row]:
    """The pursuit planners by name."""

def cover_methods() -> dict[str, Row]:
    """The methods of covering an area by name."""

def explore_strategies() -> dict[str, Row]:
    """The strategies of exploration by name."""

def guard_planners() -> dict[str, Row]:
    """The guard planners by name."""

@overload
def check(plan: Plan, map: GridMap, start: Point, goal: Point) -> None: ...
@overload
def check(plan: PursuitPlan, problem: PursuitProblem) -> None: ...
@overload
def check(plan: CoverPlan, problem: CoverProblem) -> None:
    """Verifies a plan by code that shares nothing with the planners; raises BadInput if it is wrong."""

class PursuitGuarantee(TypedDict):
    complete: bool
    optimal: bool
    sentence: str

class PursuitProblem:
    """A robot on a grid of costs has to be in the cell of a moving target in the same second.

    `costs` are integers of shape (rows, columns): the cost of one second in each cell; row 0 has the lowest y. Cells of
    `threshold` or more are walls. `target` has the cell of the target in second 0, 1, ...; cells are (column, row).
    """

    def __init__(
        self, costs: npt.NDArray[np.integer[Any]], *, threshold: int, start: Cell, target: Cells, start_s: int = 0
    ) -> None: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> PursuitProblem:
        """Reads a pursuit map."""
    @property
    def costs(self) -> npt.NDArray[np.uint32]:
        """A view."""
    @property
    def threshold(self) -> int: ...
    @property
    def start(self) -> tuple[int, int]: ...
    @property
    def target(self) -> npt.NDArray[np.int64]: ...
    @property
    def start_s(self) -> int: ...

class PursuitPlan:
    """The robot's cell in each second until the catch."""

    @property
    def path(self) -> npt.NDArray[np.int64]:
        """Cells, one for each second from `start_s`; shape (n, 2)."""
    @property
    def catch_time_s(self) -> int: ...
    @property
    def cost(self) -> int: ...
    @property
    def lower_bound(self) -> int:
        """Proven: no catch costs less. 0 if nothing is proven."""
    @property
    def earliest_catch_s(self) -> int | None:
        """The first second in which a catch is possible, if it is known."""
    @property
    def optimal(self) -> bool: ...
    @property
    def expansions(self) -> int: ...

class PursuitPlanner:
    """A pursuit planner with its options and its memory. One thread at a time; others are refused."""

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def sentence(self) -> str: ...
    @property
    def paper(self) -> str: ...
    @property
    def guarantee(self) -> PursuitGuarantee: ...
    @property
    def options(self) -> dict[str, Value]: ...
    def set(self, option: str, value: Value) -> None: ...
    def plan(self, problem: PursuitProblem, *, most_expansions: int | None = None) -> PursuitPlan:
        """Plans a catch; Ctrl-C ends it. Raises NoPath where it is proven that there is none."""

class CoverProblem:
    """Areas, and the robot that has to cover them.

    `boundary`, each of `holes` and of `others` (further areas) are the corners of simple polygons. Options, in m and as
    in scenarios: width, overlap, tracking_error, uncovered, turning_radius, reverse, headland, transfers; tool_shape,
    ... of the tool; pace_speed, ... of the pace.
    """

    def __init__(
        self,
        boundary: Points,
        *,
        holes: Iterable[Points] = (),
        others: Iterable[Points] = (),
        start: Pose | None = None,
        **options: Value,
    ) -> None: ...
    @property
    def boundary(self) -> npt.NDArray[np.float64]: ...
    @property
    def holes(self) -> list[npt.NDArray[np.float64]]: ...
    @property
    def options(self) -> dict[str, Value]: ...

class CoverPlan:
    """A track that covers the areas."""

    @property
    def method(self) -> str: ...
    @property
    def start(self) -> npt.NDArray[np.float64]:
        """x, y and heading in rad."""
    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """The track from its start, with arcs in steps of at most 5 degrees; shape (n, 2)."""
    @property
    def length(self) -> float: ...
    @property
    def turned(self) -> float:
        """Turned in place and along arcs, rad."""
    @property
    def time(self) -> float:
        """At full speed, s."""
    @property
    def order_bound(self) -> float:
        """Proven: no order of the same laps and cells takes less, s."""
    @property
    def laps(self) -> int: ...
    @property
    def lanes(self) -> int: ...
    @property
    def cells(self) -> int: ...

class CoverPlanner:
    """A method of covering areas, with its options."""

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def sentence(self) -> str: ...
    @property
    def guarantee(self) -> str: ...
    @property
    def options(self) -> dict[str, Value]: ...
    def plan(self, problem: CoverProblem, *, most_expansions: int | None = None) -> CoverPlan:
        """Plans a track; Ctrl-C ends it."""

class CoverProof:
    """What is proven of a track, from the track and the area alone. Fractions are of what the robot can reach."""

    @property
    def planned_fraction(self) -> float:
        """Covered by a robot exactly on the track."""
    @property
    def sure_fraction(self) -> float:
        """Covered for every tracking error allowed."""
    @property
    def inner_fraction(self) -> float:
        """The same, of all within the sure radius of where the robot can stand."""
    @property
    def clearance(self) -> float: ...
    @property
    def length_bound(self) -> float:
        """No track that covers all is shorter, m."""
    @property
    def complete(self) -> bool:
        """No more is left out than the problem allows."""
    @property
    def missed(self) -> npt.NDArray[np.float64]:
        """What is left out, the largest first: x, y, area in m2; shape (n, 3)."""

def prove(plan: CoverPlan, problem: CoverProblem) -> CoverProof:
    """What is proven of a track; raises BadInput if it is no track of the problem."""

def read_log(path: str | PathLike[str], *, topics: Sequence[str] = ...) -> dict[str, npt.NDArray[np.void]]:
    """The messages of a log (MCAP, ROS 1 bag, ROS 2 db3) as Run.log has them. Warns if the end of the file is missing."""
