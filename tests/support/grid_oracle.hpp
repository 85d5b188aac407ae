// A slow second opinion about paths on grids, written from the definitions in grid_map.hpp alone:
// legs against every blocked cell in exact fractions, shortest paths over all pairs of vertices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::oracle {

using Blocked = Grid<std::uint8_t>;

inline bool blocked(const Blocked& grid, int x, int y) { return !grid.contains({x, y}) || grid[{x, y}] != 0; }

struct Fraction {
  std::int64_t over = 0;
  std::int64_t under = 1;  // > 0
  friend bool operator<(Fraction a, Fraction b) { return a.over * b.under < b.over * a.under; }
  friend bool operator<=(Fraction a, Fraction b) { return a.over * b.under <= b.over * a.under; }
};

/// Clips the part of the leg p + t d in [low, high] along one axis; false when the leg stands still
/// there outside of it. Open intervals exclude their ends.
inline bool clip_axis(std::int64_t p, std::int64_t d, std::int64_t low, std::int64_t high, bool open,
                      Fraction& enter, Fraction& leave) {
  if (d == 0) return open ? low < p && p < high : low <= p && p <= high;
  Fraction first{d > 0 ? low - p : p - high, std::abs(d)};
  Fraction second{d > 0 ? high - p : p - low, std::abs(d)};
  if (enter < first) enter = first;
  if (second < leave) leave = second;
  return true;
}

/// Returns true if the leg from (ax, ay) to (bx, by), in half cells, meets the square of cell (x, y).
inline bool meets(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, int x, int y,
                  bool open) {
  Fraction enter{0, 1}, leave{1, 1};
  const std::int64_t low_x = 2 * std::int64_t{x}, low_y = 2 * std::int64_t{y};
  if (!clip_axis(ax, bx - ax, low_x, low_x + 2, open, enter, leave)) return false;
  if (!clip_axis(ay, by - ay, low_y, low_y + 2, open, enter, leave)) return false;
  return open ? enter < leave : enter <= leave;
}

inline bool pinch(const Blocked& grid, Cell v) {
  const bool ne = blocked(grid, v.x, v.y), sw = blocked(grid, v.x - 1, v.y - 1);
  const bool nw = blocked(grid, v.x - 1, v.y), se = blocked(grid, v.x, v.y - 1);
  return (ne && sw && !nw && !se) || (!ne && !sw && nw && se);
}

inline bool place(const Blocked& grid, GridModel model, Cell v) {
  if (model == GridModel::cells) return !blocked(grid, v.x, v.y);
  return !(blocked(grid, v.x, v.y) && blocked(grid, v.x - 1, v.y) && blocked(grid, v.x, v.y - 1) &&
           blocked(grid, v.x - 1, v.y - 1));
}

inline bool legal(const Blocked& grid, GridModel model, Cell a, Cell b) {
  const bool corners = model == GridModel::corners;
  const int add = corners ? 0 : 1;
  for (int y = -1; y <= grid.frame.height; ++y) {
    for (int x = -1; x <= grid.frame.width; ++x) {
      if (blocked(grid, x, y) &&
          meets(2 * a.x + add, 2 * a.y + add, 2 * b.x + add, 2 * b.y + add, x, y, corners)) {
        return false;
      }
    }
  }
  if (!corners) return true;
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  for (int y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y) {
    for (int x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x) {
      const Cell v{x, y};
      if (dx * (y - a.y) != dy * (x - a.x)) continue;  // not on the leg
      if (!(v == a) && !(v == b) && pinch(grid, v)) return false;
      if (dy == 0 && x < std::max(a.x, b.x) && blocked(grid, x, y) && blocked(grid, x, y - 1)) return false;
      if (dx == 0 && y < std::max(a.y, b.y) && blocked(grid, x, y) && blocked(grid, x - 1, y)) return false;
    }
  }
  return true;
}

/// Length of the shortest path in cells, infinite when there is none. Dense Dijkstra; legs between
/// any two vertices, or between neighbours only.
inline double shortest(const Blocked& grid, GridModel model, Cell start, Cell goal, bool any_direction) {
  const int more = model == GridModel::corners ? 1 : 0;
  std::vector<Cell> vertices;
  for (int y = 0; y < grid.frame.height + more; ++y) {
    for (int x = 0; x < grid.frame.width + more; ++x) {
      if (place(grid, model, {x, y})) vertices.push_back({x, y});
    }
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> best(vertices.size(), infinity);
  std::vector<bool> done(vertices.size(), false);
  for (std::size_t i = 0; i < vertices.size(); ++i) best[i] = vertices[i] == start ? 0.0 : infinity;
  for (;;) {
    std::size_t next = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (!done[i] && best[i] < infinity && (next == vertices.size() || best[i] < best[next])) next = i;
    }
    if (next == vertices.size()) return infinity;
    const Cell v = vertices[next];
    if (v == goal) return best[next];
    done[next] = true;
    if (model == GridModel::corners && pinch(grid, v) && !(v == start)) continue;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int dx = vertices[i].x - v.x, dy = vertices[i].y - v.y;
      if (done[i] || (!any_direction && (std::abs(dx) > 1 || std::abs(dy) > 1))) continue;
      const double through = best[next] + std::sqrt(static_cast<double>(dx * dx + dy * dy));
      if (through < best[i] && legal(grid, model, v, vertices[i])) best[i] = through;
    }
  }
}

}  // namespace outrider::oracle
