#include <fmt/format.h>

#include "local_search/construct.hpp"
#include "local_search/improve.hpp"
#include "supply/refuel.hpp"
#include "supply/supply_exact.hpp"

namespace outrider {
namespace {

constexpr double price_of_a_goal_s = 1e5;  // left out

Status check_options(SupplyOptions options) {
  for (const Option& option : describe(options)) {
    const auto value = static_cast<double>(*std::get<std::int64_t*>(option.value));
    if (value >= option.low && value <= option.high) continue;
    return bad_input(
        fmt::format("{} is {}; expected {:g} to {:g}", option.name, value, option.low, option.high));
  }
  return {};
}

/// Returns the best order found, with its stations; nothing if it was stopped before it had one.
std::optional<tour::Refuelled> search(const tour::Supplied& supplied, const SupplyOptions& options,
                                      BudgetMeter& meter, const std::stop_token& stop, SupplyTour& tour) {
  std::optional<tour::Route> route = tour::construct(supplied.instance, stop);
  if (!route) return std::nullopt;
  const auto price = [&](const tour::Route& candidate) {
    const tour::Refuelled refuelled = tour::refuel(supplied, candidate.nodes, {});
    return refuelled.time + price_of_a_goal_s * static_cast<double>(refuelled.dropped.size());
  };
  tour::Improvement better = tour::improve(supplied.instance, std::move(*route), options.seed,
                                           options.iterations, meter, stop, price);
  tour.iterations = better.iterations;
  return tour::refuel(supplied, better.best.nodes, {.labels = 64, .chain = 3});
}

}  // namespace

std::vector<Option> describe(SupplyOptions& options) {
  return {
      {"exact_goals", "", 0, 12, "most goals for which the best tour is found and proven",
       &options.exact_goals},
      {"expansions", "", 0, 1e9, "most labels that the exact search expands", &options.expansions},
      {"iterations", "", 0, 1e9, "rounds of ruin and recreate, at most 10000 for each goal",
       &options.iterations},
      {"seed", "", 0, 9e15, "seed of the search", &options.seed},
  };
}

Outcome<SupplyTour> solve_supplied(const SupplyProblem& problem, const SupplyOptions& options,
                                   const Budget& budget) {
  if (auto ok = check_options(options); !ok) return pass_on(ok);
  if (auto ok = check(problem); !ok) return pass_on(ok);
  auto supplied = tour::compile(problem);
  if (!supplied) return pass_on(supplied);
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  SupplyTour tour;
  if (problem.table.goals == 0) {
    tour.proven_optimal = true;
    return tour;
  }
  std::optional<tour::Refuelled> found = search(*supplied, options, meter, budget.stop, tour);
  if (!found) return meter.refusal();
  tour::Refuelled& best = *found;
  if (supplied->instance.goals <= options.exact_goals && tour::exact_is_possible(*supplied)) {
    const bool whole = best.dropped.empty();
    const tour::SupplyExact exact = tour::search_exactly(
        *supplied, whole ? best.time : tour::infinity, static_cast<std::uint64_t>(options.expansions), meter);
    tour.expansions = exact.expansions;
    if (!exact.choices.empty()) best = {exact.choices, {}, 0.0};
    tour.proven_optimal = exact.finished && best.dropped.empty();
    tour.proven_too_much = exact.finished && !best.dropped.empty();
  }
  tour.steps = tour::steps_of(*supplied, best.choices);
  tour.dropped = std::move(best.dropped);
  const auto after = levels(problem, tour.steps);  // the judge has the last word
  if (!after) return pass_on(after);
  tour.cost_s = after->empty() ? 0.0 : after->back().time_s;
  return tour;
}

}  // namespace outrider
