#include "steering_rows.hpp"

#include <limits>

#include "../with_options.hpp"
#include "outrider/path/steering/hybrid_a_star.hpp"
#include "outrider/path/steering/state_lattice.hpp"

namespace outrider {

std::vector<PathPlanner> planners_that_steer() {
  return {
      {.name = "hybrid_a_star",
       .sentence = "For a robot that steers: A* over poses along arcs and straights, ended by Reeds-Shepp or "
                   "Dubins paths.",
       .paper = "Dolgov, Thrun, Montemerlo and Diebel, Path planning for autonomous vehicles in unknown "
                "semi-structured environments, 2010",
       .guarantee = {.complete = false,
                     .among = PathClass::turning_curve,
                     .most_ratio = std::numeric_limits<double>::infinity(),
                     .sentence =
                         "not complete: a cell keeps one pose for each heading; near the cheapest path, "
                         "and states a bound for all paths of the robot",
                     .measure = Measure::manoeuvre},
       .configure = with_options(hybrid_a_star),
       .models = {GridModel::cells},
       .steers = true},
      {.name = "state_lattice",
       .sentence = "For a robot that steers: A* over motions between cell centres, generated from arcs and "
                   "straights.",
       .paper =
           "Pivtoraiko, Knepper and Kelly, Differentially constrained mobile robot motion planning in state "
           "lattices, 2009",
       .guarantee = {.complete = false,
                     .among = PathClass::lattice_curve,
                     .most_ratio = 1.0,
                     .sentence = "complete and cheapest on its lattice; a finer grid finds more",
                     .measure = Measure::manoeuvre},
       .configure = with_options(state_lattice),
       .models = {GridModel::cells},
       .steers = true},
  };
}

}  // namespace outrider
