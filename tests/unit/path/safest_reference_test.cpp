// The reference for safe paths (a course report of 2023) and what becomes of it.
//
// It plans on cells of 1 cm with A*: the cost is the length of the moves, and the heuristic is "the Euclidean
// distance to the goal minus the perpendicular distance from the obstacle", so that A* should like cells far
// from the obstacle. Rewritten here from that sentence; its program counts the second distance in cells and
// along the axes, and the first in metres.
#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <tuple>

#include "outrider/path/catalog.hpp"
#include "outrider/path/clearance/medial_axis.hpp"
#include "outrider/path/clearance/safest.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/safety.hpp"

namespace outrider {
namespace {

constexpr double resolution = 0.02;
constexpr Vec2 start{2.51, 0.51};
constexpr Vec2 goal{1.01, 2.51};

/// The arena of the report: 3 x 3 m, an obstacle of 0.45 x 0.35 m in its centre, a margin of 0.2 m.
PolygonGround arena() {
  return *PolygonGround::of({{0, 0}, {0, 3}, {3, 3}, {3, 0}},
                            {{{1.275, 1.325}, {1.725, 1.325}, {1.725, 1.675}, {1.275, 1.675}}}, 0.2);
}

double away_from_obstacle(Vec2 p, bool along_axes) {
  const double dx = std::max({0.0, 1.275 - 0.2 - p.x, p.x - 1.725 - 0.2});
  const double dy = std::max({0.0, 1.325 - 0.2 - p.y, p.y - 1.675 - 0.2});
  return along_axes ? dx + dy : std::hypot(dx, dy);
}

/// A* with that heuristic: `trust` times the distance from the obstacle is taken off. To the end: cells that
/// were expanded may be improved, and the search goes on when it has met the goal; the report does neither.
std::vector<Cell> reference_path(const GridMap& ground, double trust, bool along_axes, bool to_the_end) {
  const Cell from = *ground.vertex_at(start), to = *ground.vertex_at(goal);
  const auto h = [&](Cell c) {
    const Vec2 p = ground.point(c);
    return distance(p, ground.point(to)) - trust * away_from_obstacle(p, along_axes);
  };
  std::vector<double> g(ground.marks.size(), 1e300);
  std::vector<std::uint32_t> parent(ground.marks.size(), 0);
  std::vector<bool> closed(ground.marks.size(), false);
  std::priority_queue<std::tuple<double, std::uint32_t>, std::vector<std::tuple<double, std::uint32_t>>,
                      std::greater<>>
      open;
  g[ground.index(from)] = 0.0;
  parent[ground.index(from)] = ground.index(from);
  open.emplace(h(from), ground.index(from));
  while (!open.empty()) {
    const std::uint32_t s = std::get<1>(open.top());
    const double f = std::get<0>(open.top());
    open.pop();
    const Cell v = ground.at(s);
    if (closed[s] || f > g[s] + h(v) + 1e-12) continue;
    if (s == ground.index(to) && !to_the_end) break;
    closed[s] = !to_the_end;
    for (std::size_t i = 0; i < 8; ++i) {
      const Cell next{v.x + grid_moves[i].x, v.y + grid_moves[i].y};
      if ((ground.moves[s] >> i & 1U) == 0 || closed[ground.index(next)]) continue;
      const double through = g[s] + distance(ground.point(v), ground.point(next));
      if (through >= g[ground.index(next)] - 1e-12) continue;
      g[ground.index(next)] = through;
      parent[ground.index(next)] = s;
      open.emplace(through + h(next), ground.index(next));
    }
  }
  std::vector<Cell> path{to};
  while (!(path.back() == from)) path.push_back(ground.at(parent[ground.index(path.back())]));
  return {path.rbegin(), path.rend()};
}

struct Measured {
  double length, clearance, exposure;
};

Measured measured(const Plan& plan, const std::shared_ptr<const PolygonGround>& polygons) {
  const Safety safety = safety_of(plan, {nullptr, start, goal, polygons});
  return {length_of(plan), safety.clearance_m, safety.exposure};
}

class SafestReference : public ::testing::Test {
 protected:
  Measured of(const std::vector<Cell>& path) const {
    Plan plan;
    for (const Cell c : path) plan.waypoints.push_back(grid_->point(c));
    return measured(plan, polygons_);
  }

  std::shared_ptr<const PolygonGround> polygons_ = std::make_shared<const PolygonGround>(arena());
  std::shared_ptr<const GridMap> grid_ = std::make_shared<const GridMap>(
      *GridMap::of(*blocked_for_disk(*polygons_, {.resolution_m = resolution}), GridModel::cells));
  Workspace workspace_;
};

/// The heuristic never overestimates, so A* that is carried out to its end finds a shortest path, wherever
/// that runs. Met first, the goal has the estimate -d, with d its own distance from the obstacle: nothing
/// more follows than that the path is no more than d longer than the shortest.
TEST_F(SafestReference, ItsHeuristicLeadsToAShortestPathOrToOneThatIsLongerByChance) {
  const double shortest = plan_path({grid_, start, goal}, "dijkstra")->cost;
  EXPECT_NEAR(of(reference_path(*grid_, 1.0, false, true)).length, shortest, 1e-9);
  const double met_first = of(reference_path(*grid_, 1.0, false, false)).length;
  EXPECT_GT(met_first, shortest + 0.1);
  EXPECT_LE(met_first, shortest + away_from_obstacle(goal, false));
  EXPECT_NEAR(met_first, 1.5 + 1.0 + std::sqrt(0.5), 0.05);  // that of the waypoints that it drove
}

/// As it is written, and as it is programmed, with the second distance along the axes and in cells: whatever
/// comes out, the safest path is safer.
TEST_F(SafestReference, ItsPathIsNotTheSafest) {
  const auto along = medial_axis({nullptr, start, goal, polygons_}, {}, {}, workspace_);
  const auto on_grid = safest({grid_, start, goal}, {}, {}, workspace_);
  ASSERT_TRUE(along && on_grid);
  const Measured axis = measured(*along, polygons_), grid = measured(*on_grid, polygons_);
  for (const Measured& safe : {axis, grid}) EXPECT_NEAR(safe.clearance, 0.49, 2e-3);  // of start and goal
  const Measured written = of(reference_path(*grid_, 1.0, false, false));
  const Measured programmed = of(reference_path(*grid_, 100.0, true, false));
  for (const auto& [name, path] : {std::pair{"written", written}, {"programmed", programmed}}) {
    EXPECT_GT(path.exposure, 1.05 * std::max(axis.exposure, grid.exposure)) << name;
    EXPECT_LE(path.clearance, std::min(axis.clearance, grid.clearance)) << name;
    RecordProperty(std::string(name) + "_length", std::to_string(path.length));
    RecordProperty(std::string(name) + "_clearance", std::to_string(path.clearance));
    RecordProperty(std::string(name) + "_exposure", std::to_string(path.exposure));
  }
  RecordProperty("axis", std::to_string(axis.length) + " " + std::to_string(axis.clearance) + " " +
                             std::to_string(axis.exposure));
  RecordProperty("grid", std::to_string(grid.length) + " " + std::to_string(grid.clearance) + " " +
                             std::to_string(grid.exposure));
}

/// The waypoints that the report drove as its safest path: (2.5, 0.5) (2.5, 2) (2, 2.5) (1, 2.5).
TEST_F(SafestReference, TheWaypointsItDroveAreNotTheSafest) {
  Plan driven;
  driven.waypoints = {{2.5, 0.5}, {2.5, 2.0}, {2.0, 2.5}, {1.0, 2.5}};
  const Problem problem{nullptr, driven.waypoints.front(), driven.waypoints.back(), polygons_};
  const auto along = medial_axis(problem, {}, {}, workspace_);
  ASSERT_TRUE(along.has_value());
  const Safety theirs = safety_of(driven, problem), ours = safety_of(*along, problem);
  EXPECT_NEAR(theirs.clearance_m, 0.5, 1e-9);
  EXPECT_GE(ours.clearance_m, 0.4995);
  EXPECT_LT(ours.exposure, theirs.exposure);
  EXPECT_LT(length_of(*along), length_of(driven) * 1.05);
  RecordProperty("theirs", std::to_string(length_of(driven)) + " " + std::to_string(theirs.exposure));
  RecordProperty("ours", std::to_string(length_of(*along)) + " " + std::to_string(ours.exposure));
}

}  // namespace
}  // namespace outrider
