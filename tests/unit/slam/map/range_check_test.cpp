// Range finders that are right, off, and blind to some beams, in a room whose walls are known.
#include "outrider/slam/map/range_check.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"

namespace outrider {
namespace {

/// A drive through the room. The poses are off by up to 2 cm and 0.01 rad, as those of a matched map are.
struct RoomDrive {
  std::vector<LaserScan> scans;
  std::vector<PlacedScan> placed;

  explicit RoomDrive(std::uint64_t seed, double bias_m = 0.0, double outliers = 0.0,
                     const std::vector<testing::Wall>& walls = testing::furnished_room(),
                     const testing::Finder& finder = {}, bool only_longer = false) {
    Rng rng(seed);
    for (int i = 0; i < 24; ++i) {
      const double along = 0.2 * i;
      const Pose2 pose{{0.6 + along, 1.8 + 0.4 * std::sin(along)}, 0.3 * along};
      LaserScan scan = testing::scan_from(walls, pose, finder, rng);
      for (float& range : scan.ranges_m) {
        if (range <= scan.most_m) range += static_cast<float>(bias_m);
        if (rng.uniform() >= outliers) continue;
        const double least_m = only_longer ? static_cast<double>(range) : scan.least_m;
        if (least_m < scan.most_m) range = static_cast<float>(rng.uniform(least_m, scan.most_m));
      }
      scans.push_back(scan);
      const Pose2 error{{rng.uniform(-0.02, 0.02), rng.uniform(-0.02, 0.02)}, rng.uniform(-0.01, 0.01)};
      placed.push_back({nullptr, compose(pose, error), along, static_cast<std::size_t>(i)});
    }
    for (std::size_t i = 0; i < scans.size(); ++i) placed[i].scan = &scans[i];
  }
  [[nodiscard]] RangeCheck check() const { return check_range_finder(placed, 30.0); }
};

TEST(RangeCheck, AGoodRangeFinderIsBelieved) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RangeCheck check = RoomDrive(seed).check();
    EXPECT_GT(check.readings, 1000U);
    EXPECT_LT(check.stray_share(), 0.001);
    EXPECT_LT(std::abs(check.bias_m), 0.03);
    EXPECT_LT(check.bias_sd_m, 0.02);
    EXPECT_EQ(why_not_believed(check), "");
  }
}

TEST(RangeCheck, ABiasIsToldByWallsThatAreSeenAtASlant) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double bias_m : {-0.2, -0.12, 0.12, 0.2}) {
      const RangeCheck check = RoomDrive(seed, bias_m).check();
      EXPECT_NEAR(check.bias_m, bias_m, 0.04);
      const std::string why = why_not_believed(check);
      EXPECT_NE(why.find(bias_m > 0.0 ? "too long" : "too short"), std::string::npos) << why;
    }
  }
}

TEST(RangeCheck, BeamsThatEndAnywhereAreStrays) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double outliers : {0.03, 0.1, 0.3}) {
      const std::string why = why_not_believed(RoomDrive(seed, 0.0, outliers).check());
      EXPECT_NE(why.find("stand alone"), std::string::npos) << outliers << ": " << why;
    }
  }
}

/// Nearly all outliers of a range finder that reaches far beyond the walls lie behind them.
TEST(RangeCheck, BeamsThatEndBehindWallsAreStrays) {
  testing::Finder far;
  far.most_m = 30.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double outliers : {0.02, 0.1, 0.3, 0.5}) {
      const RoomDrive drive(seed, 0.0, outliers, testing::furnished_room(), far, true);
      const std::string why = why_not_believed(drive.check());
      EXPECT_NE(why.find("stand alone"), std::string::npos) << outliers << ": " << why;
    }
    const RoomDrive good(seed, 0.0, 0.0, testing::furnished_room(), far);
    EXPECT_EQ(why_not_believed(good.check()), "");
  }
}

/// Single beams lead through the gaps of a fence, to a wall that other scans show too.
TEST(RangeCheck, AFenceIsBelieved) {
  testing::Finder far;
  far.most_m = 30.0;
  std::vector<testing::Wall> walls = testing::box_walls({0, 0}, {8, 6});
  for (double x = 0.5; x < 7.5; x += 0.16) walls.push_back({{x, 3.5}, {x + 0.1, 3.5}});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RoomDrive drive(seed, 0.0, 0.0, walls, far);
    int through_a_gap = 0;
    for (const LaserScan& scan : drive.scans) {
      for (std::size_t i = 1; i + 1 < scan.ranges_m.size(); ++i) {
        const float before_m = scan.ranges_m[i - 1], after_m = scan.ranges_m[i + 1];
        through_a_gap += std::abs(before_m - after_m) < 0.1F && scan.ranges_m[i] > before_m + 0.5F ? 1 : 0;
      }
    }
    ASSERT_GT(through_a_gap, 100) << "the beams must tell the fence from a wall";
    const RangeCheck check = drive.check();
    EXPECT_EQ(why_not_believed(check), "") << check.stray_share();
  }
}

TEST(RangeCheck, NothingIsKnownOfOneScan) {
  RoomDrive drive(1, 0.2);
  drive.placed.resize(1);
  EXPECT_EQ(drive.check().readings, 0U);
  EXPECT_EQ(why_not_believed(drive.check()), "");
}

}  // namespace
}  // namespace outrider
