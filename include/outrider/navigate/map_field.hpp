// MapField: how long a robot needs to its goal from anywhere on a known map, for all that lies outside the
// window of its live map.
//
// The map is what it was when it was made, but for the window, which is as the robot sees it, and for what it
// has seen elsewhere in the last minutes. Cells that are not known to be free are not entered. The cells are
// those of the map, at least 5 cm, and larger where the map has more than a million. O(cells) each time that
// it is computed (goal_field.hpp). Frames: the world of the map.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "outrider/navigate/goal_field.hpp"
#include "outrider/navigate/live_map.hpp"
#include "outrider/slam/map/map_localiser.hpp"

namespace outrider {

class MapField {
 public:
  explicit MapField(const KnownMap& map);

  /// Returns the places of the cells that bound the free ones, and are walls to a robot.
  [[nodiscard]] const LiveMap::Walls& walls() const { return walls_; }

  /// Keeps to zones from now on.
  void keep_to(const Zones& zones, double most_m);
  /// Returns the ground of the map, around what was seen outside the window too if it is `remembered`. It is
  /// valid as long as this object.
  [[nodiscard]] GoalGround ground(const LiveMap& live, bool remembered) const;
  /// Computes the times to a goal on that ground.
  void compute(const LiveMap& live, const Footprint& footprint, const RobotModel& robot,
               const GoalQuery& query, bool remembered);
  /// Returns the time from a place to the goal, s; nothing if no way is known.
  [[nodiscard]] std::optional<double> time_s(Vec2 place) const { return field_.time_s(place); }

 private:
  GridFrame frame_;
  std::vector<std::uint8_t> closed_;  // by cell
  LiveMap::Walls walls_;
  ZoneCells zones_;
  GoalField field_;
};

}  // namespace outrider
