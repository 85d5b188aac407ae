#include "outrider/jobs/explore/mission/retreat.hpp"

#include <cmath>

#include "mission/near_robot.hpp"

namespace outrider {
namespace {

/// Returns the way back along which it came, `length_m` long.
std::vector<Vec2> way_back(const ScanLocaliser& where, double length_m) {
  std::vector<Vec2> way = {where.pose().position};
  const std::vector<Pose2> came = where.slam().trajectory();
  double length = 0.0;
  for (auto pose = came.rbegin(); pose != came.rend() && length < length_m; ++pose) {
    const double leg = distance(way.back(), pose->position);
    if (leg < 0.02) continue;
    length += leg;
    way.push_back(pose->position);
  }
  return way;
}

/// Returns the straight way of that length at whose end there is most room, among those that come no nearer
/// to anything; no way, if there is none.
std::vector<Vec2> freest_way(const Pose2& pose, const Nearby& nearby, double length_m) {
  constexpr int directions = 32;
  constexpr double error_m = 1e-3;
  const Vec2 here = pose.position;
  const double least_m = nearby.clearance(here) - error_m;
  std::vector<Vec2> way;
  double most_m = 0.0;
  for (int i = 0; i < directions; ++i) {
    const double turn_rad = 2.0 * pi * i / directions;
    const Vec2 there = here + length_m * direction(pose.heading_rad + turn_rad);
    const double room_m = nearby.clearance(there);
    if (room_m <= most_m || nearby.clearance(Segment{here, there}) < least_m) continue;
    most_m = room_m;
    way = {here, there};
  }
  return way;
}

}  // namespace

bool Retreat::stands_still(const Pose2& pose, double time_s, double patience_s) {
  constexpr double moved_m = 0.04, turned_rad = 0.3;
  const bool moved = distance(pose.position, stood_.position) > moved_m ||
                     std::abs(wrap_angle(pose.heading_rad - stood_.heading_rad)) > turned_rad;
  if (moved) moved_on(pose, time_s);
  return time_s - moved_on_s_ > patience_s;
}

std::int64_t Retreat::count(double driven_m, bool touched_new) {
  constexpr double elsewhere_m = 20.0;  // between two times stuck that have nothing in common
  if (driven_m - stuck_m_ > elsewhere_m) stuck_here_ = 0;
  stuck_m_ = driven_m;
  ++stuck_;
  if (!touched_new) ++stuck_here_;
  return stuck_here_;
}

std::vector<Vec2> Retreat::way(const ScanLocaliser& where, const Nearby& nearby, double length_m) {
  std::vector<Vec2> way;
  if (stuck_here_ % 2 == 0 && stuck_here_ > 0) way = freest_way(where.pose(), nearby, length_m);
  backwards_ = way.empty();
  if (backwards_) way = way_back(where, length_m);
  return way;
}

bool Retreat::often_here(double driven_m) const {
  constexpr std::int64_t often = 3;
  return stuck_here_ >= often && driven_m - stuck_m_ < nearby_m;
}

}  // namespace outrider
