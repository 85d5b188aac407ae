// Wandering intruders: the true motion of intruders that walk about (sim/walks.hpp), and the options of
// shooting at them. Their places are those of the targets. An intruder can be hit at any time, and leaves
// when it is hit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// Options of wandering intruders.
struct WanderOptions {
  double speed_mps = 0.0;     ///< walking speed; 0: targets stand still
  double rest_s = 15.0;       ///< mean duration of a rest
  std::string prefers;        ///< weights as place=weight, separated by blanks; the default weight is 1
  std::string history;        ///< path of recorded positions (inputs.hpp)
  bool learn = true;          ///< learn the visit map from observations; false: all regions have equal weight
  double chance = 0.5;        ///< least probability of a hit for which a shot is fired
  double look_s = 0.5;        ///< time between two observations
  double sight_m = 0.02;      ///< largest error of an observed position
  double patience_s = 300.0;  ///< time without a hit after which the robot gives up

  /// Returns true if intruders walk about.
  [[nodiscard]] bool any() const { return speed_mps > 0.0; }
};

std::vector<Option> describe(WanderOptions& options);

/// An observed position.
struct TimedPosition {
  double time_s = 0.0;
  Vec2 position;
};
/// The observed positions of one intruder, in the order of time.
using Track = std::vector<TimedPosition>;

/// Draws the true walks of all targets until `until_s`. `weights` has one weight per target. The result is a
/// pure function of the arguments. Faults: a target that does not stand on the floor or has no room to walk.
Outcome<std::vector<Walk>> draw_walks(const GuardProblem& problem, const FiringMap& firing_map,
                                      const std::vector<double>& weights, const WanderOptions& options,
                                      std::uint64_t seed, double until_s, const Budget& budget = {});

}  // namespace outrider
