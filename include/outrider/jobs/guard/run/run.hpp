// run_guard: simulates a whole guard mission with any of its capabilities, and reports.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/run/prepare.hpp"
#include "outrider/jobs/guard/run/robot.hpp"

namespace outrider {

/// The true yard, if the robot knows the yard only from a map that it made.
struct TrueYard {
  GuardProblem problem;  ///< has the same targets as the plan, in the same order
  FiringMap firing_map;
  StoreLevels levels = {};  ///< levels of the stores after exploring; infinite: full
};

/// A run of a prepared mission, with what the simulation knows and the mission does not. All references must
/// outlive the run.
struct GuardRun {
  const PreparedGuard& guard;
  const TrueYard* truth = nullptr;  ///< set if the yard was explored first
  std::vector<Walk> walks = {};     ///< true motion of walkers; none: drawn from the seed
};

/// Simulates and logs the mission of one robot or of a team (team_run.hpp, which has its metrics), and
/// returns its report. Log and report are pure functions of the arguments, except for the watch. Its status
/// is "done" if every target that can be hit was hit and no store fell below zero. Metrics:
///   targets, reached, failed, unreachable, mission_s, driven_m, turned_rad, shots   always
///   planned_s, expected_s, lower_bound_s, gap, anywhere_lower_bound_s, anywhere_gap, tour_proven,
///   stops_offered, stops, places, reached_by_reference_rule                         still targets
///   intruder_seconds, makespan_s, longest_s, plans, lower_bound_s,
///   intruder_seconds_bound, makespan_bound_s                                        arrivals
///   survived                                                                        survivors
///   expected_s, expected_error_s (its standard error)                  survivors, if none arrive
///   chance, expected_hits                                                           walkers
///   fills, unplanned_fills, least_water, least_charge_j                             limited supplies
///   shots_in_passing, hits_in_passing                                               shots on the move
///   arrival_error_mean_m, arrival_error_max_m, flight_error_max_m,
///   shots_as_foreseen, bumps                                                        rigid bodies
///   false_reached, cut_drives, contacts, post_contacts                              faults
///   contacts, walked_into, recoveries, blocked_s, belief_error_m,
///   false_reached, cut_drives                                                       sim: navigator
/// intruder_seconds is the sum of the times inside of all intruders that can be hit; an intruder that is not
/// hit counts until the end. makespan_s is the time of the last hit, or the end if one of them was not hit.
/// The bounds are those of arrival_bound.hpp. false_reached counts the
/// targets that the mission calls reached and that no ball of the log hit. cut_drives counts the drives that
/// ended before their goal, contacts those with what stands in the yard, post_contacts those with what was
/// put in the way. survived counts the hits that the intruder survived. chance is the mean of the predicted
/// chances of the shots, expected_hits their sum. Faults: those of make_rigid_world() and draw_walks().
Outcome<Report> run_guard(GuardRun run, Log& log, const RunWatch& watch = {});

}  // namespace outrider
