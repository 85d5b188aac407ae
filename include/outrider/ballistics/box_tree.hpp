// A tree of boxes: finds those that a query may meet without looking at all of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/geometry/box.hpp"

namespace outrider {

/// Returns the distance from p to the box; 0 inside.
inline double distance(Vec3 p, const Box3& box) {
  return norm(Vec3{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
                   std::max({0.0, box.low.y - p.y, p.y - box.high.y}),
                   std::max({0.0, box.low.z - p.z, p.z - box.high.z})});
}

/// A binary tree over boxes, each node with the box around its part. Boxes without bounds, such as that of a
/// half-space, are met by every query.
class BoxTree {
 public:
  /// O(n log^2 n).
  explicit BoxTree(const std::vector<Box3>& boxes);

  /// Returns the indices, ascending, of the boxes in nodes for which `may_meet(box)` is true: all that meet
  /// the query, and a few neighbours. `may_meet` must be true for a box that contains one for which it is
  /// true.
  template <class MayMeet>
  [[nodiscard]] std::vector<std::uint32_t> near(const MayMeet& may_meet) const {
    std::vector<std::uint32_t> found = unbounded_;
    if (!nodes_.empty()) visit(0, may_meet, found);
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Returns the least `distance_to(index)`, infinite if there are no boxes. The object with an index must
  /// lie in its box. Nodes are left out that are farther away than the least distance so far.
  template <class DistanceTo>
  [[nodiscard]] double least_distance(Vec3 p, const DistanceTo& distance_to) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : unbounded_) least = std::min(least, distance_to(i));
    if (!nodes_.empty()) lower(0, distance(p, nodes_[0].box), p, distance_to, least);
    return least;
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  // of its boxes in `order_`
    std::uint32_t last = 0;
    std::uint32_t right = 0;  // the left child is the next node; 0: a leaf
  };

  void build(const std::vector<Box3>& boxes, std::uint32_t first, std::uint32_t last);

  template <class MayMeet>
  void visit(std::uint32_t index, const MayMeet& may_meet, std::vector<std::uint32_t>& found) const {
    const Node& node = nodes_[index];
    if (!may_meet(node.box)) return;
    if (node.right == 0) {
      found.insert(found.end(), order_.begin() + node.first, order_.begin() + node.last);
      return;
    }
    visit(index + 1, may_meet, found);
    visit(node.right, may_meet, found);
  }

  template <class DistanceTo>
  void lower(std::uint32_t index, double box_m, Vec3 p, const DistanceTo& distance_to, double& least) const {
    constexpr double rounding_m = 1e-9;
    if (box_m > least + rounding_m) return;
    const Node& node = nodes_[index];
    if (node.right == 0) {
      for (std::uint32_t k = node.first; k < node.last; ++k) least = std::min(least, distance_to(order_[k]));
      return;
    }
    const double left_m = distance(p, nodes_[index + 1].box), right_m = distance(p, nodes_[node.right].box);
    if (left_m <= right_m) lower(index + 1, left_m, p, distance_to, least);
    lower(node.right, right_m, p, distance_to, least);
    if (left_m > right_m) lower(index + 1, left_m, p, distance_to, least);
  }

  std::vector<std::uint32_t> unbounded_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace outrider
