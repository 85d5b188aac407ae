#include "routes_graph.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "routes_parallel.hpp"

namespace outrider::routes {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

bool free_at(const CollisionMap& ground, double radius_m, Vec2 p) {
  return ground.clearance(p, radius_m) >= radius_m - same_place_m;
}

SightLines lines_of(const CollisionMap& ground, const Rows& rows, const std::vector<Vec2>& from,
                    const std::vector<Vec2>& to, const Limits& limits) {
  SightLines result;
  for (std::size_t i = 0; i < rows.size(); ++i) result.first.push_back(result.first[i] + rows[i].size());
  result.lines.reserve(result.first.back());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::uint32_t k : rows[i]) {
      const Vec2 leg = to[k] - from[i];
      result.lines.push_back({k, heading_of(leg), duration(ground.length({from[i], to[k]}), limits)});
    }
  }
  return result;
}

/// Finds, for each point of `from`, the points to[k], k >= first_to(i), that it sees.
template <class FirstTo>
Outcome<Rows> visible(const CollisionMap& ground, double radius_m, const std::vector<Vec2>& from,
                      const std::vector<Vec2>& to, FirstTo first_to, Budget& budget) {
  Rows rows(from.size());
  Status status = in_parallel(from.size(), budget, [&](std::size_t i, BudgetMeter& meter) {
    if (!meter.spend()) return false;
    for (std::size_t k = first_to(i); k < to.size(); ++k) {
      if (distance(from[i], to[k]) > same_place_m && ground.segment_free({from[i], to[k]}, radius_m)) {
        rows[i].push_back(static_cast<std::uint32_t>(k));
      }
    }
    return true;
  });
  if (!status) return pass_on(status);
  return rows;
}

}  // namespace

std::vector<Vec2> route_nodes(const CollisionMap& ground, double radius_m, double arc_step_rad,
                              const std::vector<Vec2>& extra) {
  std::vector<Vec2> nodes;
  for (const RoundedPolygon& obstacle : ground.obstacles()) {
    const RoundedPolygon grown{obstacle.core, obstacle.radius_m + radius_m};
    for (const double step : {arc_step_rad, std::min(2.0 * arc_step_rad, pi / 2)}) {
      for (const Vec2 corner : circumscribed(grown, step)) nodes.push_back(corner);
    }
  }
  nodes.insert(nodes.end(), extra.begin(), extra.end());
  std::erase_if(nodes, [&](Vec2 p) { return !free_at(ground, radius_m, p); });

  std::vector<std::size_t> order(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (nodes[i].x != nodes[j].x) return nodes[i].x < nodes[j].x;
    if (nodes[i].y != nodes[j].y) return nodes[i].y < nodes[j].y;
    return i < j;
  });
  std::vector<Vec2> kept;
  for (const std::size_t i : order) {
    const auto near = [&](Vec2 p) { return distance(p, nodes[i]) <= same_place_m; };
    if (kept.empty() || !near(kept.back())) kept.push_back(nodes[i]);
  }
  return kept;
}

Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& from, const std::vector<Vec2>& to, Budget& budget) {
  const auto all = [](std::size_t) { return std::size_t{0}; };
  Outcome<Rows> rows = visible(ground, robot.radius_m, from, to, all, budget);
  if (!rows) return pass_on(rows);
  return lines_of(ground, *rows, from, to, robot.straight());
}

Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& points, Budget& budget) {
  const auto later = [](std::size_t i) { return i + 1; };
  Outcome<Rows> upper = visible(ground, robot.radius_m, points, points, later, budget);
  if (!upper) return pass_on(upper);
  Rows rows(points.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    for (const std::uint32_t k : (*upper)[i]) rows[k].push_back(i);
    rows[i].insert(rows[i].end(), (*upper)[i].begin(), (*upper)[i].end());
  }
  return lines_of(ground, rows, points, points, robot.straight());
}

SightLines reversed(const SightLines& lines, const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  SightLines result;
  result.first.assign(to.size() + 1, 0);
  for (const SightLine& line : lines.lines) ++result.first[line.to + 1];
  for (std::size_t k = 1; k < result.first.size(); ++k) result.first[k] += result.first[k - 1];
  result.lines.resize(lines.lines.size());
  std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    for (const SightLine& line : lines.row(i)) {
      result.lines[next[line.to]++] = {i, heading_of(from[i] - to[line.to]), line.drive_s};
    }
  }
  return result;
}

}  // namespace outrider::routes
