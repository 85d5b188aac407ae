// A robot with a range finder in a world of squares, with a perfect pose: fast, and exact in what it sees.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/explore/choose/decide.hpp"

namespace outrider::testing {

/// Distance from a point to the first occupied square in a direction, m; infinite beyond the grid.
inline double cast_ray(const Grid<std::uint8_t>& truth, Vec2 from, double angle_rad, double most_m) {
  const GridFrame& frame = truth.frame;
  const Vec2 along = direction(angle_rad);
  const Vec2 start = 1.0 / frame.resolution_m * (from - frame.origin);
  Cell cell = frame.cell_at(from);
  const int step_x = along.x > 0 ? 1 : -1, step_y = along.y > 0 ? 1 : -1;
  double next_x = ((along.x > 0 ? cell.x + 1 : cell.x) - start.x) / along.x;
  double next_y = ((along.y > 0 ? cell.y + 1 : cell.y) - start.y) / along.y;
  for (double way = 0.0; way * frame.resolution_m <= most_m;) {
    if (!truth.contains(cell)) break;
    if (truth[cell] != 0) return way * frame.resolution_m;
    if (next_x < next_y) {
      way = next_x;
      next_x += 1.0 / std::abs(along.x);
      cell.x += step_x;
    } else {
      way = next_y;
      next_y += 1.0 / std::abs(along.y);
      cell.y += step_y;
    }
  }
  return std::numeric_limits<double>::infinity();
}

struct GridExplorer {
  Grid<std::uint8_t> truth;  ///< other than 0 is solid
  RobotModel robot = {.radius_m = 0.105, .speed_mps = 0.22, .turn_rate_radps = 2.84};
  double range_m = 3.5;
  double noise_m = 0.0;
  int beams = 360;
  Pose2 pose;
  double time_s = 0.0, driven_m = 0.0;
  Rng rng{1};

  [[nodiscard]] LaserScan scan() {
    LaserScan scan;
    scan.time_s = time_s;
    scan.step_rad = 2.0 * pi / beams;
    scan.least_m = 0.12;
    scan.most_m = range_m;
    for (int i = 0; i < beams; ++i) {
      const double range = cast_ray(truth, pose.position, pose.heading_rad + i * scan.step_rad, range_m);
      scan.ranges_m.push_back(static_cast<float>(range + (noise_m > 0.0 ? noise_m * rng.normal() : 0.0)));
    }
    return scan;
  }

  /// Turns towards each waypoint in place, then drives straight, for so long.
  void follow(std::vector<Vec2> way, double for_s) {
    time_s += for_s;
    for (std::size_t i = 0; i < way.size() && for_s > 0.0;) {
      const Vec2 to = way[i] - pose.position;
      if (norm(to) < 1e-3) {
        ++i;
        continue;
      }
      const double turn = wrap_angle(heading_of(to) - pose.heading_rad);
      const double turning_s = std::min(for_s, std::abs(turn) / robot.turn_rate_radps);
      pose.heading_rad += std::copysign(turning_s * robot.turn_rate_radps, turn);
      for_s -= turning_s;
      const double step_m = std::min(norm(to), for_s * robot.speed_mps);
      pose.position = pose.position + step_m / norm(to) * to;
      driven_m += step_m;
      for_s -= step_m / robot.speed_mps;
    }
  }

  /// From the robot to the nearest solid square within 0.5 m, m.
  [[nodiscard]] double clearance_m() const {
    double least = 0.5;
    const GridFrame& frame = truth.frame;
    const Cell at = frame.cell_at(pose.position);
    const int reach = static_cast<int>(least / frame.resolution_m) + 1;
    for (int y = at.y - reach; y <= at.y + reach; ++y) {
      for (int x = at.x - reach; x <= at.x + reach; ++x) {
        if (!frame.contains({x, y}) || truth[{x, y}] == 0) continue;
        const Vec2 low = frame.corner({x, y}), high = frame.corner({x + 1, y + 1});
        const Vec2 nearest{std::clamp(pose.position.x, low.x, high.x),
                           std::clamp(pose.position.y, low.y, high.y)};
        least = std::min(least, distance(nearest, pose.position));
      }
    }
    return least;
  }
};

struct GridExploration {
  DecisionKind kind = DecisionKind::go;
  bool home = false;
  double time_s = 0.0, driven_m = 0.0;
  int decisions = 0;
  double least_clearance_m = 1.0;
  Decision last;
};

/// Explores with a decision after each scan, 5 a second, until it is home with everything seen, or time is
/// up. `seen(map, decision)` is called after each decision.
template <class Seen>
GridExploration explore(GridExplorer& world, OccupancyMap& map, FrontierMap& frontiers,
                        const ExploreOptions& options, double most_s, Seen seen) {
  constexpr double period_s = 0.2;
  GridExploration run;
  Workspace workspace;
  Blacklist blacklist;
  const Pose2 home = world.pose;
  ExploreChoice before;
  while (world.time_s < most_s) {
    const MapUpdate update = map.insert(world.pose, world.scan());
    frontiers.update(map.occupancy(), update);
    const ExploreState state{frontiers,  blacklist, world.robot,  world.range_m,
                             world.pose, home,      world.time_s, before};
    auto decision = decide(state, options, workspace);
    ++run.decisions;
    if (!decision) break;
    run.last = *decision;
    run.kind = decision->kind;
    before = decision->choice;
    seen(state, *decision);
    run.least_clearance_m = std::min(run.least_clearance_m, world.clearance_m());
    run.home =
        decision->kind == DecisionKind::complete && distance(world.pose.position, home.position) < 0.05;
    if (run.home || decision->kind == DecisionKind::leak) break;
    world.follow(decision->waypoints, period_s);
  }
  run.time_s = world.time_s;
  run.driven_m = world.driven_m;
  return run;
}

}  // namespace outrider::testing
