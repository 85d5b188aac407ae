#include <fmt/format.h>

#include "../../tests/unit/tour/random_tour.hpp"
#include "../../tests/unit/tour/supply/supply_programme.hpp"
#include "outrider/tour/solve.hpp"
#include "peers.hpp"

namespace outrider::bench {
namespace {

constexpr std::size_t problem_count = 8, stop_count = 10, most_served = 4;

double proven_cost(const TourProblem& problem) {
  TourOptions options;
  options.gap = 0.0;
  const auto tour = solve(problem, options, {});
  const bool right = tour && tour->proven_optimal && check(problem, *tour);
  return right ? tour->cost_s : std::numeric_limits<double>::infinity();
}

/// Returns the least cost as proven by CBC, with flows that keep the tour in one piece; one thread, no time
/// limit.
double programmed_cost(const SupplyProblem& problem) {
  const auto programme = solve_by_programme(problem);
  return programme && programme->tour.proven_optimal ? programme->tour.cost_s
                                                     : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<PeerRow> tour_rows() {
  std::vector<PeerRow> rows;
  if (!supply_programme_is_available()) return rows;
  for (const std::size_t goals : {3U, 5U, 7U}) {
    std::vector<SupplyProblem> problems;
    for (std::uint64_t seed = 1; seed <= problem_count; ++seed) {
      SupplyProblem problem;  // without limits
      problem.table = random_yard(goals, stop_count, most_served, seed);
      problem.lengths_m.assign(problem.table.drives.size(), 1.0);
      problems.push_back(std::move(problem));
    }
    const std::string task = fmt::format("best tours, proven, {} goals from {} stops", goals, stop_count);
    rows.push_back(measure(task, "solve()", Whose::ours, problems.size(), 1,
                           [&](std::size_t i) { return proven_cost(problems[i].table); }));
    rows.push_back(measure(task, "CBC", Whose::exact_peer, problems.size(), 1,
                           [&](std::size_t i) { return programmed_cost(problems[i]); }));
  }
  return rows;
}

}  // namespace outrider::bench
