// The open nodes of Polyanya: least f first, then largest g, then the newest.
//
// The best node may be kept outside the heap, because a node is often followed by its own successor.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider::polyanya_search {

/// A position or a direction, relative to a root.
struct Arrow {
  std::int32_t x = 0, y = 0;
};
/// Returns a value > 0 if b points to the left of a. Exact.
inline std::int64_t turned(Arrow a, Arrow b) { return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x; }

/// The view of a root through a side of a polygon: the cone from `right` to `left`, both included. Without a
/// side, the root has not been expanded yet.
struct MeshNode {
  double g = 0.0;  ///< length to the root
  Cell at;         ///< the root
  Arrow right, left;
  std::uint32_t root = 0;     ///< index in mesh.turns; the last one is the start
  std::uint32_t polygon = 0;  ///< polygon behind the side
  std::uint32_t side = 0;     ///< index of the side in that polygon
};

class Frontier {
 public:
  void begin() {
    nodes_.clear();
    heap_.clear();
    hand_ = {};
    held_ = false;
  }

  void add(const MeshNode& node, double f) {
    const FrontierEntry entry = entry_of(f, node.g);
    nodes_.push_back(node);
    if (!held_) {
      hand_ = entry;
      held_ = true;
    } else if (before(entry, hand_)) {
      push(hand_);
      hand_ = entry;
    } else {
      push(entry);
    }
  }

  /// Removes the first node; returns false if there is none.
  bool pop(MeshNode& node, double& f) {
    if (!held_ && heap_.empty()) return false;
    if (!held_) {
      hand_ = heap_.front();
      drop_top();
    } else if (!heap_.empty() && before(heap_.front(), hand_)) {
      std::swap(hand_, heap_.front());
      sift_down(heap_.front(), heap_.size());
    }
    held_ = false;
    node = nodes_[~static_cast<std::uint32_t>(hand_.rank)];
    f = hand_.f;
    return true;
  }

 private:
  /// rank: largest g, then largest place in nodes_.
  struct FrontierEntry {
    double f = 0.0;
    std::uint64_t rank = 0;
  };
  [[nodiscard]] FrontierEntry entry_of(double f, double g) const {
    const std::uint64_t far = ~std::bit_cast<std::uint32_t>(static_cast<float>(g));  // g >= 0
    return {f, far << 32U | static_cast<std::uint32_t>(~nodes_.size())};
  }
  static bool before(const FrontierEntry& a,
                     const FrontierEntry& b) {  // without a branch, which could not be predicted
    const auto less = static_cast<unsigned>(a.f < b.f), equal = static_cast<unsigned>(a.f == b.f);
    return (less | (equal & static_cast<unsigned>(a.rank < b.rank))) != 0;
  }

  // A heap of four children each.
  void push(const FrontierEntry& entry) {
    std::size_t i = heap_.size();
    heap_.push_back(entry);
    for (; i > 0 && before(entry, heap_[(i - 1) / 4]); i = (i - 1) / 4) heap_[i] = heap_[(i - 1) / 4];
    heap_[i] = entry;
  }
  void drop_top() {
    const FrontierEntry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sift_down(last, heap_.size());
  }
  void sift_down(const FrontierEntry entry, std::size_t count) {
    std::size_t i = 0;
    for (std::size_t child = 1; child < count; child = 4 * i + 1) {
      std::size_t best = child;
      for (std::size_t k = child + 1; k < std::min(child + 4, count); ++k)
        best = before(heap_[k], heap_[best]) ? k : best;
      if (!before(heap_[best], entry)) break;
      heap_[i] = heap_[best];
      i = best;
    }
    heap_[i] = entry;
  }

  std::vector<MeshNode> nodes_;  // in the order of their making
  std::vector<FrontierEntry> heap_;
  FrontierEntry hand_;
  bool held_ = false;
};

}  // namespace outrider::polyanya_search
