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
                      OutsideMap, RobotFailed, StartBlocked)
from ._outrider import (AimGun, CoverMission, CoverPlan, CoverPlanner, CoverProblem, CoverProof, DriveMission,
                        DriveTwist, DriveWheels, ExploreMission, Fill, Fire, FireInPassing, FollowPiece,
                        FollowWaypoints, FrontierMap, GridMap, GridObservation, GuardMission, LandmarkSlam, LaserScan,
                        LaserSlam, Observation, OccupancyGrid, PathPlanner, Plan, PolygonMap, PoseGraph, PoseGraph3,
                        PoseGraphSolution, PoseGraphSolution3, PursuitMission, PursuitPlan, PursuitPlanner,
                        PursuitProblem, Run, ShotResult, StepToCell, StoreLevels, TagImage, TargetArrival,
                        TargetObservation, TargetReport, Wait, World, __version__, check, cover_methods,
                        explore_strategies, guard_planners, jobs, path_planners, prove, pursuit_planners, read_log,
                        run, run_mission)

__all__ = [
    "AimGun", "BadInput", "BudgetExhausted", "Cancelled", "CannotWrite", "CoverMission", "CoverPlan", "CoverPlanner",
    "CoverProblem", "CoverProof", "DriveMission", "DriveTwist", "DriveWheels", "ExploreMission", "Fault", "Fill",
    "Fire", "FireInPassing", "FollowPiece", "FollowWaypoints", "FrontierMap", "GoalBlocked", "GridMap",
    "GridObservation", "GuardMission", "LandmarkSlam", "LaserScan", "LaserSlam", "NoPath", "NoShot", "Observation",
    "OccupancyGrid", "OutsideMap", "PathPlanner", "Plan", "PolygonMap", "PoseGraph", "PoseGraph3",
    "PoseGraphSolution", "PoseGraphSolution3", "PursuitMission", "PursuitPlan", "PursuitPlanner", "PursuitProblem",
    "RobotFailed", "Run", "ShotResult", "StartBlocked", "StepToCell", "StoreLevels", "TagImage", "TargetArrival",
    "TargetObservation", "TargetReport", "Wait", "World", "__version__", "check", "cover_methods",
    "explore_strategies", "guard_planners", "jobs", "path_planners", "prove", "pursuit_planners", "read_log", "run",
    "run_mission",
]
