// Costs per metre of the cells of a grid.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::testing {

/// Patches of mud and rock on grass, or noise.
inline Grid<float> random_costs(Rng& rng, const GridFrame& frame) {
  Grid<float> costs(frame, 1.0F);
  if (rng.below(3) == 0) {
    for (float& cost : costs.cells) cost = static_cast<float>(rng.uniform(0.5, 8.0));
    return costs;
  }
  for (int patch = 0; patch < 6; ++patch) {
    const auto cost = static_cast<float>(rng.uniform(0.5, 10.0));
    const Vec2 centre{rng.uniform(0, frame.width), rng.uniform(0, frame.height)};
    const double radius = rng.uniform(1.0, 0.4 * frame.width + 1.0);
    for (std::size_t i = 0; i < costs.cells.size(); ++i) {
      const Cell c = frame.cell(i);
      if (distance(centre, Vec2{c.x + 0.5, c.y + 0.5}) < radius) costs.cells[i] = cost;
    }
  }
  return costs;
}

}  // namespace outrider::testing
