#include "jps_index.hpp"

#include <algorithm>

#include "grid/grid_runs.hpp"
#include "jps_map.hpp"

namespace outrider::jump {
namespace {

constexpr unsigned opposite(unsigned direction) { return (direction + 2) & 3U; }

/// Returns the distance of a cell from that of the next cell on the run; `stops` tells if the run stops
/// there.
std::int16_t longer(bool stops, std::int16_t next) {
  if (stops) return 1;
  return static_cast<std::int16_t>(next > 0 ? next + 1 : next - 1);
}

/// Returns the two straight components of a diagonal move.
constexpr std::array<unsigned, 2> parts_of(unsigned diagonal) {
  return {diagonal == 4 || diagonal == 7 ? east : west, diagonal < 6 ? north : south};
}

/// Returns true if a run that arrives at v by that move ends there.
bool stops_at(const GridMap& ground, const std::vector<Distances>& distances, unsigned move, std::size_t v) {
  if (move < 4) return forced_sides(ground.moves[v], move) != 0;
  const auto [h, up] = parts_of(move);
  return distances[v][h] > 0 || distances[v][up] > 0;
}

/// Computes the distances of one move for all cells, starting at the far end of each run.
void fill(const GridMap& ground, unsigned move, const std::stop_token& stop,
          std::vector<Distances>& distances) {
  const auto visit = [&](std::size_t v, std::size_t next) {
    distances[v][move] = longer(stops_at(ground, distances, move, next), distances[next][move]);
  };
  backwards_along(ground, move, visit, stop);
}

using Vertices = std::vector<std::size_t>;

void sort_once(Vertices& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

/// Returns the vertices whose moves depend on the cells.
Vertices vertices_around(const GridMap& ground, const std::vector<Cell>& cells) {
  Vertices around;
  for (const Cell c : cells) {
    for (int y = c.y - 1; y <= c.y + 1; ++y) {
      for (int x = c.x - 1; x <= c.x + 1; ++x) {
        if (ground.frame.contains({x, y})) around.push_back(ground.index({x, y}));
      }
    }
  }
  sort_once(around);
  return around;
}

/// Corrects the distances of one move. They may be wrong at `causes` and at the vertex before each, and from
/// there backwards as long as values change. Returns the vertices at which a run starts or ceases to lead to
/// a turn.
Vertices walk_back(const GridMap& ground, unsigned move, const Vertices& causes,
                   std::vector<Distances>& distances) {
  Vertices turned;
  const std::ptrdiff_t step = step_of(ground, move);
  const auto correct = [&](std::size_t v) {  // returns true if it was wrong
    const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) + step);
    const bool legal = ((ground.moves[v] >> move) & 1U) != 0;
    const std::int16_t was = distances[v][move];
    const std::int16_t is =
        legal ? longer(stops_at(ground, distances, move, next), distances[next][move]) : std::int16_t{0};
    distances[v][move] = is;
    if ((was > 0) != (is > 0)) turned.push_back(v);
    return was != is;
  };
  for (std::size_t i = 0; i < causes.size(); ++i) {
    std::size_t v = causes[step > 0 ? causes.size() - 1 - i : i];  // the far end of each line first
    correct(v);
    do v = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) - step);
    while (correct(v));
  }
  return turned;
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

std::vector<Distances> distances_of(const GridMap& ground, const std::stop_token& stop) {
  std::vector<Distances> distances(ground.marks.size(), Distances{});
  for (unsigned move = 0; move < 8; ++move) fill(ground, move, stop, distances);
  return distances;
}

void walk_again(std::vector<Distances>& distances, const GridMap& ground, const std::vector<Cell>& changed) {
  const Vertices around = vertices_around(ground, changed);
  std::array<Vertices, 4> turned;
  for (unsigned move = 0; move < 4; ++move) turned[move] = walk_back(ground, move, around, distances);
  for (unsigned move = 4; move < 8; ++move) {
    Vertices causes = around;
    for (const unsigned part : parts_of(move)) {
      causes.insert(causes.end(), turned[part].begin(), turned[part].end());
    }
    sort_once(causes);
    walk_back(ground, move, causes, distances);
  }
}

}  // namespace outrider::jump
