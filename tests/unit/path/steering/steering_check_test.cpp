#include "steering/steering_check.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "outrider/core/units.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/pieces.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

/// Ahead, a quarter to the left, and back: over a ground with one blocked cell.
struct Drive {
  Problem problem;
  Plan plan;
};
Drive drive() {
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 10, 10});
  grid[{9, 5}] = 1;
  Drive made;
  made.problem = {std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells)),
                  {1.5, 1.5},
                  {6.5, 2.5},
                  nullptr,
                  0.0,
                  0.5 * pi};
  Plan& plan = made.plan;
  plan.steering = Steering{2.0, true};
  plan.weights.per_cusp = 0.5;
  plan.weights.per_backward_m = 1.0;
  plan.pieces = {{{1.5, 1.5}, {4.5, 1.5}, {}, 0.0, false},
                 {{4.5, 1.5}, {6.5, 3.5}, {4.5, 3.5}, 0.5 * pi, false},
                 {{6.5, 3.5}, {6.5, 2.5}, {}, 0.0, true}};
  plan.cost = 3.0 + pi + 0.5 + 2.0;
  plan.lower_bound = 5.0;
  plan.waypoint_error_m = 0.01;
  plan.waypoints = points_along({1.5, 1.5}, plan.pieces, radians(5.0));
  return made;
}

TEST(SteeringCheck, AcceptsADriveAndRefusesEachChangeOfIt) {
  const Drive good = drive();
  const auto verdict = check(good.plan, good.problem);
  ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
  const std::vector<std::pair<std::string, std::function<void(Plan&)>>> changes = {
      {"a tighter limit", [](Plan& p) { p.steering->turning_radius_m = 2.1; }},
      {"no reverse", [](Plan& p) { p.steering->reverse = false; }},
      {"another cost", [](Plan& p) { p.cost -= 0.1; }},
      {"free cusps", [](Plan& p) { p.weights.per_cusp = 0.0; }},
      {"a bound above", [](Plan& p) { p.lower_bound = 20.0; }},
      {"a gap", [](Plan& p) { p.pieces[1].from.x += 0.01; }},
      {"a turn in place", [](Plan& p) { p.pieces[0].backward = true; }},
      {"no arc", [](Plan& p) { p.pieces[1].turn_rad = 0.4 * pi; }},
      {"another end", [](Plan& p) { p.pieces.pop_back(); }},
      {"waypoints elsewhere", [](Plan& p) { p.waypoints[4] = p.waypoints[4] + Vec2{0.1, 0.1}; }},
      {"a waypoint too few",
       [](Plan& p) { p.waypoints.erase(p.waypoints.begin() + 4, p.waypoints.begin() + 12); }},
      {"vertices", [](Plan& p) { p.vertices = {{1, 1}}; }},
      {"no pieces", [](Plan& p) { p.pieces.clear(); }}};
  for (const auto& [name, change] : changes) {
    Plan bad = good.plan;
    change(bad);
    EXPECT_FALSE(check(bad, good.problem).has_value()) << name;
  }
  Problem other = good.problem;
  other.outline = {{-0.4, -0.3}, {0.4, -0.3}, {0.4, 0.3}, {-0.4, 0.3}};
  EXPECT_TRUE(check(good.plan, other).has_value());
  other.outline = {{-0.4, -0.3}, {5.0, -0.3}, {5.0, 0.3}, {-0.4, 0.3}};
  EXPECT_FALSE(check(good.plan, other).has_value()) << "it comes into the cell";
  other.outline = {{-1.6, -0.3}, {0.4, -0.3}, {0.4, 0.3}, {-1.6, 0.3}};
  EXPECT_FALSE(check(good.plan, other).has_value()) << "it leaves the grid";
  other = good.problem;
  other.start_heading_rad = 0.1;
  EXPECT_FALSE(check(good.plan, other).has_value());
  other = good.problem;
  other.goal_heading_rad = 0.1;
  EXPECT_FALSE(check(good.plan, other).has_value());
  other.goal_heading_rad.reset();
  EXPECT_TRUE(check(good.plan, other).has_value());
}

TEST(SteeringCheck, ACellOnTheArcIsSeen) {
  const Drive good = drive();
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 10, 10});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      grid.cells.assign(grid.cells.size(), 0);
      grid[{x, y}] = 1;
      Problem problem = good.problem;
      problem.grid = std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::cells));
      bool met = false;  // by dense points
      for (const Vec2 p : points_along(problem.start, good.plan.pieces, 1e-3)) {
        met = met || Box2{{double(x), double(y)}, {x + 1.0, y + 1.0}}.contains(p);
      }
      for (double at = 1.5; at < 4.5; at += 0.01) met = met || (y == 1 && at >= x && at <= x + 1.0);
      EXPECT_EQ(!check(good.plan, problem).has_value(), met) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace outrider
