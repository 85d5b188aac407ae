// OpenGround: what a disk robot bumps into in a world without edges.
//
// Thread rule: const queries may run concurrently.
#pragma once

#include "outrider/motion/robot_model.hpp"
#include "outrider/sim/explorer_sim_params.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

class OpenGround {
 public:
  /// What rises less than `climbs_m` above the floor is in nobody's way.
  OpenGround(const World& world, const RobotModel& robot, double climbs_m = ExplorerWheels{}.climbs_m);

  /// Returns true if the disk can be swept along the segment without touching anything. Exact.
  [[nodiscard]] bool free(Segment s) const;
  /// Distance of the disk's rim from the nearest obstacle, m, negative where it overlaps; at most 1 m.
  [[nodiscard]] double gap_m(Vec2 centre) const;
  /// The box around all obstacles; empty without one.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

 private:
  double radius_m_;
  Box2 bounds_;
  CollisionMap ground_;  // within bounds far enough from everything
};

}  // namespace outrider
