// A tree of boxes: finds those that a query may meet without looking at all of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "outrider/geometry/box.hpp"

namespace outrider {

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

  std::vector<std::uint32_t> unbounded_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace outrider
