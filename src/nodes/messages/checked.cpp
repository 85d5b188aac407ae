#include "outrider/nodes/messages/checked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/job/grid_message.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double most_m = 1e6;
constexpr std::uint64_t most_cells = 25'000'000;
constexpr double upright = 1e-3;  // of a quaternion, in x and y

bool within(double value) { return std::isfinite(value) && std::abs(value) <= most_m; }

std::uint8_t occupancy_of(std::int8_t percent) {
  if (percent < 0) return unknown_cell;
  return percent >= 50 ? occupied_cell : free_cell;
}

std::int8_t percent_of(std::uint8_t cell) {
  if (cell == unknown_cell) return -1;
  return cell == occupied_cell ? 100 : 0;
}

}  // namespace

Outcome<double> time_of(const builtin_interfaces::Time& stamp) {
  if (stamp.sec >= 0 && stamp.nanosec < 1'000'000'000U)
    return static_cast<double>(nanoseconds_of(stamp)) * 1e-9;
  return bad_input(fmt::format("its stamp is {} s and {} ns, which is no time", stamp.sec, stamp.nanosec));
}

Outcome<double> NewestStamp::take(const builtin_interfaces::Time& stamp) {
  auto time_s = time_of(stamp);
  if (!time_s) return time_s;
  if (newest_s_ && *time_s < *newest_s_) {
    return bad_input(fmt::format(
        "the time goes back from {:.3f} s to {:.3f} s; start the node anew if its clock was set back",
        *newest_s_, *time_s));
  }
  newest_s_ = *time_s;
  return time_s;
}

Outcome<Pose2> plane_pose(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& q = pose.orientation;
  if (!within(pose.position.x) || !within(pose.position.y)) {
    return bad_input(fmt::format("its position is {:g}, {:g}; numbers up to {:g} m are taken",
                                 pose.position.x, pose.position.y, most_m));
  }
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(length - 1.0) < 0.1)) {
    return bad_input(fmt::format(
        "its rotation is the quaternion {:g}, {:g}, {:g}, {:g}, whose length is not 1", q.x, q.y, q.z, q.w));
  }
  return pose_of(pose);
}

Outcome<Grid<std::uint8_t>> checked_map(const nav_msgs::OccupancyGrid& map) {
  const std::uint64_t cells = std::uint64_t{map.info.width} * map.info.height;
  const auto side = static_cast<std::uint32_t>(most_grid_side);
  if (cells != map.data.size()) {
    return bad_input(fmt::format("the map says that it has {} x {} cells, and comes with {}", map.info.width,
                                 map.info.height, map.data.size()));
  }
  if (cells == 0 || cells > most_cells || map.info.width > side || map.info.height > side) {
    return bad_input(fmt::format("the map has {} x {} cells; 1 to {} are taken", map.info.width,
                                 map.info.height, most_cells));
  }
  // The resolution is sent in single precision.
  const double resolution_m = std::round(1e6 * static_cast<double>(map.info.resolution)) / 1e6;
  if (!(resolution_m >= 1e-3 && resolution_m <= 100.0)) {
    return bad_input(fmt::format("the cells of the map have {:g} m; 0.001 m to 100 m are taken",
                                 static_cast<double>(map.info.resolution)));
  }
  const auto origin = plane_pose(map.info.origin);
  if (!origin) return pass_on(origin);
  if (std::abs(origin->heading_rad) > upright) {
    return bad_input(fmt::format("the map is turned by {:.2f} degrees; only maps along the axes are taken",
                                 degrees(origin->heading_rad)));
  }
  Grid<std::uint8_t> grid;
  grid.frame = {origin->position, resolution_m, static_cast<int>(map.info.width),
                static_cast<int>(map.info.height)};
  grid.cells.resize(map.data.size());
  std::ranges::transform(map.data, grid.cells.begin(), occupancy_of);
  return grid;
}

bool grown_from(const GridFrame& frame, const GridFrame& before) {
  constexpr double off = 1e-3;  // of a cell, by rounding
  if (frame.resolution_m != before.resolution_m) return false;
  const Vec2 low = 1.0 / frame.resolution_m * (before.origin - frame.origin);
  const Vec2 whole{std::round(low.x), std::round(low.y)};
  return norm(low - whole) < off && whole.x >= 0.0 && whole.y >= 0.0 &&
         whole.x + before.width <= frame.width && whole.y + before.height <= frame.height;
}

bool MapBeginning::is_another(const nav_msgs::OccupancyGrid& map) {
  const std::int64_t begun_ns = nanoseconds_of(map.info.map_load_time);
  if (begun_ns == 0 || begun_ns == nanoseconds_of(map.header.stamp)) return false;
  const bool another = begun_ns_ && *begun_ns_ != begun_ns;
  begun_ns_ = begun_ns;
  return another;
}

Outcome<std::vector<Pose2>> checked_path(const nav_msgs::Path& path) {
  if (path.poses.empty()) return bad_input("the path has no pose");
  std::vector<Pose2> poses;
  poses.reserve(path.poses.size());
  for (const geometry_msgs::PoseStamped& stamped : path.poses) {
    const auto pose = plane_pose(stamped.pose);
    if (!pose) return pass_on(pose);
    poses.push_back(*pose);
  }
  return poses;
}

nav_msgs::OccupancyGrid map_message(const Grid<std::uint8_t>& map, double time_s, std::string frame,
                                    double begun_s) {
  auto message = grid_message(map.frame, 0.0, time_s);
  message.header.frame_id = std::move(frame);
  message.info.map_load_time = stamp_of(begun_s);
  message.data.resize(map.cells.size());
  std::ranges::transform(map.cells, message.data.begin(), percent_of);
  return message;
}

}  // namespace outrider
