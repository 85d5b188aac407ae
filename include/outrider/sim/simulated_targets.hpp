// SimulatedTargets: intruders that come, survive or walk about, and the detector that sees them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/ballistics/target.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/sim/intruders.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

struct TargetSimParams {
  /// Where intruders come, they are the first targets, in the order of entering, and the places where
  /// survivors go follow them.
  std::vector<Intruder> intruders = {};
  bool foreseen = false;  ///< all are seen at the start
  Survival survival = {};
  std::vector<Walk> walks = {};  ///< of targets that walk; each is seen until it is hit
  double look_s = 0.5;           ///< between two looks
  double sight_m = 0.0;          ///< largest error of a position seen
};

class SimulatedTargets {
 public:
  /// The targets must outlive it. Streams: "survival" and "sight" of the seed.
  SimulatedTargets(const std::vector<Target>& targets, TargetSimParams params, std::uint64_t seed);

  /// What is new by then; told once.
  TargetReport look(double time_s);
  /// Somebody has entered who has not been told of.
  [[nodiscard]] bool somebody_entered(double time_s) const;
  /// When the next one enters; infinite when nobody does.
  [[nodiscard]] double next_entry_s() const;
  /// The target in whose box somebody stands now.
  [[nodiscard]] std::size_t stand_in(std::size_t who) const { return stands_at_[who]; }
  /// How somebody walks; null where they stand still.
  [[nodiscard]] const Walk* walk(std::size_t who) const {
    return params_.walks.empty() ? nullptr : &params_.walks[who];
  }
  /// Somebody was hit by a ball that landed: it leaves, or goes elsewhere, which is written down.
  void hit(std::size_t who, double time_s, SimRecord& record);

 private:
  const std::vector<Target>& targets_;
  TargetSimParams params_;
  Rng survival_rng_;
  Rng sight_rng_;
  std::size_t told_ = 0;                 // intruders that have been told of
  std::vector<std::size_t> stands_at_;   // by target
  std::vector<TargetArrival> survived_;  // not yet told of
  std::vector<char> gone_;               // by target that walks
  std::uint64_t looks_ = 0;              // so far
};

}  // namespace outrider
