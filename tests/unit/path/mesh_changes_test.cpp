// A mesh that follows changes of its ground, against what any mesh of the ground has to be.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/mesh_blocks.hpp"
#include "mesh/mesh_change.hpp"
#include "mesh/polyanya/landmark.hpp"
#include "mesh_oracle.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "support/costly_cases.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;

int below(Rng& rng, int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); }

/// Another state for a rectangle, for each cell of it, for a diagonal line of cells, or for all.
void change(Rng& rng, Blocked& grid) {
  const GridFrame& frame = grid.frame;
  const Cell at{below(rng, frame.width), below(rng, frame.height)};
  const int kind = below(rng, 8), dx = below(rng, 2) * 2 - 1;
  const int width = kind == 0 ? frame.width : 1 + below(rng, kind < 4 ? 5 : 1);
  const int height = kind == 0 ? frame.height : 1 + below(rng, kind < 4 ? 5 : 1);
  const std::uint64_t state = rng.below(3);
  const double density = rng.uniform();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Cell c = kind == 0 ? Cell{x, y} : Cell{at.x + dx * x, at.y + y};
      if (!grid.contains(c) || (kind == 3 && x != y)) continue;
      grid[c] = state == 2 ? (rng.uniform() < density ? 1 : 0) : static_cast<std::uint8_t>(state);
    }
  }
}

/// A mesh and its grid, which change together.
struct Changing {
  explicit Changing(Blocked of)
      : grid(std::move(of)),
        ground(GridMap::of(grid, GridModel::corners).value()),
        mesh(navigation_mesh(ground)) {}

  void follow(const Blocked& now) {
    GridMap next = GridMap::of(now, GridModel::corners).value();
    const auto cells = cells_changed(ground, next, grid.cells.size()).value();
    ASSERT_TRUE(change_mesh(mesh, next, cells, std::numeric_limits<std::size_t>::max()));
    grid = now;
    ground = std::move(next);
  }

  Blocked grid;
  GridMap ground;
  NavigationMesh mesh;
};

class ChangesOfMeshes : public ::testing::Test {
 protected:
  template <class Check>
  void each(const char* name, int grids, int steps, int most_side, Check check) {
    Rng rng = Rng(6).child(name);
    for (int i = 0; i < outrider::testing::costly_cases(grids); ++i) {
      Changing changing(random_grid(rng, most_side));
      for (int step = 0; step < steps; ++step) {
        Blocked now = changing.grid;
        for (int k = 1 + below(rng, 3); k > 0; --k) change(rng, now);
        SCOPED_TRACE(::testing::Message() << "grid " << i << ", step " << step);
        changing.follow(now);
        ASSERT_FALSE(HasFatalFailure());
        check(changing.grid, changing.mesh);
        ASSERT_FALSE(HasFatalFailure());
      }
    }
  }
};

TEST_F(ChangesOfMeshes, LeavePolygonsThatCoverTheFreeCellsOnceAndFitTogether) {
  each("cover", 120, 25, 12, [](const Blocked& grid, const NavigationMesh& mesh) {
    mesh_oracle::expect_cover(grid, mesh);
    mesh_oracle::expect_fit(grid, mesh);
    mesh_oracle::expect_turns(grid, mesh);
    mesh_oracle::expect_polygons_at(grid, mesh);
  });
}

TEST_F(ChangesOfMeshes, LeaveLargerMeshesSoundToo) {
  each("larger", 12, 25, 40, [](const Blocked& grid, const NavigationMesh& mesh) {
    mesh_oracle::expect_cover(grid, mesh);
    mesh_oracle::expect_fit(grid, mesh);
    mesh_oracle::expect_turns(grid, mesh);
  });
}

TEST_F(ChangesOfMeshes, LeaveAllBlocksOnWaysWithoutDetours) {
  each("blocks", 200, 8, 8, [](const Blocked& /*grid*/, NavigationMesh mesh) {
    mesh_oracle::expect_blocks(mesh);
    find_blocks(mesh);
    ASSERT_TRUE(mesh.core.empty());
    mesh_oracle::expect_blocks(mesh);
  });
}

TEST_F(ChangesOfMeshes, LeaveGatesWhereABlockHasOneSide) {
  int gates = 0;
  each("gates", 40, 12, 30, [&](const Blocked& /*grid*/, NavigationMesh mesh) {
    find_blocks(mesh);
    std::vector<int> sides(mesh.top.size(), 0);  // by block, each counted from both polygons
    for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
      for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
        if (!mesh.is_gone(p) && mesh.sides[s].polygon != NavigationMesh::none) ++sides[mesh.sides[s].block];
      }
    }
    polyanya_search::Landmark landmark;
    landmark.find(mesh);
    for (std::uint32_t block = 0; block < sides.size(); ++block) {
      ASSERT_EQ(landmark.is_gate(block), sides[block] == 2);
      gates += sides[block] == 2 ? 1 : 0;
    }
  });
  EXPECT_GT(gates, 20 * outrider::testing::costly_cases(40));
}

TEST(PolyanyaOnChangedMeshes, IsTheShortestPathOverAllVertices) {
  Rng rng = Rng(7).child("vertices");
  int joined = 0, apart = 0;
  for (int i = 0; i < outrider::testing::cases(150); ++i) {
    Blocked grid = random_grid(rng, 14);
    Workspace workspace;
    for (int step = 0; step < 10; ++step) {
      change(rng, grid);
      const auto ground = std::make_shared<const GridMap>(GridMap::of(grid, GridModel::corners).value());
      for (int k = 0; k < 5; ++k) {
        const Cell start{below(rng, grid.frame.width + 1), below(rng, grid.frame.height + 1)};
        const Cell goal{below(rng, grid.frame.width + 1), below(rng, grid.frame.height + 1)};
        if (!ground->place(start) || !ground->place(goal)) continue;
        const Problem problem{ground, ground->point(start), ground->point(goal)};
        const auto plan = polyanya(problem, {}, {}, workspace);
        const double least = oracle::shortest(grid, GridModel::corners, start, goal, true);
        ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "grid " << i << ", step " << step;
        ++(plan ? joined : apart);
        if (!plan) continue;
        ASSERT_NEAR(plan->cost, least, 1e-12 * std::max(1.0, least)) << "grid " << i << ", step " << step;
        ASSERT_TRUE(check(*plan, problem));
      }
    }
  }
  EXPECT_GT(joined, 1000);
  EXPECT_GT(apart, 300);
}

/// As many queries as it takes until legs, forced turns and a landmark are found on meshes with gaps.
TEST(PolyanyaOnChangedMeshes, IsAsLongAfterManyQueries) {
  Rng rng = Rng(9).child("many queries");
  int joined = 0, less_work = 0;
  for (int i = 0; i < outrider::testing::cases(3); ++i) {
    Blocked grid = strewn(rng, 40, 40, 0.3);
    Workspace workspace;
    for (int step = 0; step < 4; ++step) {
      change(rng, grid);
      const auto ground = std::make_shared<const GridMap>(GridMap::of(grid, GridModel::corners).value());
      for (int k = 0; k < 150; ++k) {
        const Problem problem{ground,
                              {rng.uniform(0, grid.frame.width), rng.uniform(0, grid.frame.height)},
                              {rng.uniform(0, grid.frame.width), rng.uniform(0, grid.frame.height)}};
        Workspace fresh;
        const auto plan = polyanya(problem, {}, {}, workspace), truth = polyanya(problem, {}, {}, fresh);
        ASSERT_EQ(plan.has_value(), truth.has_value()) << "grid " << i << ", step " << step;
        if (!plan) continue;
        ASSERT_NEAR(plan->cost, truth->cost, 1e-12 * truth->cost) << "grid " << i << ", step " << step;
        ASSERT_TRUE(check(*plan, problem));
        ++joined;
        less_work += plan->counters.expansions < truth->counters.expansions ? 1 : 0;
      }
    }
  }
  EXPECT_GT(joined, 200);
  EXPECT_GT(less_work, 40) << "nothing was found beforehand";
}

/// Larger grids, where most changes are followed.
TEST(PolyanyaOnChangedMeshes, IsAsLongAsOnAMeshMadeAnew) {
  Rng rng = Rng(8).child("anew");
  int other_work = 0, apart = 0;
  for (int i = 0; i < outrider::testing::cases(30); ++i) {
    Blocked grid = random_grid(rng, 60);
    Workspace workspace;
    for (int step = 0; step < 40; ++step) {
      change(rng, grid);
      const auto ground = std::make_shared<const GridMap>(GridMap::of(grid, GridModel::corners).value());
      for (int k = 0; k < 4; ++k) {
        const auto point = [&] {
          return Vec2{rng.uniform(0, grid.frame.width), rng.uniform(0, grid.frame.height)};
        };
        const Problem problem{ground, point(), point()};
        Workspace fresh;
        const auto plan = polyanya(problem, {}, {}, workspace), truth = polyanya(problem, {}, {}, fresh);
        ASSERT_EQ(plan.has_value(), truth.has_value()) << "grid " << i << ", step " << step;
        if (!plan) {
          ASSERT_EQ(to_string(plan.error()), to_string(truth.error()));
          apart += plan.error().code == FaultCode::no_path ? 1 : 0;
          continue;
        }
        ASSERT_NEAR(plan->cost, truth->cost, 1e-12 * truth->cost) << "grid " << i << ", step " << step;
        ASSERT_EQ(plan->lower_bound, plan->cost);
        ASSERT_TRUE(check(*plan, problem));
        other_work += plan->counters == truth->counters ? 0 : 1;
      }
    }
  }
  EXPECT_GT(other_work, 300) << "the mesh was made anew";
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace outrider
