// The jump points that a search has reached, numbered in the order of discovery.
//
// They can be found by their cell: a hash table with open addressing, whose size depends on the search
// instead of the grid, so that a short search stays in the nearest cache. Its order does not affect results.
// O(1) expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid/dead_ends/dead_ends.hpp"
#include "grid/octile.hpp"

namespace outrider::jump {

struct JumpNode {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  Cell cell;
  std::uint32_t parent = none;  ///< for the start: itself
  Octile g = {};
  std::uint32_t point = none;  ///< its number in JumpLists, if it is a jump point of those
  double length = 0.0;         ///< value of g
  /// Direction of arrival. If it is a diagonal move, the node is no jump point, but the rest of a diagonal
  /// run of its parent, from `cell` on.
  std::uint8_t direction = 0;
  bool closed = false;
  std::uint32_t label = DeadEnds::none;  ///< of its cell in the dead ends; none until it is asked for

  [[nodiscard]] bool is_rest_of_run() const { return direction > 3; }
};

class Nodes {
 public:
  void clear() {
    nodes_.clear();
    slots_.assign(least_slots, JumpNode::none);
  }
  JumpNode& operator[](std::uint32_t id) { return nodes_[id]; }
  const JumpNode& operator[](std::uint32_t id) const { return nodes_[id]; }

  /// Adds a node that will not be found by its cell.
  std::uint32_t add(const JumpNode& node) {
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  /// Returns the node of a cell; a new one has no parent.
  std::uint32_t find_or_add(Cell c) {
    std::size_t slot = slot_of(c);
    for (; slots_[slot] != JumpNode::none; slot = (slot + 1) & (slots_.size() - 1)) {
      if (nodes_[slots_[slot]].cell == c) return slots_[slot];
    }
    const std::uint32_t id = add({c});
    slots_[slot] = id;
    if (2 * nodes_.size() > slots_.size()) grow();
    return id;
  }

 private:
  static constexpr std::size_t least_slots = 512;

  [[nodiscard]] std::size_t slot_of(Cell c) const {
    const std::uint64_t key = (static_cast<std::uint64_t>(c.y) << 32U) | static_cast<std::uint64_t>(c.x);
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> 32U) & (slots_.size() - 1);
  }
  void grow() {
    slots_.assign(4 * slots_.size(), JumpNode::none);
    for (std::uint32_t id = 0; id < nodes_.size(); ++id) {
      std::size_t slot = slot_of(nodes_[id].cell);
      while (slots_[slot] != JumpNode::none) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = id;
    }
  }

  std::vector<JumpNode> nodes_;
  std::vector<std::uint32_t> slots_;  // a power of two; none where free
};

}  // namespace outrider::jump
