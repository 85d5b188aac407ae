#include "polygon_ground_free.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "outrider/core/units.hpp"
#include "polygon_ground_predicates.hpp"

namespace outrider {
namespace {

constexpr double touching = 1e-9;  // relative to the radius: closer curves count as crossing

/// An interval of free parameters of a curve.
struct Part {
  double low = 0.0;
  double high = 0.0;
};

/// Returns the free parts of [0, end], given the parameters at which the freedom of `at(parameter)` may
/// change.
template <class At>
std::vector<Part> free_parts(const PolygonGround& ground, std::vector<double>& cuts, double end, At at) {
  cuts.push_back(0.0);
  cuts.push_back(end);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Part> parts;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double low = std::clamp(cuts[i - 1], 0.0, end), high = std::clamp(cuts[i], 0.0, end);
    if (high - low <= 1e-13 * end || !ground.point_free(at(0.5 * (low + high)))) continue;
    const bool goes_on =
        !parts.empty() && low - parts.back().high <= 1e-12 * end && ground.point_free(at(low));
    if (goes_on) {
      parts.back().high = high;
    } else {
      parts.push_back({low, high});
    }
  }
  return parts;
}

/// Finds the edges within the radius of any point of the box, each once.
void edges_near(const PolygonGround& ground, const Box2& box, std::vector<std::uint32_t>& found) {
  found.clear();
  const EdgeIndex& index = ground.index;
  const std::size_t low = cell_of(index, box.low), high = cell_of(index, box.high);
  const auto width = static_cast<std::size_t>(index.width);
  for (std::size_t row = low / width; row <= high / width; ++row) {
    const std::size_t from = row * width + low % width, to = row * width + high % width;
    for (std::uint32_t i = index.first[from]; i < index.first[to + 1]; ++i) found.push_back(index.items[i]);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

/// The angles, from `from`, at which the circle around a corner crosses the border of the region that an edge
/// forbids.
struct CircleCuts {
  Vec2 centre;
  double radius_m;
  double from_rad;
  std::vector<double>& cuts;

  void add(double angle) {
    const double turned = wrap_angle(angle - from_rad);
    cuts.push_back(turned < 0.0 ? turned + 2.0 * pi : turned);
  }
  void add_line(Vec2 normal, double offset) {  // points with dot(normal, p - centre) = offset
    const double part = offset / radius_m;
    if (std::abs(part) > 1.0 + touching) return;
    const double half = std::acos(std::clamp(part, -1.0, 1.0));
    add(heading_of(normal) + half);
    add(heading_of(normal) - half);
  }
  void add_circle(Vec2 other) {
    const double apart = distance(centre, other);
    if (apart == 0.0 || apart > 2.0 * radius_m * (1.0 + touching)) return;
    add_line((1.0 / apart) * (other - centre), 0.5 * apart);
  }
  void add_edge(const Segment& edge) {
    const Vec2 along = (1.0 / distance(edge.a, edge.b)) * (edge.b - edge.a);
    const Vec2 normal = perpendicular(along);
    const double beside = dot(normal, edge.a - centre);
    add(heading_of(normal));
    add(heading_of(-normal));
    add_line(normal, beside + radius_m);
    add_line(normal, beside - radius_m);
    add_circle(edge.a);
    add_circle(edge.b);
  }
};

void add_arcs(PolygonGround& ground, Vec2 before, Vec2 corner, Vec2 after, std::vector<std::uint32_t>& near,
              std::vector<double>& cuts) {
  if (turn_of(before, corner, after) <= 0) return;
  const double from = heading_of(-perpendicular(corner - before));
  const double to = heading_of(-perpendicular(after - corner));
  const double turned = wrap_angle(to - from);
  if (turned <= 0.0 && turned > -1.0) return;  // straight but for rounding
  const double width = turned < 0.0 ? turned + 2.0 * pi : turned;
  const double reach = 2.0 * ground.radius_m * (1.0 + touching);
  edges_near(ground, Box2{corner, corner}.grown(ground.radius_m), near);
  cuts.clear();
  CircleCuts circle{corner, ground.radius_m, from, cuts};
  for (const std::uint32_t e : near) {
    if (distance(corner, ground.edges[e]) <= reach) circle.add_edge(ground.edges[e]);
  }
  const auto at = [&](double angle) { return corner + ground.radius_m * direction(from + angle); };
  for (const Part& part : free_parts(ground, cuts, width, at)) {
    const double low = from + part.low, high = from + part.high;
    const bool known = std::any_of(ground.arcs.begin(), ground.arcs.end(), [&](const FreeArc& arc) {
      return arc.centre == corner && std::abs(wrap_angle(arc.from_rad - low)) < 1e-12;
    });
    if (known) continue;  // belongs to another polygon with the same corner
    ground.arcs.push_back(
        {corner, low, part.high - part.low, direction(low), direction(0.5 * (low + high)), direction(high)});
  }
}

/// The lengths along a line at which it crosses the border of the region that an edge forbids.
struct LineCuts {
  Vec2 from;
  Vec2 along;
  double radius_m;
  std::vector<double>& cuts;

  void add_circle(Vec2 centre) {
    const double h = cross(along, centre - from);
    if (std::abs(h) > radius_m * (1.0 + touching)) return;
    const double half = std::sqrt(std::max(0.0, radius_m * radius_m - h * h));
    cuts.push_back(dot(along, centre - from) - half);
    cuts.push_back(dot(along, centre - from) + half);
  }
  void add_line(Vec2 point, Vec2 direction) {
    const double slope = cross(along, direction);
    if (std::abs(slope) > 1e-14) cuts.push_back(cross(point - from, direction) / slope);
  }
  void add_edge(const Segment& edge) {
    const Vec2 other = (1.0 / distance(edge.a, edge.b)) * (edge.b - edge.a);
    const Vec2 aside = radius_m * perpendicular(other);
    cuts.push_back(dot(along, edge.a - from));
    cuts.push_back(dot(along, edge.b - from));
    add_line(edge.a + aside, other);
    add_line(edge.a - aside, other);
    add_circle(edge.a);
    add_circle(edge.b);
  }
};

void add_walls(PolygonGround& ground, const Segment& edge, std::vector<std::uint32_t>& near,
               std::vector<double>& cuts) {
  const double length = distance(edge.a, edge.b);
  const Vec2 along = (1.0 / length) * (edge.b - edge.a);
  const Segment moved{edge.a - ground.radius_m * perpendicular(along),
                      edge.b - ground.radius_m * perpendicular(along)};
  Box2 box;
  box.include(moved.a);
  box.include(moved.b);
  edges_near(ground, box, near);
  cuts.clear();
  LineCuts line{moved.a, along, ground.radius_m, cuts};
  for (const std::uint32_t e : near) {
    if (distance(moved, ground.edges[e]) <= ground.radius_m * (1.0 + touching)) {
      line.add_edge(ground.edges[e]);
    }
  }
  const auto at = [&](double s) { return moved.a + s * along; };
  for (const Part& part : free_parts(ground, cuts, length, at)) {
    ground.walls.push_back({at(part.low), at(part.high)});
  }
}

}  // namespace

std::optional<std::uint32_t> GroundBefore::unchanged(const PolygonGround& now, std::uint32_t edge) const {
  const std::uint32_t same = edge < gone_from ? edge : edge + gone_count;
  if (same >= ground.edges.size()) return std::nullopt;
  Box2 box;
  box.include(now.edges[edge].a);
  box.include(now.edges[edge].b);
  if (box.grown(2.0 * now.radius_m * (1.0 + 1e-6)).overlaps(changed)) return std::nullopt;
  return same;
}

void find_free_boundary(PolygonGround& ground, const GroundBefore* before) {
  std::vector<std::uint32_t> near;
  std::vector<double> cuts;
  const auto unchanged = [&](std::uint32_t edge) {
    return before == nullptr ? std::nullopt : before->unchanged(ground, edge);
  };
  const auto copy = [](auto& to, const auto& from, const std::vector<std::uint32_t>& first, std::uint32_t i) {
    to.insert(to.end(), from.begin() + first[i], from.begin() + first[i + 1]);
  };
  const auto corners_of = [&](const std::vector<Vec2>& polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto edge = static_cast<std::uint32_t>(ground.first_arc.size());
      ground.first_arc.push_back(static_cast<std::uint32_t>(ground.arcs.size()));
      if (const auto same = unchanged(edge)) {
        copy(ground.arcs, before->ground.arcs, before->ground.first_arc, *same);
      } else {
        add_arcs(ground, polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n], near, cuts);
      }
    }
  };
  corners_of(ground.boundary);
  for (const auto& obstacle : ground.obstacles) corners_of(obstacle);
  ground.first_arc.push_back(static_cast<std::uint32_t>(ground.arcs.size()));
  for (std::uint32_t edge = 0; edge < ground.edges.size(); ++edge) {
    ground.first_wall.push_back(static_cast<std::uint32_t>(ground.walls.size()));
    if (const auto same = unchanged(edge)) {
      copy(ground.walls, before->ground.walls, before->ground.first_wall, *same);
    } else {
      add_walls(ground, ground.edges[edge], near, cuts);
    }
  }
  ground.first_wall.push_back(static_cast<std::uint32_t>(ground.walls.size()));
}

}  // namespace outrider
