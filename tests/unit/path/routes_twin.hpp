// Yards, a slow twin of Routes that looks at everything for every question, and judges of what Routes says.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/path/routes/routes.hpp"

namespace outrider::testing {

inline constexpr double inf = std::numeric_limits<double>::infinity();

struct Yard {
  Box2 bounds{{-3.0, -3.0}, {3.0, 3.0}};
  std::vector<RoundedPolygon> obstacles;
  std::vector<Vec2> stops;
  RobotModel robot;

  [[nodiscard]] CollisionMap ground() const { return {bounds, obstacles}; }
};

RoundedPolygon box(Vec2 centre, double half_x, double half_y, double yaw_rad = 0.0);

/// From the nearest obstacle or the border, m.
double twin_clearance(const Yard& yard, Vec2 p);

bool twin_leg_free(const Yard& yard, Segment s);

/// The corners around the grown obstacles where the robot fits.
std::vector<Vec2> twin_nodes(const Yard& yard, double step_rad);

/// All pairs of nodes and stops that see each other, without pruning, and Bellman-Ford over (point,
/// point it was reached from) until nothing improves.
struct Twin {
  RobotModel robot;
  std::size_t nodes = 0;  // the stops follow
  std::vector<Vec2> points;
  std::vector<std::vector<std::size_t>> seen;

  Twin(const Yard& yard, double step_rad, const std::vector<Vec2>& extra = {});

  /// Least time from a stop to every stop; its first turn counts when a heading is given.
  [[nodiscard]] std::vector<double> times_from(std::size_t stop, const double* heading_rad) const;
};

Yard random_yard(Rng& rng, int obstacles, int stops, const RobotModel& robot = {});

/// Some robots hardly stop for a turn, others do little else; some jump to full speed.
RobotModel random_robot(Rng& rng);

Yard big_yard(std::uint64_t seed, int obstacles, int stops);

/// A pillar in a round room that leaves the robot a ring 1 cm wider than itself: narrower than the
/// corners around the pillar.
Yard tight_ring();

/// So many places in the middle of that ring.
std::vector<Vec2> ring_nodes(int count);

Outcome<Routes> routes_of(const Yard& yard, const std::vector<Vec2>& extra = {},
                          const RouteOptions& options = {}, const Budget& budget = {});

/// The robot is nowhere on that way in an obstacle.
void expect_sound(const Yard& yard, const std::vector<Vec2>& waypoints);

/// The numbers of a drive agree with its waypoints.
void expect_consistent(const Yard& yard, const Routes& routes, std::size_t i, std::size_t j);

}  // namespace outrider::testing
