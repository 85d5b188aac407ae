#include "outrider/pursuit/catalog.hpp"

#include <string>
#include <utility>

#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/optimal.hpp"

namespace outrider {
namespace {

std::vector<PursuitPlanner>& rows() {
  static std::vector<PursuitPlanner> planners = {
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
       .configure = with_pursuit_options(optimal_pursuit)},
      {.name = "anytime",
       .sentence =
           "The earliest catch at once, then cheaper ones until the budget ends or nothing cheaper is left.",
       .paper = "as for optimal",
       .guarantee = {.complete = true,
                     .optimal = true,
                     .sentence =
                         "complete; never dearer with more budget, and the least cost when none is set"},
       .configure = with_pursuit_options(anytime_pursuit)},
  };
  return planners;
}

}  // namespace

const std::vector<PursuitPlanner>& pursuit_planners() { return rows(); }

void add_pursuit_planner(PursuitPlanner row) { rows().push_back(std::move(row)); }

Outcome<PursuitPlanner> find_pursuit_planner(std::string_view name) {
  return find_row(pursuit_planners(), "planner", name, "planner");
}

}  // namespace outrider
