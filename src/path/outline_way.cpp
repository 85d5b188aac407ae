#include "outline_way.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/path/pieces.hpp"
#include "visibility/polygon_ground_check.hpp"

namespace outrider {

OutlineWay::OutlineWay(const PathPiece& piece, double heading_rad, const std::vector<Vec2>& outline,
                       const GridFrame& frame)
    : piece_(piece), heading_rad_(heading_rad), outline_(outline) {
  const double per_m = 1.0 / frame.resolution_m;
  for (Vec2* p : {&piece_.from, &piece_.to, &piece_.centre}) *p = per_m * (*p - frame.origin);
  if (outline_.empty()) outline_ = {Vec2{}};
  for (Vec2& corner : outline_) {
    corner = per_m * corner;
    outer_ = std::max(outer_, norm(corner));
    ways_.push_back(carried(piece_, heading_rad, corner));
    begin_.core.push_back(ways_.back().from);
    const Box2 box = bounds_of(ways_.back());
    bounds_.include(box.low);
    bounds_.include(box.high);
  }
}

bool OutlineWay::may_come_to(Cell cell, double within) const {
  constexpr double half_diagonal = 0.71;
  return distance_to(piece_, Vec2{cell.x + 0.5, cell.y + 0.5}) <= within + half_diagonal + outer_;
}

double OutlineWay::gap(Cell cell) const {
  const Vec2 low{double(cell.x), double(cell.y)}, high = low + Vec2{1.0, 1.0};
  const RoundedPolygon square{{low, {high.x, low.y}, high, {low.x, high.y}}, 0.0};
  const std::vector<Vec2>& begin = begin_.core;
  double least = std::max(0.0, signed_distance(low, begin_));  // the square may lie in the robot
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const Segment side{begin[i], begin[(i + 1) % begin.size()]};
    least = std::min(least, std::max(0.0, signed_distance(side, square)));
    for (std::size_t k = 0; k < 4; ++k)
      least = std::min(least, distance_to(ways_[i], Segment{square.core[k], square.core[(k + 1) % 4]}));
  }
  for (std::size_t i = 0; outline_.size() > 1 && i < outline_.size(); ++i) {
    const Segment side{outline_[i], outline_[(i + 1) % outline_.size()]};
    for (const Vec2 corner : square.core)
      least = std::min(least, distance_to(seen_from(piece_, heading_rad_, corner), side));
  }
  return least;
}

}  // namespace outrider
