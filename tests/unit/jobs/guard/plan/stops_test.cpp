#include "outrider/jobs/guard/plan/stops.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::random_guard_problem;

std::set<std::size_t> targets_at(const SureHits& hits, const GuardProblem& problem, std::size_t cell) {
  std::set<std::size_t> set;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (hits.has(cell, t)) set.insert(t);
  }
  return set;
}

TEST(SureHits, AreWhatTheHeaderSays) {
  Rng rng(71);
  std::size_t sure = 0;
  std::size_t not_sure = 0;
  for (int i = 0; i < cases(6); ++i) {
    auto problem = random_guard_problem(rng, 8, 4, 2.0);
    problem.errors.position_m = 0.05 * (i % 4);
    const auto firing_map = build_firing_map(problem, {.resolution_m = 0.1});
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const SureHits hits = sure_hits(problem, *firing_map, targets_with_region(*firing_map));
    const SureHits some = sure_hits(problem, *firing_map, {1, 3});
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      const FiringRegion& region = firing_map->regions[t];
      std::set<std::size_t> own;
      for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
        if (region.pitch[c] == FiringRegion::no_shot || region.error_ratio[c] > 0.9F) continue;
        const Vec2 p = firing_map->frame.centre(firing_map->frame.cell(c));
        if (firing_map->ground.clearance(p, 1.0) < problem.robot.radius_m + problem.errors.position_m)
          continue;
        bool all = true;
        for (std::size_t d = 0; d < firing_map->frame.size(); ++d) {
          const double away = distance(p, firing_map->frame.centre(firing_map->frame.cell(d)));
          all = all && (away > problem.errors.position_m + 1e-9 || region.pitch[d] != FiringRegion::no_shot);
        }
        if (all) own.insert(c);
      }
      for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
        const bool expected = own.empty() ? region.pitch[c] != FiringRegion::no_shot : own.contains(c);
        // The clearance is kept as a float; a cell at the very limit may go either way.
        const Vec2 p = firing_map->frame.centre(firing_map->frame.cell(c));
        const double room = problem.robot.radius_m + problem.errors.position_m;
        if (std::abs(firing_map->ground.clearance(p, 1.0) - room) < 1e-6) continue;
        EXPECT_EQ(hits.has(c, t), expected) << "yard " << i << " target " << t << " cell " << c;
        EXPECT_EQ(some.has(c, t), hits.has(c, t) && t % 2 == 1);
        (expected ? sure : not_sure) += 1;
      }
    }
  }
  EXPECT_GT(sure, 500U);
  EXPECT_GT(not_sure, 500U);
}

TEST(ChooseStops, CoverEveryTargetWithinTheirNumber) {
  Rng rng(72);
  for (int i = 0; i < cases(6); ++i) {
    const auto problem = random_guard_problem(rng, 8, 6, 2.0);
    const auto firing_map = build_firing_map(problem, {.resolution_m = 0.1});
    ASSERT_TRUE(firing_map.has_value());
    const SureHits hits = sure_hits(problem, *firing_map, targets_with_region(*firing_map));
    std::set<std::size_t> wanted;
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) wanted.merge(targets_at(hits, problem, c));
    for (const std::size_t most : {1U, 5U, 20U, 150U}) {
      const auto stops = choose_stops(*firing_map, hits, 0.4, most, {}, 0.0);
      EXPECT_EQ(stops, choose_stops(*firing_map, hits, 0.4, most, {}, 0.0));
      EXPECT_TRUE(std::is_sorted(stops.begin(), stops.end()));
      EXPECT_LE(stops.size(), std::max(most, problem.targets.size()));
      std::set<std::size_t> covered;
      for (const std::size_t stop : stops) covered.merge(targets_at(hits, problem, stop));
      EXPECT_EQ(covered, wanted) << most;
    }
    // In each tile nothing is lost: some stop there hits at least what any cell there hits.
    const auto all = choose_stops(*firing_map, hits, 0.4, 100000, {}, 0.0);
    const auto tile = [&](std::size_t c) {
      const Vec2 p = firing_map->frame.centre(firing_map->frame.cell(c)) - firing_map->frame.origin;
      return std::pair{static_cast<int>(p.x / 0.4), static_cast<int>(p.y / 0.4)};
    };
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      const auto set = targets_at(hits, problem, c);
      if (set.empty()) continue;
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](std::size_t stop) {
        const auto larger = targets_at(hits, problem, stop);
        return tile(stop) == tile(c) && std::includes(larger.begin(), larger.end(), set.begin(), set.end());
      }));
    }
    const Vec2 here{0.5, 0.5};
    for (const std::size_t stop : choose_stops(*firing_map, hits, 0.2, 100, {here}, 0.7)) {
      EXPECT_LE(distance(here, firing_map->frame.centre(firing_map->frame.cell(stop))), 0.7);
    }
  }
}

/// From each cell three targets of 24 can be hit, so that no place is as good as two others.
TEST(ChooseStops, OneTileWithTooManyGivesAsManyAsThereIsRoomFor) {
  Rng rng(73);
  const auto problem = random_guard_problem(rng, 8, 24, 2.0);
  const auto firing_map = build_firing_map(problem, {.resolution_m = 0.2});
  ASSERT_TRUE(firing_map.has_value());
  SureHits hits(firing_map->frame.size(), {});
  for (std::size_t cell = 0; cell < firing_map->frame.size(); ++cell) {
    for (int n = 0; n < 3; ++n) hits.add(cell, rng.below(24));
  }
  const auto all = choose_stops(*firing_map, hits, 100.0, 100000, {}, 0.0);
  ASSERT_GT(all.size(), 200U);
  for (const std::size_t most : {24U, 25U, 100U, 200U}) {
    const auto some = choose_stops(*firing_map, hits, 100.0, most, {}, 0.0);
    EXPECT_EQ(some.size(), most);
    EXPECT_TRUE(std::ranges::includes(all, some));
    std::set<std::size_t> covered;
    for (const std::size_t stop : some) covered.merge(targets_at(hits, problem, stop));
    EXPECT_EQ(covered.size(), 24U);
  }
}

TEST(SureHits, AreAdded) {
  Rng rng(74);
  constexpr std::size_t cells = 40, targets = 9;
  std::vector<std::vector<std::uint32_t>> cells_of(targets);
  std::set<std::pair<std::size_t, std::size_t>> own;
  for (std::size_t t = 0; t < targets; ++t) {
    for (std::uint32_t c = 0; c < cells; ++c) {
      if (rng.below(3) != 0) continue;
      cells_of[t].push_back(c);
      own.insert({c, t});
    }
  }
  SureHits hits(cells, cells_of);
  for (int i = 0; i < 30; ++i) {
    const std::size_t c = rng.below(cells), t = rng.below(targets);
    hits.add(c, t);
    own.insert({c, t});
  }
  for (std::size_t c = 0; c < cells; ++c) {
    EXPECT_TRUE(std::ranges::is_sorted(hits.at(c)));
    for (std::size_t t = 0; t < targets; ++t) EXPECT_EQ(hits.has(c, t), own.contains({c, t}));
  }
}

TEST(SureHits, HoldMoreThanSixtyFourTargets) {
  GuardProblem problem;
  problem.world.bounds = {{-2, -2}, {2, 2}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0, -1.5}, 0.0};
  for (int i = 0; i < 70; ++i) {
    problem.targets.push_back({fmt::format("cat_{}", i), {-1.5 + 0.043 * i, 1.0, 0}, {0.3, 0.3, 0.4}, 0.0});
  }
  const auto firing_map = build_firing_map(problem, {.resolution_m = 0.25});
  ASSERT_TRUE(firing_map.has_value());
  const SureHits hits = sure_hits(problem, *firing_map, targets_with_region(*firing_map));
  for (std::size_t t = 0; t < 70; ++t) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) count += hits.has(c, t) ? 1 : 0;
    EXPECT_GT(count, 0U) << t;
    EXPECT_LE(count, firing_map->regions[t].hits);
  }
}

}  // namespace
}  // namespace outrider
