// A proven lower bound of length + weight * exposure of all paths that keep a clearance.
//
// Let f(p) = 1 + weight / clearance(p). A function u whose slope is nowhere above f, where such a path may
// go, grows along the path by at most its cost; so u(goal) - u(start) bounds the cost of all of them. Here u
// is bilinear on square cells. In each cell, the clearance is at most the smallest, over edges of the ground
// and over means of two edges, of the largest distance of a corner of the cell, as distances to edges are
// convex; so f is bounded from below, and the slope of u is compared with that bound, cell by cell.
//
// The values of u at the corners come from the fast marching method. Where the slope is too large, the cost
// there is lowered and the march is repeated; what is left of the excess divides the whole of u. So the bound
// holds whatever the march computes. Source: Sethian, A fast marching level set method (1996); that u is the
// dual of the path, Mitchell and Papadimitriou, The weighted region problem (1991).
#pragma once

#include <stop_token>

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// A question for the least cost.
struct ExposureQuestion {
  const PolygonGround& ground;
  Vec2 start;
  Vec2 goal;
  double weight_m = 0.0;
  double least_m = 0.0;       ///< clearance that the paths keep
  std::stop_token stop = {};  ///< after a stop request nothing more is shown
};

/// Returns the bound; 0 if the cells show nothing. `cells` is their number along the longer side of the
/// ground. O(cells^2 (log cells + edges that are nearest to a cell)).
double least_cost_bound(const ExposureQuestion& question, int cells);

}  // namespace outrider
