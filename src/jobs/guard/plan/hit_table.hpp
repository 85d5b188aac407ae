// HitTable: the targets that are hit from each stop and in passing. TablePlanner makes it a plan on the move.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {

/// A stop, anywhere on free ground, and the targets that are hit from there, in order; or a station.
struct ChosenStop {
  Vec2 place;
  std::vector<std::size_t> targets = {};
  std::optional<StationCall> call = {};

  [[nodiscard]] bool made() const { return call || !targets.empty(); }
};

/// The stops with the targets that are hit from them, and the targets that are hit in passing.
struct HitTable {
  std::vector<ChosenStop> stops;  ///< in order; only those made() are in the plan
  /// Targets that are hit during some drive: before the first station, between it and the second, and so on.
  /// So each tankful serves the same targets whether they are hit from stops or in passing.
  std::vector<std::vector<std::size_t>> passing{1};

  /// Returns the targets in passing between the stations around a stop.
  std::vector<std::size_t>& passing_beside(std::size_t stop);
};

/// Returns the table of a plan from rest.
HitTable hit_table_of(const GuardPlan& plan);

/// Makes plans of tables and keeps the shots and drives that it has found. Thread rule: use each object from
/// one thread.
class TablePlanner {
 public:
  /// The arguments must outlive this object. `plan` must have routes.
  TablePlanner(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan);

  /// Returns the plan, with all its shots solved from where the gun is then; nothing if some target cannot be
  /// hit as chosen, or a stop not be driven to. A call for stops and legs that are known takes O(stops *
  /// passing targets); new ones take a search for a route and shots each.
  std::optional<GuardPlan> plan_of(const HitTable& table);
  /// Returns the time of the drives, turns included; infinite if there is no way.
  double drives_s(const HitTable& table);
  /// Returns true if the robot fits at the place despite the errors of a drive, and the place is in cells
  /// from which all those targets are sure hits (sure_cells()).
  [[nodiscard]] bool may_stop(Vec2 place, const std::vector<std::size_t>& targets);
  /// Returns the time of the plan and what the errors of the drives add to it on average: flights that have
  /// to be waited for, and targets that are lost, from places around the stops.
  double expected_s(const GuardPlan& plan);

 private:
  using Place = std::pair<double, double>;

  double expected_wait_s(Vec2 place, const PlannedHit& hit);
  [[nodiscard]] DriveCost drive(const Pose2& from, const std::vector<Vec2>& waypoints) const;
  const std::vector<Vec2>& way(const Pose2& from, Vec2 to);
  const std::optional<PlannedShot>& shot_from(Vec2 place, std::size_t target, double pitch_rad);

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  const GuardPlan& plan_;
  SureHits sure_;
  PassingShots passing_;
  std::map<Place, std::size_t> routes_index_;  // of the places that the routes of the plan join
  std::map<std::tuple<Place, double, Place>, std::vector<Vec2>> ways_;
  std::map<std::tuple<Place, std::size_t, double>, std::optional<PlannedShot>> shots_;
};

}  // namespace outrider
