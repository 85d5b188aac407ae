// A gap, which odometry alone spans, is bridged where the scans after it show the place of those before it.
#include "laser/laser_loops.hpp"

#include <gtest/gtest.h>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// A room that looks different after any turn.
std::vector<testing::Wall> oblique_room() {
  const std::vector<Vec2> corners{{0, 0}, {6, 0.8}, {4.6, 4.2}, {1.5, 4.0}, {0, 2.6}};
  std::vector<testing::Wall> walls;
  for (std::size_t i = 0; i < corners.size(); ++i)
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return walls;
}

/// A robot drove around in a room. Between keyframes `gap` - 1 and `gap` its odometry was off by `off`.
struct BrokenDrive {
  static constexpr std::uint32_t gap = 16, count = 22;
  static constexpr double reach_sd = 6.0;

  std::vector<Pose2> truth;
  KeyframeGraph graph;
  KeyframeSurfaces surfaces{{}, 30.0};
  LoopSearch search;

  BrokenDrive(const std::vector<testing::Wall>& before, const std::vector<testing::Wall>& after,
              const Pose2& off, double information_of_gap = 1.0) {
    Rng rng(1);
    testing::Finder finder;
    finder.most_m = 10.0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 0.3 * i;
      const Pose2 pose{Vec2{2.4, 2.0} + 0.5 * direction(angle), wrap_angle(angle + 0.5 * pi)};
      const Pose2 believed = i < gap ? pose : compose(off, pose);
      truth.push_back(pose);
      graph.keyframes.push_back(
          {believed, 0.15 * i, testing::scan_from(i < gap ? before : after, pose, finder, rng)});
      const double information = i == gap ? information_of_gap : 1e4;
      if (i > 0) graph.add_constraint(i - 1, i, believed, information * Eigen::Matrix3d::Identity());
    }
    graph.update_covariance();
  }

  [[nodiscard]] double worst_error_m() const {
    double worst_m = 0.0;
    for (std::uint32_t i = 0; i < count; ++i)
      worst_m = std::max(worst_m, distance(graph.keyframes[i].pose.position, truth[i].position));
    return worst_m;
  }
};

TEST(LaserLoops, AGapIsBridgedWhateverOdometryTurned) {
  for (const Pose2& off : {Pose2{{0.3, 0.2}, 0.1}, Pose2{{1.0, -0.5}, 0.5 * pi}, Pose2{{4.5, 3.0}, -3.0}}) {
    BrokenDrive drive(oblique_room(), oblique_room(), off);
    ASSERT_GT(drive.worst_error_m(), 0.2);
    ASSERT_FALSE(drive.search.spans(BrokenDrive::gap));
    ASSERT_TRUE(drive.search.bridge(drive.graph, drive.surfaces, BrokenDrive::reach_sd, BrokenDrive::gap))
        << off.heading_rad;
    EXPECT_LT(drive.worst_error_m(), 0.05);
    EXPECT_TRUE(drive.search.spans(BrokenDrive::gap));
    EXPECT_FALSE(drive.search.spans(BrokenDrive::gap - 1));
  }
}

void expect_stays_open(BrokenDrive& drive) {
  const std::vector<Pose2> before = drive.graph.poses();
  EXPECT_FALSE(drive.search.bridge(drive.graph, drive.surfaces, BrokenDrive::reach_sd, BrokenDrive::gap));
  EXPECT_FALSE(drive.search.spans(BrokenDrive::gap));
  EXPECT_EQ(drive.graph.poses(), before);
}

/// A match half a turn away, where odometry was right within a tenth of a radian, is of another place.
TEST(LaserLoops, AGapIsNotBridgedFarBeyondWhatOdometryErrsBy) {
  BrokenDrive drive(oblique_room(), oblique_room(), {{0.5, 0.5}, pi}, 100.0);
  expect_stays_open(drive);
}

TEST(LaserLoops, AGapToAnotherRoomStaysOpen) {
  const std::vector<testing::Wall> corner{{{-4, 6}, {8, -3}}, {{-3, -2}, {4, 8}}};
  BrokenDrive drive(oblique_room(), corner, {{0.3, 0.2}, 0.1});
  expect_stays_open(drive);
}

/// A room that looks the same after half a turn does not tell which of two poses is right.
TEST(LaserLoops, AGapInASymmetricRoomStaysOpen) {
  BrokenDrive drive(testing::box_walls({0, 0}, {4.8, 4}), testing::box_walls({0, 0}, {4.8, 4}),
                    {{0.3, 0.2}, 0.1});
  expect_stays_open(drive);
}

/// A street between houses that stand a little back, each by as much as no other.
std::vector<testing::Wall> street(Rng& rng) {
  std::vector<testing::Wall> walls;
  for (const double side : {-1.0, 1.0}) {
    for (double x = -20.0; x < 70.0; x += 8.0) {
      const double y = side * rng.uniform(4.0, 7.0);
      for (const testing::Wall& wall : testing::box_walls(
               {x, std::min(y, side * 12.0)}, {x + rng.uniform(5.0, 7.5), std::max(y, side * 12.0)}))
        walls.push_back(wall);
    }
  }
  return walls;
}

/// A robot that drove along the street, around where it saw nothing, and along the street again.
void expect_loop_over(const Pose2& off) {
  constexpr std::uint32_t count = 40, away = 40;
  Rng rng(7);
  const std::vector<testing::Wall> walls = street(rng);
  KeyframeGraph graph;
  KeyframeSurfaces surfaces({}, 30.0);
  testing::Finder finder;
  finder.most_m = 20.0;
  std::vector<Pose2> truth;
  for (std::uint32_t i = 0; i < count + away + count; ++i) {
    const bool is_again = i >= count + away, is_away = i >= count && !is_again;
    const Pose2 pose{{static_cast<double>(is_again ? i - count - away : i), is_away ? -40.0 : 0.0}, 0.0};
    truth.push_back(pose);
    graph.keyframes.push_back(
        {is_again ? compose(off, pose) : pose, 2.0 * i, testing::scan_from(walls, pose, finder, rng)});
    Eigen::Vector3d information(1e4, 1e4, 1e4);
    if (i == count || i == count + away) information = {0.1, 0.1, 100.0};
    if (i > 0) graph.add_constraint(i - 1, i, graph.keyframes[i].pose, information.asDiagonal());
  }
  graph.update_covariance();
  ASSERT_GT(distance(graph.keyframes.back().pose.position, truth.back().position), 6.5);
  LoopSearch search;
  ASSERT_TRUE(search.close(graph, surfaces, 6.0, 0)) << off.heading_rad;
  EXPECT_LT(distance(graph.keyframes.back().pose.position, truth.back().position), 0.1);
  ASSERT_EQ(search.closed.size(), 1U);
  EXPECT_NEAR(search.closed[0].first, count - 1, 2);
}

TEST(LaserLoops, ALoopIsFoundFartherAwayThanASearchAmongSingleVisitsReaches) {
  expect_loop_over({{9.0, 2.0}, 0.08});
}

TEST(LaserLoops, ALoopIsFoundHoweverFarItsHeadingMayBeOff) {
  for (const double off_rad : {0.7, -0.75}) expect_loop_over({{9.0, 2.0}, off_rad});
}

TEST(LaserLoops, ALoopAroundSeveralGapsLeavesThePartsBetweenHanging) {
  const std::vector<std::uint32_t> gaps{10, 20, 30};
  LoopSearch search;
  EXPECT_EQ(search.open_gaps(gaps), gaps);
  search.closed.emplace_back(2, 50);
  EXPECT_TRUE(search.spans(20));
  EXPECT_EQ(search.open_gaps(gaps), gaps);
  search.bridged.emplace_back(9, 12);
  EXPECT_EQ(search.open_gaps(gaps), (std::vector<std::uint32_t>{20, 30}));
  search.closed.emplace_back(15, 25);
  EXPECT_TRUE(search.open_gaps(gaps).empty()) << "from the third part to the second, the first, the last";
}

}  // namespace
}  // namespace outrider
