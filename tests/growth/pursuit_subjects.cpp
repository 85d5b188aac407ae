// Catching a moving target, as the seconds of its trajectory and the cells of the map grow.
#include <cmath>
#include <stdexcept>

#include "outrider/pursuit/optimal.hpp"
#include "outrider/pursuit/sweep.hpp"
#include "subject.hpp"
#include "support/smooth_pursuit.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

/// A target that rests where nobody comes, and walks about in the last fifth of the time: so no catch is
/// early.
PursuitProblem late_catch(int side, int seconds) {
  return testing::smooth_pursuit({.side = side, .seconds = seconds, .walk = testing::Walk::late});
}

/// Expansions and bytes of a planner.
template <class Planner, class Options>
std::vector<double> pursued(Planner planner, const Options& options, const PursuitProblem& problem) {
  Outcome<PursuitPlan> plan;
  const Work work = work_of([&] {
    Workspace workspace;
    plan = planner(problem, options, {}, workspace);
  });
  if (!plan) throw std::runtime_error(plan.error().sentence);
  return {static_cast<double>(plan->counters.expansions), work.blocks, work.peak_bytes};
}

std::vector<double> swept(const PursuitProblem& problem) {
  const Work work = work_of([&] { (void)sweep(problem, {}).value(); });
  return {work.blocks, work.peak_bytes};
}

}  // namespace

std::vector<Subject> pursuit_subjects() {
  const std::vector<int> seconds{128, 256, 512, 1024, 2048};
  const std::vector<int> sides{16, 32, 64, 128};
  return {{"pursuit sweep",
           "horizon, s",
           "pursuit/sweep.hpp",
           seconds,
           {{"blocks", "O(cells seconds)", linear}, {"peak bytes", "16 bytes per cell", constant}},
           [](int horizon) { return swept(late_catch(32, horizon)); }},
          {"pursuit sweep",
           "map side, cells",
           "pursuit/sweep.hpp",
           sides,
           {{"blocks", "O(cells seconds)", squared}, {"peak bytes", "16 bytes per cell", squared}},
           [](int side) { return swept(late_catch(side, 256)); }},
          {"optimal_pursuit",
           "horizon, s",
           "pursuit/optimal.hpp",
           seconds,
           {{"expansions", "stage 5 O(cells seconds), and the whole hardly longer", linear},
            {"blocks", "the same", linear},
            {"peak bytes", "(cells seconds^3)^(1/4) cells of stage 5",
             [](double horizon) { return std::pow(horizon, 0.75); }}},
           [](int horizon) {
             return pursued(optimal_pursuit, OptimalPursuitOptions{}, late_catch(64, horizon));
           }}};
}

}  // namespace outrider::growth
