#include "outrider/jobs/explore/map/map_doubt.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double most_contradicted = 0.1;  ///< share of the scans; people and noise make a few

}  // namespace

std::string range_finder_doubt(const LaserSlam& slam) {
  const std::string why = why_not_believed(slam.check_range_finder());
  return why.empty() ? why : why + ", so its map cannot be right";
}

std::string map_doubt(const LaserSlam& slam) {
  const std::vector<std::size_t> gaps = slam.gaps();
  const MapCheck check = slam.check();
  const bool contradicted =
      static_cast<double>(check.contradicted) > most_contradicted * static_cast<double>(check.scans);
  if (gaps.empty() && check.jumps.empty() && check.crossings.empty() && !contradicted)
    return range_finder_doubt(slam);
  const std::vector<Pose2> poses = slam.trajectory();
  const auto at = [&](std::size_t pose) {
    return fmt::format("({:.2f}, {:.2f})", poses[pose].position.x, poses[pose].position.y);
  };
  if (!gaps.empty()) {
    return fmt::format(
        "at {} the scans matched nothing, and odometry alone joins the map before and after; "
        "was the robot moved?",
        at(gaps.front()));
  }
  if (!check.jumps.empty()) {
    const Jump& jump = check.jumps.front();
    return fmt::format(
        "at {} its scans jump by {:.2f} m and {:.0f} degrees against odometry; was the robot "
        "moved, or does a wheel slip?",
        at(jump.after), distance(jump.by_map.position, jump.by_odometry.position),
        degrees(std::abs(wrap_angle(jump.by_map.heading_rad - jump.by_odometry.heading_rad))));
  }
  if (!check.crossings.empty()) {
    return fmt::format(
        "at {} its path leads through what its map shows as occupied; did a door close there, or was the "
        "robot moved to a place that looks alike?",
        at(check.crossings.front()));
  }
  return fmt::format("{} of {} scans contradict others about what is free, so the map cannot be right",
                     check.contradicted, check.scans);
}

}  // namespace outrider
