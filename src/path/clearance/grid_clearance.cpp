#include "grid_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/world/clearance.hpp"

namespace outrider {
namespace {

constexpr double rounding = 1e-3;  // cells
constexpr double far = 16.0;       // cells

Vec2 centre(Cell v) { return {v.x + 0.5, v.y + 0.5}; }

/// Returns the distance from x to the interval [column, column + 1].
double apart(double x, int column) { return std::max({0.0, column - x, x - column - 1.0}); }

/// The nearest blocked cell of one row, from the column at `inner` outwards on one side.
double squared_in_row(const GridMap& ground, Vec2 p, int row, int side, double inner, double least) {
  const double up = apart(p.y, row);
  for (int column = static_cast<int>(std::floor(p.x + side * inner));; column += side) {
    const double across = apart(p.x, column);
    const double squared = up * up + across * across;
    if (squared >= least) return least;
    if (ground.blocked({column, row})) return squared;
  }
}

bool wider_between(const GridClearance& clearance, Vec2 a, double at_a, Vec2 b, double at_b, double least) {
  if (at_a < least || at_b < least) return false;
  const double apart = distance(a, b);
  if (0.5 * (at_a + at_b - apart) >= least) return true;  // it changes by no more than one walks
  if (apart < rounding) return false;
  const Vec2 middle = 0.5 * (a + b);
  const double at_middle = clearance.at(middle);
  return wider_between(clearance, a, at_a, middle, at_middle, least) &&
         wider_between(clearance, middle, at_middle, b, at_b, least);
}

}  // namespace

GridClearance GridClearance::of(const GridMap& ground, const std::stop_token& stop) {
  const int width = 2 * ground.frame.width + 1, height = 2 * ground.frame.height + 1;
  Grid<std::uint8_t> solid(GridFrame{{0.0, 0.0}, 0.5, width, height});
  for (int y = -1; y <= ground.frame.height && !stop.stop_requested(); ++y) {
    for (int x = -1; x <= ground.frame.width; ++x) {
      if (!ground.blocked({x, y})) continue;
      for (int j = std::max(2 * y, 0); j <= std::min(2 * y + 2, height - 1); ++j) {
        for (int i = std::max(2 * x, 0); i <= std::min(2 * x + 2, width - 1); ++i) solid[{i, j}] = 1;
      }
    }
  }
  GridClearance made;
  made.ground = &ground;
  made.stride = static_cast<std::size_t>(width);
  made.squared = squared_clearance(solid, stop).cells;
  made.widest_squared = *std::max_element(made.squared.begin(), made.squared.end());
  return made;
}

double GridClearance::at(Vec2 p) const {
  const Vec2 near{std::round(2.0 * p.x), std::round(2.0 * p.y)};
  const std::size_t place = static_cast<std::size_t>(near.y) * stride + static_cast<std::size_t>(near.x);
  const double there = at(place), away = distance(p, 0.5 * near);
  const double outer = there + away + 1e-9, inner = std::max(0.0, there - away - 1e-9);
  double least = outer * outer;
  const int row = static_cast<int>(std::floor(p.y));
  for (int k = 0; apart(p.y, row + k) < outer || apart(p.y, row - k) < outer; ++k) {
    for (const int y : {row + k, row - k}) {
      const double up = apart(p.y, y);
      if (up * up >= least) continue;
      const double skip = up < inner ? std::sqrt(inner * inner - up * up) : 0.0;
      for (const int side : {-1, 1}) least = squared_in_row(*ground, p, y, side, skip, least);
    }
  }
  return std::sqrt(least);
}

double part_exposure(const GridClearance& clearance, Vec2 a, Vec2 b, double at_a, double at_middle,
                     double at_b) {
  const double length = distance(a, b);
  if (at_middle >= far) return length / 6.0 * (1.0 / at_a + 4.0 / at_middle + 1.0 / at_b);
  const double first = clearance.at(0.75 * a + 0.25 * b), last = clearance.at(0.25 * a + 0.75 * b);
  return length / 12.0 * (1.0 / at_a + 4.0 / first + 2.0 / at_middle + 4.0 / last + 1.0 / at_b);
}

double leg_exposure(const GridClearance& clearance, Cell from, Cell to) {
  const int parts = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  const Vec2 start = centre(from), whole = centre(to) - start;
  double sum = 0.0, at_a = clearance.at(start);
  for (int i = 0; i < parts; ++i) {
    const Vec2 a = start + static_cast<double>(i) / parts * whole;
    const Vec2 b = start + static_cast<double>(i + 1) / parts * whole;
    const double at_b = clearance.at(b);
    sum += part_exposure(clearance, a, b, at_a, clearance.at(0.5 * (a + b)), at_b);
    at_a = at_b;
  }
  return sum;
}

bool leg_is_wider(const GridClearance& clearance, Cell from, Cell to, double least) {
  const Vec2 a = centre(from), b = centre(to);
  return wider_between(clearance, a, clearance.at(a), b, clearance.at(b), least);
}

}  // namespace outrider
