#include "regions_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/log/conversions.hpp"
#include "outrider/log/gun_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map, double time_s) {
  const GridFrame& frame = firing_map.frame;
  for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
    const FiringRegion& region = firing_map.regions[t];
    outrider_msgs::FiringRegion message{problem.targets[t].name, {}};
    message.grid.header = header_of(log.time_of(time_s), "map");
    message.grid.info = {{},
                         static_cast<float>(frame.resolution_m),
                         static_cast<std::uint32_t>(frame.width),
                         static_cast<std::uint32_t>(frame.height),
                         pose_of(Pose2{frame.origin, 0.0})};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const bool hits = region.pitch[i] != FiringRegion::no_shot;
      const double forgiven =
          hits ? 100.0 * std::clamp(1.0 - static_cast<double>(region.error_ratio[i]), 0.01, 1.0) : 0.0;
      message.grid.data.push_back(
          static_cast<std::int8_t>(firing_map.reachable[i] != 0 ? std::lround(forgiven) : -1));
    }
    log.append(topic::firing_regions, time_s, std::move(message));
  }
}

}  // namespace outrider
