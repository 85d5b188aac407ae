// Hub labels of all free cells of a grid whose cells have costs: lists of hubs with costs and first moves.
//
// Thread rule: read-only after construction.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "hub_index.hpp"
#include "index_bytes.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/grid/terrain/cell_costs.hpp"

namespace outrider::hub_labelling {

class TerrainIndex {
 public:
  /// Builds the index; costs null: a metre costs 1. Returns null if it takes more memory or work than
  /// allowed, or if `stop` is requested. O(entries * length of a list).
  static std::unique_ptr<const TerrainIndex> of(const GridMap& ground, const CellCosts* costs,
                                                std::size_t most_bytes, const std::stop_token& stop);

  /// Returns the cells of a cheapest path, move by move; empty if nothing joins the two.
  [[nodiscard]] std::vector<Cell> find(const GridMap& ground, Cell start, Cell goal) const;

  /// Returns the work of building it, in entries visited.
  [[nodiscard]] std::uint64_t work() const { return work_; }

  /// Writes the index, and reads one that refers to the bytes: null if they contradict themselves or the
  /// ground.
  void write(IndexWriter& writer) const;
  static std::unique_ptr<const TerrainIndex> read(IndexReader& reader, const GridMap& ground);

 private:
  friend class TerrainLabelling;

  [[nodiscard]] std::size_t entry_of(std::size_t cell, std::uint32_t hub) const;
  void follow(const GridMap& ground, Cell from, std::uint32_t hub, std::vector<Cell>& way) const;
  [[nodiscard]] bool sound(const GridMap& ground) const;
  [[nodiscard]] bool sound(const GridMap& ground, std::uint32_t cell) const;

  StoredArray<std::uint64_t> first_;  // entries of a cell, by index of the map
  StoredArray<std::uint32_t> hubs_;   // eight times the rank of the hub, plus the move towards it; ascending
  StoredArray<double> costs_;         // to the hub, for cells of side 1
  std::uint64_t work_ = 0;
};

}  // namespace outrider::hub_labelling
