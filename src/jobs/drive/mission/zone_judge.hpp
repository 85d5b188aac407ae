// ZoneJudge: what a robot truly did in zones, by its true poses, without anything of what drove it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/motion/footprint.hpp"
#include "outrider/world/zone.hpp"

namespace outrider {

class ZoneJudge {
 public:
  ZoneJudge(const std::vector<Zone>& zones, const Footprint& footprint);

  /// Notes where the robot truly is. Times increase.
  void note(double time_s, const Pose2& truth);
  /// Returns how often the footprint entered a keep-out zone; one at the first note counts.
  [[nodiscard]] std::int64_t entered() const { return entered_; }
  /// Returns the time for which it was in a slow zone and faster than allowed there.
  [[nodiscard]] double over_slow_s() const { return over_slow_s_; }

 private:
  /// A zone, the box around it, and the robot in it at the last note.
  struct Watched {
    Zone zone;
    Box2 bounds;
    bool inside = false;
  };
  [[nodiscard]] bool overlaps(const Watched& watched, const Pose2& pose) const;

  Footprint footprint_;
  std::vector<Watched> watched_;
  std::optional<double> time_s_;
  Vec2 place_;
  std::int64_t entered_ = 0;
  double over_slow_s_ = 0.0;
};

}  // namespace outrider
