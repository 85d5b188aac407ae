// SimulatedLaser: a range finder on a robot that measures at its own rate.
#pragma once

#include <optional>

#include "outrider/sim/range_finder.hpp"

namespace outrider {

class SimulatedLaser {
 public:
  SimulatedLaser(const World& world, const RangeFinderModel& model, const Rng& rng)
      : finder_(world, model), rng_(rng) {}

  /// Returns a scan from the given pose if the next scan is due at `time_s`, else nothing. The first scan is
  /// due at time 0.
  std::optional<LaserScan> look(const Pose2& world_T_robot, double time_s);
  [[nodiscard]] const RangeFinder& finder() const { return finder_; }

 private:
  RangeFinder finder_;
  Rng rng_;
  std::int64_t turns_ = 0;  // rotations whose scan was taken
};

}  // namespace outrider
