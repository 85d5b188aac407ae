// Zones: the keep-out and slow zones of a robot (world/zone.hpp), as planners and motions ask for them.
//
// A keep-out zone is a wall that no beam takes away, from which the footprint stays `margin_m` away: that
// much may the pose be wrong. The robot is slow before any part of it, and that margin, is in a slow zone.
// Thread rule: const queries may run concurrently.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/footprint.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/zone.hpp"

namespace outrider {

/// Options of zones and passages.
struct ZoneOptions {
  double margin_m = 0.1;      ///< room that the footprint keeps from keep-out zones
  std::string side = "none";  ///< of passages that is preferred: right, left or none
  double passage_m = 3.0;     ///< width of the widest passage that has sides
};
std::vector<Option> describe(ZoneOptions& options);

/// Zones on the cells of a grid.
struct ZoneCells {
  std::vector<float> room_m;     ///< distance to keep-out zones less the margin; in one: in_zone. Empty: none
  std::vector<float> speed_mps;  ///< largest speed, infinite if any. Empty: any everywhere

  static constexpr float in_zone = -1e3F;
};

class Zones {
 public:
  Zones() = default;
  /// `margin_m` is the room that the footprint keeps from keep-out zones.
  Zones(std::vector<Zone> zones, double margin_m);

  [[nodiscard]] bool empty() const { return zones_.empty(); }
  [[nodiscard]] double margin_m() const { return margin_m_; }

  /// Returns the zones on a grid, with room up to `most_m`. O(corners + cells in zones + points on edges *
  /// cells within most_m).
  [[nodiscard]] ZoneCells cells(const GridFrame& frame, double most_m) const;
  /// Returns the edges of keep-out zones that reach into a square around a place.
  [[nodiscard]] std::vector<Segment> edges_near(Vec2 middle, double reach_m) const;
  /// Returns true if a footprint at a pose overlaps a keep-out zone. Exact.
  [[nodiscard]] bool overlap(const Footprint& footprint, const Pose2& pose) const;
  /// Returns the largest speed from which a robot can brake before its disk of a radius, and the margin, is
  /// in a slow zone; within one that of the zone.
  [[nodiscard]] double most_mps(Vec2 place, double radius_m, const RobotModel& robot, double period_s) const;

 private:
  std::vector<Zone> zones_;
  std::vector<Box2> bounds_;  // of each
  double margin_m_ = 0.0;
};

}  // namespace outrider
