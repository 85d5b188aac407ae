#include "map/flood.hpp"

#include <gtest/gtest.h>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

Grid<std::uint8_t> random_blocks(Rng& rng) {
  GridFrame frame;
  frame.width = 6 + static_cast<int>(rng.below(10));
  frame.height = 6 + static_cast<int>(rng.below(10));
  Grid<std::uint8_t> blocks(frame, TraversabilityGrid::no_block);
  for (int y = 1; y + 1 < frame.height; ++y) {
    for (int x = 1; x + 1 < frame.width; ++x) {
      const std::uint64_t kind = rng.below(10);
      blocks[{x, y}] = static_cast<std::uint8_t>(kind < 3 ? 0 : kind < 5 ? 1 : 2);
    }
  }
  return blocks;
}

/// Bellman and Ford's way, from the sentences of the header.
std::vector<std::uint32_t> relaxed(const Grid<std::uint8_t>& blocks, std::uint32_t from, bool shunned) {
  std::vector<std::uint32_t> cost(blocks.cells.size(), Flood::far);
  cost[from] = 0;
  for (bool again = true; again;) {
    again = false;
    for (std::uint32_t i = 0; i < cost.size(); ++i) {
      if (cost[i] == Flood::far) continue;
      const Cell at = blocks.frame.cell(i);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Cell to{at.x + dx, at.y + dy};
          if ((dx == 0 && dy == 0) || blocks[to] == TraversabilityGrid::no_block) continue;
          const bool diagonal = dx != 0 && dy != 0;
          if (diagonal && (blocks[{to.x, at.y}] == 0 || blocks[{at.x, to.y}] == 0)) continue;
          const std::uint32_t step =
              (diagonal ? 7U : 5U) * (shunned && blocks[to] == TraversabilityGrid::near_block ? 2U : 1U);
          if (cost[i] + step >= cost[blocks.frame.index(to)]) continue;
          cost[blocks.frame.index(to)] = cost[i] + step;
          again = true;
        }
      }
    }
  }
  return cost;
}

TEST(Flood, IsTheCheapestWayToEveryBlock) {
  Flood flood;
  Rng rng(1);
  for (int n = 0; n < testing::cases(150); ++n) {
    const Grid<std::uint8_t> blocks = random_blocks(rng);
    std::uint32_t from = 0;
    while (blocks.cells[from] == TraversabilityGrid::no_block)
      from = static_cast<std::uint32_t>(rng.below(blocks.cells.size()));
    const bool shunned = rng.below(2) == 0;
    flood.run(blocks, from, shunned ? Flood::Walls::are_shunned : Flood::Walls::do_not_matter);
    const std::vector<std::uint32_t> wanted = relaxed(blocks, from, shunned);
    for (std::uint32_t i = 0; i < wanted.size(); ++i) ASSERT_EQ(flood.cost(i), wanted[i]) << n;
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i] == Flood::far) continue;
      const std::uint32_t towards = flood.towards(blocks, i, 12);
      ASSERT_LE(flood.cost(towards), wanted[i]);
      ASSERT_GE(flood.cost(towards), std::min(wanted[i], 12U));
      ASSERT_LT(flood.cost(towards), std::max(wanted[i] + 1, 12U + 14U));
    }
    // Until some goals are reached: these, and no false costs.
    const auto goal = static_cast<std::uint32_t>(rng.below(wanted.size()));
    flood.run(blocks, from, shunned ? Flood::Walls::are_shunned : Flood::Walls::do_not_matter, {goal});
    ASSERT_EQ(flood.cost(goal), wanted[goal]);
    // In strides: what is settled is final, and all that is nearer is settled. It ends, however short they
    // are.
    for (const std::uint32_t stride : {1U, 17U}) {
      flood.begin(blocks, from, shunned ? Flood::Walls::are_shunned : Flood::Walls::do_not_matter);
      bool more = true;
      for (std::uint32_t until = 1; more; until += stride) {
        ASSERT_LT(until, 10000U) << n;
        more = flood.advance(blocks, until);
        for (std::uint32_t i = 0; i < wanted.size(); ++i) {
          if (flood.settled(i)) {
            ASSERT_EQ(flood.cost(i), wanted[i]);
          }
          ASSERT_EQ(flood.settled(i), wanted[i] != Flood::far && (!more || wanted[i] < until)) << n;
        }
      }
    }
  }
}

}  // namespace
}  // namespace outrider
