// The indices of landmarks, which answer where hub labels do not fit, against searches
// that share no code.
#include "hubs/turns/guided_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hubs/any_angle/any_angle_index.hpp"
#include "hubs/octile/octile_index.hpp"
#include "outrider/path/check.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"
#include "unit/path/mesh/corner_distances.hpp"

namespace outrider::hub_labelling {
namespace {

using oracle::Blocked;

constexpr std::size_t plenty = std::size_t{64} << 20U;

Cell random_vertex(Rng& rng, const GridMap& ground) {
  const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  const int more = ground.model == GridModel::corners ? 1 : 0;
  return {below(ground.frame.width + more), below(ground.frame.height + more)};
}

/// An index of landmarks with the memory of its queries.
template <class Index>
struct Guided {
  explicit Guided(const GridMap& of) : ground(of), index(Index::of(of, plenty, {}, false)) {}

  /// Returns the length of the way from start to goal, which must be legal; infinite if there is none.
  double length(Cell start, Cell goal) {
    std::vector<Cell> way{start};
    if (start == goal) return 0.0;
    if (!index->straight(ground, start, goal, way)) {
      BudgetMeter meter({});
      if (index->find(ground, start, goal, way, scratch, meter) != Found::way)
        return std::numeric_limits<double>::infinity();
    }
    EXPECT_EQ(way.back(), goal);
    EXPECT_TRUE(legal_way(ground, way));
    bent += way.size() > 3 ? 1 : 0;
    return Index::length_of(way);
  }

  const GridMap& ground;
  std::unique_ptr<const Index> index;
  typename Index::Scratch scratch;
  int bent = 0;
};

template <class Index>
class GuidedSearches : public ::testing::Test {};
using Indices = ::testing::Types<AnyAngleIndex, OctileIndex>;
TYPED_TEST_SUITE(GuidedSearches, Indices);

TYPED_TEST(GuidedSearches, FindTheShortestPathsOverAllVertices) {
  constexpr bool any_direction = std::is_same_v<TypeParam, AnyAngleIndex>;
  const GridModel model = any_direction ? GridModel::corners : GridModel::cells;
  Rng rng = Rng(41).child("guided");
  int joined = 0, apart = 0, bent = 0;
  for (int i = 0; i < outrider::testing::cases(150); ++i) {
    const Blocked grid = i % 3 == 0 ? rooms(rng, 14) : random_grid(rng, 12);
    const GridMap ground = GridMap::of(grid, model).value();
    Guided<TypeParam> guided(ground);
    ASSERT_NE(guided.index, nullptr);
    for (int k = 0; k < 8; ++k) {
      const Cell start = random_vertex(rng, ground), goal = random_vertex(rng, ground);
      if (!ground.place(start) || !ground.place(goal)) continue;
      const double least = oracle::shortest(grid, model, start, goal, any_direction);
      const double found = guided.length(start, goal);
      ASSERT_EQ(std::isfinite(found), std::isfinite(least)) << "grid " << i;
      if (!std::isfinite(least)) {
        ++apart;
        continue;
      }
      ASSERT_NEAR(found, least, 1e-9)
          << "grid " << i << ", from " << start.x << "," << start.y << " to " << goal.x << "," << goal.y;
      ++joined;
    }
    bent += guided.bent;
  }
  EXPECT_GT(joined, 150);
  EXPECT_GT(apart, 10);
  EXPECT_GT(bent, 50);
}

TYPED_TEST(GuidedSearches, EndWithTheBudget) {
  constexpr bool any_direction = std::is_same_v<TypeParam, AnyAngleIndex>;
  Rng rng = Rng(42).child("budget");
  const GridMap ground =
      GridMap::of(rooms(rng, 60), any_direction ? GridModel::corners : GridModel::cells).value();
  Guided<TypeParam> guided(ground);
  int ended = 0;
  for (int k = 0; k < 200; ++k) {
    const Cell start = random_vertex(rng, ground), goal = random_vertex(rng, ground);
    if (!ground.place(start) || !ground.place(goal)) continue;
    std::vector<Cell> way{start};
    Budget budget;
    budget.expansions = 2;
    BudgetMeter meter(budget);
    if (guided.index->straight(ground, start, goal, way)) continue;
    const Found found = guided.index->find(ground, start, goal, way, guided.scratch, meter);
    EXPECT_LE(meter.spent(), 2U);
    ended += found == Found::out_of_budget ? 1 : 0;
  }
  EXPECT_GT(ended, 20);
}

/// Returns the least power of two of bytes in which an index of landmarks fits.
std::size_t bytes_of_landmarks(const GridMap& ground) {
  std::size_t bytes = 1024;
  while (AnyAngleIndex::of(ground, bytes, {}, false) == nullptr) bytes *= 2;
  return bytes;
}

/// In the corridors of a maze a search on the mesh expands next to nothing, since it knows the forced turns.
TEST(GuidedSearches, AreLeftOutWhereTheMeshExpandsLess) {
  Rng rng = Rng(43).child("maze");
  const GridMap maze = GridMap::of(mesh_oracle::maze(rng, 60, 1, false), GridModel::corners).value();
  EXPECT_EQ(AnyAngleIndex::of(maze, bytes_of_landmarks(maze), {}), nullptr);
  const GridMap open = GridMap::of(strewn(rng, 120, 120, 0.1), GridModel::corners).value();
  const auto index = AnyAngleIndex::of(open, bytes_of_landmarks(open), {});
  ASSERT_NE(index, nullptr);
  EXPECT_FALSE(index->labels) << "or this shows nothing";
}

}  // namespace
}  // namespace outrider::hub_labelling
