// Flood: how far the blocks of the known ground are from one of them.
//
// Moves go to the eight blocks around, past corners only where both blocks beside are free; a straight move
// costs 5 and a diagonal one 7 (within 8 % of the straight distance), twice that into a block near a wall if
// so wanted.
// Dijkstra's algorithm with one bucket for each length. O(blocks reached); memory is kept between floods.
// Source: Dial, Algorithm 360: shortest-path forest with topological ordering (1969); the masks, Borgefors,
// Distance transformations in digital images (1986).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/jobs/explore/map/traversability_grid.hpp"

namespace outrider {

class Flood {
 public:
  static constexpr std::uint32_t far = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t per_block = 5;

  enum class Walls : std::uint8_t { do_not_matter, are_shunned };

  /// Begins at a block.
  void begin(const Grid<std::uint8_t>& blocks, std::uint32_t from, Walls walls);
  /// Goes on to all blocks nearer than `cost`; false when no others are reached.
  bool advance(const Grid<std::uint8_t>& blocks, std::uint32_t cost);
  /// Floods from a block to all reachable blocks, or until all goals are reached, if there are any.
  void run(const Grid<std::uint8_t>& blocks, std::uint32_t from, Walls walls,
           const std::vector<std::uint32_t>& goals = {});

  /// Nothing is reached.
  void clear(const Grid<std::uint8_t>& blocks);

  /// In fifths of a block; far where it was not reached, or not yet.
  [[nodiscard]] std::uint32_t cost(std::uint32_t block) const { return cost_[block]; }
  /// Returns true if cost() is that of the shortest path.
  [[nodiscard]] bool settled(std::uint32_t block) const { return cost_[block] < next_; }
  /// Blocks reached so far.
  [[nodiscard]] std::size_t reached() const { return touched_.size(); }
  /// The first block on a way from the start to that one which costs no less than `from_start`.
  [[nodiscard]] std::uint32_t towards(const Grid<std::uint8_t>& blocks, std::uint32_t block,
                                      std::uint32_t from_start) const;

 private:
  void reach(std::uint32_t block, std::uint32_t cost);

  std::vector<std::uint32_t> cost_;  // far but for `touched_`
  std::vector<std::uint32_t> touched_;
  std::uint32_t near_factor_ = 1;
  std::uint32_t next_ = 0;  // cost of the bucket that comes next
  std::array<std::vector<std::uint32_t>, 16> buckets_;
};

}  // namespace outrider
