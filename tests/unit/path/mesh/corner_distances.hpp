// Shortest lengths over the corners of single blocked cells, by lines of sight between all pairs of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/path/grid/line_of_sight.hpp"
#include "support/grid_oracle.hpp"

namespace outrider::mesh_oracle {

/// Lengths on a ground of the model `corners`, without any mesh.
class CornerDistances {
 public:
  CornerDistances(const oracle::Blocked& grid, const GridMap& ground) : ground_(ground) {
    for (int y = 0; y <= grid.frame.height; ++y) {
      for (int x = 0; x <= grid.frame.width; ++x) {
        const int count = oracle::blocked(grid, x, y) + oracle::blocked(grid, x - 1, y) +
                          oracle::blocked(grid, x, y - 1) + oracle::blocked(grid, x - 1, y - 1);
        if (count == 1) corners_.push_back({x, y});
      }
    }
    const std::size_t n = corners_.size();
    lengths_.assign(n * n, infinite);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        if (visible(ground_, corners_[i], corners_[k]))
          lengths_[i * n + k] = straight(corners_[i], corners_[k]);
      }
    }
    for (std::size_t via = 0; via < n; ++via) {
      for (std::size_t i = 0; i < n; ++i) {
        const double before = lengths_[i * n + via];
        for (std::size_t k = 0; before < infinite && k < n; ++k)
          lengths_[i * n + k] = std::min(lengths_[i * n + k], before + lengths_[via * n + k]);
      }
    }
  }

  /// Returns infinity if nothing joins them.
  [[nodiscard]] double between(Cell a, Cell b) const {
    if (a == b) return 0.0;
    if (visible(ground_, a, b)) return straight(a, b);
    const auto from = seen_from(a), to = seen_from(b);
    double least = infinite;
    for (const auto& [i, before] : from) {
      for (const auto& [k, after] : to)
        least = std::min(least, before + lengths_[i * corners_.size() + k] + after);
    }
    return least;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static double straight(Cell a, Cell b) { return std::hypot(b.x - a.x, b.y - a.y); }
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> seen_from(Cell v) const {
    std::vector<std::pair<std::size_t, double>> seen;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (visible(ground_, v, corners_[i])) seen.emplace_back(i, straight(v, corners_[i]));
    }
    return seen;
  }

  const GridMap& ground_;
  std::vector<Cell> corners_;
  std::vector<double> lengths_;
};

/// Corridors of that width that lead everywhere, and some openings more if `loops`.
inline oracle::Blocked maze(Rng& rng, int halls, int width, bool loops) {
  const int pitch = width + 1, side = halls * pitch + 1;
  oracle::Blocked grid(GridFrame{{}, 1.0, side, side});
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) grid[{x, y}] = x % pitch == 0 || y % pitch == 0 ? 1 : 0;
  }
  const auto open = [&](Cell hall, Cell way) {  // the wall between a hall and the next one that way
    for (int i = 1; i <= width; ++i) {
      const Cell low{(hall.x + (way.x > 0 ? 1 : 0)) * pitch, (hall.y + (way.y > 0 ? 1 : 0)) * pitch};
      grid[way.x != 0 ? Cell{low.x, low.y + i} : Cell{low.x + i, low.y}] = 0;
    }
  };
  const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  std::vector<bool> reached(static_cast<std::size_t>(halls * halls), false);
  std::vector<Cell> way{{below(halls), below(halls)}};
  const auto place = [&](Cell c) { return static_cast<std::size_t>(c.y * halls + c.x); };
  const auto inside = [&](Cell c) { return c.x >= 0 && c.y >= 0 && c.x < halls && c.y < halls; };
  reached[place(way.back())] = true;
  while (!way.empty()) {
    std::vector<Cell> next;
    for (unsigned d = 0; d < 4; ++d) {
      const Cell to{way.back().x + grid_moves[d].x, way.back().y + grid_moves[d].y};
      if (inside(to) && !reached[place(to)]) next.push_back(grid_moves[d]);
    }
    if (next.empty()) {
      way.pop_back();
      continue;
    }
    const Cell move = next[rng.below(next.size())];
    open(way.back(), move);
    way.push_back({way.back().x + move.x, way.back().y + move.y});
    reached[place(way.back())] = true;
  }
  for (int i = 0; loops && i < halls; ++i) {
    const Cell hall{below(halls - 1), below(halls - 1)};
    open(hall, grid_moves[rng.below(2)]);
  }
  return grid;
}

}  // namespace outrider::mesh_oracle
