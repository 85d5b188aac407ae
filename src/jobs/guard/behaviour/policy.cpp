#include "outrider/jobs/guard/behaviour/policy.hpp"

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
      {.name = "groups",
       .sentence =
           "When idle, plan for the few who have been inside longest; finish that before the next few.",
       .source = "the reference report's groups of k targets, k being arrivals.group",
       .take = [](const ReplanState& state) { return state.idle ? std::min(state.inside, state.group) : 0; }},
      {.name = "when_idle",
       .sentence = "When idle, plan for everybody inside; finish that before looking again.",
       .source = "the gated policy of polling systems, Takagi, 1986",
       .take = [](const ReplanState& state) { return state.idle ? state.inside : 0; }},
      {.name = "each_arrival",
       .sentence =
           "Plan anew for everybody inside whenever someone enters, at the next waypoint or after the shot.",
       .source = "re-optimization as in Bertsimas and van Ryzin, Operations Research 39(4), 1991",
       .take = whenever_someone_enters,
       .interrupts = true},
      {.name = "clairvoyant",
       .sentence = "Knows from the start who will enter when; for comparison.",
       .source = "what is left of the price of not knowing: Borodin and El-Yaniv, 1998",
       .take = whenever_someone_enters,
       .interrupts = true,
       .foresees = true},
  };
  return policies;
}

Outcome<ReplanPolicy> find_replan_policy(std::string_view name) {
  return find_row(replan_policies(), "policy", name, "arrivals.policy");
}

}  // namespace outrider
