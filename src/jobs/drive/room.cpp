#include "room.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/control/rounded_path.hpp"
#include "outrider/core/bisect.hpp"

namespace outrider {
namespace {

constexpr int halvings = 12;
constexpr double kept = 0.9;           ///< part of the margin of the legs
constexpr double most_margin_m = 0.5;  ///< more is not distinguished

/// Returns by how much the corner between two legs may be cut.
double room_m(Vec2 before, Vec2 at, Vec2 after, const DriveTask& task, const CollisionMap& ground) {
  if (before == at || at == after) return 0.0;
  const double margin_m = largest_up_to(most_margin_m, halvings, [&](double c) {
    return ground.segment_free({before, at}, task.radius_m + c) &&
           ground.segment_free({at, after}, task.radius_m + c);
  });
  const Vec2 in = at - before, out = after - at;
  const double sine = std::abs(std::sin(0.5 * std::atan2(cross(in, out), dot(in, out))));
  const double all_m = 0.25 * sine * std::min(norm(in), norm(out));  // what a curve over a whole leg cuts
  return largest_up_to(std::min(task.follow.pass_m, all_m), halvings, [&](double room) {
    const auto curve = rounded_corner(before, at, after, room, 1.0, 1.0);
    for (std::size_t i = 1; i < curve.size(); ++i) {
      if (!ground.segment_free({curve[i - 1], curve[i]}, task.radius_m + kept * margin_m)) return false;
    }
    return true;
  });
}

}  // namespace

void set_rooms(DriveTask& task, const CollisionMap& ground) {
  Vec2 before = task.start.position;
  for (std::size_t i = 0; i + 1 < task.waypoints.size(); ++i) {
    Waypoint& waypoint = task.waypoints[i];
    const Vec2 at = waypoint.pose.position;
    if (!waypoint.stop)
      waypoint.room_m = room_m(before, at, task.waypoints[i + 1].pose.position, task, ground);
    before = at;
  }
}

}  // namespace outrider
