#include "outrider/jobs/explore/choose/catalog.hpp"

#include "choose/strategies.hpp"

namespace outrider {

const std::vector<ExploreStrategy>& explore_strategies() {
  static const std::vector<ExploreStrategy> strategies = {
      {.name = "tour",
       .sentence =
           "The first leg of the fastest round through views that show all frontiers nearby, and home.",
       .paper = "Kulich, Faigl and Preucil, On distance utility in the exploration task, 2011; Held and "
                "Karp, A dynamic "
                "programming approach to sequencing problems, 1962",
       .value_of = "s of the round that begins there",
       .values = round_values},
      {.name = "information_gain",
       .sentence = "The view that is expected to show most for each second of turning and driving.",
       .paper = "Gonzalez-Banos and Latombe, Navigation strategies for exploring indoor environments, 2002; "
                "Burgard, "
                "Moors, Stachniss and Schneider, Coordinated multi-robot exploration, 2005",
       .value_of = "m2/s",
       .most_is_best = true,
       .values = gain_values},
      {.name = "nearest",
       .sentence = "The view that is reached first, where driving near walls counts twice.",
       .paper = "Yamauchi, A frontier-based approach for autonomous exploration, 1997; the flood fill of the "
                "reference "
                "report, from its description",
       .value_of = "s to get there",
       .values = nearness_values},
  };
  return strategies;
}

Outcome<ExploreStrategy> find_explore_strategy(std::string_view name) {
  return find_row(explore_strategies(), "strategy", name, "explore.strategy");
}

}  // namespace outrider
