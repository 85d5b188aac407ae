#include "outrider/ballistics/mesh_tree.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

Vec3 random_place(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

TEST(MeshTree, TheDistanceIsThatOfASearchOfAllTriangles) {
  Rng rng(7);
  for (int trial = 0; trial < testing::cases(40); ++trial) {
    MeshShape mesh;
    const int count = static_cast<int>(rng.uniform(1.0, 200.0));
    for (int i = 0; i < count; ++i) {
      const Vec3 at = random_place(rng, 5.0);
      mesh.triangles.push_back({at, at + random_place(rng, 1.0), at + random_place(rng, 1.0)});
    }
    const MeshTree tree(mesh);
    const Solid solid{"mesh", {}, mesh};
    for (int i = 0; i < 100; ++i) {
      const Vec3 p =
          i % 4 == 0 ? mesh.triangles[static_cast<std::size_t>(i % count)][1] : random_place(rng, 8.0);
      EXPECT_EQ(tree.distance(p), distance(p, solid)) << "bit for bit";
    }
  }
}

TEST(MeshTree, NothingIsInfinitelyFarAway) {
  EXPECT_EQ(MeshTree(MeshShape{}).distance({1, 2, 3}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace outrider
