// FrontierMap: where what is known to be free borders on what is unknown, kept as the map grows.
//
// A frontier cell is a free cell with an unknown 4-neighbour; beyond the edge of the map all is unknown.
// Frontiers are the 8-connected groups of frontier cells, cut across their longer side, in halves, while that
// is longer than `longest_m`. After every update they are what a full computation gives; a frontier keeps its
// id as long as it holds more of the cells of its former self than any other does.
//
// Not all that is unknown can be learnt: the inside of walls stays as it is, and noise opens cracks to it.
// Unknown cells beside a frontier that was pursued in vain for long are given up, so that pursuits end.
//
// update(): O(cells changed + cells of the groups that they touch), and no more.
// Sources: Yamauchi, A frontier-based approach for autonomous exploration (1997); Keidar and Kaminka,
// Efficient frontier detection for robot exploration (2014), for doing it incrementally.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/jobs/explore/traversability_grid.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct FrontierOptions {
  KnownGroundOptions ground;
  double longest_m = 1.5;       ///< a longer frontier is cut
  std::int64_t patience = 120;  ///< updates with a pursuit before a cell is given up
};

std::vector<Option> describe(FrontierOptions& options);

struct Frontier {
  std::uint32_t id = 0;
  std::vector<std::uint32_t> cells;  ///< by FrontierMap::frame(), ascending, at least one
  Vec2 centroid;                     ///< of the centres of its cells, m
  Box2 bounds;                       ///< of the same
  std::uint32_t group = 0;           ///< the least id of the frontiers that are connected with it
};

class FrontierMap {
 public:
  FrontierMap(const FrontierOptions& options, double radius_m);

  /// Takes over what changed on the map since the update before. True when much has: the frame, or thousands
  /// of cells.
  bool update(const Grid<std::uint8_t>& occupancy, const MapUpdate& update);

  /// Says that the robot is after a frontier, and near it. Only the first call after an update counts.
  void pursue(std::uint32_t frontier);
  /// True for an unknown cell beside which a frontier was pursued `patience` times.
  [[nodiscard]] bool given_up(std::uint32_t cell) const { return pursuits_[cell] >= options_.patience; }

  [[nodiscard]] const GridFrame& frame() const { return ground_.frame(); }
  [[nodiscard]] TraversabilityGrid& ground() { return ground_; }
  [[nodiscard]] const TraversabilityGrid& ground() const { return ground_; }
  /// By id.
  [[nodiscard]] const std::map<std::uint32_t, Frontier>& frontiers() const { return frontiers_; }
  /// Of what was worked out about this map, for those who decide.
  [[nodiscard]] Workspace& memory() { return memory_; }
  /// Id of the frontier that holds the cell, or 0.
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
