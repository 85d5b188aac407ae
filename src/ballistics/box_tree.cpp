#include "outrider/ballistics/box_tree.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr std::uint32_t most_in_leaf = 4;

bool bounded(const Box3& box) { return std::isfinite(norm(box.low)) && std::isfinite(norm(box.high)); }

}  // namespace

BoxTree::BoxTree(const std::vector<Box3>& boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    (bounded(boxes[i]) ? order_ : unbounded_).push_back(i);
  }
  if (!order_.empty()) build(boxes, 0, static_cast<std::uint32_t>(order_.size()));
}

void BoxTree::build(const std::vector<Box3>& boxes, std::uint32_t first, std::uint32_t last) {
  const std::size_t index = nodes_.size();
  Box3 around;
  for (std::uint32_t k = first; k < last; ++k) {
    around.include(boxes[order_[k]].low);
    around.include(boxes[order_[k]].high);
  }
  nodes_.push_back({around, first, last, 0});
  if (last - first <= most_in_leaf) return;
  // Halves by the middles of the boxes, along the longer side on the ground.
  const Vec3 size = around.high - around.low;
  const auto middle = [&](std::uint32_t i) {
    return size.x >= size.y ? boxes[i].low.x + boxes[i].high.x : boxes[i].low.y + boxes[i].high.y;
  };
  std::sort(order_.begin() + first, order_.begin() + last, [&](std::uint32_t a, std::uint32_t b) {
    return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
  });
  const std::uint32_t half = first + (last - first) / 2;
  build(boxes, first, half);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, half, last);
}

}  // namespace outrider
