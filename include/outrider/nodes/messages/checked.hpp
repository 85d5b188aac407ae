// Checks of messages that others sent: what a node takes from them is finite, whole and not older than what
// it has. Faults: bad_input with a sentence that has the values.
#pragma once

#include <cstdint>
#include <optional>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the time of a stamp, s. Fault: for one before 1970 or with more than 999,999,999 ns.
Outcome<double> time_of(const builtin_interfaces::Time& stamp);

/// Takes the times of the messages of a topic. Refuses one older than the newest.
class NewestStamp {
 public:
  /// Returns the time, s.
  Outcome<double> take(const builtin_interfaces::Time& stamp);
  [[nodiscard]] const std::optional<double>& newest_s() const { return newest_s_; }

 private:
  std::optional<double> newest_s_;
};

/// Returns the pose in the plane. Fault: for numbers that are not finite or beyond 1e6 m, and for a rotation
/// that is none.
Outcome<Pose2> plane_pose(const geometry_msgs::Pose& pose);

/// Returns the map as values of Occupancy; 50 % and more is occupied. Fault: for sizes that do not fit the
/// data, more than 25 million cells, a resolution or an origin out of range, or a map turned about its
/// origin.
Outcome<Grid<std::uint8_t>> checked_map(const nav_msgs::OccupancyGrid& map);

/// Returns true if a frame has the cells of the one before and more, on the same lattice, as that of a map
/// that grows: what was computed of the map before can be updated.
bool grown_from(const GridFrame& frame, const GridFrame& before);

/// Notices when a map is begun anew: then what is known of places on the map before holds no more. The map
/// says by its load time when it was begun; maps without one, or with their stamp in its place, say nothing.
class MapBeginning {
 public:
  /// Returns true if this map was begun at another time than those before.
  bool is_another(const nav_msgs::OccupancyGrid& map);

 private:
  std::optional<std::int64_t> begun_ns_;
};

/// Returns the points of a path, at least one. Fault: for points that are not finite, and for none.
Outcome<std::vector<Pose2>> checked_path(const nav_msgs::Path& path);

/// Returns the message of a map that was begun at that time. The inverse of checked_map().
nav_msgs::OccupancyGrid map_message(const Grid<std::uint8_t>& map, double time_s, std::string frame,
                                    double begun_s = 0.0);

}  // namespace outrider
