#include "outrider/tour/solve.hpp"

#include <fmt/format.h>

#include "exact.hpp"
#include "local_search/construct.hpp"
#include "local_search/improve.hpp"
#include "proof/proof.hpp"

namespace outrider {
namespace {

std::vector<Visit> visits_of(const tour::Instance& instance, const std::vector<std::uint32_t>& nodes) {
  std::vector<Visit> visits;
  for (const std::uint32_t n : nodes) {
    const tour::TourNode& node = instance.nodes[n];
    const std::size_t stop = instance.stop_name[node.stop];
    if (visits.empty() || visits.back().stop != stop) visits.push_back({stop, {}});
    visits.back().goals.push_back(node.goal);
  }
  return visits;
}

tour::Route route_of(const tour::Instance& instance, const std::vector<Visit>& visits) {
  tour::Route route;
  for (const Visit& visit : visits) {
    const auto named = std::ranges::find(instance.stop_name, visit.stop);
    const auto stop = static_cast<std::uint32_t>(named - instance.stop_name.begin());
    for (const std::uint32_t goal : visit.goals) route.nodes.push_back(instance.node(stop, goal));
  }
  tour::refresh(instance, route);
  return route;
}

Status check_options(TourOptions options) {
  for (const Option& option : describe(options)) {
    const double value = std::visit(
        [](const auto* number) {
          if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(*number)>>) {
            return static_cast<double>(*number);
          } else {
            return 0.0;
          }
        },
        option.value);
    if (value >= option.low && value <= option.high) continue;
    return bad_input(
        fmt::format("{} is {}; expected {:g} to {:g}", option.name, value, option.low, option.high));
  }
  return {};
}

/// Replaces the tour by the optimum and proves it, or else sets the bound that the exact search reached.
void solve_exactly(const tour::Instance& instance, const TourOptions& options, BudgetMeter& meter,
                   tour::Route& route, Tour& tour) {
  const tour::Exact exact = tour::search_exactly(instance, route.cost, options, meter);
  if (!exact.nodes.empty()) {
    route.nodes = exact.nodes;
    tour::refresh(instance, route);
  }
  tour.expansions = exact.expansions;
  tour.lower_bound_s = exact.lower_bound;
  tour.proven_optimal = exact.finished;
}

/// Improves the route for some rounds of ruin and recreate, and counts them.
void improve(const tour::Instance& instance, const TourOptions& options, std::int64_t iterations,
             BudgetMeter& meter, const std::stop_token& stop, const TourObserver& found, tour::Route& route,
             Tour& tour) {
  tour::Better better;
  if (found) {
    better = [&](const tour::Route& one) { found(visits_of(instance, one.nodes), one.cost); };
  }
  tour::Improvement improved =
      tour::improve(instance, route, options.seed, iterations, meter, stop, &tour::cost_of, better);
  route = std::move(improved.best);
  tour.iterations += improved.iterations;
}

}  // namespace

std::vector<Option> describe(TourOptions& options) {
  return {
      {"exact_goals", "", 0, 16, "most goals for which the best tour is found and proven",
       &options.exact_goals},
      {"expansions", "", 0, 1e9, "most labels that the exact search expands", &options.expansions},
      {"iterations", "", 0, 1e9,
       "rounds of ruin and recreate, at most 10000 for each goal; an eighth of them before an exact search",
       &options.iterations},
      {"gap", "", 0, 1,
       "part of the tour's time that its lower bound may leave open; 0: prove the best, 1: nothing",
       &options.gap},
      {"operations", "", 0, 1e15, "most drives and visits tried for the lower bound before the exact end",
       &options.operations},
      {"seed", "", 0, 9e15, "seed of the search", &options.seed},
  };
}

namespace {

/// Finds no more than a bound where the tour is as good as asked for.
void prove(const tour::Instance& instance, const TourOptions& options, BudgetMeter& meter, tour::Route& route,
           Tour& tour) {
  const tour::Proof proof = tour::prove(instance, route, options, meter);
  if (!proof.nodes.empty()) {
    route.nodes = proof.nodes;
    tour::refresh(instance, route);
  }
  tour.expansions += proof.labels;
  tour.lower_bound_s = std::max(tour.lower_bound_s, proof.lower_bound);
  tour.proven_optimal = proof.optimal;
}

Outcome<Tour> solve_with(const TourProblem& problem, const std::vector<Visit>* begun,
                         const TourOptions& options, const Budget& budget, const TourObserver& found) {
  if (Status status = check_options(options); !status) return pass_on(status);
  if (Status status = check(problem); !status) return pass_on(status);
  auto instance = tour::compile(problem);
  if (!instance) return pass_on(instance);
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  Tour tour;
  if (problem.goals == 0) {
    tour.proven_optimal = true;
    return tour;
  }
  std::optional<tour::Route> begin =
      begun == nullptr ? tour::construct(*instance, budget.stop) : route_of(*instance, *begun);
  if (!begin) return meter.refusal();
  tour::Route& route = *begin;
  if (instance->goals <= options.exact_goals && tour::exact_is_possible(*instance)) {
    improve(*instance, options, options.iterations / 8, meter, budget.stop, found, route,
            tour);  // enough to prune by
    solve_exactly(*instance, options, meter, route, tour);
  }
  if (!tour.proven_optimal) {
    improve(*instance, options, options.iterations, meter, budget.stop, found, route, tour);
    if (options.gap < 1.0) prove(*instance, options, meter, route, tour);
  }
  tour.visits = visits_of(*instance, route.nodes);
  tour.cost_s = cost(problem, tour.visits);
  if (tour.proven_optimal) tour.lower_bound_s = tour.cost_s;
  tour.lower_bound_s = std::min(tour.lower_bound_s, tour.cost_s);
  tour.ended_early = !meter.spend();
  return tour;
}

}  // namespace

Outcome<Tour> solve(const TourProblem& problem, const TourOptions& options, const Budget& budget,
                    const TourObserver& found) {
  return solve_with(problem, nullptr, options, budget, found);
}

Outcome<Tour> solve_from(const TourProblem& problem, const Tour& begun, const TourOptions& options,
                         const Budget& budget, const TourObserver& found) {
  if (Status status = check(problem, begun); !status) return pass_on(status);
  return solve_with(problem, &begun.visits, options, budget, found);
}

}  // namespace outrider
