#include "plan_log.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/job/grid_message.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double arc_step_rad = radians(5.0);
constexpr double corner_step_rad = radians(15.0);
constexpr double pose_step_m = 0.25;

/// Returns a grid whose values are -1. `yaw_rad` turns it about its origin.
nav_msgs::OccupancyGrid blank_grid(const GridFrame& frame, double yaw_rad) {
  auto grid = grid_message(frame, yaw_rad, 0.0);
  grid.data.assign(frame.size(), -1);
  return grid;
}

/// Returns where the robot has room, as a costmap of ROS: 100 occupied, 99 too close to it, 0 free.
nav_msgs::OccupancyGrid costmap_of(const PlanGround& ground) {
  const GridFrame& frame = ground.blocked.frame;
  auto grid = blank_grid(frame, ground.yaw_rad);
  const bool known = ground.occupied.frame == frame;
  for (std::size_t i = 0; i < grid.data.size(); ++i) {
    const bool occupied = known && ground.occupied.cells[i] != 0;
    grid.data[i] = static_cast<std::int8_t>(occupied ? 100 : ground.blocked.cells[i] != 0 ? 99 : 0);
  }
  return grid;
}

/// Returns what a metre costs in each cell.
outrider_msgs::CostGrid cost_grid_of(const PlanGround& ground) {
  const GridFrame& frame = ground.costs->per_m.frame;
  outrider_msgs::CostGrid grid;
  grid.origin = point_of(frame.origin);
  grid.resolution = frame.resolution_m;
  grid.width = static_cast<std::uint32_t>(frame.width);
  grid.height = static_cast<std::uint32_t>(frame.height);
  grid.costs.assign(ground.costs->per_m.cells.begin(), ground.costs->per_m.cells.end());
  return grid;
}

/// Returns the vertex of a state of the search: its own, or the one where it is.
Cell vertex_of(const Trace& trace, std::uint32_t state, const GridMap& map) {
  if (trace.places.empty()) return map.at(state);
  return map.frame.cell_at({trace.places[state].x, trace.places[state].y});
}

/// Returns when each vertex was expanded first, in percent of the search. A vertex is the middle of its cell.
nav_msgs::OccupancyGrid expanded_of(const Trace& trace, const PlanGround& ground) {
  const GridMap& map = *ground.grid;
  const int more = map.model == GridModel::corners ? 1 : 0;
  GridFrame frame = map.frame;
  if (more > 0)
    frame.origin = ground.to_world(frame.corner({0, 0}) - 0.5 * frame.resolution_m * Vec2{1.0, 1.0});
  frame.width += more;
  frame.height += more;
  auto grid = blank_grid(frame, ground.yaw_rad);
  for (std::size_t i = 0; i < trace.expansions.size(); ++i) {
    const Cell v = vertex_of(trace, trace.expansions[i].state, map);
    auto& percent = grid.data[frame.index(v)];
    if (percent < 0) percent = static_cast<std::int8_t>(100 * i / trace.expansions.size());
  }
  return grid;
}

/// Returns the solid parts of polygons: the obstacles, and a rim outside the boundary.
outrider_msgs::Outlines walls_of(const PolygonGround& ground) {
  const Box2 box = ground.bounds.grown(0.02 * norm(ground.bounds.size()));
  std::vector<std::vector<Vec2>> walls = {
      {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}, ground.boundary};
  walls.insert(walls.end(), ground.obstacles.begin(), ground.obstacles.end());
  return {outlines_of(walls)};
}

/// Returns the lines of the medial axis where the robot may be.
outrider_msgs::Outlines axis_of(const PolygonGround& ground) {
  std::vector<std::vector<Vec2>> lines;
  for (std::vector<Vec2>& line : medial_axis_lines(ground)) {
    if (!ground.solid(0.5 * (line.front() + line.back()))) lines.push_back(std::move(line));
  }
  return {outlines_of(lines)};
}

void log_ground(Log& log, const PlanTask& task, const PlanGround& ground) {
  const auto* world = std::get_if<World>(&task.map.shape);
  outrider_msgs::RunInfo info =
      run_info("plan", std::nullopt, world == nullptr ? World{} : *world, ground.radius_m);
  info.world = printable(std::filesystem::path(task.settled.map).filename().string());
  const Box2 bounds =
      ground.polygons ? ground.bounds().grown(0.02 * norm(ground.bounds().size())) : ground.bounds();
  info.low = point_of(bounds.low);
  info.high = point_of(bounds.high);
  if (world != nullptr) {
    log_scene(log, std::move(info), *world, task.settled.height_m);
  } else {
    log.append(topic::run, 0.0, std::move(info));
  }
  if (world == nullptr && ground.polygons) log.append(topic::walls, 0.0, walls_of(*ground.polygons));
  if (ground.costs && ground.yaw_rad == 0.0) log.append(topic::cost_grid, 0.0, cost_grid_of(ground));
  if (ground.grid) log.append(topic::costmap, 0.0, costmap_of(ground));
  if (!ground.outline.empty())
    log_footprint(log, inscribed({ground.outline, ground.radius_m}, corner_step_rad));
  log_markers(log);
}

/// Returns poses of a robot that steers along its path, as it looks there, also backwards.
std::vector<Pose2> poses_along(const std::vector<PathPiece>& pieces, const PlanGround& ground) {
  std::vector<Pose2> poses;
  for (const PathPiece& piece : pieces) {
    const double step = std::max(std::abs(piece.turn_rad) / arc_step_rad, length_of(piece) / pose_step_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(step)));
    for (int i = poses.empty() ? 0 : 1; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      poses.push_back({ground.to_world(point_on(piece, part)),
                       ground.yaw_rad + heading_in(piece) + part * piece.turn_rad});
    }
  }
  return poses;
}

void log_queries(Log& log, const std::vector<PlanQuery>& queries) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Vec2 from = queries[i].from, to = queries[i].to;
    const double ahead_rad = heading_of(to - from);
    if (i == 0 || from != queries[i - 1].from) {
      geometry_msgs::PoseWithCovarianceStamped start;
      start.header = header_of(0.0, "map");
      start.pose.pose = pose_of(Pose2{from, queries[i].from_heading_rad.value_or(ahead_rad)});
      log.append(topic::start, 0.0, std::move(start));
    }
    log.append(topic::goal, 0.0, stamped(0.0, {to, queries[i].to_heading_rad.value_or(ahead_rad)}));
  }
}

}  // namespace

void log_answer(Log& log, const PlanTask& task, const PlanQuestion& question, const PlanAnswer& answer,
                const Trace* trace) {
  const PlanGround& ground = *question.ground;
  log_ground(log, task, ground);
  if (trace != nullptr && !trace->expansions.empty())
    log.append(topic::expanded, 0.0, expanded_of(*trace, ground));
  const auto on_axis = [](const PlanRow& row) {
    const auto planner = find_path_planner(row.planner);
    return row.found() && planner && planner->axis;
  };
  if (ground.polygons && std::ranges::any_of(answer.rows, on_axis))
    log.append(topic::medial_axis, 0.0, axis_of(*ground.polygons));
  log_queries(log, question.queries);
  for (const PlanRow& row : answer.rows) {
    if (!row.found()) continue;
    if (row.plan && row.plan->steering && !row.pieces.empty()) {
      const std::vector<Pose2> poses = poses_along(row.pieces, ground);
      log.append(std::string(topic::plan_of) + row.planner, 0.0,
                 path_of(std::vector<double>(poses.size(), 0.0), poses));
      continue;
    }
    const bool exact = !row.pieces.empty();
    auto points = row.waypoints;
    if (exact) {
      const Vec2 start = row.pieces.front().from;
      points = points_along(start, row.pieces, arc_step_rad);
      for (Vec2& p : points) p = ground.to_world(p);
    }
    log.append(std::string(topic::plan_of) + row.planner, 0.0, path_of(0.0, points));
  }
}

std::string trace_json(const Trace& trace, const GridMap& ground) {
  auto expansions = nlohmann::ordered_json::array();
  for (const Expansion& expansion : trace.expansions) {
    const Cell v = vertex_of(trace, expansion.state, ground),
               parent = vertex_of(trace, expansion.parent, ground);
    expansions.push_back({{"vertex", {v.x, v.y}},
                          {"parent", {parent.x, parent.y}},
                          {"f", expansion.f},
                          {"g", expansion.g},
                          {"h", expansion.h}});
  }
  return expansions.dump() + "\n";
}

}  // namespace outrider
