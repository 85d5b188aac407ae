from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Protocol, TypedDict, overload

import numpy as np
import numpy.typing as npt

__version__: str

Point = Sequence[float] | npt.NDArray[np.floating[Any]]
Points = Sequence[Sequence[float]] | npt.NDArray[np.floating[Any]]
Value = bool | int | float | str

Cell = Sequence[int] | npt.NDArray[np.integer[Any]]
"""Column and row, which count from 0."""
Cells = Sequence[Sequence[int]] | npt.NDArray[np.integer[Any]]
Pose = Sequence[float] | npt.NDArray[np.floating[Any]]
"""x, y in m and heading in rad."""

class Row(TypedDict):
    """A row of a catalogue: the defaults of its options, and what each of them means, with unit and range."""

    sentence: str
    source: str
    guarantee: str
    options: dict[str, Value]
    help: dict[str, str]

class Guarantee(TypedDict):
    """The promise of a path planner: `most_ratio` is how many times the least cost its cost is at most."""

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
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
    @property
    def resolution(self) -> float:
        """Side of a cell, m."""
    @property
    def origin(self) -> tuple[float, float]:
        """Lowest corner of the first cell, m."""
    @property
    def model(self) -> str:
        """"cells" or "corners"."""
    @property
    def marks(self) -> npt.NDArray[np.uint8]:
        """A view of the cells, of shape (rows, columns). Bit 0 is set where a cell is blocked."""

class PolygonMap:
    """Ground as polygons for the centre of a disk of `radius` m, read-only.

    `boundary` and each of `obstacles` are the corners of simple polygons, of shape (n, 2), m. The visibility planners
    work on it. Raises BadInput for a polygon that crosses itself or has no area.
    """

    def __init__(self, boundary: Points, *, obstacles: Iterable[Points] = (), radius: float = 0.18) -> None: ...
    @property
    def boundary(self) -> npt.NDArray[np.float64]:
        """Clockwise."""
    @property
    def obstacles(self) -> list[npt.NDArray[np.float64]]:
        """Counter-clockwise."""
    @property
    def radius(self) -> float:
        """Radius of the disk, m."""

class Plan:
    """A path with its cost and a proven lower bound."""

    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """Start, points where the path turns, and goal; shape (n, 2)."""
    @property
    def cost(self) -> float:
        """Its length in m, or what the planner minimises, such as its time in s."""
    @property
    def lower_bound(self) -> float:
        """Proven: no path of the planner's class costs less."""
    @property
    def length(self) -> float:
        """Length of the path, m."""
    @property
    def expansions(self) -> int:
        """States that the search expanded."""

class PathPlanner:
    """A planner of the catalogue with its options and its memory. One thread at a time; others are refused.

    `path_planners()[name]["help"]` says what each option means.
    """

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str:
        """In the catalogue."""
    @property
    def sentence(self) -> str:
        """A sentence on what the planner does."""
    @property
    def paper(self) -> str:
        """Its source."""
    @property
    def guarantee(self) -> Guarantee:
        """The promises: completeness, by how much the cost may exceed the least one, and both in words."""
    @property
    def options(self) -> dict[str, Value]:
        """Present values by name; path_planners() says what each means. Angles in degrees."""
    def set(self, option: str, value: Value) -> None:
        """Sets an option; raises BadInput for a name or a value that it does not take."""
    def plan(
        self,
        map: GridMap | PolygonMap | World,
        start: Point,
        goal: Point,
        *,
        radius: float | None = None,
        height: float = 0.2,
        most_expansions: int | None = None,
    ) -> Plan:
        """Plans a path. On a World, `radius` and `height` are those of the robot, m, and the planner takes polygons.

        Raises NoPath where it is proven that there is none, StartBlocked, GoalBlocked, ...
        """
    def trace(
        self,
        map: GridMap | PolygonMap | World,
        start: Point,
        goal: Point,
        *,
        radius: float | None = None,
        height: float = 0.2,
        most_expansions: int | None = None,
    ) -> tuple[Plan, npt.NDArray[np.void]]:
        """Plans, and returns the expansions in their order, as records (state, parent, f, g, h)."""
    def costs(
        self,
        map: GridMap | PolygonMap | World,
        starts: Points,
        goals: Points,
        *,
        radius: float | None = None,
        height: float = 0.2,
    ) -> npt.NDArray[np.float64]:
        """The cost from each start to its goal; NaN where it is proven that there is no path."""

class Run:
    """A finished run of a job."""

    @property
    def status(self) -> str:
        """"done", "not_done", "cancelled", or a word of the job, such as "unconfirmed"."""
    @property
    def job(self) -> str:
        """Its name."""
    @property
    def reason(self) -> str:
        """One sentence that says why it is not done; empty if it is."""
    @property
    def warnings(self) -> list[str]:
        """Sentences on what was repaired in the inputs or left out of them."""
    @property
    def metrics(self) -> dict[str, float]:
        """As in run.json; names end with their units."""
    @property
    def settings(self) -> dict[str, str]:
        """Every option of the run with its value and unit, by key."""
    @property
    def tables(self) -> dict[str, dict[str, list[Any]]]:
        """The tables by name: a list of values for each column, as pandas.DataFrame takes it."""
    @property
    def log(self) -> dict[str, npt.NDArray[np.void]]:
        """Messages as records, by topic; sequences as arrays of their own, such as "scan/ranges"."""
    @property
    def result(self) -> str:
        """The text of run.json."""
    def save(self, folder: str | PathLike[str]) -> dict[str, str]:
        """Writes run.json, run.mcap, run.svg and the files of the job, and returns their paths by name."""

def run(scenario: str | PathLike[str], *, seed: int | None = None, set: dict[str, Value] = {}) -> Run:
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
def check(
    plan: Plan,
    map: GridMap | PolygonMap | World,
    start: Point,
    goal: Point,
    *,
    radius: float | None = None,
    height: float = 0.2,
) -> None: ...
@overload
def check(plan: PursuitPlan, problem: PursuitProblem) -> None: ...
@overload
def check(plan: CoverPlan, problem: CoverProblem) -> None:
    """Verifies a plan by code that shares nothing with the planners; raises BadInput if it is wrong."""

class PursuitGuarantee(TypedDict):
    """The promise of a pursuit planner."""

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
    def threshold(self) -> int:
        """Cells of this cost or more are walls."""
    @property
    def start(self) -> tuple[int, int]:
        """Cell of the robot at `start_s`."""
    @property
    def target(self) -> npt.NDArray[np.int64]:
        """Cell of the target in second 0, 1, ...; shape (n, 2)."""
    @property
    def start_s(self) -> int:
        """The second in which the plan begins."""

class PursuitPlan:
    """The robot's cell in each second until the catch."""

    @property
    def path(self) -> npt.NDArray[np.int64]:
        """Cells, one for each second from `start_s`; shape (n, 2)."""
    @property
    def catch_time_s(self) -> int:
        """The second of the catch."""
    @property
    def cost(self) -> int:
        """Sum of the costs of the cells until the catch."""
    @property
    def lower_bound(self) -> int:
        """Proven: no catch costs less. 0 if nothing is proven."""
    @property
    def earliest_catch_s(self) -> int | None:
        """The first second in which a catch is possible, if it is known."""
    @property
    def optimal(self) -> bool:
        """Proven: no catch costs less."""
    @property
    def expansions(self) -> int:
        """States that the search expanded."""

class PursuitPlanner:
    """A pursuit planner with its options and its memory. One thread at a time; others are refused.

    `pursuit_planners()[name]["help"]` says what each option means.
    """

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str:
        """In the catalogue."""
    @property
    def sentence(self) -> str:
        """A sentence on what the planner does."""
    @property
    def paper(self) -> str:
        """Its source."""
    @property
    def guarantee(self) -> PursuitGuarantee:
        """The promises: completeness and optimality, and both in words."""
    @property
    def options(self) -> dict[str, Value]:
        """Present values by name; pursuit_planners() says what each means."""
    def set(self, option: str, value: Value) -> None:
        """Sets an option; raises BadInput for a name or a value that it does not take."""
    def plan(self, problem: PursuitProblem, *, most_expansions: int | None = None) -> PursuitPlan:
        """Plans a catch; Ctrl-C ends it. Raises NoPath where it is proven that there is none."""

class CoverProblem:
    """Areas, and the robot that has to cover them.

    `boundary`, each of `holes` and of `others` (further areas) are the corners of simple polygons, m.
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
    def boundary(self) -> npt.NDArray[np.float64]:
        """Corners of the first area, m; shape (n, 2)."""
    @property
    def holes(self) -> list[npt.NDArray[np.float64]]:
        """Corners of each hole, m."""
    @property
    def options(self) -> dict[str, Value]:
        """Present values by name; angles in degrees."""

class CoverPlan:
    """A track that covers the areas."""

    @property
    def method(self) -> str:
        """Name of the method."""
    @property
    def start(self) -> npt.NDArray[np.float64]:
        """x, y and heading in rad."""
    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """The track from its start, with arcs in steps of at most 5 degrees; shape (n, 2)."""
    @property
    def length(self) -> float:
        """Length of the track, m."""
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
    def laps(self) -> int:
        """Rounds along the edges."""
    @property
    def lanes(self) -> int:
        """Straight lanes."""
    @property
    def cells(self) -> int:
        """Parts into which the area was cut."""

class CoverPlanner:
    """A method of covering areas, with its options."""

    def __init__(self, name: str, **options: Value) -> None: ...
    @property
    def name(self) -> str:
        """In the catalogue."""
    @property
    def sentence(self) -> str:
        """A sentence on what the method does."""
    @property
    def guarantee(self) -> str:
        """The promise of the method, in words."""
    @property
    def options(self) -> dict[str, Value]:
        """Present values by name; angles in degrees."""
    def plan(self, problem: CoverProblem, *, most_expansions: int | None = None) -> CoverPlan:
        """Plans a track; Ctrl-C ends it."""

class CoverProof:
    """The proof of a track, from the track and the area alone. Fractions are of what the robot can reach."""

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
    def clearance(self) -> float:
        """Least distance of the robot's middle to an edge, m."""
    @property
    def length_bound(self) -> float:
        """No track that covers all is shorter, m."""
    @property
    def complete(self) -> bool:
        """No more is left out than the problem allows."""
    @property
    def missed(self) -> npt.NDArray[np.float64]:
        """The parts that are left out, the largest first: x, y, area in m2; shape (n, 3)."""

def prove(plan: CoverPlan, problem: CoverProblem) -> CoverProof:
    """Returns what is proven of a track; raises BadInput if it is no track of the problem."""

class OccupancyGrid:
    """A map of free (0), occupied (1) and unknown (2) cells, read-only; row 0 has the lowest y."""

    def __init__(
        self, cells: npt.NDArray[np.bool_] | npt.NDArray[np.uint8], *, resolution: float = 0.05, origin: Point = (0.0, 0.0)
    ) -> None: ...
    @property
    def cells(self) -> npt.NDArray[np.uint8]:
        """A view."""
    @property
    def resolution(self) -> float:
        """Side of a cell, m."""
    @property
    def origin(self) -> tuple[float, float]:
        """Lowest corner of the first cell, m."""
    def ground(self) -> GridMap:
        """Ground for path planners, where what is not free is blocked."""

class Frontier(TypedDict):
    """A frontier: the centres of its cells, shape (n, 2), m."""

    id: int
    points: npt.NDArray[np.float64]
    centroid: tuple[float, float]
    group: int

class FrontierMap:
    """The frontiers between free and unknown cells of a growing map, for a robot of that radius."""

    def __init__(self, radius: float, **options: Value) -> None: ...
    def update(self, grid: OccupancyGrid | LaserSlam) -> None:
        """Takes the map as it is now; frontiers keep their ids.

        A grid is compared with the one before, cell by cell. Of a LaserSlam only what has changed is read.
        """
    @property
    def frontiers(self) -> list[Frontier]:
        """The frontiers by id; `points` are the centres of its cells, `group` is equal for those that hang together."""
    @property
    def ground(self) -> GridMap:
        """The places where the robot may stand: known free cells, far enough from what is occupied."""

class PoseGraphSolution:
    """The most likely poses of a graph."""

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Shape (n, 3): x, y, heading in rad; in space (n, 4, 4)."""
    @property
    def cost(self) -> float:
        """Half the sum of the squared errors of all edges, weighted by their information."""
    @property
    def start_cost(self) -> float:
        """Before it began."""
    @property
    def status(self) -> str:
        """converged or not_converged. PoseGraph.lower_bound() says how near the least cost is."""
    @property
    def start(self) -> str:
        """Start of the best descent."""
    @property
    def iterations(self) -> int:
        """Iterations of the best descent."""
    @property
    def refused(self) -> list[int]:
        """Edges that robust "gnc" refused."""

class PoseGraphSolution3(PoseGraphSolution):
    """The most likely poses of a graph in space; `poses` has the shape (n, 4, 4)."""

class PoseGraph:
    """Poses in the plane (x, y, heading in rad) and measurements between them. The first pose stays where it is."""

    def __init__(self) -> None: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> PoseGraph:
        """Reads g2o or TORO."""
    def add_pose(self, pose: Pose) -> int:
        """Returns its number, which counts from 0."""
    def add_edge(
        self, from_pose: int, to_pose: int, measured: Pose, information: Sequence[Sequence[float]] | npt.NDArray[np.float64]
    ) -> None:
        """Adds a measured pose of one in the frame of the other, with its information matrix."""
    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Shape (n, 3)."""
    @property
    def edges(self) -> npt.NDArray[np.int64]:
        """The two poses of each edge; shape (m, 2)."""
    @property
    def degrees_of_freedom(self) -> float:
        """Measured numbers minus those that are sought."""
    def cost(self, poses: npt.NDArray[np.float64]) -> float:
        """The cost of the graph at those poses."""
    def optimise(self, *, most_iterations: int | None = None, **options: Value) -> PoseGraphSolution:
        """Finds the most likely poses; Ctrl-C ends it."""
    def lower_bound(self, poses: npt.NDArray[np.float64]) -> float:
        """Proven: no poses cost less. Good at poses of low cost."""
    def covariances(self, poses: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Covariance of each pose given the first; shape (n, 3, 3)."""
    def g2o(self, poses: npt.NDArray[np.float64]) -> str:
        """The graph as g2o text."""

class PoseGraph3:
    """Poses in space (matrices of 4 x 4) and measurements between them. The first pose stays where it is."""

    def __init__(self) -> None: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> PoseGraph3:
        """Reads g2o."""
    def add_pose(self, pose: npt.NDArray[np.float64]) -> int:
        """Returns its number, which counts from 0."""
    def add_edge(
        self, from_pose: int, to_pose: int, measured: npt.NDArray[np.float64], information: npt.NDArray[np.float64]
    ) -> None:
        """The information is of position and rotation, 6 x 6."""
    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Shape (n, 4, 4)."""
    @property
    def edges(self) -> npt.NDArray[np.int64]:
        """The two poses of each edge; shape (m, 2)."""
    @property
    def degrees_of_freedom(self) -> float:
        """Measured numbers minus those that are sought."""
    def cost(self, poses: npt.NDArray[np.float64]) -> float:
        """The cost of the graph at those poses."""
    def optimise(self, *, most_iterations: int | None = None, **options: Value) -> PoseGraphSolution3:
        """Finds the most likely poses; Ctrl-C ends it."""
    def lower_bound(self, poses: npt.NDArray[np.float64]) -> float:
        """Proven: no poses cost less. Good at poses of low cost."""
    def covariances(self, poses: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Covariance of each pose given the first, of position and rotation; shape (n, 6, 6)."""
    def g2o(self, poses: npt.NDArray[np.float64]) -> str:
        """The graph as g2o text."""

class LaserScan:
    """One revolution of a planar laser range finder: ranges in m, bearings in rad."""

    def __init__(
        self,
        ranges: Sequence[float] | npt.NDArray[np.floating[Any]],
        *,
        first: float,
        step: float,
        least: float,
        most: float,
        time: float = 0.0,
    ) -> None:
        """Ranges above `most` or infinite: free up to there; below `least` or NaN: no reading."""
    @property
    def ranges(self) -> npt.NDArray[np.float32]:
        """m, float32."""
    @property
    def first(self) -> float:
        """Bearing of the first range, rad."""
    @property
    def step(self) -> float:
        """Between two bearings, rad."""
    @property
    def least(self) -> float:
        """Below it there is no reading, m."""
    @property
    def most(self) -> float:
        """Above it all is free up to it, m."""
    @property
    def time(self) -> float:
        """s."""

class LaserStep(TypedDict):
    """The result of a step: whether the scan matched, whether the robot is lost, whether a loop was closed."""

    pose: npt.NDArray[np.float64]
    matched: bool
    lost: bool
    closed_loop: bool

class LaserSlam:
    """Localisation and mapping with a laser range finder. One thread at a time; others are refused."""

    def __init__(self, start: Pose = (0.0, 0.0, 0.0), **options: Value) -> None: ...
    def advance(self, motion: Pose, scan: LaserScan) -> LaserStep:
        """Takes the motion since the last scan, by odometry in the frame of the robot then, and the scan after it."""
    def settle(self) -> None:
        """Optimises all poses and draws the map anew."""
    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """x, y in m and heading in rad, as estimated now."""
    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """Covariance of x, y and heading of the last kept scan; shape (3, 3)."""
    @property
    def trajectory(self) -> npt.NDArray[np.float64]:
        """The start and the pose after each step; shape (n, 3)."""
    @property
    def map(self) -> OccupancyGrid:
        """The map as it is now. Only what has changed is copied, unless somebody still holds the map of before."""
    @property
    def graph(self) -> PoseGraph:
        """Its keyframes and all constraints between them."""
    @property
    def loops(self) -> int:
        """Loops closed so far."""

class LandmarkStep(TypedDict):
    """The result of a step: how many landmarks were used, refused and kept for later, and ids added and removed."""

    used: int
    refused: int
    waiting: int
    added: list[int]
    removed: list[int]
    lost: bool

class LandmarkEstimates(TypedDict):
    """Landmarks as arrays of n: shapes (n), (n, 2), (n, 2, 2), (n); m."""

    id: npt.NDArray[np.int64]
    position: npt.NDArray[np.float64]
    covariance: npt.NDArray[np.float64]
    sightings: npt.NDArray[np.int64]

class LandmarkSlam:
    """Localisation and mapping with landmarks. One thread at a time; others are refused."""

    def __init__(self, start: Pose = (0.0, 0.0, 0.0), **options: Value) -> None: ...
    @staticmethod
    def load(state: str) -> LandmarkSlam:
        """Goes on from the text of `state`."""
    def advance(
        self,
        odometry: Pose,
        covariance: npt.NDArray[np.float64],
        *,
        positions: Points,
        covariances: npt.NDArray[np.float64],
        ids: Sequence[int] | npt.NDArray[np.integer[Any]] | None = None,
    ) -> LandmarkStep:
        """Takes a motion with its covariance (3, 3), and the landmarks seen after it in the frame of the robot."""
    def settle(self) -> None:
        """Optimises all poses and landmarks."""
    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """x, y in m and heading in rad, as estimated now."""
    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """Covariance of x, y and heading; shape (3, 3)."""
    @property
    def trajectory(self) -> npt.NDArray[np.float64]:
        """The start and the pose after each step; shape (n, 3)."""
    @property
    def landmarks(self) -> LandmarkEstimates:
        """The landmarks as arrays, one entry each."""
    @property
    def cost(self) -> float:
        """Cost of the estimate, half a chi-squared."""
    @property
    def state(self) -> str:
        """All that it knows as text, for load()."""

class TagImage:
    """The AprilTags in one image of a camera; there may be none.

    `taken` is the time of exposure, s. `corners` has for each id the corners in px, of shape (4, 2): lower left, lower
    right, upper right, upper left, measured from the upper left corner of the image.
    """

    def __init__(self, *, taken: float, corners: Mapping[int, Points]) -> None: ...
    @property
    def taken(self) -> float:
        """Time of exposure, s."""
    @property
    def corners(self) -> dict[int, npt.NDArray[np.float64]]:
        """The corners by id, px; shape (4, 2)."""

class ShotResult:
    """The outcome of one shot: the target by its number, whether it was hit, and when the ball landed, s."""

    def __init__(self, *, target: int, hit: bool, landed: float) -> None: ...
    @property
    def target(self) -> int:
        """Number of the target."""
    @property
    def hit(self) -> bool:
        """True if the shot hit the target."""
    @property
    def landed(self) -> float:
        """When the flight ended, s."""

class StoreLevels:
    """Levels of the water tank, in its unit, and of the battery, J. An unlimited store is infinite."""

    def __init__(self, *, water: float = ..., charge: float = ...) -> None: ...
    @property
    def water(self) -> float:
        """In the unit of the tank."""
    @property
    def charge(self) -> float:
        """J."""

class TargetArrival:
    """An intruder that has entered, or survived a hit, walks to a place, and is there at `settles`, s."""

    def __init__(self, *, target: int, place: int, settles: float) -> None: ...
    @property
    def target(self) -> int:
        """Number of the intruder."""
    @property
    def place(self) -> int:
        """Number of the place."""
    @property
    def settles(self) -> float:
        """When it is there, s."""

class TargetObservation:
    """A place where a target was seen, m, and the time, s."""

    def __init__(self, *, target: int, time: float, position: Point) -> None: ...
    @property
    def target(self) -> int:
        """Number of the target."""
    @property
    def time(self) -> float:
        """s."""
    @property
    def position(self) -> tuple[float, float]:
        """m."""

class TargetReport:
    """The observations of a target detector since the last observation."""

    def __init__(
        self,
        *,
        arrivals: Sequence[TargetArrival] = (),
        seen: Sequence[TargetObservation] = (),
        more_to_come: bool = False,
    ) -> None: ...
    @property
    def arrivals(self) -> list[TargetArrival]:
        """Intruders that entered or moved on."""
    @property
    def seen(self) -> list[TargetObservation]:
        """In the order of time."""
    @property
    def more_to_come(self) -> bool:
        """More intruders may still enter."""

class GridObservation:
    """A team on a grid: the cell of each robot, and the cells of the target that became known, one a second.

    The first observation begins with second 0. Cells are (column, row), which count from 0.
    """

    def __init__(self, *, robots: Cells, target: Cells) -> None: ...
    @property
    def robots(self) -> npt.NDArray[np.int64]:
        """Shape (n, 2)."""
    @property
    def target(self) -> npt.NDArray[np.int64]:
        """Shape (m, 2)."""

class Observation:
    """The measurements of a robot: the time in s, the pose by odometry since the start, and what its devices add.

    `touching`: it touched something since the last observation; `touch`: the bearing of that in rad, if known. `gun`:
    yaw and pitch of the barrel relative to the robot, rad. A robot that knows its pose in the world gives that as
    odometry, as GuardMission takes it.
    """

    def __init__(
        self,
        *,
        time: float,
        odometry: Pose,
        scan: LaserScan | None = None,
        touching: bool = False,
        touch: float | None = None,
        image: TagImage | None = None,
        gun: Sequence[float] | None = None,
        shots: Sequence[ShotResult] = (),
        stores: StoreLevels | None = None,
        targets: TargetReport | None = None,
        grid: GridObservation | None = None,
    ) -> None: ...
    @property
    def time(self) -> float:
        """s."""
    @property
    def odometry(self) -> npt.NDArray[np.float64]:
        """x, y in m and heading in rad."""
    @property
    def scan(self) -> LaserScan | None:
        """Taken since the last observation."""
    @property
    def touching(self) -> bool:
        """It touched something since the last observation."""
    @property
    def touch(self) -> float | None:
        """Bearing of that, rad."""
    @property
    def image(self) -> TagImage | None:
        """The newest one, even if an earlier observation had it."""
    @property
    def gun(self) -> tuple[float, float] | None:
        """Yaw and pitch relative to the robot, rad."""
    @property
    def shots(self) -> list[ShotResult]:
        """The shots that ended since the last observation."""
    @property
    def stores(self) -> StoreLevels | None:
        """Set if water or charge is limited."""
    @property
    def targets(self) -> TargetReport | None:
        """Set if the robot has a target detector."""
    @property
    def grid(self) -> GridObservation | None:
        """Set for a team on a grid."""

class DriveTwist:
    """Drive with a constant twist until a time, then sense again: m/s ahead and to the left, rad/s, s."""

    def __init__(self, *, ahead: float, left: float = 0.0, turn: float = 0.0, until: float) -> None: ...
    @property
    def ahead(self) -> float:
        """m/s."""
    @property
    def left(self) -> float:
        """m/s."""
    @property
    def turn(self) -> float:
        """rad/s, counter-clockwise."""
    @property
    def until(self) -> float:
        """s."""

class FollowPiece:
    """Turn towards a leg or an arc, pause, and drive along it from rest to rest."""

    @property
    def from_point(self) -> tuple[float, float]:
        """Start of the piece, m."""
    @property
    def to_point(self) -> tuple[float, float]:
        """End of the piece, m."""
    @property
    def turn(self) -> float:
        """Angle of the arc, rad; 0 for a leg."""
    @property
    def backward(self) -> bool:
        """The robot drives it in reverse."""
    @property
    def pause(self) -> float:
        """Before the drive, s."""

class Wait:
    """Stand still until a time, s."""

    def __init__(self, *, until: float) -> None: ...
    @property
    def until(self) -> float:
        """s; may be infinite."""

class DriveWheels:
    """Drive with constant speeds of the wheels, rad/s in the order of the chassis, until a time; then sense again."""

    def __init__(self, *, speeds: Sequence[float] | npt.NDArray[np.float64], until: float) -> None: ...
    @property
    def speeds(self) -> npt.NDArray[np.float64]:
        """Four numbers, rad/s; what a chassis has no wheel for is 0. DriveMission.twist() tells the motion."""
    @property
    def until(self) -> float:
        """s."""

class FireInPassing:
    """A shot fired while the robot drives along a straight leg."""

    @property
    def target(self) -> int:
        """Number of the target."""
    @property
    def leg(self) -> int:
        """Index of the waypoint at which the leg ends."""
    @property
    def after(self) -> float:
        """Time of the shot, counted from the beginning of the leg, s."""
    @property
    def yaw(self) -> float:
        """Yaw of the barrel in the world, rad."""
    @property
    def pitch(self) -> float:
        """Pitch of the barrel, rad."""
    @property
    def speed(self) -> float:
        """Speed of the ball at the muzzle, m/s; the velocity of the robot is added."""

class FollowWaypoints:
    """Turn in place towards the next waypoint, drive straight to it and stop, until the last one.

    The command does not wait for the balls of its shots to land.
    """

    def __init__(self, waypoints: Points, *, until_arrival: bool = False) -> None: ...
    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """Shape (n, 2), m; the first is where the robot is."""
    @property
    def until_arrival(self) -> bool:
        """Stop at the next waypoint once an intruder enters."""
    @property
    def shots(self) -> list[FireInPassing]:
        """In the order of time."""
    @property
    def aim(self) -> AimGun | None:
        """Direction of the barrel on arrival, to which it turns during the drive, after the last shot."""

class AimGun:
    """Turn the barrel to a yaw and a pitch in the world, rad."""

    def __init__(self, *, yaw: float, pitch: float) -> None: ...
    @property
    def yaw(self) -> float:
        """In the world, rad."""
    @property
    def pitch(self) -> float:
        """rad."""

class Fire:
    """Fire along the barrel, and tell the outcome as a ShotResult: angles in rad, the speed at the muzzle in m/s."""

    def __init__(
        self, *, target: int, yaw: float, pitch: float, speed: float, until_landed: bool = True
    ) -> None: ...
    @property
    def target(self) -> int:
        """Number of the target."""
    @property
    def yaw(self) -> float:
        """Yaw of the barrel in the world, rad."""
    @property
    def pitch(self) -> float:
        """Pitch of the barrel, rad."""
    @property
    def speed(self) -> float:
        """Speed of the ball at the muzzle, m/s."""
    @property
    def until_landed(self) -> bool:
        """The command ends when the ball has landed; otherwise at once, and the outcome is told later."""

class Fill:
    """Fill a store completely at the station where the robot stands."""

    @property
    def station(self) -> int:
        """Index in GuardMission.stations."""
    @property
    def store(self) -> str:
        """One of "water" and "charge"."""

class StepToCell:
    """Move one robot of a team to a neighbouring cell, or let it stay; the step takes one second."""

    def __init__(self, cell: Cell, *, robot: int = 0) -> None: ...
    @property
    def robot(self) -> int:
        """Its number in the team."""
    @property
    def cell(self) -> tuple[int, int]:
        """Column and row."""

Command = (
    DriveTwist | DriveWheels | FollowPiece | FollowWaypoints | Wait | AimGun | Fire | Fill | StepToCell
)

class Robot(Protocol):
    """A robot, real or simulated, that carries a mission out: any class with these two methods."""

    def sense(self) -> Observation:
        """Returns what it senses now; each event since the last observation once."""
    def act(self, command: Any, /) -> None:
        """Carries the command out and returns when it is done."""

class Mission(Protocol):
    """A mission answers each observation with a command: any class with this method; None ends the mission."""

    def step(self, observation: Observation, /) -> Command | None:
        """Returns the next command, or None when the mission is over."""

class CoverMission:
    """Drives the track of a plan, piece by piece."""

    def __init__(self, plan: CoverPlan, *, pause: float = 0.0) -> None: ...
    def step(self, observation: Observation) -> FollowPiece | None:
        """Returns the next command, or None after the last piece."""

class ExploreMission:
    """Maps a building that nobody knows, and comes home. Its robot senses scans and takes DriveTwist."""

    def __init__(self, start: Pose = (0.0, 0.0, 0.0), **options: Value) -> None: ...
    def step(self, observation: Observation) -> DriveTwist | None:
        """Returns the next command, or None when the mission is over."""
    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """The pose that the robot believes to have."""
    @property
    def stop_reason(self) -> str:
        """complete, left_over, budget, leak, stuck, lost or blind; empty while it explores."""
    @property
    def reason(self) -> str:
        """The stop reason as a sentence."""
    @property
    def home(self) -> bool:
        """The robot is back at its start."""
    @property
    def map(self) -> OccupancyGrid:
        """A copy."""

class DriveArrival(TypedDict):
    """A stop at which the robot stood: the number of the waypoint, s, the believed pose, why it is unconfirmed."""

    waypoint: int
    time: float
    pose: npt.NDArray[np.float64]
    doubt: str

class RobotCamera(TypedDict):
    """A camera that looks straight ahead, and its place on the robot."""

    width: int
    height: int
    matrix: npt.NDArray[np.float64]
    distortion: npt.NDArray[np.float64]
    ahead: float
    above: float

class DriveMission:
    """Drives to the waypoints of a scenario of the job drive, by the tags in sight or open loop by time.

    Its robot takes DriveWheels. In the closed loop it gives a TagImage: a robot of a fixed rate gives the newest one each
    time. `set` has options by key, such as {"loop": "open"}.
    """

    def __init__(self, scenario: str | PathLike[str], *, set: dict[str, Value] = {}) -> None: ...
    def step(self, observation: Observation) -> DriveWheels | None:
        """Returns the next command, or None when the mission is over."""
    def twist(self, speeds: Sequence[float] | npt.NDArray[np.float64]) -> tuple[float, float, float]:
        """The motion that four speeds of the wheels make: m/s ahead and to the left, rad/s."""
    @property
    def status(self) -> str:
        """done, unconfirmed, doubtful, lost or stuck; empty while it drives."""
    @property
    def reason(self) -> str:
        """Why it is not done."""
    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """The pose that the robot believes to have."""
    @property
    def start(self) -> npt.NDArray[np.float64]:
        """The pose at the start."""
    @property
    def waypoints(self) -> npt.NDArray[np.float64]:
        """Shape (n, 3)."""
    @property
    def arrivals(self) -> list[DriveArrival]:
        """The stops at which it stood; `doubt` is empty where the tags confirm it."""
    @property
    def tags(self) -> dict[int, npt.NDArray[np.float64]]:
        """The tags by id: their corners in the world, m, in the order of TagImage; shape (4, 3)."""
    @property
    def camera(self) -> RobotCamera:
        """Sides in px, camera matrix, distortion (k1, k2, p1, p2, k3), and its place on the robot in m.

        The matrix counts from the centre of the first pixel, as calibration files do, TagImage from its corner: add half
        a pixel.
        """

class GuardTarget(TypedDict):
    """A target: the place of its base, m, and what has become of it."""

    name: str
    position: tuple[float, float, float]
    status: str
    reason: str
    shots: int

class GuardIntruder(TypedDict):
    """An intruder: the number of its place, and when it enters and is there, s."""

    name: str
    place: int
    enters: float
    settles: float

class GuardStation(TypedDict):
    """A station, m, and what it fills."""

    name: str
    position: tuple[float, float]
    water: bool
    charge: bool

class GuardMission:
    """Hits the targets in the yard of a scenario of the job guard with a water gun.

    It is planned when it is made; Ctrl-C ends that. Its robot knows its pose in the world and takes FollowWaypoints,
    AimGun, Fire, Wait and, with limited supplies, Fill. It gives its gun, the outcome of each shot, its stores if they are
    limited, and a TargetReport if intruders come, survive hits or walk about. The yard must be known.
    """

    def __init__(
        self, scenario: str | PathLike[str], *, seed: int | None = None, set: dict[str, Value] = {}
    ) -> None: ...
    def step(self, observation: Observation) -> FollowWaypoints | AimGun | Fire | Wait | Fill | None:
        """Returns the next command, or None when the mission is over."""
    @property
    def status(self) -> str:
        """done if every target that can be hit was hit, else not_done; empty before the end."""
    @property
    def reason(self) -> str:
        """Why not every target was hit."""
    @property
    def start(self) -> npt.NDArray[np.float64]:
        """The pose at the start: x, y in m and heading in rad."""
    @property
    def stops(self) -> npt.NDArray[np.float64]:
        """The stops of the plan for targets that stand still; shape (n, 2)."""
    @property
    def cost(self) -> float:
        """Time of that plan if every shot hits, s."""
    @property
    def lower_bound(self) -> float:
        """Proven of that plan, as in run.json, s."""
    @property
    def targets(self) -> list[GuardTarget]:
        """The targets with their status: waiting, reached, failed or unreachable, with a sentence."""
    @property
    def intruders(self) -> list[GuardIntruder]:
        """The intruders that the scenario lets come: the place of each, and when it enters and is there, s."""
    @property
    def stations(self) -> list[GuardStation]:
        """The stations that fill the stores."""

class PursuitMission:
    """Catches the target of a problem with one robot or a team, and plans again while it learns where the target goes.

    Its robot gives a GridObservation and takes StepToCell, which takes a second. The problem has the map and tells how
    long the target is there; where the target is comes from the observations.
    """

    def __init__(self, problem: PursuitProblem, **options: Value) -> None: ...
    def step(self, observation: Observation) -> StepToCell | None:
        """Returns the next command, or None when the mission is over. Raises NoPath if it is proven that there is none."""
    @property
    def status(self) -> str:
        """done if the target was caught, else not_done; empty before the end."""
    @property
    def reason(self) -> str:
        """Why it was not caught."""
    @property
    def caught(self) -> bool:
        """The target is caught."""
    @property
    def time(self) -> int:
        """The present second."""
    @property
    def cost(self) -> int:
        """Paid until now."""
    @property
    def lower_bound(self) -> int:
        """Proven for the whole mission; 0 where the future is not known."""
    @property
    def paths(self) -> list[npt.NDArray[np.int64]]:
        """For each robot, its cell in second 0, 1, ...; shape (n, 2)."""

def run_mission(mission: Mission, robot: Robot, *, most_steps: int | None = None) -> int:
    """Senses, steps and acts until the mission is over, and returns the number of commands.

    Raises RobotFailed, with the exception as its `__cause__`, where the robot or a mission in Python raises one.
    """

class Solids(TypedDict):
    """Solids as arrays, one entry each."""

    name: list[str]
    kind: list[str]
    bounds: npt.NDArray[np.float64]

class Outline(TypedDict):
    """A convex obstacle: corners, shape (n, 2), m, grown by a radius, m."""

    corners: npt.NDArray[np.float64]
    radius: float

class World:
    """The solids of a yard or a building, and its bounds."""

    @staticmethod
    def load(path: str | PathLike[str]) -> World:
        """Reads SDF, a map of map_server, an image or slices; warns of what it repaired or left out."""
    @property
    def name(self) -> str:
        """As in its file."""
    @property
    def bounds(self) -> npt.NDArray[np.float64]:
        """The lowest and the highest corner; shape (2, 2)."""
    @property
    def solids(self) -> Solids:
        """Boxes around them have the shape (n, 2, 3)."""
    def outlines(self, *, height: float = 0.2) -> list[Outline]:
        """The obstacles of a robot of that height: convex corners, grown by a radius."""
    def clearances(self, points: Points, *, height: float = 0.2, most: float = 10.0) -> npt.NDArray[np.float64]:
        """The distance of each point to the nearest obstacle or edge, at most `most`; negative inside."""
    def polygons(self, radius: float, *, height: float = 0.2) -> PolygonMap:
        """The ground of a disk of that radius as polygons; round obstacles become slightly larger polygons."""
    def grid(self, radius: float, *, resolution: float = 0.1, height: float = 0.2) -> GridMap:
        """The ground of a disk of that radius."""

def read_log(path: str | PathLike[str], *, topics: Sequence[str] = []) -> dict[str, npt.NDArray[np.void]]:
    """The messages of a log (MCAP, ROS 1 bag, ROS 2 db3) as Run.log has them. Warns if the end of the file is missing."""
