#include "outrider/jobs/explore/mission/touch_marks.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// The obstacle at a touch, in the frame of the robot: a straight piece across the bearing of the contact, so
/// long to either side; or the part of the rim ahead if the bumper does not tell the bearing.
std::vector<Vec2> touched_obstacle(const Observation& seen, double radius_m, double half_m, bool backwards) {
  constexpr double beyond_m = 0.003, apart_m = 0.02;
  const int parts = static_cast<int>(std::ceil(half_m / apart_m));  // to either side
  std::vector<Vec2> points;
  for (int i = -parts; i <= parts; ++i) {
    const double part = static_cast<double>(i) / parts;
    if (seen.touch_rad) {
      const Vec2 towards = direction(*seen.touch_rad);
      points.push_back((radius_m + beyond_m) * towards + part * half_m * Vec2{-towards.y, towards.x});
    } else {
      points.push_back((radius_m + beyond_m) * direction((backwards ? pi : 0.0) + 0.6 * part));
    }
  }
  return points;
}

}  // namespace

/// Returns how far what is touched is taken to reach to either side: twice as far for each earlier touch of
/// the same straight edge. So the robot feels its way along a glass wall in a few touches.
double TouchMarks::half_length_m(Vec2 contact, Vec2 towards) const {
  constexpr double first_radii = 0.75, most_m = 0.4, same_edge_m = 0.03, nearby_edge_m = 1.0;
  double half_m = first_radii * radius_m_;
  for (const Vec2 other : contacts_) {
    const Vec2 off = other - contact;
    if (norm(off) < nearby_edge_m && std::abs(dot(off, towards)) < same_edge_m) half_m *= 2.0;
  }
  return std::min(half_m, most_m);
}

void TouchMarks::note(const Observation& seen, const ScanLocaliser& where, TraversabilityGrid& ground) {
  constexpr double new_m = 0.03;
  const bool backwards = where.twist().ahead_mps < 0.0;
  const double bearing_rad = seen.touch_rad.value_or(backwards ? pi : 0.0);
  const Vec2 contact = where.pose() * (radius_m_ * direction(bearing_rad));
  const Vec2 towards = direction(where.pose().heading_rad + bearing_rad);
  new_ = std::ranges::none_of(contacts_, [&](Vec2 other) { return distance(other, contact) < new_m; });
  const double half_m = half_length_m(contact, towards);
  contacts_.push_back(contact);
  const Pose2 since_scan = relative_pose(where.slam().pose(), where.pose());
  for (const Vec2 point : touched_obstacle(seen, radius_m_, half_m, backwards)) {
    touches_.push_back({where.scans(), since_scan * point});
    points_.push_back(where.pose() * point);
    if (ground.frame().size() > 0) ground.mark_touched(points_.back());
  }
}

void TouchMarks::mark(TraversabilityGrid& ground, const LaserSlam& slam) {
  if (std::exchange(redraws_, false)) {
    const std::vector<Pose2> came = slam.trajectory();
    ground.forget_marks();
    for (std::size_t i = 1; i < came.size(); ++i) ground.mark_open({came[i - 1].position, came[i].position});
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      const auto scan = std::min(static_cast<std::size_t>(touches_[i].scan), came.size() - 1);
      points_[i] = came[scan] * touches_[i].point;
      ground.mark_touched(points_[i]);
    }
  }
  const Pose2 here = slam.pose();
  ground.mark_open({trail_end_.value_or(here).position, here.position});
  trail_end_ = here;
}

}  // namespace outrider
