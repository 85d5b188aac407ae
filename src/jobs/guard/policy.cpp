#include "outrider/jobs/guard/policy.hpp"

#include <algorithm>

#include "outrider/core/options.hpp"

namespace outrider {
namespace {

std::size_t whenever_someone_enters(const ReplanState& state) {
  return state.idle || state.entered > 0 ? state.inside : 0;
}

}  // namespace

const std::vector<ReplanPolicy>& replan_policies() {
  static const std::vector<ReplanPolicy> policies = {
      {"groups", "When idle, plan for the few who have been inside longest; finish that before the next few.",
       "the reference report's groups of k targets, k being arrivals.group",
       [](const ReplanState& state) { return state.idle ? std::min(state.inside, state.group) : 0; }},
      {"when_idle", "When idle, plan for everybody inside; finish that before looking again.",
       "the gated policy of polling systems, Takagi, 1986",
       [](const ReplanState& state) { return state.idle ? state.inside : 0; }},
      {"each_arrival",
       "Plan anew for everybody inside whenever someone enters, at the next waypoint or after the shot.",
       "re-optimization as in Bertsimas and van Ryzin, Operations Research 39(4), 1991",
       whenever_someone_enters, true},
      {"clairvoyant", "Knows from the start who will enter when; for comparison.",
       "what is left of the price of not knowing: Borodin and El-Yaniv, 1998", whenever_someone_enters, true,
       true},
  };
  return policies;
}

Outcome<ReplanPolicy> find_replan_policy(std::string_view name) {
  return find_row(replan_policies(), "policy", name, "arrivals.policy");
}

}  // namespace outrider
