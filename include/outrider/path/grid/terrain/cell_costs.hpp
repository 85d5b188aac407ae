// CellCosts: what a metre costs in each cell of a grid, such as mud, gravel, slopes, or closeness to people.
//
// The cost of a path is the integral of the cost per metre along it. So a straight move costs the mean of its
// two cells times its length, and so does a diagonal move, which passes from one cell into the other at
// their common corner. A leg in any direction costs, for each cell, its length in the cell times the cost per
// metre there. Legs run between centres of cells (the model `cells`), so none runs along a border.
// Thread rule: read-only after construction.
#pragma once

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Least and largest accepted cost per metre.
inline constexpr float least_cost_per_m = 1e-3F;
inline constexpr float most_cost_per_m = 1e6F;

/// Costs as described above.
struct CellCosts {
  Grid<float> per_m;   ///< cost per metre of each cell
  double least = 1.0;  ///< least of them

  /// Takes the costs of a grid. Fault: bad_input for a number of costs that does not match the frame, or a
  /// cost outside of the accepted range, with its cell. O(cells).
  static Outcome<CellCosts> of(Grid<float> per_m);
};

/// Returns the cost of the straight leg between the centres of two cells of the grid, for cells of side 1.
/// Exact but for rounding. O(|dx| + |dy|).
double cost_of_leg(const CellCosts& costs, Cell from, Cell to);

}  // namespace outrider
