// A whole guard mission in simulation: whatever its capabilities, one robot, one mission, one report.
#pragma once

#include <optional>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/mission.hpp"
#include "outrider/jobs/guard/robot.hpp"
#include "outrider/jobs/guard/survivors.hpp"

namespace outrider {

/// Intruders that walk about, and what is planned against them.
struct WalkerRun {
  const MovingPlan& plan;
  const std::vector<Walk>& walks;  ///< as they really go, by target
};

/// The yard as it really is, where the robot knows it by a map.
struct TrueYard {
  const GuardProblem& problem;  ///< its targets are those of the plan, in their order
  const FiringMap& firing_map;
  StoreLevels levels = {};  ///< that the exploring has left; infinite: the stores are full
};

/// A mission: the yard as the robot knows it, the plan, and the capabilities that are asked for. What is
/// referred to must outlive the run.
struct GuardRun {
  const GuardProblem& problem;
  const FiringMap& firing_map;
  const GuardPlan& plan;
  const GuardOptions& options;
  std::uint64_t seed = 1;
  std::optional<ArrivalPlan> arrivals = {};  ///< intruders come or survive; `problem` is that of their yard
  Survival survival = {};
  std::optional<WalkerRun> walkers = {};
  std::optional<TrueYard> truth = {};
  bool rigid = false;  ///< rigid bodies carry it out
};

/// Carries the mission out and reports. The report is a pure function of the arguments, the observer left
/// out. status is "done" when every target that can be hit was hit, and no store ran below empty. Metrics:
///   targets, reached, failed, unreachable, mission_s, driven_m, turned_rad, shots   always
///   planned_s, expected_s, lower_bound_s, gap, anywhere_lower_bound_s, anywhere_gap, tour_proven,
///   stops_offered, stops, places, reached_by_reference_rule                         still targets
///   intruder_seconds   time inside of all intruders that can be hit, summed; who is not hit stays to the end
///   makespan_s         when the last of them was hit; the end when one was not
///   longest_s, plans, lower_bound_s, intruder_seconds_bound, makespan_bound_s       arrivals
///   (arrival_bound.hpp) survived           hits after which somebody went elsewhere survivors chance,
///   expected_hits   mean of the stated chances of the shots, and their sum  walkers fills, unplanned_fills,
///   least_water, least_charge_j                             limited supplies shots_in_passing,
///   hits_in_passing                                               shots on the move arrival_error_mean_m,
///   arrival_error_max_m, flight_error_max_m, shots_as_foreseen, bumps   rigid bodies
/// Refused: rigid bodies that make_rigid_world() refuses.
Outcome<Report> run_guard(const GuardRun& run, const RunWatch& watch = {});

}  // namespace outrider
