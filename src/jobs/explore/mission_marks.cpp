// The marks of the robot on its ground: places where it has driven, obstacles that it touched, and gaps that
// it tries.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mission_parts.hpp"

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

/// Returns how far what is touched is taken to reach to either side: twice as far for each earlier touch of
/// the same straight edge. So the robot feels its way along a glass wall in a few touches.
double half_length_m(const ExploreMission& mission, Vec2 contact, Vec2 towards) {
  constexpr double first_radii = 0.75, most_m = 0.4, same_edge_m = 0.03, nearby_edge_m = 1.0;
  double half_m = first_radii * mission.task.robot.radius_m;
  for (const Vec2 other : mission.contacts) {
    const Vec2 off = other - contact;
    if (norm(off) < nearby_edge_m && std::abs(dot(off, towards)) < same_edge_m) half_m *= 2.0;
  }
  return std::min(half_m, most_m);
}

NarrowPlace& narrow_at(ExploreMission& mission, Vec2 place) {
  for (NarrowPlace& one : mission.narrow) {
    if (distance(one.place, place) <= same_place_m) return one;
  }
  return mission.narrow.emplace_back(NarrowPlace{place, 0.0, false, 0});
}

/// Returns true if the robot has driven through the place.
bool driven_through(const ExploreMission& mission, Vec2 place) {
  const double near_m = mission.frontiers.frame().resolution_m;
  return std::ranges::any_of(mission.slam.trajectory(),
                             [&](const Pose2& pose) { return distance(pose.position, place) <= near_m; });
}

}  // namespace

void note_touch(ExploreMission& mission, const Observation& seen) {
  constexpr double new_m = 0.03;
  const double radius_m = mission.task.robot.radius_m;
  const bool backwards = mission.twist.ahead_mps < 0.0;
  const double bearing_rad = seen.touch_rad.value_or(backwards ? pi : 0.0);
  const Vec2 contact = mission.pose * (radius_m * direction(bearing_rad));
  const Vec2 towards = direction(mission.pose.heading_rad + bearing_rad);
  mission.new_touch =
      std::ranges::none_of(mission.contacts, [&](Vec2 other) { return distance(other, contact) < new_m; });
  const double half_m = half_length_m(mission, contact, towards);
  mission.contacts.push_back(contact);
  const Pose2 since_scan = relative_pose(mission.slam.pose(), mission.pose);
  for (const Vec2 point : touched_obstacle(seen, radius_m, half_m, backwards)) {
    mission.touches.push_back({mission.scans, since_scan * point});
    mission.touched.push_back(mission.pose * point);
    if (mission.frontiers.frame().size() > 0) mission.frontiers.ground().mark_touched(mission.touched.back());
  }
}

void mark_ground(ExploreMission& mission) {
  TraversabilityGrid& ground = mission.frontiers.ground();
  if (mission.marks_moved) {
    const std::vector<Pose2> came = mission.slam.trajectory();
    ground.forget_marks();
    for (std::size_t i = 1; i < came.size(); ++i) ground.mark_open({came[i - 1].position, came[i].position});
    for (std::size_t i = 0; i < mission.touches.size(); ++i) {
      const TouchedPoint& touch = mission.touches[i];
      const auto scan = std::min(static_cast<std::size_t>(touch.scan), came.size() - 1);
      mission.touched[i] = came[scan] * touch.point;
      ground.mark_touched(mission.touched[i]);
    }
    mission.marks_moved = false;
  }
  const Pose2 here = mission.slam.pose();
  ground.mark_open({mission.trail_end.value_or(here).position, here.position});
  mission.trail_end = here;
}

bool open_narrow_way(ExploreMission& mission, const LeftOvers& left) {
  for (const NarrowWay& way : left.worth_a_try) {
    bool opened = false;
    for (std::size_t i = 1; i < way.points.size(); ++i)
      opened = mission.frontiers.ground().mark_open({way.points[i - 1], way.points[i]}) || opened;
    if (!opened) continue;
    const bool known = std::ranges::any_of(mission.narrow, [&](const NarrowPlace& one) {
      return distance(one.place, way.narrowest) <= same_place_m;
    });
    narrow_at(mission, way.narrowest);
    if (!known) {
      add_event(mission, "narrow",
                fmt::format("it tries the gap at ({:.2f}, {:.2f}), which may be wide enough", way.narrowest.x,
                            way.narrowest.y));
    }
    return true;
  }
  return false;
}

void note_too_narrow(ExploreMission& mission, bool measured) {
  const PathRoom room = *mission.room;
  if (driven_through(mission, room.narrowest)) return;
  NarrowPlace& place = narrow_at(mission, room.narrowest);
  if (measured && place.measured) return;  // it is sent here all the same, as along its trail
  mission.looks = {};
  place.place = room.narrowest;
  place.tries += measured ? 0 : 1;
  place.measured = place.measured || measured;
  if (std::isfinite(room.least_m)) place.width_m = std::max(place.width_m, 2.0 * room.least_m);
  if (measured) {
    add_event(mission, "narrow",
              fmt::format("the gap at ({:.2f}, {:.2f}) is {:.3f} m wide, too narrow for it", place.place.x,
                          place.place.y, place.width_m));
  }
  mission.marks_moved = true;
  mission.path.reset();
  mission.room.reset();
}

}  // namespace outrider
