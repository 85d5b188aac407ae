// The pose of a scan in rooms whose walls are known.
#include "scan/scan_match.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "scan/scan_agreement.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr Pose2 in_the_middle{{2.3, 2.0}, 0.4};

LaserScan scan_seen_from(const std::vector<testing::Wall>& walls, const Pose2& pose, Rng& rng) {
  testing::Finder finder;
  finder.most_m = 10.0;
  return testing::scan_from(walls, pose, finder, rng);
}

Surface seen_from(const std::vector<testing::Wall>& walls, const Pose2& pose, Rng& rng) {
  return surface_of(scan_seen_from(walls, pose, rng), {}, 30.0);
}

SurfaceMap map_from(const std::vector<testing::Wall>& walls, Rng& rng) {
  const Surface surface = seen_from(walls, in_the_middle, rng);
  return SurfaceMap(std::vector<SurfaceMap::Part>{{&surface, in_the_middle, 0}});
}

double nothing_speaks_against(const Pose2&) { return 0.0; }

/// The window of a short drive: 10 cm and 6 degrees to each side.
MatchWindow window_about(const Pose2& pose) { return {pose, 0.1, 0.1, 0.033, 0.033}; }

void expect_near(const Pose2& pose, const Pose2& truth) {
  EXPECT_LT(distance(pose.position, truth.position), 0.02);
  EXPECT_LT(std::abs(wrap_angle(pose.heading_rad - truth.heading_rad)), 0.01);
}

class ScanMatch : public ::testing::Test {
 protected:
  Rng rng{1};
  std::vector<testing::Wall> walls = testing::furnished_room();
  SurfaceMap map = map_from(walls, rng);
  BackOff wide;
};

TEST_F(ScanMatch, WithinTheWindowAndFarBeyondIt) {
  for (int trial = 0; trial < testing::cases(10); ++trial) {
    const Pose2 truth{in_the_middle.position + testing::random_point(rng, 0.3), rng.uniform(-pi, pi)};
    const LaserScan scan = scan_seen_from(walls, truth, rng),
                    known = scan_seen_from(walls, in_the_middle, rng);
    const Surface surface = surface_of(scan, {}, 30.0);
    const auto contradiction = [&](const Pose2& at) {
      return mutual_agreement(scan, at, known, in_the_middle).contradiction();
    };
    const Vec2 aside = direction(rng.uniform(-pi, pi));
    for (const auto& [off_m, off_rad] : {std::pair(0.05, 0.05), std::pair(0.5, 0.5), std::pair(2.5, 3.0)}) {
      const Pose2 guess{truth.position + off_m * aside, truth.heading_rad + off_rad};
      const auto fit = match_scan(map, surface, window_about(guess), contradiction, wide);
      ASSERT_TRUE(fit) << off_m;
      expect_near(fit->pose, truth);
      EXPECT_GT(fit->share, 0.8);
    }
  }
}

TEST_F(ScanMatch, APoseThatIsContradictedIsNotTaken) {
  const Surface surface = seen_from(walls, in_the_middle, rng);
  Surface part = surface;  // half of the points are of something new
  for (std::size_t i = 0; i < part.size(); i += 2) part[i].position = 3.0 * part[i].position;
  const MatchWindow window = window_about(in_the_middle);
  const auto unopposed = match_scan(map, part, window, nothing_speaks_against, wide);
  ASSERT_TRUE(unopposed);
  ASSERT_LT(unopposed->share, 0.9);
  EXPECT_FALSE(match_scan(map, part, window, [](const Pose2&) { return 0.9; }, wide));
}

/// A room that is entered, and one that is known and looks the same: nothing says that odometry is wrong.
TEST_F(ScanMatch, ARoomLikeAKnownOneIsNotTakenForItUnlessOdometryIsContradicted) {
  const Surface surface = seen_from(walls, in_the_middle, rng);
  const MatchWindow beside = window_about({in_the_middle.position + Vec2{3.0, 0.0}, pi});
  ASSERT_FALSE(match_nearby(map, surface, beside, nothing_speaks_against));
  EXPECT_FALSE(match_scan(map, surface, beside, nothing_speaks_against, wide));
  const auto there = [&](const Pose2& at) {
    return distance(at.position, in_the_middle.position) > 1.0 ? 0.5 : 0.0;
  };
  const auto fit = match_scan(map, surface, beside, there, wide);
  ASSERT_TRUE(fit);
  expect_near(fit->pose, in_the_middle);
}

TEST_F(ScanMatch, AnotherRoomIsNotMatched) {
  const std::vector<testing::Wall> corner{{{-8, 8}, {8, -5}}, {{-8, -2}, {4, 8}}};
  const Surface surface = seen_from(corner, {}, rng);
  ASSERT_GT(surface.size(), 60U);
  const auto fit = match_scan(map, surface, window_about(in_the_middle), nothing_speaks_against, wide);
  EXPECT_FALSE(fit);
}

/// In a room that looks the same after half a turn, a scan that may be turned by anything is not recognised.
TEST(ScanMatchOfASymmetricRoom, IsNotGuessed) {
  Rng rng(2);
  const auto walls = testing::box_walls({0, 0}, {6, 4});
  const Pose2 centre{{3.0, 2.0}, 0.0};
  const Surface surface = seen_from(walls, centre, rng);
  const SurfaceMap map(std::vector<SurfaceMap::Part>{{&surface, centre, 0}});
  EXPECT_FALSE(recognise_place(map, surface, {centre, 1.0, pi}));
  const auto narrow = recognise_place(map, surface, {centre, 1.0, 0.5});
  ASSERT_TRUE(narrow);
  expect_near(narrow->pose, centre);
}

TEST(ScanMatchOfAFurnishedRoom, IsRecognisedInTheFullTurn) {
  Rng rng(3);
  const auto walls = testing::furnished_room();
  const SurfaceMap map = map_from(walls, rng);
  const Pose2 truth{{2.5, 2.2}, -2.0};
  const auto fit = recognise_place(map, seen_from(walls, truth, rng), {in_the_middle, 2.0, pi});
  ASSERT_TRUE(fit);
  expect_near(fit->pose, truth);
}

}  // namespace
}  // namespace outrider
