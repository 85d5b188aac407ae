#include "cell_costs_check.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Adds the shares of a leg at which one coordinate is a whole number.
void add_cuts(double from, double to, std::vector<double>& cuts) {
  if (from == to) return;
  const auto last = static_cast<int>(std::floor(std::max(from, to)));
  for (auto line = static_cast<int>(std::ceil(std::min(from, to))); line <= last; ++line) {
    cuts.push_back((line - from) / (to - from));
  }
}

}  // namespace

double weighted_length(const Plan& plan, const GridMap& ground, const CellCosts& costs) {
  double sum = 0.0;
  for (std::size_t i = 1; i < plan.vertices.size(); ++i) {
    const Cell a = plan.vertices[i - 1], b = plan.vertices[i];
    const Vec2 from{a.x + 0.5, a.y + 0.5}, to{b.x + 0.5, b.y + 0.5};
    std::vector<double> cuts{0.0, 1.0};
    add_cuts(from.x, to.x, cuts);
    add_cuts(from.y, to.y, cuts);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const Vec2 middle = from + 0.5 * (cuts[k - 1] + cuts[k]) * (to - from);
      const Cell cell{static_cast<int>(std::floor(middle.x)), static_cast<int>(std::floor(middle.y))};
      if (ground.frame.contains(cell))
        sum += (cuts[k] - cuts[k - 1]) * distance(from, to) * double{costs.per_m[cell]};
    }
  }
  return ground.frame.resolution_m * sum;
}

}  // namespace outrider
