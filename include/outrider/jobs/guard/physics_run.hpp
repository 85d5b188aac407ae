// A whole guard mission among rigid bodies: the same plan and executor as run_guard(), but Gazebo's physics
// engine says where the wheels bring the robot and what the ball touches.
#pragma once

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// The report of run_guard() with sim = "physics"; the reasons of failed targets say what the last shot
/// touched, where, and how far off. Metrics that a kinematic run has not:
///   arrival_error_mean_m, arrival_error_max_m   from where the wheels were sent to where they came
///   flight_error_max_m                          from a contact in the engine to the parabola at that time
///   shots_as_foreseen                           shots that touched first what the exact flight touches
///   bumps                                       solids that the robot touched, counted once a drive
/// `progress` is told the part of the targets that is settled. A pure function of the arguments, the observer
/// left out. Refused: what make_rigid_world() refuses, and flights in air.
Outcome<Report> run_guard_in_physics(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                                     const GuardOptions& options, std::uint64_t seed,
                                     const RunWatch& watch = {});

/// What run_guard_in_physics() would refuse of a problem, known without a plan.
Status check_physics(const GuardProblem& problem);

}  // namespace outrider
