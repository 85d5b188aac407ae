#include "outrider/path/visibility/polygon_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "polygon_ground_free.hpp"
#include "polygon_ground_predicates.hpp"

namespace outrider {
namespace {

std::string text(Vec2 p) { return place_text(p.x, p.y); }

double twice_area(const std::vector<Vec2>& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return sum;
}

/// Returns the corners without consecutive duplicates.
std::vector<Vec2> distinct(std::vector<Vec2> corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

Segment edge_of(const std::vector<Vec2>& polygon, std::size_t i) {
  return {polygon[i], polygon[(i + 1) % polygon.size()]};
}

bool crosses_itself(const std::vector<Vec2>& polygon, std::size_t i, std::size_t j) {
  const Segment s = edge_of(polygon, i), t = edge_of(polygon, j);
  if (s.b == t.a) return turn_of(s.a, s.b, t.b) == 0 && dot(s.b - s.a, t.b - t.a) < 0.0;
  if (t.b == s.a) return turn_of(t.a, t.b, s.b) == 0 && dot(t.b - t.a, s.b - s.a) < 0.0;
  return segments_meet(s, t);
}

Status check_simple(const std::vector<Vec2>& polygon, std::string_view name) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j) {
      const bool next = j == i + 1 || (i == 0 && j + 1 == polygon.size());
      const Segment s = edge_of(polygon, i), t = edge_of(polygon, j);
      if (!(next ? crosses_itself(polygon, i, j) : segments_meet(s, t))) continue;
      return bad_input(
          fmt::format("{} crosses or touches itself: its edges {} {} and {} {} meet; split it "
                      "into simple polygons",
                      name, text(s.a), text(s.b), text(t.a), text(t.b)));
    }
  }
  return {};
}

bool encloses(const std::vector<Vec2>& polygon, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment e = edge_of(polygon, i);
    if ((e.a.y > p.y) == (e.b.y > p.y)) continue;
    const double side = cross(e.b - e.a, p - e.a);
    if ((e.b.y > e.a.y) == (side > 0.0)) inside = !inside;
  }
  return inside;
}

Status check_count(const std::vector<Vec2>& boundary, const std::vector<std::vector<Vec2>>& obstacles) {
  std::size_t count = boundary.size();
  for (const auto& obstacle : obstacles) count += obstacle.size();
  if (count <= most_polygon_corners && obstacles.size() <= most_polygon_corners) return {};
  return bad_input(
      fmt::format("{} corners are more than {}, the most that are taken; simplify the "
                  "polygons",
                  count, most_polygon_corners));
}

/// Returns the first fault of any polygon, or of the numbers.
Status check_all(const std::vector<Vec2>& boundary, const std::vector<std::vector<Vec2>>& obstacles,
                 double radius_m) {
  const bool good_radius = radius_m >= least_polygon_radius_m && radius_m <= most_polygon_radius_m;
  if (!good_radius) {
    return bad_input(fmt::format("a robot radius of {} m is not valid among polygons; expected {} to {} m",
                                 short_number(radius_m), least_polygon_radius_m, most_polygon_radius_m));
  }
  if (auto good = check_count(boundary, obstacles); !good) return good;
  if (auto good = check_polygon(boundary, "the boundary"); !good) return good;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (auto good = check_polygon(obstacles[i], fmt::format("obstacle {}", i + 1)); !good) return good;
  }
  return {};
}

Box2 box_of(const std::vector<Vec2>& polygon) {
  Box2 box;
  for (const Vec2 p : polygon) box.include(p);
  return box;
}

/// Makes the ground of polygons that have passed the checks; `before` may be null.
PolygonGround ground_of(const std::vector<Vec2>& boundary, const std::vector<std::vector<Vec2>>& obstacles,
                        double radius_m, const GroundBefore* before) {
  PolygonGround ground;
  ground.radius_m = radius_m;
  const auto take = [&ground](const std::vector<Vec2>& corners, bool clockwise) {
    std::vector<Vec2> polygon = distinct(corners);
    if ((twice_area(polygon) < 0.0) != clockwise) std::reverse(polygon.begin(), polygon.end());
    for (std::size_t i = 0; i < polygon.size(); ++i) ground.edges.push_back(edge_of(polygon, i));
    return polygon;
  };
  ground.boundary = take(boundary, true);
  for (const Vec2 p : ground.boundary) ground.bounds.include(p);
  for (const auto& obstacle : obstacles) ground.obstacles.push_back(take(obstacle, false));
  ground.index = index_of(ground);
  find_free_boundary(ground, before);
  return ground;
}

}  // namespace

Status check_polygon(const std::vector<Vec2>& corners, std::string_view name) {
  if (corners.size() > most_polygon_corners) {
    return bad_input(
        fmt::format("{} has {} corners; at most {} are taken", name, corners.size(), most_polygon_corners));
  }
  for (const Vec2 p : corners) {
    const bool good = std::abs(p.x) <= farthest_corner_m && std::abs(p.y) <= farthest_corner_m;
    if (!good) {
      return bad_input(fmt::format("{} has the corner {}; coordinates are numbers from -{} to {} m", name,
                                   text(p), farthest_corner_m, farthest_corner_m));
    }
  }
  const std::vector<Vec2> polygon = distinct(corners);
  if (polygon.size() < 3) {
    return bad_input(
        fmt::format("{} has {} distinct corners; a polygon has at least three", name, polygon.size()));
  }
  if (auto simple = check_simple(polygon, name); !simple) return simple;
  return {};
}

Outcome<PolygonGround> PolygonGround::of(std::vector<Vec2> boundary, std::vector<std::vector<Vec2>> obstacles,
                                         double radius_m) {
  if (auto good = check_all(boundary, obstacles, radius_m); !good) return pass_on(good);
  return ground_of(boundary, obstacles, radius_m, nullptr);
}

Outcome<PolygonGround> PolygonGround::with_obstacle(const std::vector<Vec2>& corners) const {
  if (auto good = check_polygon(corners, "the new obstacle"); !good) return pass_on(good);
  auto more = obstacles;
  more.push_back(corners);
  if (auto good = check_count(boundary, more); !good) return pass_on(good);
  const GroundBefore before{*this, static_cast<std::uint32_t>(edges.size()), 0, box_of(corners)};
  return ground_of(boundary, more, radius_m, &before);
}

Outcome<PolygonGround> PolygonGround::without_obstacle(std::size_t which) const {
  if (which >= obstacles.size()) {
    return bad_input(fmt::format("there is no obstacle {} to take away; there are {}, counted from 0", which,
                                 obstacles.size()));
  }
  std::size_t gone_from = boundary.size();
  for (std::size_t i = 0; i < which; ++i) gone_from += obstacles[i].size();
  const GroundBefore before{*this, static_cast<std::uint32_t>(gone_from),
                            static_cast<std::uint32_t>(obstacles[which].size()), box_of(obstacles[which])};
  auto fewer = obstacles;
  fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(which));
  return ground_of(boundary, fewer, radius_m, &before);
}

bool PolygonGround::outside(Vec2 p) const { return !encloses(boundary, p); }

double PolygonGround::edge_distance(Vec2 p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& edge : edges) least = std::min(least, distance(p, edge));
  return least;
}

}  // namespace outrider
