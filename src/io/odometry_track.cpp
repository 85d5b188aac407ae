#include "odometry_track.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider {

Status OdometryTrack::add(std::int64_t time_ns, const Pose2& odom_T_robot) {
  constexpr std::int64_t window_ns = 30'000'000'000;
  constexpr std::size_t most_samples = 100'000;
  if (!finite(odom_T_robot)) return bad_input("a pose of the odometry is not finite; leave the message out");
  if (!empty() && time_ns < last_ns()) {
    return bad_input(
        fmt::format("the time of the odometry goes back from {:.3f} s to {:.3f} s; cut the log there",
                    1e-9 * static_cast<double>(last_ns()), 1e-9 * static_cast<double>(time_ns)));
  }
  if (!empty() && time_ns == last_ns()) samples_.pop_back();
  samples_.push_back({time_ns, odom_T_robot});
  while (samples_.size() > most_samples ||
         (samples_.size() > 2 && time_ns - samples_[1].time_ns > window_ns)) {
    samples_.pop_front();
  }
  return {};
}

Pose2 OdometryTrack::at(std::int64_t time_ns) const {
  const auto after = std::ranges::lower_bound(samples_, time_ns, {}, &Sample::time_ns);
  if (after == samples_.end()) return samples_.back().pose;
  if (after->time_ns == time_ns || after == samples_.begin()) return after->pose;
  const Sample& before = *std::prev(after);
  const double share =
      static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after->time_ns - before.time_ns);
  const double turn_rad = wrap_angle(after->pose.heading_rad - before.pose.heading_rad);
  return {before.pose.position + share * (after->pose.position - before.pose.position),
          before.pose.heading_rad + share * turn_rad};
}

}  // namespace outrider
