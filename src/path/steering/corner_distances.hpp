// CornerDistances: how far it is to the goal for a point that may move in any direction, found backwards and
// only as far as it is asked for.
//
// The search runs from the goal over the corners of the cells, along the eight moves of the grid model
// `corners`, led by the octile distance to the start; each answer continues it until that corner is settled
// (reverse resumable A*, Silver, Cooperative pathfinding, 2005). The moves of a corner depend on the four
// cells around it alone, so nothing is prepared for a ground.
//
// Two facts make it a judge. The corners that are no pinches hang together exactly as the free cells do
// across their sides: where it finds no way, no curve joins the places. And a leg between two corners has a
// path along the moves through the cells that it crosses, which is at most 1 / cos(22.5 degrees) times as
// long: so lower_bound() holds for every curve. Lengths are in cells. O(1) after the search has come there.
#pragma once

#include <array>
#include <cstdint>
#include <stop_token>

#include "outrider/core/outcome.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/search/labels.hpp"
#include "outrider/search/queue.hpp"

namespace outrider {

class CornerDistances {
 public:
  /// Begins a search. The ground must outlive it, the cells of goal and start must be free; both in cells.
  /// Fault: no_path, which is proven, unless `stop` is requested: then the distances mean nothing.
  Status begin(const GridMap& ground, Vec2 goal, Vec2 start, const std::stop_token& stop);

  /// Returns the length of a path to the goal, at most by 1 / cos(22.5 degrees) and a cell longer than the
  /// shortest one; infinite if nothing leads there. `p` lies in a free cell.
  double at(Vec2 p);
  /// Returns a length that no curve from p to the goal is shorter than.
  double lower_bound(Vec2 p);

 private:
  [[nodiscard]] unsigned moves_of(Cell corner) const;
  [[nodiscard]] State index(Cell corner) const { return static_cast<State>(corner.y * stride_ + corner.x); }
  /// Returns the distance of a corner, running the search until it is known.
  double settled(Cell corner);
  void relax(Cell corner, double distance);

  const GridMap* ground_ = nullptr;
  Vec2 goal_;
  Cell target_;
  Cell goal_cell_;
  int stride_ = 0;
  double goal_offset_ = 0.0;  ///< distance of the goal to the nearest corner at which the search began
  std::stop_token stop_;
  Labels<double> labels_;
  BucketQueue queue_;
};

}  // namespace outrider
