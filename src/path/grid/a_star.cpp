#include "outrider/path/grid/a_star.hpp"

#include <fmt/format.h>

#include "octile_search.hpp"

namespace outrider {

std::vector<Option> describe(AStarOptions& options) {
  return {{"weight", "", 1.0, 100.0,
           "weight of the estimate; above 1 the search is faster and the path at most so many times longer",
           &options.weight}};
}

Outcome<Plan> a_star(const Problem& problem, const AStarOptions& options, const Budget& budget,
                     Workspace& workspace) {
  const bool good = options.weight >= 1.0 && options.weight <= 100.0;
  if (!good) {
    return bad_input(fmt::format("{} is not valid; expected a number from 1 to 100", options.weight),
                     "weight");
  }
  return octile_search(problem, options.weight, budget, workspace);
}

}  // namespace outrider
