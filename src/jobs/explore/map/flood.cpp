#include "map/flood.hpp"

#include <algorithm>

namespace outrider {
namespace {

struct Step {
  std::ptrdiff_t to;
  std::ptrdiff_t beside[2];  ///< must be free
  std::uint32_t cost;
};

std::array<Step, 8> steps_of(int width) {
  std::array<Step, 8> steps;
  for (std::size_t i = 0; i < 8; ++i) {
    const Cell d = grid_moves[i];
    const std::ptrdiff_t across = d.x, up = std::ptrdiff_t{d.y} * width, to = across + up;
    steps[i] = i < 4 ? Step{to, {to, to}, 5} : Step{to, {across, up}, 7};
  }
  return steps;
}

const std::uint8_t* at(const Grid<std::uint8_t>& blocks, std::uint32_t block) {
  return blocks.cells.data() + block;
}

std::uint32_t price(std::uint8_t block, const Step& step, std::uint32_t near_factor) {
  return block == TraversabilityGrid::near_block ? near_factor * step.cost : step.cost;
}

bool passes(const std::uint8_t* block, const Step& step) {
  return block[step.to] != TraversabilityGrid::no_block &&
         block[step.beside[0]] != TraversabilityGrid::no_block &&
         block[step.beside[1]] != TraversabilityGrid::no_block;
}

}  // namespace

void Flood::reach(std::uint32_t block, std::uint32_t cost) {
  if (cost >= cost_[block]) return;
  if (cost_[block] == far) touched_.push_back(block);
  cost_[block] = cost;
  buckets_[cost % buckets_.size()].push_back(block);
}

void Flood::clear(const Grid<std::uint8_t>& blocks) {
  for (const std::uint32_t block : touched_) cost_[block] = far;
  touched_.clear();
  if (cost_.size() != blocks.cells.size()) cost_.assign(blocks.cells.size(), far);
  for (auto& bucket : buckets_) bucket.clear();
  next_ = 0;
}

void Flood::begin(const Grid<std::uint8_t>& blocks, std::uint32_t from, Walls walls) {
  near_factor_ = walls == Walls::are_shunned ? 2 : 1;
  clear(blocks);
  reach(from, 0);
}

bool Flood::advance(const Grid<std::uint8_t>& blocks, std::uint32_t cost) {
  const std::array<Step, 8> steps = steps_of(blocks.frame.width);
  const auto is_empty = [](const std::vector<std::uint32_t>& bucket) { return bucket.empty(); };
  for (; next_ < cost; ++next_) {
    std::vector<std::uint32_t>& bucket = buckets_[next_ % buckets_.size()];
    if (bucket.empty() && std::ranges::all_of(buckets_, is_empty)) return false;
    // A step costs from 5 to 14, so nothing joins the bucket in hand.
    for (const std::uint32_t block : bucket) {
      if (cost_[block] != next_) continue;
      const std::uint8_t* const here = at(blocks, block);
      for (const Step& step : steps) {
        if (!passes(here, step)) continue;
        reach(static_cast<std::uint32_t>(block + step.to), next_ + price(here[step.to], step, near_factor_));
      }
    }
    bucket.clear();
  }
  return true;
}

void Flood::run(const Grid<std::uint8_t>& blocks, std::uint32_t from, Walls walls,
                const std::vector<std::uint32_t>& goals) {
  begin(blocks, from, walls);
  const auto is_settled = [&](std::uint32_t goal) { return settled(goal); };
  std::uint32_t until = goals.empty() ? far : 1;
  while (advance(blocks, until) && !std::ranges::all_of(goals, is_settled)) until += 64;
}

std::uint32_t Flood::towards(const Grid<std::uint8_t>& blocks, std::uint32_t block,
                             std::uint32_t from_start) const {
  const std::array<Step, 8> steps = steps_of(blocks.frame.width);
  while (cost_[block] != far && cost_[block] > from_start) {
    std::uint32_t before = block;
    for (const Step& step : steps) {
      const auto next = static_cast<std::uint32_t>(block + step.to);
      if (cost_[next] != far && passes(at(blocks, block), step) &&
          cost_[next] + price(blocks.cells[block], step, near_factor_) == cost_[block]) {
        before = next;
        break;
      }
    }
    if (before == block || cost_[before] < from_start) return block;
    block = before;
  }
  return block;
}

}  // namespace outrider
