#include "research/guard/heading_cone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

struct TileStep {
  Cell by;
  std::int16_t weight = 0;
};

constexpr std::array<TileStep, 4> quarter{{{{1, 0}, 9}, {{2, 1}, 20}, {{1, 1}, 13}, {{1, 2}, 20}}};
constexpr std::size_t cones = 4 * quarter.size();
constexpr int reach = 4;  // no tile extends farther from its vertex, along x or y
constexpr double contact = 1e-9;

TileStep step(std::size_t i) {
  TileStep step = quarter[i % quarter.size()];
  for (std::size_t turn = 0; turn < i / quarter.size() % 4; ++turn) step.by = {-step.by.y, step.by.x};
  return step;
}

Vec2 vector(Cell cell) { return {static_cast<double>(cell.x), static_cast<double>(cell.y)}; }

/// The part in a cell whose sides are `wider` farther from its centre.
std::vector<Vec2> clipped_to(std::vector<Vec2> polygon, Cell cell, double wider = 0.0) {
  const Vec2 centre = vector(cell);
  for (const Vec2 normal : {Vec2{1.0, 0.0}, Vec2{-1.0, 0.0}, Vec2{0.0, 1.0}, Vec2{0.0, -1.0}}) {
    polygon = clip(polygon, normal, dot(normal, centre) + 0.5 + wider);
  }
  return polygon;
}

/// The linear function with the weights of both steps, as a gradient.
Vec2 measure(const TileStep& p, const TileStep& q) {
  const Vec2 a = vector(p.by), b = vector(q.by);  // cross(a, b) is 1
  return {p.weight * b.y - q.weight * a.y, q.weight * a.x - p.weight * b.x};
}

/// Calls visit(cell) for each cell that a tile may touch.
template <class Visit>
void each_cell(const Visit& visit) {
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) visit(Cell{x, y});
  }
}

std::vector<TileOverlap> overlaps(const TileStep& p, const TileStep& q) {
  const Vec2 a = vector(p.by), b = vector(q.by), gradient = measure(p, q);
  std::vector<TileOverlap> found;
  each_cell([&](Cell cell) {
    const std::vector<Vec2> part = clipped_to({{0.0, 0.0}, a, a + b, b}, cell);
    if (RoundedPolygon{part}.area() < contact) return;
    const auto [least, most] = std::minmax_element(
        part.begin(), part.end(), [&](Vec2 l, Vec2 r) { return dot(gradient, l) < dot(gradient, r); });
    found.push_back({cell, static_cast<std::int16_t>(std::floor(dot(gradient, *least) + contact)),
                     static_cast<std::int16_t>(std::ceil(dot(gradient, *most) - contact))});
  });
  return found;
}

/// The far side of the tile that the step `along` leads across: from there, `other` long.
TileExit exit_along(const TileStep& along, const TileStep& other) {
  TileExit exit{along.by, along.weight, {}};
  const Vec2 from = vector(along.by), to = from + vector(other.by);
  each_cell([&](Cell cell) {
    if (!clipped_to({from, to}, cell, contact).empty()) exit.cells.push_back(cell);  // touched counts
  });
  return exit;
}

}  // namespace

double HeadingCone::angle_to(double heading_rad) const {
  return std::max(0.0, std::abs(wrap_angle(heading_rad - middle_rad)) - half_width_rad);
}

double HeadingCone::angle_to(const HeadingCone& other) const {
  return std::max(0.0, angle_to(other.middle_rad) - other.half_width_rad);
}

std::vector<HeadingCone> heading_cones() {
  std::vector<HeadingCone> all;
  for (std::size_t i = 0; i < cones; ++i) {
    const TileStep p = step(i), q = step(i + 1);
    const double from = heading_of(vector(p.by));
    const double width = wrap_angle(heading_of(vector(q.by)) - from);
    all.push_back({exit_along(p, q), exit_along(q, p), from + 0.5 * width, 0.5 * width, overlaps(p, q)});
  }
  return all;
}

double heading_scale() {
  double most = 0.0;
  for (std::size_t i = 0; i < quarter.size(); ++i) most = std::max(most, norm(measure(step(i), step(i + 1))));
  return most;
}

}  // namespace outrider
