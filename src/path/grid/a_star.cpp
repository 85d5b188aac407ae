#include "outrider/path/grid/a_star.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "octile_search.hpp"

namespace outrider {
namespace {

const std::vector<std::string> heuristics{"octile", "euclidean", "chebyshev"};  // as Heuristic
const std::vector<std::string> tie_rules{"largest_g", "smallest_g"};

}  // namespace

std::vector<Option> describe(AStarOptions& options) {
  return {
      {"weight", "", 1.0, 100.0,
       "weight of the estimate; above 1 the search is faster and the path at most so many times longer",
       &options.weight},
      choice_option("heuristic", "the estimate of the length that is left: octile, euclidean or chebyshev",
                    &options.heuristic, heuristics),
      choice_option("ties", "which of equal estimates comes first: largest_g or smallest_g", &options.ties,
                    tie_rules)};
}

Outcome<Plan> a_star(const Problem& problem, const AStarOptions& options, const Budget& budget,
                     Workspace& workspace) {
  const bool good = options.weight >= 1.0 && options.weight <= 100.0;
  if (!good) {
    return bad_input(fmt::format("{} is not valid; expected a number from 1 to 100", options.weight),
                     "weight");
  }
  const auto heuristic = std::ranges::find(heuristics, options.heuristic);
  if (heuristic == heuristics.end())
    return no_such_row("heuristic", options.heuristic, heuristics, "heuristic");
  const auto rule = std::ranges::find(tie_rules, options.ties);
  if (rule == tie_rules.end()) return no_such_row("rule for ties", options.ties, tie_rules, "ties");
  const Guide guide{options.weight, static_cast<Heuristic>(heuristic - heuristics.begin()),
                    rule != tie_rules.begin()};
  return guide.plain() ? octile_search(problem, options.weight, budget, workspace)
                       : guided_search(problem, guide, budget, workspace);
}

}  // namespace outrider
