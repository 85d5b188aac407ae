#include "outrider/jobs/drive/route.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/path/catalog.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"

namespace outrider {
namespace {

Outcome<Problem> problem_for(const PathPlanner& planner, const CollisionMap& ground, double radius_m,
                             Vec2 start, Vec2 goal, double resolution_m, const std::stop_token& stop) {
  Problem problem{nullptr, start, goal};
  if (planner.models.empty()) {
    auto polygons = polygons_from_world(ground, radius_m);
    if (!polygons) return pass_on(polygons);
    problem.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
    return problem;
  }
  const GridModel model = planner.takes(GridModel::corners) ? GridModel::corners : planner.models.front();
  GridOptions options;
  options.resolution_m = resolution_m;
  auto grid = grid_from_world(ground, radius_m, model, options, stop);
  if (!grid) return pass_on(grid);
  problem.grid = std::make_shared<const GridMap>(std::move(*grid));
  return problem;
}

/// The heading towards the nearest tag whose face is in sight from there; nothing where there is none.
std::optional<double> towards_a_tag(const DriveTask& task, const CollisionMap& ground, Vec2 from) {
  constexpr double before_wall_m = 0.01;
  constexpr double least_cosine = 0.5;  // a tag seen at a flatter angle says little
  std::optional<double> heading;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Tag& tag : task.tags.tags) {
    const Vec2 out = xy(-1.0 * tag.world_T_tag.rotation.axes[2]);
    const Vec2 at = xy(tag.world_T_tag.position);
    const Vec2 sight = from - at;
    const double range_m = norm(sight);
    if (range_m >= nearest_m || dot(sight, out) < least_cosine * range_m) continue;
    if (!ground.segment_free({from, at + before_wall_m * out}, 0.0)) continue;
    nearest_m = range_m;
    heading = heading_of(-sight);
  }
  return heading;
}

}  // namespace

std::vector<Option> describe(DriveRouteOptions& options) {
  return {
      {"margin", "m", 0.0, 10.0, "that a planned path keeps beyond the robot's radius", &options.margin_m},
      {"resolution", "m", 1e-3, 10.0, "of the grid, for planners that need one", &options.resolution_m},
      {"thin", "m", 0.0, 10.0, "how far a planned path may lie from its waypoints' legs", &options.thin_m},
  };
}

std::vector<Vec2> thinned(const std::vector<Vec2>& points, double thin_m, const CollisionMap& ground,
                          double radius_m) {
  if (points.size() < 3) return points;
  std::vector<Vec2> kept = {points.front()};
  std::vector<std::pair<std::size_t, std::size_t>> legs = {{0, points.size() - 1}};  // the last is the next
  while (!legs.empty()) {
    const auto [first, last] = legs.back();
    legs.pop_back();
    const Segment leg{points[first], points[last]};
    std::size_t farthest = first;
    double most_m = -1.0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = distance(points[i], leg);
      if (off > most_m) {
        most_m = off;
        farthest = i;
      }
    }
    if (farthest == first || (most_m <= thin_m && ground.segment_free(leg, radius_m))) {
      kept.push_back(points[last]);
    } else {
      legs.insert(legs.end(), {{farthest, last}, {first, farthest}});
    }
  }
  return kept;
}

double way_clearance_m(const std::vector<Vec2>& points, const CollisionMap& ground) {
  double clearance_m = std::numeric_limits<double>::infinity();
  const Box2& bounds = ground.bounds();
  for (const Vec2 p : points) {  // a leg is nearest to a straight edge at one of its ends
    clearance_m = std::min(
        {clearance_m, p.x - bounds.low.x, bounds.high.x - p.x, p.y - bounds.low.y, bounds.high.y - p.y});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Segment leg{points[i == 0 ? 0 : i - 1], points[i]};
    for (const RoundedPolygon& obstacle : ground.obstacles()) {
      clearance_m = std::min(clearance_m, signed_distance(leg, obstacle));
    }
  }
  return clearance_m;
}

Outcome<DriveRoute> plan_route(const DriveTask& task, const CollisionMap& ground, const Pose2& goal,
                               const std::string& planner, const DriveRouteOptions& options,
                               const Budget& budget) {
  auto row = find_path_planner(planner);
  if (!row) return pass_on(row);
  if (row->steers) {
    return bad_input(
        fmt::format("{} plans for a robot that steers, and this one turns in place; take another one",
                    planner),
        "planner");
  }
  const double radius_m = task.radius_m + options.margin_m;
  auto problem = problem_for(*row, ground, radius_m, task.start.position, goal.position, options.resolution_m,
                             budget.stop);
  if (!problem) return pass_on(problem);
  Workspace workspace;
  auto plan = row->configure().plan(*problem, budget, workspace);
  if (!plan) return pass_on(plan);
  std::vector<Vec2> points = plan->waypoints;
  points.front() = task.start.position;
  points.back() = goal.position;
  points = thinned(points, options.thin_m, ground, task.radius_m);
  DriveRoute route{std::move(*plan), {}};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const auto facing = task.chassis.moves_sideways() ? towards_a_tag(task, ground, points[i]) : std::nullopt;
    route.waypoints.push_back({{points[i], facing.value_or(heading_of(points[i + 1] - points[i]))}, false});
  }
  route.waypoints.push_back({goal, true});
  return route;
}

Status check_waypoints(const DriveTask& task, const CollisionMap& ground, bool straight) {
  Vec2 from = task.start.position;
  for (std::size_t i = 0; i <= task.waypoints.size(); ++i) {
    const Vec2 at = i == 0 ? from : task.waypoints[i - 1].pose.position;
    const std::string name = i == 0 ? "the start" : fmt::format("waypoint {}", i);
    const std::string where = i == 0 ? "start" : "waypoints";
    const double clearance_m = ground.clearance(at, task.radius_m + 1.0);
    if (clearance_m < task.radius_m) {
      return bad_input(
          fmt::format("{} at {:g},{:g} is {:.3g} m {} an obstacle or the edge; a robot of radius "
                      "{:g} m stands at least as far away",
                      name, at.x, at.y, std::abs(clearance_m), clearance_m < 0.0 ? "within" : "from",
                      task.radius_m),
          where);
    }
    if (straight && !ground.segment_free({from, at}, task.radius_m)) {
      return bad_input(fmt::format("the straight way to {} at {:g},{:g} touches an obstacle; put waypoints "
                                   "around it, or give a goal and a planner",
                                   name, at.x, at.y),
                       where);
    }
    from = at;
  }
  return {};
}

}  // namespace outrider
