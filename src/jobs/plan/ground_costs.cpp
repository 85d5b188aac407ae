#include "ground_costs.hpp"

#include "outrider/geometry/vec.hpp"

namespace outrider {

Outcome<std::shared_ptr<const CellCosts>> ground_costs(const PlanCostOptions& options, const GridFrame& frame,
                                                       double yaw_rad) {
  if (!options.any()) return std::shared_ptr<const CellCosts>();
  Outcome<Grid<float>> costs = Grid<float>(frame, 1.0F);
  if (options.map) costs = costs_of(*options.map, frame, yaw_rad);
  if (!costs) return pass_on(costs);
  for (std::size_t i = 0; options.terrain && i < costs->cells.size(); ++i) {
    const Vec2 p = frame.origin + rotated(yaw_rad, frame.centre(frame.cell(i)) - frame.origin);
    costs->cells[i] += static_cast<float>(options.per_slope * norm(options.terrain->gradient(p)));
  }
  auto made = CellCosts::of(std::move(*costs));
  if (!made) return bad_input(made.error().sentence, options.map ? options.map->name : "slope_cost");
  return std::make_shared<const CellCosts>(std::move(*made));
}

}  // namespace outrider
