#include "outrider/jobs/explore/mission/gap_passage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns true if the next part of the path leads over ground on which the map leaves no room.
bool leads_through_narrow(const TraversabilityGrid& ground, Vec2 here, const PathProgress& path) {
  constexpr double ahead_m = 0.8, step_m = 0.02;
  const auto narrow = [&](Vec2 point) {
    const Cell cell = ground.frame().cell_at(point);
    return ground.frame().contains(cell) &&
           ground.crowded(static_cast<std::uint32_t>(ground.frame().index(cell)));
  };
  if (narrow(here)) return true;
  const double to_m = path.along_m + ahead_m;
  double before = 0.0;
  for (std::size_t i = 1; i < path.points.size() && before < to_m; ++i) {
    const double leg = distance(path.points[i - 1], path.points[i]);
    for (double at = std::max(0.0, path.along_m - before); at < leg && before + at < to_m; at += step_m) {
      if (narrow(path.points[i - 1] + (at / leg) * (path.points[i] - path.points[i - 1]))) return true;
    }
    before += leg;
  }
  return false;
}

/// Returns true if the robot has driven through the place.
bool driven_through(const LaserSlam& slam, Vec2 place, double near_m) {
  return std::ranges::any_of(slam.trajectory(),
                             [&](const Pose2& pose) { return distance(pose.position, place) <= near_m; });
}

}  // namespace

NarrowPlace& GapPassage::at(Vec2 place) {
  for (NarrowPlace& one : places_) {
    if (distance(one.place, place) <= same_place_m) return one;
  }
  return places_.emplace_back(NarrowPlace{place, 0.0, false, 0});
}

std::optional<std::string> GapPassage::open_way(const LeftOvers& left, TraversabilityGrid& ground) {
  for (const NarrowWay& way : left.worth_a_try) {
    bool opened = false;
    for (std::size_t i = 1; i < way.points.size(); ++i)
      opened = ground.mark_open({way.points[i - 1], way.points[i]}) || opened;
    if (!opened) continue;
    const std::size_t known = places_.size();
    at(way.narrowest);
    if (places_.size() == known) return std::string();
    return fmt::format("it tries the gap at ({:.2f}, {:.2f}), which may be wide enough", way.narrowest.x,
                       way.narrowest.y);
  }
  return std::nullopt;
}

/// Notes that the robot does not fit through the gap ahead, as far as it knows its width.
bool GapPassage::note(const ScanLocaliser& where, const TraversabilityGrid& ground, bool measured) {
  const PathRoom room = *room_;
  if (driven_through(where.slam(), room.narrowest, ground.frame().resolution_m)) return false;
  NarrowPlace& place = at(room.narrowest);
  if (measured && place.measured) return false;  // it is sent here all the same, as along its trail
  looks_ = {};
  place.place = room.narrowest;
  place.tries += measured ? 0 : 1;
  place.measured = place.measured || measured;
  if (std::isfinite(room.least_m)) place.width_m = std::max(place.width_m, 2.0 * room.least_m);
  newest_ = place;
  room_.reset();
  return true;
}

bool GapPassage::note_stuck(const ScanLocaliser& where, const TraversabilityGrid& ground) {
  return note(where, ground, false);
}

std::string GapPassage::sentence() const {
  return fmt::format("the gap at ({:.2f}, {:.2f}) is {:.3f} m wide, too narrow for it", newest_.place.x,
                     newest_.place.y, newest_.width_m);
}

/// Judges the narrowest place ahead by the looks at it. Returns false if it is too narrow.
bool GapPassage::judge(const ExploreTask& task, const ScanLocaliser& where,
                       const TraversabilityGrid& ground) {
  constexpr double beside_m = 0.05;       // of the rim
  constexpr double early_error_m = 0.01;  // farther off it is seen less well
  constexpr int sure = 6;
  const double radius_m = task.robot.radius_m;
  const double rim_m = distance(room_->narrowest, where.pose().position) - radius_m;
  const bool is_before = rim_m < 2.0 * beside_m;
  if (rim_m >= beside_m || looks_.count < sure) looks_.add(*room_);
  if (looks_.count < sure) {
    fits_ = fits_ && !is_before;
    return true;
  }
  const double wanted_m = radius_m + task.explore.gap_margin_m - (is_before ? 0.0 : early_error_m);
  if (looks_.room_m >= wanted_m) return true;
  room_->least_m = looks_.room_m;
  return !note(where, ground, true);
}

bool GapPassage::look(const ExploreTask& task, const ScanLocaliser& where, TraversabilityGrid& ground,
                      PathProgress* path, Driving driving) {
  constexpr double ahead_m = 0.6, roomy_m = 0.06, point_m = 0.0005;
  constexpr double largest_error_m = 0.02;
  if (centred_scan_ == where.scans()) return true;
  centred_scan_ = where.scans();
  room_.reset();
  fits_ = true;
  const Vec2 here = where.pose().position;
  if (path == nullptr || !leads_through_narrow(ground, here, *path)) {
    looks_ = {};
    return true;
  }
  surfaces_ = {where.surfaces(), point_m};
  if (driving == Driving::back) {
    room_ = PathRoom{surfaces_.clearance(here), here};
    return true;
  }
  const double radius_m = task.robot.radius_m;
  room_ = centre_path(*path, here, surfaces_, ahead_m, radius_m + roomy_m);
  fits_ = room_->least_m >= radius_m - largest_error_m;
  return driving != Driving::to_goal || !std::isfinite(room_->least_m) || judge(task, where, ground);
}

std::pair<RobotModel, SteerOptions> GapPassage::way_of_driving(const ExploreTask& task) const {
  std::pair<RobotModel, SteerOptions> driving{task.robot, task.steer};
  if (!room_) return driving;
  auto& [robot, steering] = driving;
  constexpr double careful_m = 0.03, lookahead_m = 0.2;
  const double play_m = std::max(0.0, room_->least_m - robot.radius_m);
  if (play_m < careful_m) robot.speed_mps *= 0.5;
  steering.least_gap_m = std::min(steering.least_gap_m, 0.7 * play_m);
  steering.lookahead_m = std::min(steering.lookahead_m, lookahead_m);
  return driving;
}

}  // namespace outrider
