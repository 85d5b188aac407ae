// GoalField: how long a robot needs from each cell of a grid to its goal, around all that stands there.
//
// The robot is a point that goes from cell to cell, more slowly where less room is beside it: nowhere nearer
// to an obstacle than the largest disk in its footprint, at a quarter of its speed where it may have to
// align, and at full speed where nothing is within `wide_m` of its footprint. What nobody has seen counts as
// open. Keep-out zones are not entered, and slow zones crossed with their speed, at least a sixteenth of the
// full one. The wrong side of a passage takes half as long again. A goal outside the grid is reached from its
// edge: in the time that is told for places out there (map_field.hpp), or else in a straight line.
//
// Dijkstra from the goal over eight neighbours, with times in small units in a ring of buckets (Dial, 1969);
// it ends once the surroundings of the robot are reached. O(cells + obstacles * cells within most room).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/motion/footprint.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/navigate/zones.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The ground on which a robot goes, and its obstacles.
struct GoalGround {
  GridFrame frame;
  std::vector<Vec2> obstacles;  ///< points that it keeps clear of
  const std::vector<std::uint8_t>* closed =
      nullptr;                       ///< cells that are not 0 may not be entered; null: all may
  const ZoneCells* zones = nullptr;  ///< zones on these cells; null: none
};

/// The goal of a GoalField, and the room that a robot wants.
struct GoalQuery {
  Vec2 goal;
  double within_m = 0.1;  ///< distance from the goal at which the robot has arrived
  double wide_m = 0.35;   ///< room beside its footprint at which a robot goes at full speed
  double margin_m = 0.0;  ///< room that it keeps at least
  /// Returns the time to the goal from a place at the edge of the grid, s; nothing where there is no way.
  /// Empty: what lies beyond is not known.
  std::function<std::optional<double>(Vec2)> beyond = {};
  int side = 0;            ///< of passages that is preferred: -1 right, 1 left, 0 none; the other costs time
  double passage_m = 3.0;  ///< width of the widest passage that has sides
};

class GoalField {
 public:
  /// Computes the times, at least those around `place` and those that are less; all if there is no place.
  void compute(const GoalGround& ground, const Footprint& footprint, const RobotModel& robot,
               const GoalQuery& query, std::optional<Vec2> place);

  /// Returns the time from a place to the goal, s; nothing if no way is known. Interpolated.
  [[nodiscard]] std::optional<double> time_s(Vec2 place) const;
  /// Returns the direction in which the time falls fastest; nothing where none is known.
  [[nodiscard]] std::optional<Vec2> downhill(Vec2 place) const;
  /// Returns the way down from a place to the goal, or to the edge of the window, at most `most_m` long.
  [[nodiscard]] std::vector<Vec2> way(Vec2 place, double most_m) const;

 private:
  using Units = std::uint32_t;  // of time: a sixteenth of that to cross a cell at full speed
  static constexpr Units unknown = 0xffffffff;

  void find_room(const GoalGround& ground, const Footprint& footprint, const GoalQuery& query);
  void slow_down(const ZoneCells& zones, const RobotModel& robot);
  void let_out(Vec2 place, const ZoneCells* zones);
  void seed(const GoalQuery& query);
  void seed_edge(const GoalQuery& query);
  void spread(std::optional<Vec2> place);
  void reach(std::size_t cell, Units time);
  [[nodiscard]] Units units_at(Cell cell) const {
    return frame_.contains(cell) ? time_[frame_.index(cell)] : unknown;
  }

  GridFrame frame_;
  double unit_s_ = 1.0;
  std::vector<float> distance_m_;    // to the nearest obstacle, by cell
  std::vector<std::uint8_t> pace_;   // to cross a cell, by cell; 0: no room
  std::vector<std::uint8_t> wrong_;  // by cell, a bit for each way that is on the wrong side; empty: none
  std::vector<Units> time_;          // to the goal, by cell
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::pair<Units, std::uint32_t>>
      edge_;                 // cells at the edge to be reached from outside, latest first
  std::size_t waiting_ = 0;  // entries in the buckets
};

}  // namespace outrider
