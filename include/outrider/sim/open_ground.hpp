// OpenGround: the obstacles that a disk robot can touch, in a world without a boundary.
//
// Thread rule: const queries may run concurrently.
#pragma once

#include <vector>

#include "outrider/motion/footprint.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/faults/explorer_sim_params.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

class OpenGround {
 public:
  /// Anything lower than `climbs_m` above the floor is not an obstacle.
  OpenGround(const World& world, const RobotModel& robot, double climbs_m = ExplorerWheels{}.climbs_m);

  /// Returns true if the disk can be swept along the segment without touching anything. Exact.
  [[nodiscard]] bool free(Segment s) const;
  /// Returns the distance from the rim of the disk to the nearest obstacle, m. It is negative if they
  /// overlap, and cut off at 1 m.
  [[nodiscard]] double gap_m(Vec2 centre) const;
  /// Returns the distance from the footprint of a robot at a pose to the nearest obstacle, m, at most 1 m;
  /// negative if they overlap. O(obstacles).
  [[nodiscard]] double gap_m(const Footprint& footprint, const Pose2& pose) const;
  /// Returns the direction in which the gap shrinks fastest, rad: that of the nearest obstacle within 1 m.
  [[nodiscard]] double towards_nearest(Vec2 centre) const;
  /// Returns the bounding box of all obstacles; empty if there are none.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

 private:
  double radius_m_;
  Box2 bounds_;
  std::vector<Box2> boxes_;  // of the obstacles
  CollisionMap ground_;      // its bounds lie far outside all obstacles
};

}  // namespace outrider
