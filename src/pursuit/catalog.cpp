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
      {.name = "optimal",
       .sentence = "The cheapest catch, proven: floods from the robot and the target bound a search over "
                   "ways in time.",
       .paper = "Handler and Zang, A dual algorithm for the constrained shortest path problem, 1980; "
                "Desrochers and "
                "Soumis, A generalized permanent labelling algorithm for the shortest path problem with time "
                "windows, "
                "1988",
       .guarantee = {.complete = true,
                     .optimal = true,
                     .sentence = "complete; the least cost of all catches, or the proof that there is none"},
       .configure = with_options(optimal_pursuit)},
      {.name = "anytime",
       .sentence =
           "The earliest catch at once, then cheaper ones until the budget ends or nothing cheaper is left.",
       .paper = "as for optimal",
       .guarantee = {.complete = true,
                     .optimal = true,
                     .sentence =
                         "complete; never dearer with more budget, and the least cost when none is set"},
       .configure = with_options(anytime_pursuit)},
      {.name = "iterative_a_star",
       .sentence =
           "A* in space towards cells of the target from its last one back, with penalties for being late.",
       .paper = "the method of the reference report (course CMU 16-782), from its description",
       .guarantee = {.complete = false,
                     .optimal = false,
                     .sentence = "none; a catch at one of the seconds that it tries"},
       .configure = with_options(iterative_a_star)},
      {.name = "multi_goal_a_star",
       .sentence = "A* over (cell, second) with every cell of the target in its second as a goal.",
       .paper =
           "Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths, "
           "1968",
       .guarantee = {.complete = false,
                     .optimal = true,
                     .sentence = "the least cost where its states fit in memory; else it gives up"},
       .configure = with_options(multi_goal_a_star)},
      {.name = "lrta_star",
       .sentence = "Follows the target, looking one cell ahead and learning; for comparison.",
       .paper = "Korf, Real-time heuristic search, 1990",
       .guarantee = {.complete = false,
                     .optimal = false,
                     .sentence = "none; it never catches a target that keeps going away"},
       .configure = with_options(lrta_star)},
      {.name = "rtaa_star",
       .sentence = "Follows the target with a small A* each second and learns from it; for comparison.",
       .paper = "Koenig and Likhachev, Real-time adaptive A*, 2006",
       .guarantee = {.complete = false,
                     .optimal = false,
                     .sentence = "none; it never catches a target that keeps going away"},
       .configure = with_options(rtaa_star)},
  };
  return planners;
}

Outcome<PursuitPlanner> find_pursuit_planner(std::string_view name) {
  return find_row(pursuit_planners(), "planner", name, "planner");
}

}  // namespace outrider
