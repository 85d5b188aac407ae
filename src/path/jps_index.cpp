#include "jps_index.hpp"

#include "jps_map.hpp"

namespace outrider::jump {
namespace {

constexpr unsigned opposite(unsigned direction) { return (direction + 2) & 3U; }

/// From the distance of the next cell on the way, and whether the run stops there.
std::int16_t longer(bool stops, std::int16_t next) {
  if (stops) return 1;
  return static_cast<std::int16_t>(next > 0 ? next + 1 : next - 1);
}

/// Fills the distance of one move for all cells, from the far end of each run on.
template <class Stops>
void fill(const GridGround& ground, unsigned move, std::vector<Distances>& distances, Stops stops) {
  const Cell d = grid_moves[move];
  const int width = ground.frame.width, height = ground.frame.height;
  const std::ptrdiff_t step = d.y * static_cast<std::ptrdiff_t>(ground.stride) + d.x;
  for (int i = 0; i < height; ++i) {
    const int y = d.y > 0 ? height - 1 - i : i;
    for (int j = 0; j < width; ++j) {
      const std::size_t v = ground.index({d.x > 0 ? width - 1 - j : j, y});
      if (((ground.moves[v] >> move) & 1U) == 0) continue;
      const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) + step);
      distances[v][move] = longer(stops(next), distances[next][move]);
    }
  }
}

}  // namespace

unsigned forced_sides(unsigned moves, unsigned direction) {
  unsigned sides = 0;
  for (const unsigned side : {lower, higher}) {
    const unsigned turn = side_of(direction, side), back = opposite(direction);
    const unsigned diagonal = horizontal(turn) ? diagonal_of(turn, back) : diagonal_of(back, turn);
    if (((moves >> turn) & 1U) != 0 && ((moves >> diagonal) & 1U) == 0) sides |= side;
  }
  return sides;
}

std::vector<Distances> distances_of(const GridGround& ground) {
  std::vector<Distances> distances(ground.marks.size(), Distances{});
  for (const unsigned d : {east, north, west, south}) {
    fill(ground, d, distances, [&](std::size_t v) { return forced_sides(ground.moves[v], d) != 0; });
  }
  for (const unsigned h : {east, west}) {
    for (const unsigned v : {north, south}) {
      fill(ground, diagonal_of(h, v), distances,
           [&](std::size_t next) { return distances[next][h] > 0 || distances[next][v] > 0; });
    }
  }
  return distances;
}

}  // namespace outrider::jump
