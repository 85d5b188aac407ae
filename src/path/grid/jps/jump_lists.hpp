// The jump points next to those that searches have expanded, kept for the next searches on the same ground.
//
// The jump points next to another one do not depend on start or goal, so they are scanned once, when they are
// first asked for. Memory: 44 bytes for each jump point met, and 4 bytes for each that lies next to an
// expanded one.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "jps_map.hpp"
#include "outrider/path/grid/grid_map.hpp"

namespace outrider::jump {

struct JumpPoint {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  Cell cell;
  std::array<std::uint32_t, 4> lists = {none, none, none, none};  ///< by direction of arrival
  std::uint32_t query = 0;                                        ///< the last one that reached it
  std::uint32_t node = 0;                                         ///< its node in that query
  std::uint32_t label = none;  ///< in the dead ends of the ground; none until it is asked for
};

/// A run of diagonal steps and the straight run beside it that begins at the same cell.
struct TurnRuns {
  std::int32_t straight = 0;  ///< free cells ahead
  std::int32_t diagonal = 0;  ///< legal steps
};

/// The successors of a jump point that is reached in a straight direction.
struct JumpList {
  std::int32_t ahead = 0;                  ///< free cells ahead
  std::array<TurnRuns, 2> turns;           ///< to the lower and to the higher side; 0 where none is forced
  std::span<const std::uint32_t> reached;  ///< four times the jump point plus the direction of arrival
};

class JumpLists {
 public:
  /// Forgets all jump points.
  void clear();

  /// Returns the number of a jump point. O(1) expected.
  std::uint32_t number(Cell c);

  JumpPoint& operator[](std::uint32_t point) { return points_[point]; }

  /// Returns what follows a jump point, and scans for it if it is not known. Valid until the next call.
  JumpList next(const Map& map, const GridMap& ground, std::uint32_t point, unsigned direction);

  [[nodiscard]] std::size_t bytes() const {
    return points_.size() * sizeof(JumpPoint) + 4 * (words_.size() + slots_.size());
  }

 private:
  static constexpr std::size_t header = 6;  // words: number of jump points, free cells ahead, four of turns

  [[nodiscard]] std::size_t slot_of(Cell c) const {
    const std::uint64_t key = (static_cast<std::uint64_t>(c.y) << 32U) | static_cast<std::uint64_t>(c.x);
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> 32U) & (slots_.size() - 1);
  }
  void grow();
  std::uint32_t scan(const Map& map, const GridMap& ground, Cell c, unsigned direction);

  std::vector<JumpPoint> points_;
  std::vector<std::uint32_t> words_;  // the lists
  std::vector<std::uint32_t> slots_;  // jump points by cell, open addressing; a power of two
};

}  // namespace outrider::jump
