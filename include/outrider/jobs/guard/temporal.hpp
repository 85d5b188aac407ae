// Temporal: the decision problem of a guard mission as durative actions, and the judge of plans for it.
//
// Decided are the stops, their order, the shots from each and, on finite supplies, the stations. The model of
// time is that of tour/problem.hpp and tour/supply.hpp, over states that are few: a pose is a stop with the
// heading that some drive leaves there, so that each drive between two poses, with the turn before it, takes
// a number. The gun is two numbers, its yaw relative to the body and its pitch after the last shot:
//  - drive to another pose;
//  - shoot at a target: aim, then the flight. Yaw is the same all round, so the plan says which way the gun
//    goes: direct, or by a full turn more or less. The action takes at least what either axis needs;
//  - rest: the gun turns to yaw and pitch zero, before a fill;
//  - fill a store to the brim at a station.
// The robot does one thing at a time. Times in s, angles in rad.
// Source: Fox and Long, PDDL2.1: an extension to PDDL for expressing temporal planning domains, Journal of
// Artificial Intelligence Research 20, 2003. io/pddl.hpp writes it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/tour/supply.hpp"

namespace outrider {

struct TemporalPose {
  std::size_t stop = 0;
  double heading_rad = 0.0;
};

struct TemporalProblem {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  SupplyProblem supplies;
  std::vector<TemporalPose> poses;  ///< the start first, then as drives lead to them
  std::vector<std::size_t> after;   ///< by pose and stop, row-major: the pose after that drive, or none

  [[nodiscard]] std::size_t stops() const { return supplies.table.services.size(); }
  [[nodiscard]] bool leads(std::size_t from, std::size_t to) const;
  /// Of a drive that leads from one pose to the other, with its turn, s; and what it takes of the charge, J.
  [[nodiscard]] double drive_s(std::size_t from, std::size_t to) const;
  [[nodiscard]] double drive_charge(std::size_t from, std::size_t to) const;
  /// Charge that a shot from the pose must leave: what the way to the nearest charger takes, J.
  [[nodiscard]] double homeward_charge(std::size_t pose) const;
  /// The shot at a goal from a pose; null without one.
  [[nodiscard]] const Service* service(std::size_t pose, std::uint32_t goal) const;
  /// Of the gun relative to the body, in [0, 2 pi).
  [[nodiscard]] double shot_yaw(std::size_t pose, const Service& service) const;
};

enum class TemporalVerb : std::uint8_t { drive, shoot, rest, fill };
enum class WayRound : std::uint8_t { direct, plus, minus };

/// What a way round adds to the yaw that the gun is to turn to: 0 or a full turn.
double turn_of(WayRound way);

struct TemporalAction {
  double start_s = 0.0;
  double duration_s = 0.0;
  TemporalVerb verb = TemporalVerb::drive;
  std::size_t pose = 0;             ///< where it begins; not read for `rest`
  std::size_t object = 0;           ///< drive: the pose where it ends; shoot: the goal; fill: the station
  WayRound way = WayRound::direct;  ///< of the gun, for `shoot` and `rest`
};

struct TemporalVerdict {
  std::optional<std::size_t> broken;  ///< index of the action at fault, where it is one
  std::string reason;                 ///< the first broken condition; empty where the plan is valid
  double makespan_s = 0.0;            ///< when the last action of the plan ends
  [[nodiscard]] bool valid() const { return reason.empty(); }
};

/// Stops without a shot and without a station are left out of the poses. Refused: what check(SupplyProblem)
/// refuses, and a problem of more than `most_ways` drives between poses. O(poses x stops).
Outcome<TemporalProblem> temporal_problem(SupplyProblem supplies, std::size_t most_ways = 200'000);

/// The steps of a tour as actions, each after the one before with a gap, as PDDL wants it between an effect
/// and what depends on it. All gaps together are one part in ten million of the time of the steps. Refused:
/// steps that levels() of tour/supply.hpp refuses.
Outcome<std::vector<TemporalAction>> temporal_actions(const TemporalProblem& problem,
                                                      const std::vector<SupplyStep>& steps);

/// Follows the actions in the order of their times (in their own order among equal ones), and says the first
/// condition that does not hold: the robot busy or elsewhere, no such drive or shot, a target shot twice or
/// never, a store empty, a wrong duration. Times may be off by `tolerance_s`, as planners round them. Indices
/// in the actions must be within the problem. O(n log n + n x shots of a stop).
TemporalVerdict judge(const TemporalProblem& problem, const std::vector<TemporalAction>& actions,
                      double tolerance_s);

}  // namespace outrider
