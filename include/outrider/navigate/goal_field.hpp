// GoalField: how long a robot needs from each cell of the live map to its goal, around all that is marked.
//
// The robot is a point that goes from cell to cell, more slowly where less room is beside it: nowhere nearer
// to a mark than the largest disk in its footprint, at a quarter of its speed where it may have to align, and
// at full speed where nothing is within `wide_m` of its footprint. A goal outside the window is reached in a
// straight line from the edge of the window. What nobody has seen counts as open.
//
// Dijkstra from the goal over eight neighbours, with times in small units in a ring of buckets (Dial, 1969);
// it ends once the surroundings of the robot are reached. O(cells + marks * cells within most room).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/motion/footprint.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/navigate/live_map.hpp"

namespace outrider {

/// The goal of a GoalField, and the room that a robot wants.
struct GoalQuery {
  Vec2 goal;
  double within_m = 0.1;  ///< distance from the goal at which the robot has arrived
  double wide_m = 0.35;   ///< room beside its footprint at which a robot goes at full speed
  double margin_m = 0.0;  ///< room that it keeps at least
};

class GoalField {
 public:
  /// Computes the times for a robot that is somewhere now.
  void compute(const LiveMap& map, const Footprint& footprint, const RobotModel& robot,
               const GoalQuery& query, Vec2 place);

  /// Returns the time from a place to the goal, s; nothing if no way is known. Interpolated.
  [[nodiscard]] std::optional<double> time_s(Vec2 place) const;
  /// Returns the direction in which the time falls fastest; nothing where none is known.
  [[nodiscard]] std::optional<Vec2> downhill(Vec2 place) const;
  /// Returns the way down from a place to the goal, or to the edge of the window, at most `most_m` long.
  [[nodiscard]] std::vector<Vec2> way(Vec2 place, double most_m) const;

 private:
  using Units = std::uint32_t;  // of time: a sixteenth of that to cross a cell at full speed
  static constexpr Units unknown = 0xffffffff;

  void find_room(const LiveMap& map, const Footprint& footprint, const GoalQuery& query, Vec2 place);
  void seed(const GoalQuery& query);
  void spread(Vec2 place);
  void reach(std::size_t cell, Units time);
  [[nodiscard]] Units units_at(Cell cell) const {
    return frame_.contains(cell) ? time_[frame_.index(cell)] : unknown;
  }

  GridFrame frame_;
  double unit_s_ = 1.0;
  std::vector<float> distance_m_;   // to the nearest mark, by cell
  std::vector<std::uint8_t> pace_;  // to cross a cell, by cell; 0: no room
  std::vector<Units> time_;         // to the goal, by cell
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::pair<Units, std::uint32_t>>
      edge_;                 // cells at the edge to be reached from outside, latest first
  std::size_t waiting_ = 0;  // entries in the buckets
};

}  // namespace outrider
