// Surroundings: what stands near a robot, for many questions about where its footprint would touch something.
//
// The distance from a place to the nearest mark is exact at the middles of the cells of a small grid, and
// interpolated between them: at more than 0.15 m from every mark it is at most 3 mm too large, and half a
// cell too small where two marks are equally far. The gap between a footprint and the marks is exact. look()
// is O(marks), find_distances() O(marks * cells within most_m); then a query is O(1), and that of a footprint
// O(marks beside it). Thread rule: const queries may run concurrently.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/motion/footprint.hpp"
#include "outrider/navigate/live_map.hpp"
#include "outrider/navigate/zones.hpp"

namespace outrider {

class Surroundings {
 public:
  /// Distances are told up to that.
  static constexpr double most_m = 0.6;

  /// Takes the marks of a map that do not move, within `reach_m` of a place, in x and in y; with `edges`
  /// those of the allowed ground too, and the keep-out zones there. These count as marks that are nearer by
  /// the margin of the zones less `margin_m`, that of the motion.
  void look(const LiveMap& map, Vec2 middle, double reach_m, bool edges = true, const Zones* zones = nullptr,
            double margin_m = 0.0);
  /// Leaves the marks that a footprint overlaps out of gap(): they are where the robot is, so they are off by
  /// a little, and nothing else may be touched because of them.
  void leave_inside(const Footprint& footprint, const Pose2& pose);
  /// Finds the distances that clearance() tells, of what look() took.
  void find_distances();

  /// Returns the places of the marks that were taken, tile by tile.
  [[nodiscard]] const std::vector<Vec2>& places() const { return places_; }
  /// Returns the distance from a place to the nearest mark, m, at most most_m; that outside the grid too.
  /// After find_distances().
  [[nodiscard]] double clearance(Vec2 place) const;
  /// Returns the distance from the footprint of a robot at a pose to the nearest mark, m, at most `most`; it
  /// is negative where they overlap.
  [[nodiscard]] double gap(const Footprint& footprint, const Pose2& pose, double most) const;
  /// Returns the same for the marks that were left out, at most 0.
  [[nodiscard]] double inside_gap(const Footprint& footprint, const Pose2& pose) const;
  /// Returns the distance to the nearest edge of a keep-out zone, without the margin; 0 where they overlap.
  [[nodiscard]] double zone_gap(const Footprint& footprint, const Pose2& pose, double most) const;
  /// Returns the room that a motion keeps from keep-out zones, m.
  [[nodiscard]] double zone_margin_m() const { return zone_margin_m_; }

 private:
  void sort_into_tiles();

  GridFrame frame_;
  GridFrame tiles_;
  std::vector<Vec2> places_;
  std::vector<Vec2> inside_;          // that were left out
  std::vector<std::uint32_t> first_;  // tile -> its first place, one more at the end
  std::vector<float> distance_m_;     // by cell
  std::vector<Segment> edges_;        // of keep-out zones
  double zone_margin_m_ = 0.0;
  double nearer_m_ = 0.0;  // by which edges count as nearer than they are
};

}  // namespace outrider
