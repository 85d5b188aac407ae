// The open nodes of Polyanya: least f first, then the newest.
//
// The best node may be kept outside the heap, because a node is often followed by its own successor.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "grid/quad_heap.hpp"
#include "mesh/mesh_sight.hpp"

namespace outrider::polyanya_search {

/// The view of a root through a side of a polygon in a cone. Without a side, the root has not been expanded
/// yet.
struct MeshNode {
  double g = 0.0;  ///< length to the root
  Cell at;         ///< the root
  Cone cone;
  std::uint32_t root = 0;     ///< index in mesh.turns; the last one is the start
  std::uint32_t polygon = 0;  ///< polygon behind the side; without a side, the number of the Departure
  std::uint32_t side = 0;     ///< index of the side in that polygon
};

struct FrontierEntry {
  double f = 0.0;
  std::uint32_t node = 0;
};
/// Compares without a branch, because a processor could not predict it.
inline bool before(const FrontierEntry& a, const FrontierEntry& b) {
  const auto less = static_cast<unsigned>(a.f < b.f), equal = static_cast<unsigned>(a.f == b.f);
  return (less | (equal & static_cast<unsigned>(a.node > b.node))) != 0;
}

class Frontier {
 public:
  void begin() {
    nodes_.clear();
    heap_.clear();
    held_ = false;
  }

  void add(const MeshNode& node, double f) {
    FrontierEntry entry{f, static_cast<std::uint32_t>(nodes_.size())};
    nodes_.push_back(node);
    if (held_) {
      if (!before(first_, entry)) std::swap(first_, entry);
    } else if (heap_.empty() || !before(heap_.front(), entry)) {
      first_ = entry;
      held_ = true;
      return;
    }
    heap_.push(entry);
  }

  /// Removes the first node; returns false if there is none.
  bool pop(MeshNode& node, double& f) {
    if (!held_) {
      if (heap_.empty()) return false;
      first_ = heap_.front();
      heap_.pop();
    }
    held_ = false;
    node = nodes_[first_.node];
    f = first_.f;
    return true;
  }

 private:
  std::vector<MeshNode> nodes_;  // in the order of their making
  QuadHeap<FrontierEntry> heap_;
  FrontierEntry first_;
  bool held_ = false;
};

}  // namespace outrider::polyanya_search
