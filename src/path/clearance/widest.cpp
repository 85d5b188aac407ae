#include "outrider/path/clearance/widest.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "medial_graph.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider {
namespace {

constexpr double rounding = 1e-9;

}  // namespace

std::vector<Option> describe(WidestOptions& options) {
  return {{"kept", "", 0.0, 1.0, "share of the largest possible least clearance that the path keeps",
           &options.kept}};
}

Outcome<Plan> widest(const Problem& problem, const WidestOptions& options, const Budget& budget,
                     Workspace& workspace) {
  const bool good_share = options.kept >= 0.0 && options.kept <= 1.0;
  if (!good_share) return bad_input(fmt::format("{} is not valid; expected 0 to 1", options.kept), "kept");
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  const MedialGraph graph = medial_graph(*ground, problem.start, problem.goal, workspace);
  BudgetMeter meter(budget);
  auto largest = largest_clearance(graph, meter, workspace);
  if (!largest) return pass_on(largest);

  const double kept = options.kept * (*largest * (1.0 - rounding) - graph.rounding_m);
  auto wide = PolygonGround::of((*ground)->boundary, (*ground)->obstacles,
                                std::clamp(kept, (*ground)->radius_m, most_polygon_radius_m));
  if (!wide) return pass_on(wide);
  Problem widened = problem;
  widened.polygons = std::make_shared<const PolygonGround>(std::move(*wide));
  Budget left = budget;
  left.expansions -= meter.spent();
  auto plan = visibility_graph_implicit(widened, {}, left, workspace);
  if (plan) plan->counters.expansions += meter.spent();
  return plan;
}

}  // namespace outrider
