// Guarding a yard: from where targets can be hit, and the tour that serves them.
#include <cmath>
#include <stdexcept>

#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/tour/solve.hpp"
#include "subject.hpp"
#include "support/guard_yard.hpp"
#include "unit/tour/random_tour.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

constexpr double half_side_m = 4.0;

std::vector<double> firing_mapped(int targets, double resolution_m) {
  Rng rng = stream("guard", 0);  // the same yard for all sizes
  const GuardProblem problem =
      testing::random_guard_problem(rng, 8, static_cast<std::size_t>(targets), half_side_m);
  GuardOptions options;
  options.resolution_m = resolution_m;
  const Work work = work_of([&] {
    const auto map = build_firing_map(problem, options, {}, RegionSearch::centres_only);
    if (!map) throw std::runtime_error(map.error().sentence);
  });
  return {work.blocks, work.peak_bytes};
}

/// Two stops a goal, each serving up to four.
TourProblem yard_with(int goals) {
  const auto count = static_cast<std::size_t>(goals);
  return random_yard(count, 2 * count, 4, 25);
}

std::vector<double> toured(int goals, std::int64_t iterations) {
  const TourProblem problem = yard_with(goals);
  TourOptions options;
  options.exact_goals = 0;
  options.gap = 1.0;  // only the search: nothing is proven
  options.iterations = iterations;
  Outcome<Tour> tour;
  const Work work = work_of([&] { tour = solve(problem, options, {}); });
  if (!tour) throw std::runtime_error(tour.error().sentence);
  return {static_cast<double>(tour->iterations), work.blocks, work.peak_bytes};
}

std::vector<double> checked_tour(int goals) {
  const TourProblem problem = yard_with(goals);
  const Work work = work_of([&] { (void)check(problem); });
  return {work.blocks};
}

double cubed(double n) { return n * n * n; }

}  // namespace

std::vector<Subject> guard_subjects() {
  const std::string map = "jobs/guard/yard/firing_map.hpp";
  return {{"build_firing_map",
           "targets",
           map,
           {4, 8, 16, 32, 64},
           {{"blocks", "O(cells * targets)", linear}, {"peak bytes", "O(cells * targets)", linear}},
           [](int targets) { return firing_mapped(targets, 0.1); }},
          {"build_firing_map",
           "cells along the yard",
           map,
           {40, 80, 160, 320},
           {{"blocks", "O(cells * targets)", squared}, {"peak bytes", "O(cells * targets)", squared}},
           [](int side) { return firing_mapped(4, 2.0 * half_side_m / side); }},
          {"solve (tour)",
           "goals",
           "tour/solve.hpp",
           {8, 16, 32, 64},
           {{"iterations", "as many as the options say", constant},
            {"blocks", "polishing, the costliest part, in rounds of O(goals^3)", cubed},
            {"peak bytes", "none is stated; held to the drives between stops", squared}},
           [](int goals) { return toured(goals, 50); }},
          {"check (tour)",
           "goals",
           "tour/problem.hpp",
           {16, 32, 64, 128, 256},
           {{"blocks", "O(stops^2 + services)", squared}},
           checked_tour}};
}

}  // namespace outrider::growth
