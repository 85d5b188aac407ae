#include "outrider/jobs/explore/mission/gap_passage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "map/rays.hpp"
#include "outrider/geometry/polyline.hpp"

namespace outrider {
namespace {

constexpr double point_m = 0.0005;  // half the side of a point of a surface

/// Returns true if the map leaves no room at the place.
bool is_narrow(const TraversabilityGrid& ground, Vec2 place) {
  const Cell cell = ground.frame().cell_at(place);
  return ground.frame().contains(cell) &&
         ground.crowded(static_cast<std::uint32_t>(ground.frame().index(cell)));
}

/// Returns true if a place is near another and in sight of it.
bool is_beside(const TraversabilityGrid& ground, Vec2 place, Vec2 other) {
  constexpr double beside_m = 2.0;
  const GridFrame& frame = ground.frame();
  if (distance(place, other) > beside_m || !frame.contains(frame.cell_at(place))) return false;
  bool is_free = true;
  const Cell end = frame.cell_at(other);
  walk_ray(frame.cell_at(place), end, [&](Cell cell) {
    is_free = is_free && frame.contains(cell) && ground.known()[cell] == free_cell;
    return is_free && cell != end;
  });
  return is_free;
}

/// Returns true if the next part of the path leads over ground on which the map leaves no room, or within
/// `beside_m` of what was touched, which the map does not show.
bool leads_through_narrow(const TraversabilityGrid& ground, const std::vector<Vec2>& touched, double beside_m,
                          Vec2 here, const PathProgress& path) {
  constexpr double ahead_m = 0.8;
  const auto narrow = [&](Vec2 point) {
    return is_narrow(ground, point) ||
           std::ranges::any_of(touched, [&](Vec2 other) { return distance(point, other) < beside_m; });
  };
  return narrow(here) || std::ranges::any_of(points_ahead(path, ahead_m), narrow);
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

std::optional<std::string> GapPassage::open_way(const LeftOvers& left, std::optional<Vec2> beside,
                                                TraversabilityGrid& ground) {
  for (const NarrowWay& way : left.worth_a_try) {
    if (beside && !is_beside(ground, *beside, way.points.front())) continue;
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

void GapPassage::shut_gaps(TraversabilityGrid& ground) const {
  for (const NarrowPlace& one : places_) {
    if (one.measured) ground.mark_shut(one.place, 0.5 * one.width_m + ground.frame().resolution_m);
  }
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
                      const std::vector<Vec2>& touched, PathProgress* path, Driving driving) {
  constexpr double ahead_m = 0.6, roomy_m = 0.06;
  constexpr double largest_error_m = 0.02;
  if (centred_scan_ == where.scans()) return true;
  centred_scan_ = where.scans();
  room_.reset();
  fits_ = true;
  const Vec2 here = where.pose().position;
  const double radius_m = task.robot.radius_m;
  if (path == nullptr || !leads_through_narrow(ground, touched, radius_m + roomy_m, here, *path)) {
    looks_ = {};
    return true;
  }
  surfaces_ = where.surfaces();
  surfaces_.insert(surfaces_.end(), touched.begin(), touched.end());
  room_ = centre_path(*path, here, {surfaces_, point_m}, ahead_m, radius_m + roomy_m);
  fits_ = room_->least_m >= radius_m - largest_error_m;
  return driving != Driving::to_goal || !std::isfinite(room_->least_m) || is_narrow(ground, here) ||
         judge(task, where, ground);
}

Follow GapPassage::order(const PathProgress& path, const RobotModel& robot) const {
  constexpr double straight_m = 0.002, beside_m = 0.1, play_part = 0.3, careful_m = 0.03;
  constexpr double aim_m = 0.2, same_m = 1e-3;
  // First straight to the farthest near point of the path that is as free; its next points would have the
  // robot turn with all the noise of the surfaces.
  const Nearby surfaces{surfaces_, point_m};
  const Vec2 here = path.points.front();
  const double free_m = std::min(room_->least_m, surfaces.clearance(here)) - same_m;
  std::size_t aim = 1;
  for (std::size_t i = 1; i < path.points.size() && distance(here, path.points[i]) < aim_m; ++i) {
    if (surfaces.clearance(Segment{here, path.points[i]}) >= free_m) aim = i;
  }
  std::vector<Vec2> points{here};
  std::ranges::copy(
      simplified({path.points.begin() + static_cast<std::ptrdiff_t>(aim), path.points.end()}, straight_m),
      std::back_inserter(points));
  TrackPieces legs;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] != points[i - 1]) legs.push_back({points[i - 1], points[i], {}});
  }
  const double play_m = std::max(0.0, room_->least_m - robot.radius_m);
  return {std::make_shared<const TrackPieces>(std::move(legs)), beside_m, play_part * play_m,
          (play_m < careful_m ? 0.5 : 1.0) * robot.speed_mps};
}

}  // namespace outrider
