// SimulatedLaser: a range finder on a robot, which looks at its own rate.
#pragma once

#include <optional>

#include "outrider/sim/range_finder.hpp"

namespace outrider {

class SimulatedLaser {
 public:
  SimulatedLaser(const World& world, const RangeFinderModel& model, const Rng& rng)
      : finder_(world, model), rng_(rng) {}

  /// The scan of the first call at or after each turn of the laser, from that pose.
  std::optional<LaserScan> look(const Pose2& world_T_robot, double time_s);
  [[nodiscard]] const RangeFinder& finder() const { return finder_; }

 private:
  RangeFinder finder_;
  Rng rng_;
  std::int64_t turns_ = 0;  // that have been looked at
};

}  // namespace outrider
