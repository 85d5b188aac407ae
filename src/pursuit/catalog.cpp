#include "outrider/pursuit/catalog.hpp"

#include <memory>
#include <string>

#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/iterative_a_star.hpp"
#include "outrider/pursuit/multi_goal_a_star.hpp"
#include "outrider/pursuit/optimal.hpp"
#include "outrider/pursuit/real_time.hpp"

namespace outrider {
namespace {

template <class Options>
using Planner = Outcome<PursuitPlan> (*)(const PursuitProblem&, const Options&, const Budget&, Workspace&);

template <class Options>
std::function<ConfiguredPursuitPlanner()> with_options(Planner<Options> planner) {
  return [planner] {
    const auto options = std::make_shared<Options>();
    return ConfiguredPursuitPlanner{
        describe(*options),
        [planner, options](const PursuitProblem& problem, const Budget& budget, Workspace& workspace) {
          return planner(problem, *options, budget, workspace);
        }};
  };
}

}  // namespace

const std::vector<PursuitPlanner>& pursuit_planners() {
  static const std::vector<PursuitPlanner> planners = {
      {"optimal",
       "The cheapest catch, proven: floods from the robot and the target bound a search over ways in time.",
       "Handler and Zang, A dual algorithm for the constrained shortest path problem, 1980; Desrochers and "
       "Soumis, A generalized permanent labelling algorithm for the shortest path problem with time windows, "
       "1988",
       {true, true, "complete; the least cost of all catches, or the proof that there is none"},
       with_options(optimal_pursuit)},
      {"anytime",
       "The earliest catch at once, then cheaper ones until the budget ends or nothing cheaper is left.",
       "as for optimal",
       {true, true, "complete; never dearer with more budget, and the least cost when none is set"},
       with_options(anytime_pursuit)},
      {"iterative_a_star",
       "A* in space towards cells of the target from its last one back, with penalties for being late.",
       "the method of the reference report (course CMU 16-782), from its description",
       {false, false, "none; a catch at one of the seconds that it tries"},
       with_options(iterative_a_star)},
      {"multi_goal_a_star",
       "A* over (cell, second) with every cell of the target in its second as a goal.",
       "Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths, "
       "1968",
       {false, true, "the least cost where its states fit in memory; else it gives up"},
       with_options(multi_goal_a_star)},
      {"lrta_star",
       "Follows the target, looking one cell ahead and learning; for comparison.",
       "Korf, Real-time heuristic search, 1990",
       {false, false, "none; it never catches a target that keeps going away"},
       with_options(lrta_star)},
      {"rtaa_star",
       "Follows the target with a small A* each second and learns from it; for comparison.",
       "Koenig and Likhachev, Real-time adaptive A*, 2006",
       {false, false, "none; it never catches a target that keeps going away"},
       with_options(rtaa_star)},
  };
  return planners;
}

Outcome<PursuitPlanner> find_pursuit_planner(std::string_view name) {
  return find_row(pursuit_planners(), "planner", name, "planner");
}

}  // namespace outrider
