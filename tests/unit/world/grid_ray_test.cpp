#include "outrider/world/grid_ray.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Returns true if no line parts the segment from the inside of the cell: one along an axis, or the segment's
/// own.
bool meets(LatticePoint a, LatticePoint b, Cell cell) {
  const std::int64_t side = LatticePoint::side, x0 = side * cell.x, y0 = side * cell.y;
  if (std::max(a.x, b.x) <= x0 || std::min(a.x, b.x) >= x0 + side) return false;
  if (std::max(a.y, b.y) <= y0 || std::min(a.y, b.y) >= y0 + side) return false;
  int left = 0, right = 0;
  for (const auto& [x, y] : {std::pair{x0, y0}, {x0 + side, y0}, {x0, y0 + side}, {x0 + side, y0 + side}}) {
    const std::int64_t turn = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    left += turn >= 0 ? 1 : 0;
    right += turn <= 0 ? 1 : 0;
  }
  return left < 4 && right < 4;
}

TEST(GridRay, CrossesTheCellsThatTheSegmentMeets) {
  Rng rng(1);
  for (int i = 0; i < testing::cases(300); ++i) {
    const auto drawn = [&] {
      return Cell{static_cast<int>(rng.below(15)) - 7, static_cast<int>(rng.below(15)) - 7};
    };
    const bool centres = rng.below(2) == 0;  // rays through corners
    const auto point = [&] {
      return centres ? lattice_centre(drawn()) : lattice_point(testing::random_point(rng, 7.0));
    };
    const LatticePoint a = point(), b = point();
    std::vector<Cell> crossed;
    cross_cells(a, b, [&](Cell cell) { crossed.push_back(cell); });
    EXPECT_EQ(crossed.front(), a.cell());
    EXPECT_EQ(crossed.back(), b.cell());
    const auto apart = [&](Cell c) { return std::max(std::abs(c.x), std::abs(c.y)); };
    for (std::size_t k = 1; k < crossed.size(); ++k) {
      EXPECT_EQ(apart({crossed[k].x - crossed[k - 1].x, crossed[k].y - crossed[k - 1].y}), 1);
    }
    for (int y = -8; y <= 8; ++y) {
      for (int x = -8; x <= 8; ++x) {
        const Cell cell{x, y};
        const bool on = std::ranges::count(crossed, cell) == 1;
        EXPECT_EQ(on, meets(a, b, cell) || cell == a.cell()) << x << ' ' << y;
      }
    }
  }
}

TEST(GridRay, GoesOnUntilToldToStop) {
  std::vector<Cell> met;
  walk_ray(lattice_centre({0, 0}), lattice_centre({-2, 1}), [&](Cell cell) {
    met.push_back(cell);
    return cell.x > -5;
  });
  EXPECT_EQ(met, (std::vector<Cell>{{0, 0}, {-1, 0}, {-1, 1}, {-2, 1}, {-3, 1}, {-3, 2}, {-4, 2}, {-5, 2}}));
  int visits = 0;
  walk_ray(lattice_centre({3, 3}), lattice_centre({3, 3}), [&](Cell) { return ++visits > 0; });
  EXPECT_EQ(visits, 1) << "a ray without a direction leads nowhere";
}

}  // namespace
}  // namespace outrider
