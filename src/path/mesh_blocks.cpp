#include "mesh_blocks.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr std::uint32_t none = NavigationMesh::none;

/// Depth-first search without recursion. A block is closed when the search returns over the side by
/// which it came in; its sides lie on a stack of their own until then.
class BlockSearch {
 public:
  explicit BlockSearch(NavigationMesh& mesh)
      : mesh_(mesh), order_(mesh.polygons(), none), low_(order_.size()), next_(mesh.first) {}

  void search(std::uint32_t root, std::uint32_t part) {
    enter(root, none, part);
    while (!way_.empty()) {
      const Step here = way_.back();
      std::uint32_t& next = next_[here.polygon];
      if (next < mesh_.first[here.polygon + 1]) {
        follow(here, next++, part);
      } else {
        way_.pop_back();
        if (!way_.empty()) leave(way_.back().polygon, here);
      }
    }
  }
  [[nodiscard]] bool reached(std::uint32_t polygon) const { return order_[polygon] != none; }
  /// The polygons in the order in which they were reached.
  [[nodiscard]] const std::vector<std::uint32_t>& reached() const { return reached_; }

 private:
  struct Step {
    std::uint32_t polygon;
    std::uint32_t from;       // the polygon before it
    std::size_t open_before;  // sides that were open when it was entered
  };

  void enter(std::uint32_t polygon, std::uint32_t from, std::uint32_t part) {
    order_[polygon] = low_[polygon] = static_cast<std::uint32_t>(reached_.size());
    reached_.push_back(polygon);
    mesh_.part[polygon] = part;
    way_.push_back({polygon, from, open_.size()});
  }

  void follow(const Step& here, std::uint32_t side, std::uint32_t part) {
    const std::uint32_t to = mesh_.sides[side].polygon;
    if (to == none || to == here.from) return;
    if (!reached(to)) {
      enter(to, here.polygon, part);
      open_.push_back(side);
    } else if (order_[to] < order_[here.polygon]) {  // else it was followed from its other end
      open_.push_back(side);
      low_[here.polygon] = std::min(low_[here.polygon], order_[to]);
    }
  }

  void leave(std::uint32_t parent, const Step& child) {
    if (low_[child.polygon] < order_[parent]) {
      low_[parent] = std::min(low_[parent], low_[child.polygon]);
      return;
    }
    const auto block = static_cast<std::uint32_t>(mesh_.top.size());
    mesh_.top.push_back(parent);
    for (; open_.size() > child.open_before; open_.pop_back()) {
      NavigationMesh::Side& side = mesh_.sides[open_.back()];
      side.block = mesh_.sides[side.behind].block = block;
    }
  }

  NavigationMesh& mesh_;
  std::vector<std::uint32_t> order_, low_, next_, reached_;
  std::vector<Step> way_;
  std::vector<std::uint32_t> open_;  // sides of blocks that are not closed
};

}  // namespace

void find_blocks(NavigationMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.first.size() - 1);
  mesh.part.assign(count, none);
  BlockSearch search(mesh);
  std::uint32_t parts = 0;
  for (std::uint32_t p = 0; p < count; ++p) {
    if (!search.reached(p)) search.search(p, parts++);
  }
  mesh.up.assign(count, none);
  mesh.depth.assign(count, 0);
  for (const std::uint32_t p : search.reached()) {
    for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
      const std::uint32_t block = mesh.sides[s].block;
      if (block == none || mesh.top[block] == p) continue;
      mesh.up[p] = block;
      mesh.depth[p] = mesh.depth[mesh.top[block]] + 1;
      break;
    }
  }
}

}  // namespace outrider
