#include "terrain_refine.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_ahead = 32;
constexpr int most_rounds = 16;

class Refiner {
 public:
  Refiner(const GridMap& ground, const CellCosts* costs, PlanCounters& counters)
      : ground_(ground), costs_(costs), counters_(counters) {}

  std::vector<Cell> drawn_together(const std::vector<Cell>& vertices) {
    std::vector<double> cost(vertices.size(), 0.0);
    std::vector<std::size_t> before(vertices.size(), 0);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      cost[i] = cost[i - 1] + leg_cost(costs_, vertices[i - 1], vertices[i]);
      before[i] = i - 1;
      for (std::size_t k = i - std::min(i, most_ahead); k + 1 < i; ++k) {
        if (cost[k] + least(vertices[k], vertices[i]) >= cost[i]) continue;
        const double direct = cost[k] + leg_cost(costs_, vertices[k], vertices[i]);
        if (!(direct < cost[i]) || !sees(vertices[k], vertices[i])) continue;
        cost[i] = direct;
        before[i] = k;
      }
    }
    std::vector<Cell> kept{vertices.back()};
    for (std::size_t i = vertices.size() - 1; i > 0; i = before[i]) kept.push_back(vertices[before[i]]);
    return {kept.rbegin(), kept.rend()};
  }

  /// Moves each vertex to the neighbouring cell over which the way between its neighbours costs least.
  /// Returns true if one has moved.
  bool shift(std::vector<Cell>& vertices) {
    bool any = false;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
      const Cell from = vertices[i - 1], at = vertices[i], to = vertices[i + 1];
      double best = (leg_cost(costs_, from, at) + leg_cost(costs_, at, to)) * (1.0 - 1e-12);
      for (const Cell move : grid_moves) {
        const Cell other{at.x + move.x, at.y + move.y};
        if (!ground_.place(other) || least(from, other) + least(other, to) >= best) continue;
        const double over = leg_cost(costs_, from, other) + leg_cost(costs_, other, to);
        if (!(over < best) || !sees(from, other) || !sees(other, to)) continue;
        best = over;
        vertices[i] = other;
        any = true;
      }
    }
    return any;
  }

 private:
  /// No leg between the two costs less.
  [[nodiscard]] double least(Cell from, Cell to) const {
    return (costs_ == nullptr ? 1.0 : costs_->least) * std::hypot(from.x - to.x, from.y - to.y);
  }
  bool sees(Cell from, Cell to) {
    ++counters_.line_of_sight_checks;
    return visible(ground_, from, to);
  }

  const GridMap& ground_;
  const CellCosts* costs_;
  PlanCounters& counters_;
};

}  // namespace

double leg_cost(const CellCosts* costs, Cell from, Cell to) {
  return costs == nullptr ? std::hypot(from.x - to.x, from.y - to.y) : cost_of_leg(*costs, from, to);
}

double path_cost(const CellCosts* costs, const std::vector<Cell>& vertices) {
  double cost = 0.0;
  for (std::size_t i = 1; i < vertices.size(); ++i) cost += leg_cost(costs, vertices[i - 1], vertices[i]);
  return cost;
}

std::vector<Cell> refined_path(const GridMap& ground, const CellCosts* costs, std::vector<Cell> vertices,
                               PlanCounters& counters) {
  Refiner refiner(ground, costs, counters);
  for (int round = 0; round < most_rounds; ++round) {
    vertices = refiner.drawn_together(vertices);
    if (!refiner.shift(vertices)) break;
  }
  return refiner.drawn_together(vertices);
}

}  // namespace outrider
