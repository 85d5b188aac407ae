// FrontierMap: the frontiers between free and unknown cells of a growing map, updated incrementally.
//
// A frontier cell is a free cell with an unknown 4-neighbour; everything beyond the edge of the map is
// unknown. Frontiers are the 8-connected groups of frontier cells. A group longer than `longest_m` is cut in
// halves across its longer side, repeatedly. After every update the frontiers equal those of a full
// computation. A frontier keeps its id as long as it holds more of its former cells than any other frontier
// does.
//
// Not all unknown cells can become known: the inside of walls stays unknown, and noise opens gaps to it.
// Unknown cells beside a frontier that was pursued in vain for `patience` updates are given up, so
// exploration ends.
//
// update() takes O(cells changed + cells of the groups that they touch).
// Sources: Yamauchi, A frontier-based approach for autonomous exploration (1997); Keidar and Kaminka,
// Efficient frontier detection for robot exploration (2014), for the incremental update.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/jobs/explore/map/traversability_grid.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of the map.
struct FrontierOptions {
  KnownGroundOptions ground;    ///< of the traversability grid
  double longest_m = 1.5;       ///< a longer frontier is cut
  std::int64_t patience = 120;  ///< updates with a pursuit after which a cell is given up
};

/// Describes the options by name.
std::vector<Option> describe(FrontierOptions& options);

/// A frontier.
struct Frontier {
  std::uint32_t id = 0;              ///< not 0
  std::vector<std::uint32_t> cells;  ///< indices in FrontierMap::frame(), ascending, at least one
  Vec2 centroid;                     ///< mean of the centres of its cells, m
  Box2 bounds;                       ///< box of the centres of its cells
  std::uint32_t group = 0;           ///< smallest id of the frontiers connected with it
};

/// The map.
class FrontierMap {
 public:
  FrontierMap(const FrontierOptions& options, double radius_m);

  /// Applies the changes of the map since the last update. Returns true if the frame or thousands of cells
  /// changed.
  bool update(const Grid<std::uint8_t>& occupancy, const MapUpdate& update);

  /// Marks that the robot pursues a frontier and is near it. Only the first call after an update counts.
  void pursue(std::uint32_t frontier);
  /// Returns true for an unknown cell beside which a frontier was pursued `patience` times.
  [[nodiscard]] bool given_up(std::uint32_t cell) const { return pursuits_[cell] >= options_.patience; }

  [[nodiscard]] const GridFrame& frame() const { return ground_.frame(); }
  [[nodiscard]] TraversabilityGrid& ground() { return ground_; }
  [[nodiscard]] const TraversabilityGrid& ground() const { return ground_; }
  /// Returns the frontiers by id.
  [[nodiscard]] const std::map<std::uint32_t, Frontier>& frontiers() const { return frontiers_; }
  /// Returns the workspace in which decisions keep results about this map.
  [[nodiscard]] Workspace& memory() { return memory_; }
  /// Returns the id of the frontier that holds the cell, or 0.
  [[nodiscard]] std::uint32_t frontier_of(std::uint32_t cell) const { return owner_[cell]; }

 private:
  void reframe(const GridFrame& before, const TraversabilityGrid::Change& change);
  void sort_anew(const std::set<std::uint32_t>& groups, std::vector<std::uint32_t> cells);
  [[nodiscard]] bool borders(std::uint32_t cell) const;

  FrontierOptions options_;
  TraversabilityGrid ground_;
  std::vector<std::uint32_t> owner_;     // id of the frontier of a cell, 0 without one
  std::vector<std::uint16_t> pursuits_;  // of a cell, while it is unknown
  bool pursued_ = true;                  // since the last update
  std::map<std::uint32_t, Frontier> frontiers_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups_;  // ids of the frontiers, by the least
  std::uint32_t next_id_ = 1;
  Workspace memory_;
};

}  // namespace outrider
