// Wandering intruders: how they move in truth, and what is asked of those who hunt them.
//
// An intruder rests at a place for a time, exponential with mean `rest`, then walks to another one at
// `speed`, on the shortest way around the obstacles, and so on. Places are those of the targets; the next one
// is drawn by their weights among those that there is a way to. It can be hit at any time, and leaves then.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/jobs/guard/firing_map.hpp"

namespace outrider {

struct WanderOptions {
  double speed_mps = 0.0;     ///< 0: they sit still
  double rest_s = 15.0;       ///< mean
  std::string prefers;        ///< place=weight with blanks between; 1 where a place is not named
  std::string history;        ///< path of recorded positions (io/sightings.hpp)
  bool learn = true;          ///< false: every place on the map counts the same
  double chance = 0.5;        ///< least probability of a hit with which a shot is taken
  double look_s = 0.5;        ///< between two sightings
  double sight_m = 0.02;      ///< largest error of a position seen
  double patience_s = 300.0;  ///< since the last hit, before the rest is given up

  [[nodiscard]] bool any() const { return speed_mps > 0.0; }
};

std::vector<Option> describe(WanderOptions& options);

/// A position seen.
struct TimedPosition {
  double time_s = 0.0;
  Vec2 position;
};
/// Of one intruder, in the order of time.
using Track = std::vector<TimedPosition>;

/// The true walks of all targets until `until_s`, a pure function of the arguments; `weights` by target.
/// Refused: a target that does not stand on the floor or has no room to walk, targets that block.
Outcome<std::vector<Walk>> draw_walks(const GuardProblem& problem, const FiringMap& firing_map,
                                      const std::vector<double>& weights, const WanderOptions& options,
                                      std::uint64_t seed, double until_s, const Budget& budget = {});

}  // namespace outrider
