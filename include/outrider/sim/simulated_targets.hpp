// SimulatedTargets: intruders that enter, survive hits or walk about, and the detector that observes them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/ballistics/target.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/sim/intruders.hpp"

namespace outrider {

inline constexpr double instant_s = 1e-9;  ///< times closer than this are one

/// The behaviour of the simulated targets.
struct TargetSimParams {
  /// Arriving intruders in the order of entering. They are the first targets of the list; the targets after
  /// them are the places to which survivors go.
  std::vector<Intruder> intruders = {};
  bool foreseen = false;         ///< the detector reports all intruders at the start
  Survival survival = {};        ///< behaviour after a hit
  std::vector<Walk> walks = {};  ///< motions of walking targets; each is observed until it is hit
  double look_s = 0.5;           ///< time between two observations of walking targets
  double sight_m = 0.0;          ///< largest error of an observed position
};

class SimulatedTargets {
 public:
  /// The targets must outlive this object. Uses the random streams "survival" and "sight" of the seed.
  SimulatedTargets(const std::vector<Target>& targets, TargetSimParams params, std::uint64_t seed);

  /// Returns the events up to `time_s` that were not reported before.
  TargetReport look(double time_s);
  /// Returns true if an intruder has entered that was not reported yet.
  [[nodiscard]] bool somebody_entered(double time_s) const;
  /// Returns the time at which the next intruder enters; infinite if there is none.
  [[nodiscard]] double next_entry_s() const;
  /// Returns the index of the target in whose box this intruder stands now.
  [[nodiscard]] std::size_t stand_in(std::size_t who) const { return stands_at_[who]; }
  /// Returns the motion of a target; null if targets stand still.
  [[nodiscard]] const Walk* walk(std::size_t who) const {
    return params_.walks.empty() ? nullptr : &params_.walks[who];
  }
  /// Registers a hit at `time_s`, which may be still to come. The target leaves, or it survives and moves;
  /// the move goes to `queue`, and is reported once that time has come.
  void hit(std::size_t who, double time_s, LogQueue& queue);

 private:
  const std::vector<Target>& targets_;
  TargetSimParams params_;
  Rng survival_rng_;
  Rng sight_rng_;
  std::size_t told_ = 0;                // intruders that have been reported
  std::vector<std::size_t> stands_at_;  // by target
  /// A move that is not reported yet.
  struct Survived {
    TargetArrival arrival;
    double hit_s = 0.0;
  };
  std::vector<Survived> survived_;
  std::vector<double> gone_s_;  // by walking target: when it was hit
  std::uint64_t looks_ = 0;     // so far
};

}  // namespace outrider
