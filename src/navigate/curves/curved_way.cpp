#include "outrider/navigate/curved_way.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "navigate_grid.hpp"
#include "outrider/path/pieces.hpp"
#include "outrider/path/steering/hybrid_a_star.hpp"

namespace outrider {
namespace {

constexpr double wider_part = 1.1;  // of the tightest curve, for those of the way
constexpr double cusp_m = 0.6;      // price of a change of direction
constexpr double backward_price = 1.3;
constexpr double round_step_rad = radians(15.0);  // of round corners that are made straight
constexpr double cell_reach = 0.71;               // of a cell, from its middle to its corners
constexpr double rounding_part = 0.8;  // of a cell, by which a path comes nearer than their middles
constexpr double around_ends_m = 1.0;  // where a way may have less room
constexpr double curve_weight = 1.5;   // of the estimate
constexpr double pose_cell_m = 0.1;    // of a search, at most
constexpr std::uint64_t curve_expansions = 20'000;  // of a search
constexpr int goal_directions = 8;                  // in which a free place beside the goal is sought

/// Returns the footprint as corners about its origin and the radius of its round corners.
RoundedPolygon outline_of(const Footprint& footprint) {
  const RoundedPolygon& shape = footprint.shape();
  const bool is_disk = shape.core.size() == 1 && shape.core.front() == Vec2{};
  if (is_disk || (shape.core.size() > 2 && signed_distance(Vec2{}, RoundedPolygon{shape.core, 0.0}) < 0.0))
    return shape;
  return {circumscribed(shape, round_step_rad), 0.0};
}

/// Returns the least distance from a footprint to obstacles, m, at most `most`.
double gap_at(const std::vector<Vec2>& obstacles, const Footprint& footprint, const Pose2& pose,
              double most) {
  for (const Vec2 place : obstacles) {
    if (distance(place, pose.position) < footprint.outer_m() + most)
      most = std::min(most, footprint.gap_m(pose.to_local(place)));
  }
  return most;
}

/// Returns a place at the goal, or within the tolerance, where the robot has the least room; nothing if there
/// is none.
std::optional<Vec2> free_goal(const GoalGround& ground, const Footprint& footprint, const CurveQuery& query) {
  for (const double part : {0.0, 0.4, 0.8}) {
    for (int i = 0; i < (part == 0.0 ? 1 : goal_directions); ++i) {
      const Vec2 place = query.goal + part * query.within_m * direction(2.0 * pi * i / goal_directions);
      const double gap_m =
          query.heading_rad
              ? gap_at(ground.obstacles, footprint, {place, *query.heading_rad}, query.margin_m)
              : gap_at(ground.obstacles, Footprint::disk(footprint.inner_m()), {place, 0.0}, query.margin_m);
      if (gap_m >= query.margin_m) return place;
    }
  }
  return {};
}

/// An end of a way: the cells that the robot covers there, and the room that it has.
struct WayEnd {
  Vec2 position;
  std::vector<std::size_t> covered;
  double room_m = std::numeric_limits<double>::infinity();
};

WayEnd end_at(const GoalGround& ground, const std::vector<float>& distance_m, const RoundedPolygon& outline,
              const Pose2& pose) {
  const GridFrame& frame = ground.frame;
  const RoundedPolygon near{outline.core, cell_reach * frame.resolution_m};
  Box2 box;
  for (const Vec2 corner : outline.core) box.include(pose * corner);
  box = box.grown(near.radius_m);
  const Cell low = frame.cell_at(box.low), high = frame.cell_at(box.high);
  WayEnd end{pose.position, {}};
  for (int y = std::max(low.y, 0); y <= std::min(high.y, frame.height - 1); ++y) {
    for (int x = std::max(low.x, 0); x <= std::min(high.x, frame.width - 1); ++x) {
      if (signed_distance(pose.to_local(frame.centre({x, y})), near) > 0.0) continue;
      const std::size_t i = frame.index({x, y});
      end.covered.push_back(i);
      end.room_m = std::min(end.room_m, static_cast<double>(distance_m[i]) - outline.radius_m);
    }
  }
  // A way goes on from there though the cells beside it are a little nearer.
  end.room_m -= rounding_part * frame.resolution_m;
  return end;
}

/// Blocks the cells whose middle is nearer to an obstacle than `least_m`, or than at the ends near those, but
/// for what the robot covers there.
Grid<std::uint8_t> blocked_cells(const GoalGround& ground, const std::vector<float>& distance_m,
                                 double radius_m, double room_m, const std::vector<WayEnd>& ends) {
  const double hard_m = cell_reach * ground.frame.resolution_m;  // something is in the cell itself
  Grid<std::uint8_t> blocked(ground.frame);
  for (std::size_t i = 0; i < blocked.cells.size(); ++i) {
    double least_m = radius_m + room_m;
    const Vec2 middle = ground.frame.centre(ground.frame.cell(i));
    for (const WayEnd& end : ends) {
      if (distance(middle, end.position) < around_ends_m)
        least_m = std::clamp(radius_m + end.room_m, std::min(hard_m, least_m), least_m);
    }
    blocked.cells[i] = static_cast<double>(distance_m[i]) < least_m ? 1 : 0;
  }
  for (const WayEnd& end : ends) {
    for (const std::size_t i : end.covered) blocked.cells[i] = 0;
  }
  for (std::size_t i = 0; ground.closed != nullptr && i < blocked.cells.size(); ++i) {
    if ((*ground.closed)[i] != 0) blocked.cells[i] = 1;
  }
  return blocked;
}

HybridAStarOptions options_of(const RobotModel& robot) {
  HybridAStarOptions options;
  options.steering.turning_radius_m = wider_part * robot.turning_radius_m;
  options.steering.cusp_price_m = cusp_m;
  options.steering.backward_price = backward_price;
  options.cell_m = std::min(0.2 * robot.turning_radius_m, pose_cell_m);
  options.weight = curve_weight;
  return options;
}

/// Returns the way of a robot that goes along pieces from their end to their begin, looking the other way.
TrackPieces backwards_in_time(const TrackPieces& pieces) {
  TrackPieces way;
  std::ranges::transform(pieces.rbegin(), pieces.rend(), std::back_inserter(way), reversed);
  return way;
}

}  // namespace

Outcome<TrackPieces> plan_curved_way(const GoalGround& ground, const Footprint& footprint,
                                     const RobotModel& robot, const CurveQuery& query, Workspace& workspace) {
  const auto goal = free_goal(ground, footprint, query);
  if (!goal) return fault(FaultCode::goal_blocked, "something stands at the goal");
  RoundedPolygon outline = outline_of(footprint);
  const double rounding_m = rounding_part * ground.frame.resolution_m;
  const double tight_m = query.margin_m + rounding_m, wide_m = std::max(tight_m, query.wide_m);
  std::vector<float> distance_m;
  spread_distances(ground.frame, ground.obstacles, outline.radius_m + wide_m + rounding_m, distance_m);
  if (ground.zones != nullptr && !ground.zones->room_m.empty()) {
    for (std::size_t i = 0; i < distance_m.size(); ++i)
      distance_m[i] = std::min(distance_m[i], ground.zones->room_m[i]);
  }
  std::vector<WayEnd> ends{end_at(ground, distance_m, outline, query.start)};
  ends.push_back(query.heading_rad ? end_at(ground, distance_m, outline, {*goal, *query.heading_rad})
                                   : WayEnd{*goal, {}, tight_m});
  // A search gets out of a narrow place sooner than into it, so it begins at the narrower end.
  const bool from_goal = (query.heading_rad ? ends.back().room_m : wide_m) < ends.front().room_m;
  const auto looks = [&](double heading_rad) { return from_goal ? heading_rad + pi : heading_rad; };
  Problem problem;
  problem.start = query.start.position;
  problem.goal = *goal;
  problem.start_heading_rad = looks(query.start.heading_rad);
  if (query.heading_rad) problem.goal_heading_rad = looks(*query.heading_rad);
  const HybridAStarOptions options = options_of(robot);
  if (from_goal) {
    std::swap(problem.start, problem.goal);
    std::swap(problem.start_heading_rad, problem.goal_heading_rad);
    for (Vec2& corner : outline.core) corner = -1.0 * corner;
  }
  if (outline.core.size() > 1) problem.outline = outline.core;
  Budget budget;
  budget.expansions = curve_expansions;
  Outcome<TrackPieces> answer;
  for (const double room_m : {wide_m, tight_m}) {
    auto grid =
        GridMap::of(blocked_cells(ground, distance_m, outline.radius_m, room_m, ends), GridModel::cells);
    if (!grid) return pass_on(grid);
    problem.grid = std::make_shared<const GridMap>(std::move(*grid));
    auto plan = hybrid_a_star(problem, options, budget, workspace);
    if (plan) return from_goal ? backwards_in_time(plan->pieces) : std::move(plan->pieces);
    answer = pass_on(plan);
  }
  return answer;
}

}  // namespace outrider
