#include "outrider/sim/open_ground.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr double farthest_m = 1.0;  ///< that gap_m() tells

/// Returns the obstacles that the solids form between the height that the wheels climb and the robot's top.
std::vector<RoundedPolygon> obstacles(const World& world, const RobotModel& robot, double climbs_m) {
  return CollisionMap::of(world, robot.height_m, climbs_m, robot.max_slope_rad).obstacles();
}

Box2 box_around(const std::vector<RoundedPolygon>& pieces) {
  Box2 box;
  for (const RoundedPolygon& piece : pieces) {
    box.include(piece.bounds().low);
    box.include(piece.bounds().high);
  }
  return box;
}

}  // namespace

OpenGround::OpenGround(const World& world, const RobotModel& robot, double climbs_m)
    : radius_m_(robot.radius_m), ground_({{0.0, 0.0}, {0.0, 0.0}}, {}) {
  std::vector<RoundedPolygon> pieces = obstacles(world, robot, climbs_m);
  bounds_ = box_around(pieces);
  for (const RoundedPolygon& piece : pieces) boxes_.push_back(piece.bounds());
  if (!bounds_.empty())
    ground_ = CollisionMap(bounds_.grown(2.0 * (radius_m_ + farthest_m)), std::move(pieces));
}

bool OpenGround::free(Segment s) const {
  if (bounds_.empty()) return true;
  const Box2 near = bounds_.grown(radius_m_ + farthest_m);
  if (near.contains(s.a) && near.contains(s.b)) return ground_.segment_free(s, radius_m_);
  const std::vector<Vec2> corners = {
      near.low, {near.high.x, near.low.y}, near.high, {near.low.x, near.high.y}};
  const auto inside = cut(corners, s.a, s.b - s.a, 0.0, 1.0);
  if (!inside) return true;
  const auto at = [&](double t) { return s.a + t * (s.b - s.a); };
  return ground_.segment_free({at(inside->low), at(inside->high)}, radius_m_);
}

double OpenGround::gap_m(Vec2 centre) const {
  if (bounds_.empty() || !bounds_.grown(radius_m_ + farthest_m).contains(centre)) return farthest_m;
  return ground_.clearance(centre, radius_m_ + farthest_m) - radius_m_;
}

double OpenGround::gap_m(const Footprint& footprint, const Pose2& pose) const {
  double least_m = farthest_m;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].distance_to(pose.position) > footprint.outer_m() + least_m) continue;
    least_m = std::min(least_m, footprint.gap_m(pose, ground_.obstacles()[i]));
  }
  return least_m;
}

double OpenGround::towards_nearest(Vec2 centre) const {
  constexpr double step_m = 1e-4;
  const auto slope = [&](Vec2 step) { return gap_m(centre - step) - gap_m(centre + step); };
  return heading_of(Vec2{slope({step_m, 0.0}), slope({0.0, step_m})});
}

}  // namespace outrider
