#include "outrider/path/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "grid/terrain/cell_costs_check.hpp"
#include "outrider/core/text.hpp"
#include "outrider/path/pieces.hpp"
#include "outrider/path/safety.hpp"
#include "steering/steering_check.hpp"
#include "visibility/polygon_ground_check.hpp"

namespace outrider {
namespace {

constexpr double relative = 1e-9;
constexpr double quadrature = 0.01;  // relative error of an exposure
constexpr double touching_m = 1e-9;

/// A point in half cells: the cell c covers [2 c, 2 c + 2], so centres and corners are whole numbers.
struct Half {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Half half(Cell v, GridModel model) {
  const int add = model == GridModel::cells ? 1 : 0;
  return {2 * std::int64_t{v.x} + add, 2 * std::int64_t{v.y} + add};
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return q * b == a || (a < 0) == (b < 0) ? q : q - 1;
}

/// Returns true if the closed leg meets the cell: its closed square (cells) or its open square (corners).
bool meets(Half a, Half b, Cell c, GridModel model) {
  const std::int64_t x0 = 2 * std::int64_t{c.x}, y0 = 2 * std::int64_t{c.y};
  const auto [low_x, high_x] = std::minmax({a.x, b.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y});
  const auto side = [&](std::int64_t x, std::int64_t y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  };
  const auto [least, most] =
      std::minmax({side(x0, y0), side(x0 + 2, y0), side(x0, y0 + 2), side(x0 + 2, y0 + 2)});
  if (model == GridModel::cells) {
    return low_x <= x0 + 2 && high_x >= x0 && low_y <= y0 + 2 && high_y >= y0 && least <= 0 && most >= 0;
  }
  return low_x < x0 + 2 && high_x > x0 && low_y < y0 + 2 && high_y > y0 && least < 0 && most > 0;
}

/// Returns true if the leg meets no blocked cell. Visits, row by row, the columns of the leg in that row.
bool clear_of_cells(const GridMap& ground, Half a, Half b) {
  if (a.y > b.y) std::swap(a, b);
  for (std::int64_t row = floor_divide(a.y - 1, 2); row <= floor_divide(b.y, 2); ++row) {
    std::int64_t low_x = std::min(a.x, b.x), high_x = std::max(a.x, b.x);
    if (a.y != b.y) {
      const auto x_at = [&](std::int64_t y) {
        return a.x + floor_divide((b.x - a.x) * (std::clamp(y, a.y, b.y) - a.y), b.y - a.y);
      };
      const auto [first, second] = std::minmax({x_at(2 * row), x_at(2 * row + 2)});
      low_x = first;
      high_x = second + 1;
    }
    for (std::int64_t column = floor_divide(low_x - 1, 2); column <= floor_divide(high_x, 2); ++column) {
      const Cell c{static_cast<int>(column), static_cast<int>(row)};
      if (ground.blocked(c) && meets(a, b, c, ground.model)) return false;
    }
  }
  return true;
}

bool is_pinch(const GridMap& ground, Cell v) {
  const bool ne = ground.blocked({v.x, v.y}), sw = ground.blocked({v.x - 1, v.y - 1});
  const bool nw = ground.blocked({v.x - 1, v.y}), se = ground.blocked({v.x, v.y - 1});
  return ne == sw && nw == se && ne != nw;
}

/// For the model `corners`, returns true if no unit of a leg along a lattice line runs between two blocked
/// cells, and no lattice point strictly between the ends is a pinch.
bool clear_of_borders(const GridMap& ground, Cell a, Cell b) {
  const int count = std::gcd(b.x - a.x, b.y - a.y);
  const Cell step{(b.x - a.x) / count, (b.y - a.y) / count};
  for (int i = 0; i < count; ++i) {
    const Cell v{a.x + i * step.x, a.y + i * step.y};
    const Cell low{std::min(v.x, v.x + step.x), std::min(v.y, v.y + step.y)};
    if (i > 0 && is_pinch(ground, v)) return false;
    if (step.y == 0 && ground.blocked(low) && ground.blocked({low.x, low.y - 1})) return false;
    if (step.x == 0 && ground.blocked(low) && ground.blocked({low.x - 1, low.y})) return false;
  }
  return true;
}

bool legal(const GridMap& ground, Cell a, Cell b) {
  if (!ground.contains(a) || !ground.contains(b) || a == b) return false;
  if (!clear_of_cells(ground, half(a, ground.model), half(b, ground.model))) return false;
  return ground.model == GridModel::cells || clear_of_borders(ground, a, b);
}

/// Returns true if v is a legal vertex of a path. Only the ends may be pinches.
bool stands(const GridMap& ground, Cell v, bool is_end) {
  if (ground.model == GridModel::cells) return !ground.blocked(v);
  const bool touches_free = !ground.blocked({v.x, v.y}) || !ground.blocked({v.x - 1, v.y}) ||
                            !ground.blocked({v.x, v.y - 1}) || !ground.blocked({v.x - 1, v.y - 1});
  return touches_free && (is_end || !is_pinch(ground, v));
}

/// Returns true if v is the vertex of p: p lies within half a cell of it along both axes.
bool stands_for(const GridMap& ground, Cell v, Vec2 p) {
  const Vec2 apart = ground.point(v) - p;
  const double most = ground.frame.resolution_m * (0.5 + 1e-6);
  return std::abs(apart.x) <= most && std::abs(apart.y) <= most;
}

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "plan"); }

struct Turning {
  double sum_rad = 0.0;
  double rounding_rad = 0.0;  ///< error caused by the rounded ends of short pieces
};

/// Sums the turns of the path: in place before the first piece and between pieces, and along arcs.
Turning turning_of(const Plan& plan) {
  std::vector<PathPiece> pieces = plan.pieces;
  for (std::size_t i = 1; plan.pieces.empty() && i < plan.waypoints.size(); ++i) {
    pieces.push_back({plan.waypoints[i - 1], plan.waypoints[i], {}, 0.0});
  }
  Turning turning;
  const auto turn = [&](const PathPiece& before, const PathPiece& after) {
    turning.sum_rad += turn_between(before, after);
    const double size = 1.0 + norm(after.from);
    turning.rounding_rad += 1e-14 * size * (1.0 / length_of(before) + 1.0 / length_of(after));
  };
  if (plan.weights.heading_rad && !pieces.empty()) {
    const Vec2 faced{std::cos(*plan.weights.heading_rad), std::sin(*plan.weights.heading_rad)};
    turn({-1.0 * faced, {}, {}, 0.0}, pieces.front());
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    turning.sum_rad += std::abs(pieces[i].turn_rad);
    if (i > 0) turn(pieces[i - 1], pieces[i]);
  }
  return turning;
}

/// Checks that the exposure counted in the cost is within the error that the planners state.
Status check_exposure(const Plan& plan, const Problem& problem, const std::stop_token& stop) {
  if (plan.weights.per_exposure_m == 0.0) return {};
  const Safety truth = safety_of(plan, problem, stop);
  if (stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while the plan was checked");
  const bool good = plan.exposure >= (1.0 - quadrature) * truth.exposure_low &&
                    plan.exposure <= (1.0 + quadrature) * truth.exposure_high;
  if (good) return {};
  return refused(fmt::format("the exposure is {}, but it lies between {} and {}", short_number(plan.exposure),
                             short_number(truth.exposure_low), short_number(truth.exposure_high)));
}

/// Returns what cusps and metres backwards cost.
double reversing_of(const Plan& plan) {
  double cost = 0.0;
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    const PathPiece& piece = plan.pieces[i];
    if (piece.backward) cost += plan.weights.per_backward_m * length_of(piece);
    if (i > 0 && piece.backward != plan.pieces[i - 1].backward) cost += plan.weights.per_cusp;
  }
  return cost;
}

Status check_numbers(const Plan& plan, const Problem& problem, const std::stop_token& stop) {
  const double length = length_of(plan);
  const Turning turning = plan.weights.per_rad == 0.0 ? Turning{} : turning_of(plan);
  const bool by_cell = plan.weights.by_cell && problem.grid && problem.costs;
  const double metres = by_cell ? weighted_length(plan, *problem.grid, *problem.costs) : length;
  const double sum = plan.weights.per_m * metres + plan.weights.per_rad * turning.sum_rad +
                     plan.weights.per_exposure_m * plan.exposure + reversing_of(plan);
  const double slack = relative * std::max(1.0, sum);
  if (!(std::abs(plan.cost - sum) <= slack + plan.weights.per_rad * turning.rounding_rad)) {
    return refused(
        fmt::format("the cost is {}, but its legs add up to {}", short_number(plan.cost), short_number(sum)));
  }
  const bool good_bound = plan.lower_bound >= 0.0 && plan.lower_bound <= plan.cost + slack;
  if (!good_bound) {
    return refused(fmt::format("the lower bound {} does not lie between 0 and the cost {}",
                               short_number(plan.lower_bound), short_number(plan.cost)));
  }
  if (auto good = check_exposure(plan, problem, stop); !good) return good;
  const double left = distance(plan.waypoints.back(), problem.goal);
  if (!(std::abs(plan.reached_within - left) <= relative * std::max(1.0, length))) {
    return refused(fmt::format("the path ends {} m from the goal, not {} m", short_number(left),
                               short_number(plan.reached_within)));
  }
  return {};
}

}  // namespace

Status check(const Plan& plan, const Problem& problem, const std::stop_token& stop) {
  if (problem.polygons) {
    if (auto good = check_on_polygons(plan, problem); !good) return good;
    return check_numbers(plan, problem, stop);
  }
  if (!problem.grid) return bad_input("the problem has no grid to check the plan on");
  if (!plan.steering && !problem.outline.empty())
    return refused("it is for a disk, and the robot has an outline");
  if (plan.steering) {
    if (auto good = check_steering(plan, problem); !good) return good;
    return check_numbers(plan, problem, stop);
  }
  const GridMap& ground = *problem.grid;
  if (plan.waypoints.empty() || plan.waypoints.size() != plan.vertices.size()) {
    return refused(fmt::format("{} waypoints came with {} vertices; give as many, and at least one",
                               plan.waypoints.size(), plan.vertices.size()));
  }
  for (std::size_t i = 0; i < plan.vertices.size(); ++i) {
    const Cell v = plan.vertices[i];
    const bool is_end = i == 0 || i + 1 == plan.vertices.size();
    if (!ground.contains(v) || !stands(ground, v, is_end)) {
      return refused(
          fmt::format("waypoint {} stands on the vertex ({}, {}), which is not free", i, v.x, v.y));
    }
    if (!(distance(ground.point(v), plan.waypoints[i]) <= relative * ground.frame.resolution_m)) {
      return refused(fmt::format("waypoint {} does not lie on its vertex ({}, {})", i, v.x, v.y));
    }
    if (i > 0 && !legal(ground, plan.vertices[i - 1], v)) {
      return refused(fmt::format("leg {} from ({}, {}) to ({}, {}) is not legal", i, plan.vertices[i - 1].x,
                                 plan.vertices[i - 1].y, v.x, v.y));
    }
  }
  if (!stands_for(ground, plan.vertices.front(), problem.start))
    return refused("it does not begin at the start");
  if (!stands_for(ground, plan.vertices.back(), problem.goal)) return refused("it does not end at the goal");
  return check_numbers(plan, problem, stop);
}

Status check(const Plan& plan, const CollisionMap& ground, double radius_m,
             const std::vector<Vec2>& outline) {
  if (plan.waypoints.empty()) return refused("it has no waypoints");
  const double least_m = clearance_m(plan, ground, outline);
  if (least_m >= radius_m - hulls_error_m(plan, outline) - touching_m) return {};
  return refused(fmt::format("it comes within {} m of an obstacle, nearer than the {} m of the robot",
                             short_number(least_m), short_number(radius_m)));
}

}  // namespace outrider
