// Temporal: the decision problem of a guard mission with durative actions, and a validator of plans for it.
//
// A plan chooses the stops, their order, the shots from each stop and, with limited supplies, the stations.
// Times are those of tour/problem.hpp and tour/supply/supply.hpp. The state space is finite: a pose is a stop
// with a heading with which some drive arrives there, so each drive between two poses, including the turn
// before it, has a fixed duration. The state of the gun is its yaw relative to the body and its pitch after
// the last shot. The actions:
//  - drive: go to another pose;
//  - shoot: aim at a target, then wait for the flight. Yaw angles that differ by a full turn are equal, so
//  the plan
//    states which way the gun turns: direct, or by a full turn more or less. The action lasts at least as
//    long as each of the two axes needs;
//  - rest: turn the gun to yaw and pitch zero, before a fill;
//  - fill: fill a store completely at a station.
// The robot does one action at a time. Times in s, angles in rad.
// Source: Fox and Long, PDDL2.1: an extension to PDDL for expressing temporal planning domains, Journal of
// Artificial Intelligence Research 20, 2003. pddl.hpp writes the problem as PDDL.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/tour/supply/supply.hpp"

namespace outrider {

/// A stop with a heading.
struct TemporalPose {
  std::size_t stop = 0;
  double heading_rad = 0.0;
};

/// The decision problem.
struct TemporalProblem {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  SupplyProblem supplies;
  std::vector<TemporalPose> poses;  ///< the start first, then in the order in which drives reach them
  std::vector<std::size_t> after;   ///< by pose and stop, row-major: the pose after this drive, or `none`

  [[nodiscard]] std::size_t stops() const { return supplies.table.services.size(); }
  /// Returns true if a drive leads from one pose to the other.
  [[nodiscard]] bool leads(std::size_t from, std::size_t to) const;
  /// Return the duration, s, and the energy, J, of the drive from one pose to the other, including the turn.
  [[nodiscard]] double drive_s(std::size_t from, std::size_t to) const;
  [[nodiscard]] double drive_charge(std::size_t from, std::size_t to) const;
  /// Returns the charge that must be left after a shot from the pose: the energy to the nearest charger, J.
  [[nodiscard]] double homeward_charge(std::size_t pose) const;
  /// Returns the shot at a goal from a pose; null if there is none.
  [[nodiscard]] const Service* service(std::size_t pose, std::uint32_t goal) const;
  /// Returns the yaw of the gun for a shot, relative to the body, in [0, 2 pi).
  [[nodiscard]] double shot_yaw(std::size_t pose, const Service& service) const;
};

enum class TemporalVerb : std::uint8_t { drive, shoot, rest, fill };
enum class WayRound : std::uint8_t { direct, plus, minus };

/// Returns the angle that is added to the target yaw: 0, or plus or minus a full turn.
double turn_of(WayRound way);

struct TemporalAction {
  double start_s = 0.0;
  double duration_s = 0.0;
  TemporalVerb verb = TemporalVerb::drive;
  std::size_t pose = 0;             ///< pose at the beginning; unused for `rest`
  std::size_t object = 0;           ///< drive: the pose at its end; shoot: the goal; fill: the station
  WayRound way = WayRound::direct;  ///< direction in which the gun turns, for `shoot` and `rest`
};

/// The result of a validation.
struct TemporalVerdict {
  std::optional<std::size_t> broken;  ///< index of the invalid action, if a single action is to blame
  std::string reason;                 ///< the first violated condition; empty if the plan is valid
  double makespan_s = 0.0;            ///< end of the last action
  [[nodiscard]] bool valid() const { return reason.empty(); }
};

/// Makes the temporal problem. Stops without a shot and without a station get no poses. Faults: those of
/// check(SupplyProblem), and more than `most_ways` drives between poses. O(poses * stops).
Outcome<TemporalProblem> temporal_problem(SupplyProblem supplies, std::size_t most_ways = 200'000);

/// Converts the steps of a tour to actions. There is a gap between consecutive actions, because PDDL requires
/// time between an effect and an action that depends on it. The sum of all gaps is 1e-7 of the time of the
/// steps. Faults: those of levels() (tour/supply/supply.hpp).
Outcome<std::vector<TemporalAction>> temporal_actions(const TemporalProblem& problem,
                                                      const std::vector<SupplyStep>& steps);

/// Validates a plan. It simulates the actions sorted by start time (stable) and reports the first violated
/// condition: the robot is busy or elsewhere, a drive or shot does not exist, a target is shot at twice or
/// never, a store is empty, or a duration is wrong. Times may be off by `tolerance_s`, because planners round
/// them. The indices in the actions must be valid. O(n log n + n * shots of a stop).
TemporalVerdict judge(const TemporalProblem& problem, const std::vector<TemporalAction>& actions,
                      double tolerance_s);

}  // namespace outrider
