// The tour on finite supplies as a mixed-integer programme, solved with CBC: the second opinion on
// solve_supplied(), by a method that shares no code with it.
//
// Let a vertex be (stop, heading, goal) for a service, or (stop, heading, station, copy) for a fill: at a
// vertex the heading and the gun are known, so that the time t_uv and the charge q_uv of an arc from the end
// of u to the end of v (for a fill: to its beginning) are numbers. The headings at a stop are those with
// which a drive arrives. There are as many copies of a fill as an optimal tour can need: one for each service
// that it can follow, and of those that it follows at other stations, one for each goal. The tour is a path
// from the start s to the end e. With x_uv = 1 for the arcs taken, k_uv the goals served, and w_uv and c_uv
// the water and the charge on leaving u, as parts of the full stores W and C (Gavish and Graves, The
// travelling salesman problem and related problems, 1978: flows in place of big numbers):
//
//   least    sum of t_uv x_uv + sum over fills v of (fixed x_uv + per_unit full (x_uv - level on arrival))
//   with     sum of x into v = sum of x out of v <= 1;  out of s = 1;  into e = 1
//            sum of x into the vertices of a goal = 1
//            k_uv <= goals x_uv;  k out of v - k into v = sum of x into v at services, 0 at fills
//            w_uv <= x_uv;        w out of v = w into v - water_per_shot / W x at services,
//                                 x at fills of water, w into v at fills of charge;  w out of s = 1
//            q_uv / C x_uv <= c_uv <= x_uv;  c out of v = sum of (c_uv - q_uv / C x_uv) at services and fills
//                                 of water, x at fills of charge;  c out of s = 1
//            c out of v >= (charge to the nearest charger) / C x at services
//
// Fit for a handful of goals: vertices are services x headings, arcs their pairs.
#pragma once

#include "outrider/tour/supply/supply.hpp"

namespace outrider {

struct SupplyProgramme {
  SupplyTour tour;  ///< its cost is that of levels(), not the solver's
  std::size_t columns = 0;
  std::size_t rows = 0;
  double objective_s = 0.0;  ///< the solver's
};

/// Returns false where the tests were built without CBC.
bool supply_programme_is_available();

/// The optimum, unless the search ends after `nodes` nodes: then the best tour found, not called proven.
/// Faults: those of check(); no_path when no tour serves every goal; budget_exhausted when none was found in
/// time; bad_input for more than 40,000 columns, or where there is no CBC. Writes nothing.
Outcome<SupplyProgramme> solve_by_programme(const SupplyProblem& problem, std::int64_t nodes = 200'000);

}  // namespace outrider
