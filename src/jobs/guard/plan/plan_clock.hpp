// PlanClock: time and supplies of a plan, stop by stop; and the first and the last step of every guard
// planner.
#pragma once

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// A plan without stops: its places counted, the targets without a firing region told unreachable.
GuardPlan begin_plan(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options);

/// The time and the supplies of a plan that is carried out stop by stop, if nothing goes wrong: turns,
/// drives, aims, flights and fills in their order; on the move, aims and flights beside the drives. The
/// arguments must outlive it.
class PlanClock {
 public:
  PlanClock(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);

  /// Drives to the next stop of the plan, not before `begin_s`, and hits everything from there, or fills a
  /// store.
  void make_stop(double begin_s = 0.0);
  [[nodiscard]] std::size_t stops_made() const { return stops_made_; }
  [[nodiscard]] bool done() const { return stops_made_ == plan_.stops.size(); }
  [[nodiscard]] double free_s() const { return time_s_; }  ///< the robot may drive on
  [[nodiscard]] double end_s() const;                      ///< it may, and the last ball has landed
  [[nodiscard]] double heading_rad() const { return heading_rad_; }
  /// The levels of the stores after the last stop, and the time that it took to fill one there.
  [[nodiscard]] const SupplyLevel& level() const { return level_; }

 private:
  void aim(GunState to);
  void use(double seconds, double metres, std::size_t shots);
  void fill(Store store);

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  const GuardPlan& plan_;
  std::size_t stops_made_ = 0;
  double time_s_ = 0.0;
  double heading_rad_ = 0.0;
  GunState gun_;
  double gun_free_s_ = 0.0;  // since when the gun may turn to the next shot
  double landed_s_ = 0.0;    // the last ball
  SupplyLevel level_;
};

/// Time of the plan if nothing goes wrong, until the last ball lands (PlanClock).
double mission_time(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);

/// Joins the stops, from the start on, by the drives that are fastest with the turn before them, and finds
/// the cost of the whole. Refused as yard_routes().
Status finish_plan(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget,
                   GuardPlan& plan);

}  // namespace outrider
