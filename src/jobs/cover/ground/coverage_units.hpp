// Jobs: the laps and cells of a track, each with the ways to drive it, and their order as a tour.
#pragma once

#include "ground/sweep_cells.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/search/workspace.hpp"
#include "strokes/laps.hpp"

namespace outrider::cover {

/// Shortest ways of the disk between points, with memory for the next ones. A way between two points of one
/// part of the standing room stays in its field; others use the ground of the whole track.
class TransitPlanner {
 public:
  TransitPlanner(const CoverageArea& area, const Budget& budget);

  /// Pieces from one point to the other; none where they are the same.
  Outcome<std::vector<PathPiece>> way(Vec2 from, Vec2 to);
  /// Returns the paths to all of them.
  Outcome<std::vector<std::vector<PathPiece>>> ways(Vec2 from, const std::vector<Vec2>& to);
  /// Returns true if a path between these points leaves its part.
  [[nodiscard]] bool transfers(Vec2 from, Vec2 to) const;

 private:
  /// A part of the standing room and where moves within it stay.
  struct Part {
    RingedPolygon room;
    std::shared_ptr<const PolygonGround> ground;
  };
  [[nodiscard]] std::size_t part_of(Vec2 p) const;

  std::vector<Part> parts_;
  double near_m_;  ///< from a part, of points that belong to it
  std::shared_ptr<const PolygonGround> ground_;
  Budget budget_;
  Workspace workspace_;
};

/// One way to do a unit: at least one piece.
struct Traversal {
  std::vector<PathPiece> pieces;
  std::vector<PieceRole> roles;

  [[nodiscard]] Vec2 entry() const { return pieces.front().from; }
  [[nodiscard]] Vec2 exit() const { return pieces.back().to; }
};
using CoverageUnit = std::vector<Traversal>;

/// The lap from each of up to `places` of its corners, in both directions.
CoverageUnit lap_unit(const Lap& lap, std::size_t places);

/// Back and forth over the lanes, from either end of the first and of the last.
Outcome<CoverageUnit> cell_unit(const SweepCell& cell, TransitPlanner& transit);

struct OrderedUnits {
  CoverTrack track;
  std::vector<PieceRole> roles;
  std::vector<std::size_t> begins;  ///< the first piece of each unit
  double bound_s = 0.0;
};

/// Refuses so many ways to begin laps and lanes that no tour takes them, before tables of them are made.
Status check_ways(std::size_t ways);

/// All units, one after another, in the order and the variants that take the least time; begun at the start,
/// or without one where the first begins.
Outcome<OrderedUnits> ordered(const std::vector<CoverageUnit>& units, const std::optional<Pose2>& start,
                              const Pace& pace, const TourOptions& options, const Budget& budget,
                              TransitPlanner& transit);

}  // namespace outrider::cover
