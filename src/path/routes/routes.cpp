#include "outrider/path/routes/routes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "one_route.hpp"
#include "routes_graph.hpp"
#include "routes_parallel.hpp"
#include "routes_search.hpp"

namespace outrider {

using routes::Node;
using routes::open_nodes;
using routes::RouteQuery;
using routes::RouteTree;
using routes::same_place_m;
using routes::SightLine;
using routes::SightLines;

struct CornerTable {
  CollisionMap ground;
  RobotModel robot;
  std::vector<Node> nodes;
  SightLines lines;  // node to node
};

struct RouteTable {
  std::shared_ptr<const CornerTable> corners;
  std::vector<Vec2> stops;
  std::vector<RouteTree> trees;  // from each stop to the later ones
};

namespace {

constexpr std::size_t most_nodes = 16'384;
constexpr std::size_t most_stops = 2048;

Status check_place(const CollisionMap& ground, const RobotModel& robot, Vec2 p, FaultCode blocked,
                   std::string_view name) {
  if (!finite(p)) return bad_input(fmt::format("{} has a coordinate that is not a finite number", name));
  const Box2& bounds = ground.bounds();
  if (!bounds.contains(p)) {
    return fault(
        FaultCode::outside_map,
        fmt::format("{} at ({:.3f}, {:.3f}) lies outside x {:g} to {:g}, y {:g} to {:g} m; move it in", name,
                    p.x, p.y, bounds.low.x, bounds.high.x, bounds.low.y, bounds.high.y));
  }
  const double clearance = ground.clearance(p, robot.radius_m);
  if (clearance >= robot.radius_m - same_place_m) return {};
  return fault(blocked,
               fmt::format("{} at ({:.3f}, {:.3f}) is blocked: the clearance there is {:.3f} m and the "
                           "robot's radius {:g} m; move it",
                           name, p.x, p.y, clearance, robot.radius_m));
}

Status check_request(const RobotModel& robot, const std::vector<Vec2>& extra_nodes,
                     const RouteOptions& options) {
  if (!(robot.radius_m >= 0.0) || !std::isfinite(robot.radius_m)) {
    return bad_input(fmt::format("the robot's radius of {} m is not valid; it is 0 or more", robot.radius_m));
  }
  for (const Limits& limits : {robot.straight(), robot.turning()}) {
    if (!(limits.speed > 0.0) || !std::isfinite(limits.speed) || !(limits.acceleration > 0.0)) {
      return bad_input("the robot's speeds and accelerations must be above 0");
    }
  }
  if (!(options.arc_step_rad >= radians(1.0) - 1e-12) || !(options.arc_step_rad <= pi / 2 + 1e-12)) {
    return bad_input(fmt::format("an arc step of {:g} degrees is not valid; expected 1 to 90",
                                 degrees(options.arc_step_rad)));
  }
  if (extra_nodes.size() > most_nodes) {
    return bad_input(
        fmt::format("{} extra nodes are too many; give at most {}", extra_nodes.size(), most_nodes));
  }
  if (!std::ranges::all_of(extra_nodes, [](Vec2 p) { return finite(p); })) {
    return bad_input("an extra node has a coordinate that is not a finite number");
  }
  return {};
}

Status check_stops(const CollisionMap& ground, const RobotModel& robot, const std::vector<Vec2>& stops) {
  if (stops.size() > most_stops) {
    return bad_input(fmt::format("{} stops are too many; give at most {}", stops.size(), most_stops));
  }
  for (std::size_t i = 0; i < stops.size(); ++i) {
    Status status = check_place(ground, robot, stops[i], FaultCode::goal_blocked, fmt::format("stop {}", i));
    if (!status) return status;
  }
  return {};
}

double opposite(double heading_rad) { return wrap_angle(heading_rad + pi); }

/// Returns the path to a target of a search as points, including both ends.
std::vector<Vec2> points_of(const RouteTree& tree, const std::vector<Node>& nodes, Vec2 start,
                            std::uint32_t target, Vec2 goal) {
  std::vector<Vec2> points = {start};
  for (const std::uint32_t node : routes::nodes_to(tree, target)) points.push_back(nodes[node].at);
  points.push_back(goal);
  return points;
}

}  // namespace

std::vector<Option> describe(RouteOptions& options) {
  return {{"arc_step", "deg", 1.0, 90.0,
           "turn between the corners of a route around a rounded obstacle; finer is closer, with more halts",
           &options.arc_step_rad}};
}

Drive Routes::between(std::size_t from, std::size_t to) const {
  if (from == to) return {0.0, 0.0, 0.0};
  const Drive drive = table_->trees[std::min(from, to)].arrivals[std::max(from, to)].drive;
  if (from < to || !(drive.time_s > 0.0) || !std::isfinite(drive.time_s)) return drive;
  return {drive.time_s, opposite(drive.arrival_rad), opposite(drive.departure_rad)};
}

std::vector<Vec2> Routes::waypoints(std::size_t from, std::size_t to) const {
  const double time_s = between(from, to).time_s;
  if (!std::isfinite(time_s)) return {};
  if (time_s == 0.0) return {table_->stops[from]};
  const auto [low, high] = std::minmax({from, to});
  auto points = points_of(table_->trees[low], table_->corners->nodes, table_->stops[low],
                          static_cast<std::uint32_t>(high), table_->stops[high]);
  if (from > to) std::reverse(points.begin(), points.end());
  return points;
}

Outcome<Route> Routes::route(const Pose2& start, Vec2 goal, const Budget& budget) const {
  const CornerTable& t = *table_->corners;
  if (!std::isfinite(start.heading_rad)) return bad_input("the start's heading is not a finite number");
  Status start_status = check_place(t.ground, t.robot, start.position, FaultCode::start_blocked, "the start");
  if (!start_status) return pass_on(start_status);
  Status goal_status = check_place(t.ground, t.robot, goal, FaultCode::goal_blocked, "the goal");
  if (!goal_status) return pass_on(goal_status);
  if (distance(start.position, goal) <= same_place_m) {
    return Route{{start.position}, drive_cost(t.robot, start.heading_rad, {start.position})};
  }

  // On flat ground the straight line is the fastest: its direction lies between those of the legs of any
  // other way, which turns as far at least, is no shorter, and halts besides.
  if (t.ground.terrain() == nullptr && t.ground.segment_free({start.position, goal}, t.robot.radius_m)) {
    return Route{{start.position, goal}, drive_cost(t.robot, start.heading_rad, {start.position, goal})};
  }
  const Pose2 from{start.position, wrap_angle(start.heading_rad)};
  BudgetMeter meter(budget);
  auto waypoints = routes::one_route({t.ground, t.robot, t.nodes, t.lines}, from, goal, meter);
  if (!waypoints) return pass_on(waypoints);
  if (waypoints->empty()) {
    return fault(
        FaultCode::no_path,
        fmt::format("no route leads from ({:.3f}, {:.3f}) to ({:.3f}, {:.3f}) over the {} nodes; extra "
                    "nodes from a grid path may open a narrow passage",
                    start.position.x, start.position.y, goal.x, goal.y, t.nodes.size()));
  }
  const DriveCost cost = drive_cost(t.robot, start.heading_rad, *waypoints, t.ground.terrain());
  return Route{std::move(*waypoints), cost};
}

const RobotModel& Corners::robot() const { return table_->robot; }
std::size_t Corners::size() const { return table_->nodes.size(); }

namespace {

/// find_corners() and routes_between() of what has been checked; they take what they spend off the budget.
Outcome<Corners> corners_of(const CollisionMap& ground, const RobotModel& robot,
                            const std::vector<Vec2>& extra_nodes, const RouteOptions& options,
                            Budget& remaining) {
  CornerTable table{
      ground, robot, routes::route_nodes(ground, robot.radius_m, options.arc_step_rad, extra_nodes), {}};
  if (table.nodes.size() > most_nodes) {
    return bad_input(
        fmt::format("the ground has {} free corners to drive around, more than {}; take a part of it "
                    "(bounds), or take away what nobody drives between (removed)",
                    table.nodes.size(), most_nodes));
  }
  auto lines = routes::sight_lines(ground, robot, table.nodes, remaining);
  if (!lines) return pass_on(lines);
  table.lines = std::move(*lines);
  return Corners(std::make_shared<const CornerTable>(std::move(table)));
}

Outcome<Routes> routes_over(const Corners& corners, const std::vector<Vec2>& stops, Budget& remaining) {
  const CornerTable& c = *corners.table();
  const std::vector<Node> ends = open_nodes(stops);
  auto stop_lines = routes::sight_lines(c.ground, c.robot, ends, c.nodes, remaining);
  if (!stop_lines) return pass_on(stop_lines);
  auto direct = routes::sight_lines(c.ground, c.robot, ends, remaining);
  if (!direct) return pass_on(direct);
  const SightLines to_stops = routes::reversed(*stop_lines, ends, c.nodes);

  RouteTable table{corners.table(), stops, std::vector<RouteTree>(stops.size())};
  Status searched = routes::in_parallel(stops.size(), remaining, [&](std::size_t i, BudgetMeter& meter) {
    RouteTree& tree = table.trees[i];
    const RouteQuery query{stop_lines->row(i), direct->row(i), static_cast<std::uint32_t>(i + 1),
                           static_cast<std::uint32_t>(stops.size())};
    if (!routes::search_routes(c.robot, c.lines, to_stops, query, meter, tree)) return false;
    for (std::size_t k = i + 1; k < stops.size(); ++k) {
      if (distance(stops[i], stops[k]) <= same_place_m)
        tree.arrivals[k] = {{0.0, 0.0, 0.0}, routes::no_label};
    }
    return true;
  });
  if (!searched) return pass_on(searched);
  return Routes(std::make_shared<const RouteTable>(std::move(table)));
}

}  // namespace

Outcome<Corners> find_corners(const CollisionMap& ground, const RobotModel& robot,
                              const std::vector<Vec2>& extra_nodes, const RouteOptions& options,
                              const Budget& budget) {
  if (auto ok = check_request(robot, extra_nodes, options); !ok) return pass_on(ok);
  Budget remaining = budget;
  return corners_of(ground, robot, extra_nodes, options, remaining);
}

Outcome<Routes> routes_between(const Corners& corners, const std::vector<Vec2>& stops, const Budget& budget) {
  if (auto ok = check_stops(corners.table()->ground, corners.robot(), stops); !ok) return pass_on(ok);
  Budget remaining = budget;
  return routes_over(corners, stops, remaining);
}

Outcome<Routes> routes_between(const CollisionMap& ground, const RobotModel& robot,
                               const std::vector<Vec2>& stops, const std::vector<Vec2>& extra_nodes,
                               const RouteOptions& options, const Budget& budget) {
  if (auto ok = check_request(robot, extra_nodes, options); !ok) return pass_on(ok);
  if (auto ok = check_stops(ground, robot, stops); !ok) return pass_on(ok);
  Budget remaining = budget;
  auto corners = corners_of(ground, robot, extra_nodes, options, remaining);
  if (!corners) return pass_on(corners);
  return routes_over(*corners, stops, remaining);
}

}  // namespace outrider
