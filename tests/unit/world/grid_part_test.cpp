#include "outrider/world/grid_part.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(GridPart, HoldsWhatIsSetAndTheRestOutside) {
  Rng rng(31);
  std::size_t kept = 0;
  for (int i = 0; i < testing::cases(200); ++i) {
    const GridFrame frame{{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)},
                          rng.uniform(0.05, 1.0),
                          1 + static_cast<int>(rng.below(30)),
                          1 + static_cast<int>(rng.below(30))};
    const Vec2 centre{rng.uniform(-20.0, 30.0), rng.uniform(-20.0, 30.0)};
    const double reach = i % 5 == 0 ? inf : rng.uniform(0.0, 15.0);
    GridPart<int> part(frame, centre, reach, -1);
    std::vector<int> twin(frame.size(), -1);
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 away = frame.centre(frame.cell(c)) - centre;
      if (std::max(std::abs(away.x), std::abs(away.y)) > reach) continue;
      part.set(c, static_cast<int>(c));
      twin[c] = static_cast<int>(c);
      ++kept;
    }
    for (std::size_t c = 0; c < frame.size(); ++c) ASSERT_EQ(part[c], twin[c]);
    std::vector<int> visited(frame.size(), -1);
    std::size_t next = 0;
    part.each([&](std::size_t c, int value) {
      EXPECT_GE(c, next);
      next = c + 1;
      visited[c] = value;
    });
    EXPECT_EQ(visited, twin);
    const GridPart<double> halves = part.mapped(-0.5, [](std::size_t, int value) { return 0.5 * value; });
    for (std::size_t c = 0; c < frame.size(); ++c) EXPECT_EQ(halves[c], 0.5 * twin[c]);
  }
  EXPECT_GT(kept, 1000U);
}

TEST(GridPart, WithoutCellsIsAllOutside) {
  const GridPart<int> none(7);
  EXPECT_EQ(none[0], 7);
  EXPECT_EQ(none[12345], 7);
  none.each([](std::size_t, int) { FAIL(); });
}

}  // namespace
}  // namespace outrider
