"""Outrider: a ground robot finds its way, and does a job, in a yard or a building.

    import outrider

    run = outrider.run("scenarios/yard/yard.yaml", seed=2)
    print(run.status, run.metrics["mission_s"])

    ground = outrider.GridMap(blocked, resolution=0.05)      # bool, row 0 has the lowest y
    plan = outrider.PathPlanner("theta_star").plan(ground, (0.5, 0.5), (9.5, 4.5))

Lengths are in metres, angles of options in degrees, times in seconds. What Outrider refuses is an exception of
a class in this module, with its sentence and where it is.
"""

from ._faults import (BadInput, BudgetExhausted, Cancelled, CannotWrite, Fault, GoalBlocked, NoPath, NoShot,
                      OutsideMap, StartBlocked)
from ._outrider import (CoverPlan, CoverPlanner, CoverProblem, CoverProof, FrontierMap, GridMap, LandmarkSlam,
                        LaserScan, LaserSlam, OccupancyGrid, PathPlanner, Plan, PoseGraph, PoseGraph3,
                        PoseGraphSolution, PoseGraphSolution3, PursuitPlan, PursuitPlanner, PursuitProblem, Run,
                        __version__, check, cover_methods, explore_strategies, guard_planners, jobs, path_planners,
                        prove, pursuit_planners, read_log, run)

__all__ = [
    "BadInput", "BudgetExhausted", "Cancelled", "CannotWrite", "CoverPlan", "CoverPlanner", "CoverProblem",
    "CoverProof", "Fault", "FrontierMap", "GoalBlocked", "GridMap", "LandmarkSlam", "LaserScan", "LaserSlam",
    "NoPath", "NoShot", "OccupancyGrid", "OutsideMap", "PathPlanner", "Plan", "PoseGraph", "PoseGraph3",
    "PoseGraphSolution", "PoseGraphSolution3", "PursuitPlan", "PursuitPlanner", "PursuitProblem", "Run",
    "StartBlocked", "__version__", "check", "cover_methods", "explore_strategies", "guard_planners", "jobs",
    "path_planners", "prove", "pursuit_planners", "read_log", "run",
]
