#include "mesh_sweep.hpp"

#include <algorithm>
#include <span>

namespace outrider {
namespace {

using Chain = std::vector<std::uint32_t>;

class Sweep {
 public:
  explicit Sweep(const std::vector<BorderSide>& border) {
    for (const BorderSide& side : border) {
      cut_.corners.push_back(side.from);
      cut_.corners.push_back(side.to);
    }
    std::sort(cut_.corners.begin(), cut_.corners.end(), earlier);
    cut_.corners.erase(std::unique(cut_.corners.begin(), cut_.corners.end()), cut_.corners.end());
    for (const BorderSide& side : border) {
      const std::uint32_t a = name(side.from), b = name(side.to);
      sides_.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(sides_.begin(), sides_.end(), [this](Side s, Side t) {
      return s.low != t.low ? s.low < t.low : turned(at(s.low), at(s.high), at(t.high)) < 0;
    });
  }

  Triangulation run() {
    auto begin = sides_.cbegin();
    for (std::uint32_t v = 0; v < cut_.corners.size(); ++v) {
      auto end = begin;
      while (end != sides_.cend() && end->low == v) ++end;
      pass(v, {begin, end});
      begin = end;
    }
    return std::move(cut_);
  }

 private:
  struct Side {
    std::uint32_t low, high;  ///< corners, in the order in which they are passed
  };
  /// A part of the sweep line inside the region.
  struct Interval {
    Side left, right;
    Chain chain;
  };

  [[nodiscard]] Cell at(std::uint32_t corner) const { return cut_.corners[corner]; }
  [[nodiscard]] std::uint32_t name(Cell corner) const {
    const auto found = std::lower_bound(cut_.corners.begin(), cut_.corners.end(), corner, earlier);
    return static_cast<std::uint32_t>(found - cut_.corners.begin());
  }
  /// Returns a value > 0 if the corner lies to the left of the side, 0 if the side ends there.
  [[nodiscard]] std::int64_t left_of(const Side& side, std::uint32_t v) const {
    return turned(at(side.low), at(side.high), at(v));
  }

  /// Cuts off the triangles that a corner sees from the right end of the chain; the corner becomes the new
  /// end.
  void cut_from_right(Chain& chain, std::uint32_t v) {
    for (; chain.size() >= 2; chain.pop_back()) {
      const std::uint32_t a = chain[chain.size() - 2], b = chain.back();
      if (turned(at(a), at(b), at(v)) <= 0) break;
      cut_.triangles.push_back({a, b, v});
    }
    chain.push_back(v);
  }
  void cut_from_left(Chain& chain, std::uint32_t v) {
    std::size_t k = 0;
    for (; k + 1 < chain.size() && turned(at(v), at(chain[k]), at(chain[k + 1])) > 0; ++k)
      cut_.triangles.push_back({v, chain[k], chain[k + 1]});
    chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(k));
    chain.insert(chain.begin(), v);
  }

  /// Processes a corner: the sides that end there are replaced by those that rise from it, ordered from left
  /// to right.
  void pass(std::uint32_t v, std::span<const Side> rising) {
    const auto first = std::partition_point(intervals_.begin(), intervals_.end(),
                                            [&](const Interval& i) { return left_of(i.right, v) < 0; });
    auto last = first;
    Chain left, right;  // from the next side on the left to the corner, and on to that on the right
    std::vector<Side> sides(rising.begin(), rising.end());
    for (; last != intervals_.end() && left_of(last->left, v) <= 0; ++last) {
      Chain& chain = last->chain;
      const bool from_left = last->left.high == v, from_right = last->right.high == v;
      if (!from_left && !from_right) {  // from the top
        const auto top = std::max_element(chain.begin(), chain.end());
        right.assign(top, chain.end());
        chain.erase(top + 1, chain.end());
      }
      if (!from_left) sides.insert(sides.begin(), last->left);
      if (!from_right) sides.push_back(last->right);
      if (from_left && !from_right) {
        right = std::move(chain);
      } else {
        cut_from_right(chain, v);
        if (!from_left) left = std::move(chain);
      }
      if (!from_right) cut_from_left(right, v);
    }
    replace(first, last, v, sides, std::move(left), std::move(right));
  }

  using Place = std::vector<Interval>::iterator;
  void replace(Place first, Place last, std::uint32_t v, const std::vector<Side>& sides, Chain left,
               Chain right) {
    std::vector<Interval> now;
    for (std::size_t k = 0; k + 1 < sides.size(); k += 2) now.push_back({sides[k], sides[k + 1], {v}});
    if (!left.empty()) now.front().chain = std::move(left);
    if (!right.empty()) {
      Chain& chain = now.back().chain;
      chain.pop_back();  // the corner itself
      chain.insert(chain.end(), right.begin(), right.end());
    }
    const auto kept = std::min(now.size(), static_cast<std::size_t>(last - first));
    const auto rest = now.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto place = intervals_.erase(std::move(now.begin(), rest, first), last);
    intervals_.insert(place, std::make_move_iterator(rest), std::make_move_iterator(now.end()));
  }

  Triangulation cut_;
  std::vector<Side> sides_;          // by lower corner, then from left to right
  std::vector<Interval> intervals_;  // from left to right
};

}  // namespace

Triangulation cut_region(const std::vector<BorderSide>& border) { return Sweep(border).run(); }

}  // namespace outrider
