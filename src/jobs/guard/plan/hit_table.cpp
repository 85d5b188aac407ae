#include "plan/hit_table.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "outrider/jobs/guard/plan/supply_plan.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr double lost_shot_s = 10.0;  // for a target that has no shot from where the robot got to

/// Displacements of a stop by the largest error of a drive.
std::array<Vec2, 4> displacements(double off_m) {
  return {Vec2{off_m, 0.0}, Vec2{0.0, off_m}, Vec2{-off_m, 0.0}, Vec2{0.0, -off_m}};
}

}  // namespace

std::vector<std::size_t>& HitTable::passing_beside(std::size_t stop) {
  const auto before = stops.begin() + static_cast<std::ptrdiff_t>(stop);
  const auto stations =
      std::count_if(stops.begin(), before, [](const ChosenStop& s) { return s.call.has_value(); });
  return passing[static_cast<std::size_t>(stations)];
}

HitTable hit_table_of(const GuardPlan& plan) {
  HitTable table;
  for (const PlannedStop& stop : plan.stops) {
    table.stops.push_back({stop.position, {}, stop.call});
    for (const PlannedHit& hit : stop.hits) table.stops.back().targets.push_back(hit.target);
    if (stop.call) table.passing.emplace_back();
  }
  return table;
}

TablePlanner::TablePlanner(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan)
    : problem_(problem),
      firing_map_(firing_map),
      plan_(plan),
      sure_(sure_hits(problem, firing_map, plan.targets())),
      passing_(problem, firing_map) {
  routes_index_[{problem.start.position.x, problem.start.position.y}] = 0;
  for (std::size_t i = 0; i < plan.stops.size(); ++i) {
    const Vec2 place = plan.stops[i].position;
    routes_index_[{place.x, place.y}] = i + 1;
  }
}

std::optional<GuardPlan> TablePlanner::plan_of(const HitTable& table) {
  GuardPlan result = plan_;
  result.stops.clear();
  Pose2 pose = problem_.start;
  GunState gun;
  auto segment = table.passing.begin();
  std::vector<std::size_t> left = *segment;
  for (const ChosenStop& chosen : table.stops) {
    if (!chosen.made()) continue;
    const auto& [place, targets, call] = chosen;
    PlannedStop stop{place, way(pose, place), {}, call};
    if (stop.waypoints.empty()) return std::nullopt;
    if (call) {  // the drive there is for the store alone, and the gun comes to rest
      if (!left.empty()) return std::nullopt;
      left = *++segment;
      gun = {};
    } else {
      stop.passing = passing_.along(pose.heading_rad, stop.waypoints, gun, left);
      for (const PassingHit& hit : stop.passing) std::erase(left, hit.target);
      gun = gun_after(stop.passing, gun);
    }
    pose = {place, drive(pose, stop.waypoints).heading_rad};
    for (const std::size_t target : targets) {
      const auto& shot = shot_from(place, target, gun.pitch_rad);
      if (!shot) return std::nullopt;
      stop.hits.push_back({target, *shot});
      gun = joints_of(firing_map_, pose, shot->gun);
    }
    result.stops.push_back(std::move(stop));
  }
  if (!left.empty()) return std::nullopt;
  PlanClock clock(problem_, firing_map_, result);
  while (!clock.done()) {
    clock.make_stop();
    if (!suffices(problem_.supplies, clock.level())) return std::nullopt;
  }
  result.cost_s = clock.end_s();
  return result;
}

double TablePlanner::drives_s(const HitTable& table) {
  Pose2 pose = problem_.start;
  double time = 0.0;
  for (const ChosenStop& stop : table.stops) {
    if (!stop.made()) continue;
    const auto& waypoints = way(pose, stop.place);
    if (waypoints.empty()) return std::numeric_limits<double>::infinity();
    const DriveCost there = drive(pose, waypoints);
    time += there.time_s;
    pose = {stop.place, there.heading_rad};
  }
  return time;
}

bool TablePlanner::may_stop(Vec2 place, const std::vector<std::size_t>& targets) {
  const auto cell = firing_map_.cell_of(place);
  if (!cell || firing_map_.reachable[*cell] == 0) return false;
  const double room_m = problem_.robot.radius_m + problem_.errors.position_m;
  if (firing_map_.ground.clearance(place, room_m) < room_m) return false;
  if (!firing_map_.ground.segment_free({place, place}, problem_.robot.radius_m)) return false;  // on a slope
  return std::ranges::all_of(targets, [&](std::size_t target) { return sure_.has(*cell, target); });
}

double TablePlanner::expected_s(const GuardPlan& plan) {
  double time = plan.cost_s;
  for (const PlannedStop& stop : plan.stops) {
    for (const PlannedHit& hit : stop.hits) time += expected_wait_s(stop.position, hit);
  }
  return time;
}

/// The time that a shot adds on average because the errors of the drive lead to a place where it has to be
/// waited for, or where there is none.
double TablePlanner::expected_wait_s(Vec2 place, const PlannedHit& hit) {
  const double off = problem_.errors.position_m;
  if (off == 0.0) return 0.0;
  double wait_s = 0.0;
  for (const Vec2 aside : displacements(off)) {
    const auto& shot = shot_from(place + aside, hit.target, hit.shot.gun.pitch_rad);
    if (!shot) {
      wait_s += lost_shot_s / 4.0;
    } else if (hit.shot.survives && !shot->survives) {
      wait_s += shot->flight_s / 4.0;
    }
  }
  return wait_s;
}

DriveCost TablePlanner::drive(const Pose2& from, const std::vector<Vec2>& waypoints) const {
  return drive_cost(problem_.robot, from.heading_rad, waypoints, firing_map_.ground.terrain());
}

/// The fastest drive, with the turn before it.
const std::vector<Vec2>& TablePlanner::way(const Pose2& from, Vec2 to) {
  const Place begin{from.position.x, from.position.y}, end{to.x, to.y};
  const auto [entry, added] = ways_.try_emplace({begin, from.heading_rad, end});
  if (!added) return entry->second;
  if (auto route = plan_.routes->route(from, to)) {
    entry->second = std::move(route->waypoints);
  } else if (routes_index_.contains(begin) && routes_index_.contains(end)) {
    entry->second = plan_.routes->waypoints(routes_index_[begin], routes_index_[end]);
  }
  return entry->second;
}

const std::optional<PlannedShot>& TablePlanner::shot_from(Vec2 place, std::size_t target, double pitch_rad) {
  const auto [entry, added] = shots_.try_emplace({{place.x, place.y}, target, pitch_rad});
  if (added) entry->second = outrider::shot_from(problem_, firing_map_, target, place, pitch_rad);
  return entry->second;
}

}  // namespace outrider
