#include "outrider/pursuit/check.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "outrider/pursuit/sweep.hpp"

namespace outrider {
namespace {

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "plan"); }

Status check_steps(const PursuitPlan& plan, const PursuitProblem& problem) {
  std::uint64_t paid = 0;
  for (std::size_t k = 0; k < plan.path.size(); ++k) {
    const std::size_t second = static_cast<std::size_t>(problem.start_s) + k;
    const Cell c = plan.path[k];
    if (!problem.costs->contains(c)) return refused(fmt::format("at second {} it is off the map", second));
    if (problem.wall(c))
      return refused(fmt::format("at second {} it is in the wall {}", second, cell_text(c)));
    if (k == 0) continue;
    const Cell before = plan.path[k - 1];
    if (std::abs(c.x - before.x) > 1 || std::abs(c.y - before.y) > 1) {
      return refused(fmt::format("before second {} it goes from {} to {}, which are no neighbours", second,
                                 cell_text(before), cell_text(c)));
    }
    paid += (*problem.costs)[before];
    const bool meets = c == problem.target[second], last = k + 1 == plan.path.size();
    if (last && !meets) {
      return refused(fmt::format("at second {}, its last, it has not caught the target", second));
    }
    if (meets && !last)
      return refused(fmt::format("it catches the target at second {}, and goes on", second));
  }
  if (plan.cost != paid)
    return refused(fmt::format("the cost is {}, but its seconds add up to {}", plan.cost, paid));
  return {};
}

}  // namespace

Status check(const PursuitPlan& plan, const PursuitProblem& problem) {
  if (Status good = check(problem); !good) return good;
  if (plan.path.size() < 2) return refused("it has no second that counts");
  if (plan.path.front() != problem.start) return refused("it does not begin with the robot");
  const std::size_t last = static_cast<std::size_t>(problem.start_s) + plan.path.size() - 1;
  if (static_cast<std::size_t>(plan.catch_time_s) != last || last >= problem.target.size()) {
    return refused(fmt::format("the catch is at second {}, but the path ends at {} and the target at {}",
                               plan.catch_time_s, last, problem.last_s()));
  }
  if (Status good = check_steps(plan, problem); !good) return good;
  if (plan.lower_bound > plan.cost) {
    return refused(fmt::format("the lower bound {} is above the cost {}", plan.lower_bound, plan.cost));
  }
  if (plan.earliest_catch_s > plan.catch_time_s) {
    return refused(fmt::format("it catches at second {}, before the earliest catch at {}", plan.catch_time_s,
                               plan.earliest_catch_s));
  }
  return {};
}

Status certify(const PursuitPlan& plan, const PursuitProblem& problem, const Budget& budget) {
  if (Status good = check(plan, problem); !good) return good;
  Outcome<LeastCatch> least = sweep(problem, budget);
  if (!least) return pass_on(least);
  if (plan.lower_bound > least->cost) {
    return refused(
        fmt::format("the lower bound is {}, but there is a catch for {}", plan.lower_bound, least->cost));
  }
  if (plan.earliest_catch_s >= 0 && plan.earliest_catch_s != least->earliest_catch_s) {
    return refused(fmt::format("the earliest catch is at second {}, not at {}", least->earliest_catch_s,
                               plan.earliest_catch_s));
  }
  return {};
}

}  // namespace outrider
