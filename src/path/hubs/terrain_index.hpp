// Hub labels of all free cells of a grid whose cells have costs: lists of hubs with costs and first moves.
//
// Thread rule: read-only after construction.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "hub_index.hpp"
#include "outrider/path/grid/cell_costs.hpp"
#include "outrider/path/grid/grid_map.hpp"

namespace outrider::hub_labelling {

class TerrainIndex {
 public:
  /// Builds the index; costs null: a metre costs 1. Returns null if it takes more memory or work than
  /// allowed, or if `stop` is requested. O(entries * length of a list).
  static std::unique_ptr<const TerrainIndex> of(const GridMap& ground, const CellCosts* costs,
                                                std::size_t most_bytes, const std::stop_token& stop);

  /// Returns the cells of a cheapest path, move by move; empty if nothing joins the two.
  [[nodiscard]] std::vector<Cell> find(const GridMap& ground, Cell start, Cell goal) const;

  [[nodiscard]] std::size_t memory() const {
    return first_.size() * sizeof(std::size_t) + hubs_.size() * (sizeof(std::uint32_t) + sizeof(double));
  }
  /// Returns the work of building it, in entries visited.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  friend class TerrainLabelling;

  void follow(const GridMap& ground, Cell from, std::uint32_t hub, std::vector<Cell>& way) const;

  std::vector<std::size_t> first_;   // entries of a cell, by index of the map
  std::vector<std::uint32_t> hubs_;  // eight times the rank of the hub, plus the move towards it; ascending
  std::vector<double> costs_;        // to the hub, for cells of side 1
  std::uint64_t work_ = 0;
};

}  // namespace outrider::hub_labelling
