// DriveLattice: from below, how far a disk drives between the cells of a grid, around the obstacles.
//
// Vertices are the centres of cells. A dual square, between four of them, is open when some point of it
// may be free: one of its corners has a clearance of the radius less half the diagonal. So every drive
// stays in the union of the open squares. Moves go along the sides and diagonals of open squares and, as
// the knight of chess, across two of them; they weigh 5, 7 and 11.
//
// Claim: a way of length L from vertex to vertex in that union has a chain of moves of weight at most
// 5 sqrt(1.04) L / spacing. For the shortest way bends at vertices only. Each straight part, by symmetry
// of slope 0 to 1/2 or 1/2 to 1, passes open squares along which it can be exchanged for side moves and
// knight's moves, or knight's moves and diagonals, with the same sum; a knight's move weighs no less than
// 5 dx + dy, and over all directions the weight of a unit vector is at most 5 sqrt(1.04).
//
// Source: Borgefors, Distance transformations in digital images, 1986 (weights 5, 7, 11).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

class DriveLattice {
 public:
  /// A value for each cell, in units of 1 / 5 of a side move; `endless` means never.
  using Field = std::vector<std::uint16_t>;
  static constexpr std::uint16_t endless = 65535;

  /// `clearance_m` has the distance from the centre of each cell to the nearest obstacle, as far as it is
  /// less than the radius.
  DriveLattice(const GridFrame& frame, const std::vector<float>& clearance_m, double radius_m);

  /// No drive of one unit is shorter, m.
  [[nodiscard]] double unit_m() const { return unit_m_; }
  /// Lowers each value until none exceeds another by more than `scale` times the weight of the moves
  /// between them; a value that would not fall below its `ceiling` is left alone and goes no further. The
  /// sums saturate. Dijkstra's algorithm with buckets (Dial, 1969): O(cells + largest value).
  void lower(Field& field, std::uint32_t scale, const Field* ceiling = nullptr) const;

 private:
  static constexpr std::size_t directions = 16;

  std::array<std::ptrdiff_t, directions> step_{};  // to the next cell, by direction
  std::vector<std::uint16_t> moves_;               // by cell: a bit for each direction that is open
  double unit_m_ = 0.0;
};

}  // namespace outrider
