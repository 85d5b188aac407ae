// PursuitField: a pursuit problem in the memory layout for floods and searches.
//
// Cells are numbered row by row, with a border of one closed cell on each side, so the index of a neighbour
// is one addition away. Seconds count from the start: second 0 is start_s. Construction takes O(cells +
// seconds log).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/pursuit/plan.hpp"

namespace outrider {

using CellIndex = std::uint32_t;

/// All cells from low to high; empty if high is below low.
struct CellBox {
  Cell low{0, 0}, high{-1, -1};

  [[nodiscard]] bool empty() const { return high.x < low.x || high.y < low.y; }
  [[nodiscard]] int width() const { return high.x - low.x + 1; }
  [[nodiscard]] int height() const { return high.y - low.y + 1; }
  [[nodiscard]] std::uint64_t area() const {
    return empty() ? 0 : static_cast<std::uint64_t>(width()) * static_cast<std::uint64_t>(height());
  }
  [[nodiscard]] bool has(Cell c) const {
    return c.x >= low.x && c.y >= low.y && c.x <= high.x && c.y <= high.y;
  }
  [[nodiscard]] CellBox grown(int by) const { return {{low.x - by, low.y - by}, {high.x + by, high.y + by}}; }
};

inline constexpr std::uint64_t unreachable = std::numeric_limits<std::uint64_t>::max();

/// A set of cells with one bit per cell; a run of three neighbours is read at once.
class CellSet {
 public:
  explicit CellSet(std::size_t cells = 0) : bytes_(cells / 8 + 4, 0) {}
  void add(CellIndex i) { bytes_[i / 8] = static_cast<std::uint8_t>(bytes_[i / 8] | (1U << i % 8)); }
  void remove(CellIndex i) { bytes_[i / 8] = static_cast<std::uint8_t>(bytes_[i / 8] & ~(1U << i % 8)); }
  [[nodiscard]] bool has(CellIndex i) const { return (bytes_[i / 8] >> i % 8 & 1U) != 0; }
  /// Returns three bits, for i, i + 1 and i + 2.
  [[nodiscard]] unsigned three(CellIndex i) const {
    const unsigned two = bytes_[i / 8] | static_cast<unsigned>(bytes_[i / 8 + 1]) << 8U;
    return two >> i % 8 & 7U;
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

struct PursuitField {
  explicit PursuitField(const PursuitProblem& problem);

  CellIndex stride = 0;
  CellIndex start = 0;               ///< where the robot is at start_s
  int start_s = 0;                   ///< second from which on its path is open
  int last_s = 0;                    ///< last second of the target, from the start
  std::uint32_t cheapest = 0;        ///< cost of the cheapest free cell
  std::vector<std::uint32_t> costs;  ///< costs of free cells; border and walls are not read
  CellSet free;
  std::vector<CellIndex> target;  ///< at second 0, 1, ... from the start
  CellSet visited;                ///< cells in which the target is in some second from 1 on

  [[nodiscard]] CellIndex index(Cell c) const {
    return static_cast<CellIndex>(c.y + 1) * stride + static_cast<CellIndex>(c.x + 1);
  }
  [[nodiscard]] Cell cell(CellIndex i) const {
    return {static_cast<int>(i % stride) - 1, static_cast<int>(i / stride) - 1};
  }
  [[nodiscard]] std::size_t size() const { return costs.size(); }
  /// Returns the box of the whole map.
  [[nodiscard]] CellBox box() const {
    return {{0, 0}, {static_cast<int>(stride) - 3, static_cast<int>(size() / stride) - 3}};
  }
  /// Returns the first second from `second` on, except 0, in which the target is there; -1 if there is none.
  [[nodiscard]] int next_visit(CellIndex i, int second) const;
  /// Returns the index offsets of the eight steps, in the order of CellSet windows.
  [[nodiscard]] std::array<CellIndex, 8> steps() const {
    return {0U - stride - 1, 0U - stride, 0U - stride + 1, 0U - 1U, 1, stride - 1, stride, stride + 1};
  }

 private:
  struct Visit {
    CellIndex cell;
    int second;
  };
  std::vector<Visit> visits_;  // by cell, then second
};

/// Calls f(neighbour) for the neighbours of i in the set, in the order of their indices.
template <class F>
void for_neighbours(const CellSet& set, CellIndex i, CellIndex stride, F f) {
  for (const CellIndex row : {i - stride, i, i + stride}) {
    const unsigned three = set.three(row - 1);
    if ((three & 1U) != 0) f(row - 1);
    if ((three & 2U) != 0 && row != i) f(row);
    if ((three & 4U) != 0) f(row + 1);
  }
}

}  // namespace outrider
