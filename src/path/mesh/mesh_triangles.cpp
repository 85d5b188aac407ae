#include "mesh_triangles.hpp"

#include <algorithm>
#include <cstring>

namespace outrider {
namespace {

using Chain = std::vector<std::uint32_t>;

/// Equal runs of free cells in neighbouring rows: x0 to x1, y0 to y1. In the order of y0, then x0.
struct Slab {
  int x0, x1, y0, y1;
};

std::int64_t squared(Cell a, Cell b) {
  const std::int64_t x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y;
}

/// Calls visit(x) for each x from 0 to `last` at which marked(x) is set. `marked` yields eight values at
/// once, in the lowest bits of eight bytes. Most bytes of a row equal their neighbours, so most groups of
/// eight are skipped at once.
template <class Marked, class Visit>
void each_marked(int last, Marked marked, Visit visit) {
  for (int x = 0; x <= last; x += 8) {
    const std::uint64_t eight = marked(x) & 0x0101010101010101U;
    if (eight == 0) continue;
    std::array<std::uint8_t, 8> each{};
    std::memcpy(each.data(), &eight, sizeof eight);
    for (int k = 0; k < 8 && x + k <= last; ++k) {
      if (each[static_cast<std::size_t>(k)] != 0) visit(x + k);
    }
  }
}
/// Returns eight marks, or as many as there are.
std::uint64_t eight_marks(const GridMap& ground, std::size_t from) {
  std::uint64_t eight = 0;
  if (from + sizeof eight <= ground.marks.size()) {
    std::memcpy(&eight, ground.marks.data() + from, sizeof eight);
  } else {
    std::memcpy(&eight, ground.marks.data() + from, ground.marks.size() - from);
  }
  return eight;
}
static_assert(GridMap::blocked_bit == 1, "the lowest bit of a mark");

std::vector<Slab> slabs_of(const GridMap& ground, const std::stop_token& stop) {
  std::vector<Slab> slabs;
  std::vector<std::size_t> below, here;  // slabs that reach the last row and this one
  for (int y = 0; y < ground.frame.height && !stop.stop_requested(); ++y) {
    here.clear();
    std::size_t next = 0;
    int x0 = -1;
    const auto end_or_begin = [&](int x) {
      if (x0 < 0) {
        x0 = x;
        return;
      }
      while (next < below.size() && slabs[below[next]].x0 < x0) ++next;
      if (next < below.size() && slabs[below[next]].x0 == x0 && slabs[below[next]].x1 == x) {
        slabs[below[next]].y1 = y + 1;
        here.push_back(below[next]);
      } else {
        slabs.push_back({x0, x, y, y + 1});
        here.push_back(slabs.size() - 1);
      }
      x0 = -1;
    };
    const std::uint32_t row = ground.index({0, y});
    const auto changes = [&](int x) {  // the borders of the grid are blocked
      const std::size_t at = row + static_cast<std::uint32_t>(x);
      return eight_marks(ground, at) ^ eight_marks(ground, at - 1);
    };
    each_marked(ground.frame.width, changes, end_or_begin);
    std::swap(below, here);
  }
  return slabs;
}

class Cutter {
 public:
  Cutter(const GridMap& ground, const std::stop_token& stop) : stop_(stop), slabs_(slabs_of(ground, stop)) {
    for (int y = 0; y <= ground.frame.height && !stop.stop_requested(); ++y) {
      row_.push_back(static_cast<std::uint32_t>(cut_.corners.size()));
      const std::uint32_t row = ground.index({0, y});
      const auto corners = [&](int x) {  // where the marks differ both along the row and across it
        const std::size_t above = row + static_cast<std::uint32_t>(x), below = above - ground.stride;
        const std::uint64_t ne = eight_marks(ground, above), nw = eight_marks(ground, above - 1);
        const std::uint64_t se = eight_marks(ground, below), sw = eight_marks(ground, below - 1);
        return ((ne ^ nw) | (se ^ sw)) & ((ne ^ se) | (nw ^ sw));
      };
      each_marked(ground.frame.width, corners, [&](int x) { cut_.corners.push_back({x, y}); });
    }
    row_.push_back(static_cast<std::uint32_t>(cut_.corners.size()));
  }

  Triangulation run() {
    for (const Slab& slab : slabs_) {
      if (stop_.stop_requested()) break;
      cut_strip(slab);
      if (at(low(slab).first).x == slab.x0) cut_mountain(slab, true);
      if (at(low(slab).last).x == slab.x1) cut_mountain(slab, false);
    }
    return std::move(cut_);
  }

 private:
  /// Consecutive corners on a line, from the first to the last.
  struct Range {
    std::uint32_t first, last;
  };

  [[nodiscard]] Cell at(std::uint32_t corner) const { return cut_.corners[corner]; }
  [[nodiscard]] Range on_line(int y, int x0, int x1) const {
    const auto begin = cut_.corners.begin() + row_[static_cast<std::size_t>(y)];
    const auto end = cut_.corners.begin() + row_[static_cast<std::size_t>(y) + 1];
    const auto left = [](Cell c, int x) { return c.x < x; };
    const auto first = std::lower_bound(begin, end, x0, left),
               last = std::lower_bound(first, end, x1 + 1, left);
    return {static_cast<std::uint32_t>(first - cut_.corners.begin()),
            static_cast<std::uint32_t>(last - cut_.corners.begin()) - 1};
  }
  [[nodiscard]] Range low(const Slab& s) const { return on_line(s.y0, s.x0, s.x1); }
  [[nodiscard]] Range high(const Slab& s) const { return on_line(s.y1, s.x0, s.x1); }

  void cut_strip(const Slab& slab) {
    auto [b, b_last] = low(slab);
    auto [t, t_last] = high(slab);
    while (b < b_last || t < t_last) {
      const bool below =
          t == t_last || (b < b_last && squared(at(b + 1), at(t)) <= squared(at(b), at(t + 1)));
      cut_.triangles.push_back(below ? std::array{b, b + 1, t} : std::array{b, t + 1, t});
      ++(below ? b : t);
    }
  }

  /// Returns the slab above another one at the same wall.
  [[nodiscard]] const Slab& above(const Slab& s, bool left) const {
    return *std::lower_bound(slabs_.begin(), slabs_.end(), s, [left](const Slab& p, const Slab& of) {
      if (p.y0 != of.y1) return p.y0 < of.y1;
      return left ? p.x0 < of.x0 : p.x1 < of.x1;
    });
  }

  /// Cuts the area between the wall that begins beside the slab and the strips along it.
  void cut_mountain(const Slab& begin, bool left) {
    chain_.assign(1, left ? low(begin).first : low(begin).last);
    for (const Slab* slab = &begin;; slab = &above(*slab, left)) {
      const std::uint32_t next = left ? high(*slab).first : high(*slab).last;
      while (chain_.size() >= 2) {
        const std::uint32_t a = chain_[chain_.size() - 2], b = chain_.back();
        const std::int64_t turn = turned(at(a), at(b), at(next));
        if (left ? turn <= 0 : turn >= 0) break;
        cut_.triangles.push_back(left ? std::array{a, b, next} : std::array{a, next, b});
        chain_.pop_back();
      }
      chain_.push_back(next);
      if (at(next).x == (left ? begin.x0 : begin.x1)) return;
    }
  }

  const std::stop_token& stop_;
  std::vector<Slab> slabs_;
  Triangulation cut_;
  std::vector<std::uint32_t> row_;  // by y: the first corner of the line
  Chain chain_;
};

}  // namespace

Triangulation cut_into_triangles(const GridMap& ground, const std::stop_token& stop) {
  return Cutter(ground, stop).run();
}

}  // namespace outrider
