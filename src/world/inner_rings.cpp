#include "inner_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <queue>
#include <tuple>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

constexpr int bucket_side = 16;  // cells

/// Returns twice the signed area of the triangle; positive if it turns to the left.
std::int64_t turn(Cell a, Cell b, Cell c) {
  const auto x = [](Cell p, Cell q) { return std::int64_t{q.x} - p.x; };
  const auto y = [](Cell p, Cell q) { return std::int64_t{q.y} - p.y; };
  return x(a, b) * y(a, c) - y(a, b) * x(a, c);
}

Vec2 at(Cell cell) { return {static_cast<double>(cell.x), static_cast<double>(cell.y)}; }

class Cutter {
 public:
  Cutter(const std::vector<LatticeRing>& rings, double tolerance) : tolerance_(tolerance) {
    for (const LatticeRing& ring : rings) {
      const std::size_t first = corners_.size();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        corners_.push_back({ring[i], first + (i + ring.size() - 1) % ring.size(),
                            first + (i + 1) % ring.size(), first + (i + 1) % ring.size(), rings_.size()});
        buckets_[bucket_of(ring[i])].push_back(corners_.size() - 1);
      }
      rings_.push_back({first, ring.size()});
    }
  }

  void cut_all() {
    while (cut_once()) {
    }
  }

  [[nodiscard]] std::vector<LatticeRing> rings() const {
    std::vector<LatticeRing> left;
    for (const Ring& ring : rings_) {
      LatticeRing cells;
      std::size_t corner = ring.some;
      do {
        cells.push_back(corners_[corner].cell);
        corner = corners_[corner].next;
      } while (corner != ring.some);
      left.push_back(std::move(cells));
    }
    return left;
  }

 private:
  struct Corner {
    Cell cell;
    std::size_t previous = 0, next = 0;  ///< of those that are left
    std::size_t next_at_first = 0;
    std::size_t ring = 0;
    bool cut = false;
    int version = 0;  ///< counts changes of its neighbours
  };
  struct Ring {
    std::size_t some = 0;  ///< a corner that is left
    std::size_t corners = 0;
  };
  struct Candidate {
    double error = 0.0;
    std::size_t corner = 0;
    int version = 0;
    bool operator>(const Candidate& other) const {
      return std::tie(error, corner) > std::tie(other.error, other.corner);
    }
  };
  using Queue = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

  static Cell bucket_of(Cell cell) { return {cell.x / bucket_side, cell.y / bucket_side}; }

  struct ByRow {
    bool operator()(Cell a, Cell b) const { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }
  };

  /// Returns how far the corners that the new edge replaces lie from it, in cells.
  [[nodiscard]] double error_without(const Corner& corner) const {
    const Segment edge{at(corners_[corner.previous].cell), at(corners_[corner.next].cell)};
    double most = 0.0;
    std::size_t replaced = corners_[corner.previous].next_at_first;
    for (; replaced != corner.next && most <= tolerance_; replaced = corners_[replaced].next_at_first)
      most = std::max(most, distance(at(corners_[replaced].cell), edge));
    return most;
  }

  void consider(std::size_t index, Queue& queue) const {
    const Corner& corner = corners_[index];
    if (turn(corners_[corner.previous].cell, corner.cell, corners_[corner.next].cell) < 0) return;
    const double error = error_without(corner);
    if (error <= tolerance_) queue.push({error, index, corner.version});
  }

  /// Returns true if no other corner lies in or on the triangle that would be cut off.
  [[nodiscard]] bool triangle_empty(const Corner& corner) const {
    const Cell a = corners_[corner.previous].cell, b = corner.cell, c = corners_[corner.next].cell;
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const Cell low = bucket_of({low_x, low_y}), high = bucket_of({high_x, high_y});
    for (int y = low.y; y <= high.y; ++y) {
      const auto end = buckets_.upper_bound({high.x, y});
      for (auto bucket = buckets_.lower_bound({low.x, y}); bucket != end; ++bucket) {
        for (const std::size_t other : bucket->second) {
          const Cell p = corners_[other].cell;
          if (p == a || p == b || p == c) continue;
          if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 && p.x >= low_x &&
              p.x <= high_x && p.y >= low_y && p.y <= high_y)
            return false;
        }
      }
    }
    return true;
  }

  void cut(std::size_t index) {
    Corner& corner = corners_[index];
    corner.cut = true;
    corners_[corner.previous].next = corner.next;
    corners_[corner.next].previous = corner.previous;
    ++corners_[corner.previous].version;
    ++corners_[corner.next].version;
    rings_[corner.ring].some = corner.next;
    --rings_[corner.ring].corners;
    std::erase(buckets_[bucket_of(corner.cell)], index);
  }

  /// Cuts what can be cut; what another corner stood in the way of may be cut the next time.
  bool cut_once() {
    Queue queue;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (!corners_[i].cut) consider(i, queue);
    }
    bool any = false;
    for (; !queue.empty(); queue.pop()) {
      const Candidate best = queue.top();
      const Corner& corner = corners_[best.corner];
      if (corner.cut || corner.version != best.version) continue;
      if (rings_[corner.ring].corners <= 3 || !triangle_empty(corner)) continue;
      cut(best.corner);
      consider(corner.previous, queue);
      consider(corner.next, queue);
      any = true;
    }
    return any;
  }

  double tolerance_;
  std::vector<Corner> corners_;
  std::vector<Ring> rings_;
  std::map<Cell, std::vector<std::size_t>, ByRow> buckets_;
};

}  // namespace

std::vector<LatticeRing> cut_corners(const std::vector<LatticeRing>& rings, double tolerance) {
  Cutter cutter(rings, tolerance);
  cutter.cut_all();
  return cutter.rings();
}

}  // namespace outrider
