// Plans in PDDL: what loads is judged without harm, and reads back as the same actions.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "research/guard/pddl.hpp"

namespace {

outrider::TemporalProblem small_problem() {
  outrider::SupplyProblem problem;
  problem.table.goals = 2;
  problem.table.services = {{}, {{0, 1.0, 0.2, 0.5}, {1, 2.0, 0.1, 0.5}}, {{1, 1.0, 0.3, 0.5}}, {}};
  problem.table.drives.assign(16, {2.0, 0.0, 1.0});
  problem.lengths_m.assign(16, 1.0);
  problem.water = 1.0;
  problem.charge = 100.0;
  problem.charge_per_second = 1.0;
  problem.stations = {{3, outrider::Store::water, 3.0, 0.5}, {3, outrider::Store::charge, 3.0, 0.5}};
  return *outrider::temporal_problem(problem);
}

}  // namespace

extern "C" int FUZZ_ENTRY(pddl_plan)(const std::uint8_t* data, std::size_t size) {
  static const outrider::TemporalProblem problem = small_problem();
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto plan = outrider::pddl_plan_from_text(input, "plan.txt", problem);
  if (!plan) {
    if (plan.error().sentence.empty() || plan.error().where.empty()) std::abort();
    return 0;
  }
  const auto verdict = outrider::judge(problem, plan->actions, 1e-3);
  if (verdict.broken && *verdict.broken >= plan->actions.size()) std::abort();
  const auto again =
      outrider::pddl_plan_from_text(outrider::pddl_plan(problem, plan->actions), "again.txt", problem);
  if (!again || again->phrases != plan->phrases) std::abort();
  return 0;
}
