// Maps of a room whose walls are known: right, folded, and shifted.
#include "outrider/slam/map/map_check.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// Two drives through the room along the same line. Poses are the truth until a test moves them.
struct TwoDrives {
  std::vector<LaserScan> scans;
  std::vector<PlacedScan> placed;

  explicit TwoDrives(std::size_t each) {
    Rng rng(1);
    testing::Finder finder;
    finder.most_m = 10.0;
    for (std::size_t i = 0; i < 2 * each; ++i) {
      const double along = 3.0 * static_cast<double>(i % each) / static_cast<double>(each);
      const Pose2 pose{{1.0 + along, 1.8}, 0.1};
      scans.push_back(testing::scan_from(testing::furnished_room(), pose, finder, rng));
      placed.push_back({nullptr, pose, 6.0 * static_cast<double>(i) / static_cast<double>(each), i + 100});
    }
    for (std::size_t i = 0; i < scans.size(); ++i) placed[i].scan = &scans[i];
  }
};

TEST(MapCheck, AMapThatIsRightIsNotContradicted) {
  const TwoDrives drives(20);
  const MapCheck check = check_map(drives.placed);
  EXPECT_EQ(check.scans, 39U) << "the first one has none before it";
  EXPECT_EQ(check.contradicted, 0U);
  EXPECT_TRUE(check.contradictions.empty());
}

/// The second drive is mapped askew, so that its walls cross the room of the first one.
TEST(MapCheck, AFoldedMapIsContradictedByTheEarlierVisit) {
  TwoDrives drives(20);
  for (std::size_t i = 20; i < 40; ++i) {
    drives.placed[i].world_T_laser = compose(Pose2{{1.6, 4.8}, -0.5 * pi}, drives.placed[i].world_T_laser);
  }
  const MapCheck check = check_map(drives.placed);
  EXPECT_EQ(check.scans, 39U);
  ASSERT_GT(check.contradicted, 0U);
  EXPECT_EQ(check.contradictions.size(), check.contradicted);
  for (const Contradiction& one : check.contradictions) {
    EXPECT_LT(one.earlier, one.later);
    EXPECT_GE(one.later, 120U) << "numbers are those of the poses";
    EXPECT_GT(one.share, 0.5);
  }
}

TEST(MapCheck, NeighboursAreComparedToo) {
  TwoDrives drives(20);
  drives.placed.resize(20);
  ASSERT_EQ(check_map(drives.placed).contradicted, 0U);
  const testing::Finder far{.most_m = 10.0};
  Rng rng(2);
  drives.scans[10] = testing::scan_from(testing::box_walls({-9, -9}, {9, 9}), {}, far, rng);
  const MapCheck check = check_map(drives.placed);
  ASSERT_FALSE(check.contradictions.empty());
  EXPECT_EQ(check.contradictions.front().later, 110U);
}

TEST(MapCheck, NothingIsClaimedOfNoScans) {
  EXPECT_EQ(check_map({}).scans, 0U);
  const TwoDrives drives(1);
  EXPECT_EQ(check_map(std::span(drives.placed).first(1)).scans, 0U);
}

}  // namespace
}  // namespace outrider
