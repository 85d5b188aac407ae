// SimulatedLaser: a range finder on a robot that measures at its own rate, with the faults of its sensor.
#pragma once

#include <optional>

#include "outrider/sim/faults/walk_ins.hpp"
#include "outrider/sim/sensors/range_finder.hpp"
#include "outrider/sim/simulated_link.hpp"

namespace outrider {

class SimulatedLaser {
 public:
  SimulatedLaser(const World& world, const RangeFinderModel& model, const Rng& rng,
                 const ExplorerFaults& faults = {}, const LinkFaults& link = {});

  /// Measures a scan from the given pose if the next scan is due at `time_s`. The first scan is due at time
  /// 0. Returns the scan that arrives now, if any: that one, or with latency an older one. The scan also
  /// shows `walk_ins`, if given.
  std::optional<LaserScan> look(const Pose2& world_T_robot, double time_s, const WalkIns* walk_ins = nullptr);
  [[nodiscard]] const RangeFinder& finder() const { return finder_; }

 private:
  void spoil(LaserScan& scan, double time_s);

  RangeFinder finder_;
  ExplorerFaults faults_;
  Rng rng_;
  Rng fault_rng_;
  std::vector<float> frozen_;           // ranges that are repeated
  SimulatedLink<LaserScan> under_way_;  // measured and not arrived
  std::int64_t turns_ = 0;              // rotations whose scan was taken
};

}  // namespace outrider
