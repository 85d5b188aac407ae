#include "mesh_blocks.hpp"

#include <algorithm>

namespace outrider {
namespace {

/// Depth-first search without recursion. A block is complete when the search returns over the side by which
/// it entered the block; until then the sides of the block are on a separate stack.
class BlockSearch {
 public:
  explicit BlockSearch(NavigationMesh& mesh)
      : mesh_(mesh), order_(mesh.polygons(), NavigationMesh::none), low_(order_.size()), next_(mesh.first) {}

  void search(std::uint32_t root, const std::stop_token& stop) {
    enter(root, NavigationMesh::none);
    while (!way_.empty() && !stop.stop_requested()) {
      const Step here = way_.back();
      std::uint32_t& next = next_[here.polygon];
      if (next < mesh_.first[here.polygon + 1]) {
        follow(here, next++);
      } else {
        way_.pop_back();
        if (!way_.empty()) leave(way_.back().polygon, here);
      }
    }
  }
  [[nodiscard]] bool reached(std::uint32_t polygon) const { return order_[polygon] != NavigationMesh::none; }
  /// Returns the polygons in the order in which they were reached.
  [[nodiscard]] const std::vector<std::uint32_t>& reached() const { return reached_; }

 private:
  struct Step {
    std::uint32_t polygon;
    std::uint32_t from;       // the polygon before it
    std::size_t open_before;  // sides that were open when it was entered
  };

  void enter(std::uint32_t polygon, std::uint32_t from) {
    order_[polygon] = low_[polygon] = static_cast<std::uint32_t>(reached_.size());
    reached_.push_back(polygon);
    way_.push_back({polygon, from, open_.size()});
  }

  void follow(const Step& here, std::uint32_t side) {
    const std::uint32_t to = mesh_.sides[side].polygon;
    if (to == NavigationMesh::none || to == here.from) return;
    if (!reached(to)) {
      enter(to, here.polygon);
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

void find_blocks(NavigationMesh& mesh, const std::stop_token& stop) {
  const auto count = static_cast<std::uint32_t>(mesh.polygons());
  mesh.up.resize(count, NavigationMesh::none);
  mesh.order.assign(count, 0);
  mesh.top.clear();
  mesh.core.clear();
  BlockSearch search(mesh);
  for (std::uint32_t p = 0; p < count && !stop.stop_requested(); ++p) {
    if (!mesh.is_gone(p) && !search.reached(p)) search.search(p, stop);
  }
  for (std::uint32_t place = 0; place < search.reached().size(); ++place) {
    const std::uint32_t p = search.reached()[place];
    mesh.order[p] = place;
    mesh.up[p] = NavigationMesh::none;
    for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
      const std::uint32_t block = mesh.sides[s].block;
      if (block == NavigationMesh::none || mesh.top[block] == p) continue;
      mesh.up[p] = block;
      break;
    }
  }
}

std::uint32_t add_to_core(NavigationMesh& mesh) {
  mesh.core.push_back(static_cast<std::uint32_t>(mesh.top.size()));
  mesh.top.push_back(NavigationMesh::none);
  return mesh.core.back();
}

void move_to_core(NavigationMesh& mesh, std::uint32_t polygon, std::uint32_t block) {
  const auto move = [&mesh](std::uint32_t b) {
    if (mesh.top[b] != NavigationMesh::none) mesh.core.push_back(b);
    mesh.top[b] = NavigationMesh::none;
  };
  for (std::uint32_t p = polygon; p != NavigationMesh::none;) {
    std::uint32_t& up = mesh.up[p];
    if (up == NavigationMesh::none) up = block;  // the root
    p = mesh.top[up];
    move(up);
  }
  for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s) {
    if (mesh.sides[s].block != NavigationMesh::none) move(mesh.sides[s].block);
  }
}

}  // namespace outrider
