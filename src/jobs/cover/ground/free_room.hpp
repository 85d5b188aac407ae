// FreeRoom: which legs and arcs a disk may drive among polygons.
//
// A piece that begins where the disk may stand is free if it keeps the radius from every edge, by exact
// distances to 1e-9 m. Shares no code with the judge of tracks. O(edges near the piece) after a scan of all
// boxes of edges.
#pragma once

#include <span>
#include <vector>

#include "outrider/path/pieces.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider::cover {

class FreeRoom {
 public:
  /// The ground must outlive this object.
  explicit FreeRoom(const PolygonGround& ground);

  [[nodiscard]] bool free(const PathPiece& piece) const;
  [[nodiscard]] bool free(std::span<const PathPiece> pieces) const;
  /// Returns how far the disk can go straight from a free place, at most `most_m`, from below.
  [[nodiscard]] double free_length(Vec2 from, double heading_rad, double most_m) const;
  [[nodiscard]] bool point_free(Vec2 p) const { return ground_.point_free(p); }

 private:
  const PolygonGround& ground_;
  std::vector<Box2> boxes_;  ///< of the edges, grown by the radius
};

}  // namespace outrider::cover
