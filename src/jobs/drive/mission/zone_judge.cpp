#include "mission/zone_judge.hpp"

#include <algorithm>

namespace outrider {
namespace {

// A robot is faster than allowed if it is so by more than that.
constexpr double over_part = 0.02, over_mps = 0.005;

/// Returns true if two polygons of one, two or more corners overlap or come nearer than a distance.
bool meet(const std::vector<Vec2>& polygon, const std::vector<Vec2>& ring, double near_m) {
  const auto side = [](const std::vector<Vec2>& corners, std::size_t i) {
    return Segment{corners[i], corners[(i + 1) % corners.size()]};
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (distance(side(polygon, i), side(ring, k)) <= near_m) return true;
    }
  }
  return false;
}

}  // namespace

ZoneJudge::ZoneJudge(const std::vector<Zone>& zones, const Footprint& footprint) : footprint_(footprint) {
  for (const Zone& zone : zones) {
    Watched& one = watched_.emplace_back(Watched{zone, {}});
    for (const std::vector<Vec2>& ring : zone.rings)
      std::ranges::for_each(ring, [&](Vec2 p) { one.bounds.include(p); });
  }
}

bool ZoneJudge::overlaps(const Watched& watched, const Pose2& pose) const {
  if (watched.bounds.distance_to(pose.position) > footprint_.outer_m()) return false;
  std::vector<Vec2> placed;
  for (const Vec2 corner : footprint_.shape().core) placed.push_back(pose * corner);
  const auto meets_ring = [&](const auto& ring) { return meet(placed, ring, footprint_.shape().radius_m); };
  // If the borders do not meet, all of the robot is in the zone or out of it, or has a whole ring within.
  return watched.zone.contains(placed.front()) ||
         std::ranges::any_of(watched.zone.rings, [&](const auto& ring) {
           return meets_ring(ring) || footprint_.gap_m(pose.to_local(ring.front())) < 0.0;
         });
}

void ZoneJudge::note(double time_s, const Pose2& truth) {
  const double passed_s = time_s_ ? time_s - *time_s_ : 0.0;
  const double speed_mps = passed_s > 0.0 ? distance(place_, truth.position) / passed_s : 0.0;
  bool over = false;
  for (Watched& one : watched_) {
    const bool was_inside = one.inside;
    one.inside = overlaps(one, truth);
    if (one.zone.kind == Zone::Kind::keep_out) {
      entered_ += one.inside && !was_inside ? 1 : 0;
    } else if (one.inside && was_inside) {
      over |= speed_mps > (1.0 + over_part) * one.zone.speed_mps + over_mps;
    }
  }
  if (over) over_slow_s_ += passed_s;
  time_s_ = time_s;
  place_ = truth.position;
}

}  // namespace outrider
