// OdometryTrack: the latest poses of a robot by odometry, asked for at times between them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

class OdometryTrack {
 public:
  /// Adds a pose; one of the same time replaces the one before. Poses more than 30 s older are forgotten.
  /// Fault: bad_input if it is not finite, or the time goes back.
  Status add(std::int64_t time_ns, const Pose2& odom_T_robot);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] std::int64_t first_ns() const { return samples_.front().time_ns; }
  [[nodiscard]] std::int64_t last_ns() const { return samples_.back().time_ns; }

  /// Returns the pose: exactly one that was added, or between two linear in position and heading; outside of
  /// all the nearest. Expects that it is not empty.
  [[nodiscard]] Pose2 at(std::int64_t time_ns) const;

 private:
  struct Sample {
    std::int64_t time_ns = 0;
    Pose2 pose;
  };
  std::deque<Sample> samples_;
};

}  // namespace outrider
