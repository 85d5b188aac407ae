#include "outrider/path/clearance/widest.hpp"

#include <algorithm>

#include "clearance_options.hpp"
#include "medial_graph.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider {

std::vector<Option> describe(WidestOptions& options) { return {kept_option(options.kept)}; }

Outcome<Plan> widest(const Problem& problem, const WidestOptions& options, const Budget& budget,
                     Workspace& workspace) {
  if (auto good = check_share(options.kept, "kept"); !good) return pass_on(good);
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  const MedialGraph graph = medial_graph(*ground, problem.start, problem.goal, workspace);
  BudgetMeter meter(budget);
  auto largest = largest_clearance(graph, meter, workspace);
  if (!largest) return pass_on(largest);

  const double kept = options.kept * (*largest * (1.0 - kept_rounding) - graph.rounding_m);
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
