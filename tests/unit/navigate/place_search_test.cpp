#include "outrider/navigate/place_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// A scan of a corridor along x: far ahead and behind, near at the sides.
LaserScan corridor(double ahead_m, double behind_m) {
  LaserScan scan{0.0, 0.0, 2.0 * pi / 360, 0.1, 10.0, {}};
  for (int beam = 0; beam < 360; ++beam) {
    const double bearing = scan.step_rad * beam;
    const double side_m = 0.8 / std::max(1e-6, std::abs(std::sin(bearing)));
    const double end_m =
        (std::cos(bearing) > 0.0 ? ahead_m : behind_m) / std::max(1e-6, std::abs(std::cos(bearing)));
    scan.ranges_m.push_back(static_cast<float>(std::min(side_m, end_m)));
  }
  return scan;
}

TEST(PlaceSearch, GoesWhereItIsFreeAndWhereItHasNotBeen) {
  PlaceSearch search;
  search.look(corridor(9.0, 9.0), {});
  const auto first = search.next({}, 0.3);
  ASSERT_TRUE(first);
  EXPECT_GT(std::abs(first->x), 2.0);
  EXPECT_LT(std::abs(first->y), 0.5);
  search.look(corridor(9.0, 9.0), {*first, 0.0});
  const auto second = search.next(*first, 0.3);
  ASSERT_TRUE(second);
  EXPECT_GT(std::abs(second->x), std::abs(first->x) + 1.0);  // not back
}

TEST(PlaceSearch, FindsNoPlaceWhereThereIsNoRoom) {
  PlaceSearch search;
  EXPECT_FALSE(search.looks());
  EXPECT_FALSE(search.next({}, 0.4));
  search.look(corridor(0.4, 0.4), {});
  EXPECT_TRUE(search.looks());
  EXPECT_FALSE(search.next({}, 0.4));
}

TEST(PlaceSearch, GrowsWhileItStandsToo) {
  PlaceSearch search;
  search.advance(1.0, 2.0);
  search.advance(-1.0, 1.0);
  EXPECT_DOUBLE_EQ(search.length_m(), 3.0);
  search.advance(0.0, 10.0);
  EXPECT_DOUBLE_EQ(search.length_m(), 4.0);
  search.begin();
  EXPECT_DOUBLE_EQ(search.length_m(), 0.0);
}

}  // namespace
}  // namespace outrider
