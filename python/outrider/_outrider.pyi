from collections.abc import Iterable, Sequence
from os import PathLike
from typing import Any, Protocol, TypedDict, overload

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
    def radius(self) -> float: ...

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
    def plan(
        self, map: GridMap | PolygonMap, start: Point, goal: Point, *, most_expansions: int | None = None
    ) -> Plan: ...
    def trace(
        self, map: GridMap | PolygonMap, start: Point, goal: Point, *, most_expansions: int | None = None
    ) -> tuple[Plan, npt.NDArray[np.void]]:
        """Plans, and returns the expansions in their order, as records (state, parent, f, g, h)."""
    def costs(self, map: GridMap | PolygonMap, starts: Points, goals: Points) -> npt.NDArray[np.float64]:
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
def check(plan: Plan, map: GridMap | PolygonMap, start: Point, goal: Point) -> None: ...
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

class OccupancyGrid:
    """A map of free (0), occupied (1) and unknown (2) cells, read-only; row 0 has the lowest y."""

    def __init__(
        self, cells: npt.NDArray[np.bool_] | npt.NDArray[np.uint8], *, resolution: float = 0.05, origin: Point = (0.0, 0.0)
    ) -> None: ...
    @property
    def cells(self) -> npt.NDArray[np.uint8]:
        """A view."""
    @property
    def resolution(self) -> float: ...
    @property
    def origin(self) -> tuple[float, float]: ...
    def ground(self) -> GridMap:
        """Ground for path planners, where what is not free is blocked."""

class Frontier(TypedDict):
    id: int
    points: npt.NDArray[np.float64]
    centroid: tuple[float, float]
    group: int

class FrontierMap:
    """The frontiers between free and unknown cells of a growing map, for a robot of that radius."""

    def __init__(self, radius: float, **options: Value) -> None: ...
    def update(self, grid: OccupancyGrid) -> None:
        """Takes the map as it is now; frontiers keep their ids."""
    @property
    def frontiers(self) -> list[Frontier]:
        """By id; `points` are the centres of its cells, `group` is equal for those that hang together."""
    @property
    def ground(self) -> GridMap:
        """Where the robot may stand: known free cells, far enough from what is occupied."""

class PoseGraphSolution:
    """The most likely poses of a graph."""

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Shape (n, 3): x, y, heading in rad; in space (n, 4, 4)."""
    @property
    def cost(self) -> float: ...
    @property
    def start_cost(self) -> float: ...
    @property
    def status(self) -> str:
        """converged or not_converged. PoseGraph.lower_bound() says how near the least cost is."""
    @property
    def start(self) -> str:
        """Of the best descent."""
    @property
    def iterations(self) -> int: ...
    @property
    def refused(self) -> list[int]:
        """Edges that robust "gnc" refused."""

class PoseGraphSolution3(PoseGraphSolution): ...

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
    def poses(self) -> npt.NDArray[np.float64]: ...
    @property
    def edges(self) -> npt.NDArray[np.int64]:
        """The two poses of each edge; shape (m, 2)."""
    @property
    def degrees_of_freedom(self) -> float: ...
    def cost(self, poses: npt.NDArray[np.float64]) -> float: ...
    def optimise(self, *, most_iterations: int | None = None, **options: Value) -> PoseGraphSolution:
        """Options as in scenarios: start, kernel, kernel_width, robust, ... Ctrl-C ends it."""
    def lower_bound(self, poses: npt.NDArray[np.float64]) -> float:
        """Proven: no poses cost less. Good at poses of low cost."""
    def covariances(self, poses: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Of each pose given the first; shape (n, 3, 3)."""
    def g2o(self, poses: npt.NDArray[np.float64]) -> str:
        """The graph as g2o text."""

class PoseGraph3:
    """Poses in space (matrices of 4 x 4) and measurements between them. The first pose stays where it is."""

    def __init__(self) -> None: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> PoseGraph3: ...
    def add_pose(self, pose: npt.NDArray[np.float64]) -> int: ...
    def add_edge(
        self, from_pose: int, to_pose: int, measured: npt.NDArray[np.float64], information: npt.NDArray[np.float64]
    ) -> None:
        """The information is of position and rotation, 6 x 6."""
    @property
    def poses(self) -> npt.NDArray[np.float64]: ...
    @property
    def edges(self) -> npt.NDArray[np.int64]: ...
    @property
    def degrees_of_freedom(self) -> float: ...
    def cost(self, poses: npt.NDArray[np.float64]) -> float: ...
    def optimise(self, *, most_iterations: int | None = None, **options: Value) -> PoseGraphSolution3: ...
    def lower_bound(self, poses: npt.NDArray[np.float64]) -> float: ...
    def covariances(self, poses: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def g2o(self, poses: npt.NDArray[np.float64]) -> str: ...

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
    def ranges(self) -> npt.NDArray[np.float32]: ...
    @property
    def first(self) -> float: ...
    @property
    def step(self) -> float: ...
    @property
    def least(self) -> float: ...
    @property
    def most(self) -> float: ...
    @property
    def time(self) -> float: ...

class LaserStep(TypedDict):
    pose: npt.NDArray[np.float64]
    matched: bool
    lost: bool
    closed_loop: bool

class LaserSlam:
    """Localisation and mapping with a laser range finder. One thread at a time; others are refused.

    Options as in scenarios; those of the map begin with map_, such as map_resolution.
    """

    def __init__(self, start: Pose = (0.0, 0.0, 0.0), **options: Value) -> None: ...
    def advance(self, motion: Pose, scan: LaserScan) -> LaserStep:
        """Takes the motion since the last scan, by odometry in the frame of the robot then, and the scan after it."""
    def settle(self) -> None:
        """Optimises all poses and draws the map anew."""
    @property
    def pose(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """Of x, y and heading of the last kept scan; shape (3, 3)."""
    @property
    def trajectory(self) -> npt.NDArray[np.float64]:
        """The start and the pose after each step; shape (n, 3)."""
    @property
    def map(self) -> OccupancyGrid:
        """A copy of the map as it is now."""
    @property
    def graph(self) -> PoseGraph: ...
    @property
    def loops(self) -> int: ...

class LandmarkStep(TypedDict):
    used: int
    refused: int
    waiting: int
    added: list[int]
    removed: list[int]
    lost: bool

class LandmarkEstimates(TypedDict):
    id: npt.NDArray[np.int64]
    position: npt.NDArray[np.float64]
    covariance: npt.NDArray[np.float64]
    sightings: npt.NDArray[np.int64]

class LandmarkSlam:
    """Localisation and mapping with landmarks. One thread at a time; others are refused. Options as in scenarios."""

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
    def settle(self) -> None: ...
    @property
    def pose(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @property
    def trajectory(self) -> npt.NDArray[np.float64]: ...
    @property
    def landmarks(self) -> LandmarkEstimates: ...
    @property
    def cost(self) -> float: ...
    @property
    def state(self) -> str: ...

class Observation:
    """What a robot senses: the time in s, the pose by odometry since the start, and what its devices add."""

    def __init__(
        self,
        *,
        time: float,
        odometry: Pose,
        scan: LaserScan | None = None,
        touching: bool = False,
        touch: float | None = None,
    ) -> None:
        """`touching`: it touched something since the last observation; `touch`: the bearing of that in rad, if known."""
    @property
    def time(self) -> float: ...
    @property
    def odometry(self) -> npt.NDArray[np.float64]: ...
    @property
    def scan(self) -> LaserScan | None: ...
    @property
    def touching(self) -> bool: ...

class DriveTwist:
    """Drive with a constant twist until a time, then sense again: m/s ahead and to the left, rad/s, s."""

    def __init__(self, *, ahead: float, left: float = 0.0, turn: float = 0.0, until: float) -> None: ...
    @property
    def ahead(self) -> float: ...
    @property
    def left(self) -> float: ...
    @property
    def turn(self) -> float: ...
    @property
    def until(self) -> float: ...

class FollowPiece:
    """Turn towards a leg or an arc, pause, and drive along it from rest to rest."""

    @property
    def from_point(self) -> tuple[float, float]: ...
    @property
    def to_point(self) -> tuple[float, float]: ...
    @property
    def turn(self) -> float:
        """Of the arc, rad; 0 for a leg."""
    @property
    def backward(self) -> bool: ...
    @property
    def pause(self) -> float: ...

class Wait:
    """Stand still until a time, s."""

    def __init__(self, *, until: float) -> None: ...
    @property
    def until(self) -> float: ...

Command = DriveTwist | FollowPiece | Wait

class Robot(Protocol):
    """What carries a mission out: any class with these two methods."""

    def sense(self) -> Observation: ...
    def act(self, command: Any, /) -> None:
        """Carries the command out and returns when it is done."""

class Mission(Protocol):
    """What answers each observation with a command: any class with this method; None ends the mission."""

    def step(self, observation: Observation, /) -> Command | None: ...

class CoverMission:
    """Drives the track of a plan, piece by piece."""

    def __init__(self, plan: CoverPlan, *, pause: float = 0.0) -> None: ...
    def step(self, observation: Observation) -> FollowPiece | None: ...

class ExploreMission:
    """Maps a building that nobody knows, and comes home.

    Its robot senses scans and takes DriveTwist. Options as in scenarios: strategy, planner, ..., robot_radius, ...,
    slam_reach, ..., map_resolution, ...
    """

    def __init__(self, start: Pose = (0.0, 0.0, 0.0), **options: Value) -> None: ...
    def step(self, observation: Observation) -> DriveTwist | None: ...
    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """Where it believes to be."""
    @property
    def stop_reason(self) -> str:
        """complete, left_over, budget, leak, stuck, lost or blind; empty while it explores."""
    @property
    def reason(self) -> str: ...
    @property
    def home(self) -> bool: ...
    @property
    def map(self) -> OccupancyGrid:
        """A copy."""

def run_mission(mission: Mission, robot: Robot, *, most_steps: int | None = None) -> int:
    """Senses, steps and acts until the mission is over, and returns the number of commands.

    Raises RobotFailed, with the exception as its `__cause__`, where the robot or a mission in Python raises one.
    """

class Solids(TypedDict):
    name: list[str]
    kind: list[str]
    bounds: npt.NDArray[np.float64]

class Outline(TypedDict):
    corners: npt.NDArray[np.float64]
    radius: float

class World:
    """The solids of a yard or a building, and its bounds."""

    @staticmethod
    def load(path: str | PathLike[str]) -> World:
        """Reads SDF, a map of map_server, an image or slices; warns of what it repaired or left out."""
    @property
    def name(self) -> str: ...
    @property
    def bounds(self) -> npt.NDArray[np.float64]:
        """The lowest and the highest corner; shape (2, 2)."""
    @property
    def solids(self) -> Solids:
        """Boxes around them have the shape (n, 2, 3)."""
    def outlines(self, *, height: float = 0.2) -> list[Outline]:
        """What stands in the way of a robot of that height: convex corners, grown by a radius."""
    def clearances(self, points: Points, *, height: float = 0.2, most: float = 10.0) -> npt.NDArray[np.float64]:
        """The distance of each point to the nearest obstacle or edge, at most `most`; negative inside."""
    def grid(self, radius: float, *, resolution: float = 0.1, height: float = 0.2) -> GridMap:
        """The ground of a disk of that radius."""

def read_log(path: str | PathLike[str], *, topics: Sequence[str] = ...) -> dict[str, npt.NDArray[np.void]]:
    """The messages of a log (MCAP, ROS 1 bag, ROS 2 db3) as Run.log has them. Warns if the end of the file is missing."""
