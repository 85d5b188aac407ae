// TouchMarks: what a robot marks on its ground: where it has driven, which stays open, and what it touched,
// which stays blocked although its range finder may see nothing there. The marks move with the map when that
// is drawn anew.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/jobs/explore/map/traversability_grid.hpp"
#include "outrider/jobs/explore/mission/scan_localiser.hpp"

namespace outrider {

class TouchMarks {
 public:
  explicit TouchMarks(double radius_m) : radius_m_(radius_m) {}

  /// Notes that the bumper was pressed, and marks the obstacle on the ground, if there is one yet.
  /// O(touches).
  void note(const Observation& seen, const ScanLocaliser& where, TraversabilityGrid& ground);
  /// Brings the ground up to date: the driven trail, and after redraw() all that was touched.
  void mark(TraversabilityGrid& ground, const LaserSlam& slam);
  /// The map was drawn anew, or marks have to go: all are set again at the next mark().
  void redraw() { redraws_ = true; }

  /// Returns points of the obstacles that it touched, in the world by the newest estimate.
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
  /// Returns true once after it touched something that was not touched before.
  bool take_new() { return std::exchange(new_, false); }

 private:
  struct Touch {
    std::int64_t scan = 0;  ///< number of scans before
    Vec2 point;             ///< in the frame of the robot at the newest of these scans
  };
  [[nodiscard]] double half_length_m(Vec2 contact, Vec2 towards) const;

  double radius_m_;
  std::vector<Vec2> contacts_;  ///< where it touched something, in the world of that time
  std::vector<Touch> touches_;
  std::vector<Vec2> points_;        ///< the same in the world
  std::optional<Pose2> trail_end_;  ///< pose up to which the driven trail is marked
  bool new_ = false;
  bool redraws_ = false;
};

}  // namespace outrider
