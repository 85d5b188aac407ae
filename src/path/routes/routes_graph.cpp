#include "routes_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "outrider/core/units.hpp"
#include "routes_parallel.hpp"

namespace outrider::routes {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

constexpr std::size_t most_close_corners = 2048;

bool free_at(const CollisionMap& ground, double radius_m, Vec2 p) {
  return ground.clearance(p, radius_m) >= radius_m - same_place_m;
}

/// Returns the first of the nodes, sorted by x, within each such distance. One that stands for several counts
/// as a place in the open.
std::vector<Node> thinned(const std::vector<Node>& nodes, double within_m) {
  std::vector<Node> kept;
  for (const Node& node : nodes) {
    std::size_t i = kept.size();
    while (i > 0 && kept[i - 1].at.x >= node.at.x - within_m && distance(kept[i - 1].at, node.at) > within_m)
      --i;
    if (i > 0 && kept[i - 1].at.x >= node.at.x - within_m) {
      kept[i - 1] = {kept[i - 1].at};
    } else {
      kept.push_back(node);
    }
  }
  return kept;
}

std::vector<Node> sorted(std::vector<Node> nodes) {
  std::ranges::stable_sort(nodes, [](const Node& a, const Node& b) {
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
  });
  return nodes;
}

/// Returns the corners of the grown obstacles where the robot fits.
std::vector<Node> free_corners(const CollisionMap& ground, double radius_m, double arc_step_rad) {
  std::vector<Node> nodes;
  for (const RoundedPolygon& obstacle : ground.obstacles()) {
    const RoundedPolygon grown{obstacle.core, obstacle.radius_m + radius_m};
    for (const double step : std::set{arc_step_rad, std::min(2.0 * arc_step_rad, pi / 2)}) {
      const std::vector<Vec2> corners = circumscribed(grown, step);
      const std::size_t n = corners.size();
      for (std::size_t i = 0; i < n; ++i) {
        if (free_at(ground, radius_m, corners[i]))
          nodes.push_back({corners[i], corners[(i + n - 1) % n], corners[(i + 1) % n]});
      }
    }
  }
  return nodes;
}

SightLines lines_of(const CollisionMap& ground, const Rows& rows, const std::vector<Node>& from,
                    const std::vector<Node>& to, const Limits& limits) {
  SightLines result;
  for (std::size_t i = 0; i < rows.size(); ++i) result.first.push_back(result.first[i] + rows[i].size());
  result.lines.reserve(result.first.back());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::uint32_t k : rows[i]) {
      const Segment leg{from[i].at, to[k].at};
      result.lines.push_back({k, heading_of(leg.b - leg.a), duration(ground.length(leg), limits)});
    }
  }
  return result;
}

/// Returns true if a straight leg joins the nodes, touches both and is free.
bool joined(const CollisionMap& ground, double radius_m, const Node& a, const Node& b) {
  return distance(a.at, b.at) > same_place_m && a.is_touched_from(b.at) && b.is_touched_from(a.at) &&
         ground.segment_free({a.at, b.at}, radius_m);
}

/// Finds, for each node of `from`, the nodes to[k], k >= first_to(i), to which it is joined.
template <class FirstTo>
Outcome<Rows> visible(const CollisionMap& ground, double radius_m, const std::vector<Node>& from,
                      const std::vector<Node>& to, FirstTo first_to, Budget& budget) {
  Rows rows(from.size());
  Status status = in_parallel(from.size(), budget, [&](std::size_t i, BudgetMeter& meter) {
    if (!meter.spend()) return false;
    for (std::size_t k = first_to(i); k < to.size(); ++k) {
      if (joined(ground, radius_m, from[i], to[k])) rows[i].push_back(static_cast<std::uint32_t>(k));
    }
    return true;
  });
  if (!status) return pass_on(status);
  return rows;
}

}  // namespace

bool Node::is_touched_from(Vec2 place) const {
  const Vec2 leg = at - place;
  const double left = cross(leg, before - at), right = cross(leg, after - at);
  const double touch = 1e-9 * norm(leg);
  return (left >= -touch && right >= -touch) || (left <= touch && right <= touch);
}

std::vector<Node> open_nodes(const std::vector<Vec2>& places) {
  std::vector<Node> nodes;
  nodes.reserve(places.size());
  for (const Vec2 place : places) nodes.push_back({place});
  return nodes;
}

std::vector<Node> route_nodes(const CollisionMap& ground, double radius_m, double arc_step_rad,
                              const std::vector<Vec2>& extra) {
  std::vector<Node> nodes = sorted(free_corners(ground, radius_m, arc_step_rad));
  for (const double share : {1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0}) {
    if (nodes.size() > most_close_corners) nodes = thinned(nodes, share * radius_m);
  }
  for (const Vec2 place : extra) {
    if (free_at(ground, radius_m, place)) nodes.push_back({place});
  }
  return thinned(sorted(std::move(nodes)), same_place_m);
}

Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Node>& from, const std::vector<Node>& to, Budget& budget) {
  const auto all = [](std::size_t) { return std::size_t{0}; };
  Outcome<Rows> rows = visible(ground, robot.radius_m, from, to, all, budget);
  if (!rows) return pass_on(rows);
  return lines_of(ground, *rows, from, to, robot.straight());
}

Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Node>& nodes, Budget& budget) {
  const auto later = [](std::size_t i) { return i + 1; };
  Outcome<Rows> upper = visible(ground, robot.radius_m, nodes, nodes, later, budget);
  if (!upper) return pass_on(upper);
  Rows rows(nodes.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    for (const std::uint32_t k : (*upper)[i]) rows[k].push_back(i);
    rows[i].insert(rows[i].end(), (*upper)[i].begin(), (*upper)[i].end());
  }
  return lines_of(ground, rows, nodes, nodes, robot.straight());
}

SightLines reversed(const SightLines& lines, const std::vector<Node>& from, const std::vector<Node>& to) {
  SightLines result;
  result.first.assign(to.size() + 1, 0);
  for (const SightLine& line : lines.lines) ++result.first[line.to + 1];
  for (std::size_t k = 1; k < result.first.size(); ++k) result.first[k] += result.first[k - 1];
  result.lines.resize(lines.lines.size());
  std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    for (const SightLine& line : lines.row(i)) {
      result.lines[next[line.to]++] = {i, heading_of(from[i].at - to[line.to].at), line.drive_s};
    }
  }
  return result;
}

}  // namespace outrider::routes
