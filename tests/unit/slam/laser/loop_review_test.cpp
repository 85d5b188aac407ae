// A loop that was closed wrongly is undone when later scans or later loops contradict it.
#include "laser/loop_review.hpp"

#include <gtest/gtest.h>

#include "laser/laser_loops.hpp"
#include "laser_room.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t visit = 20, since = 13;

/// A robot drove through a hall and, `away_m` further on, past what looked like its middle, where a loop was
/// closed. Then it saw the walls `further`.
struct LoopedDrive {
  KeyframeGraph graph;
  KeyframePair loop{8, visit};
  std::vector<Pose2> driven;  ///< where it is without the loop

  LoopedDrive(double away_m, const std::vector<testing::Wall>& hall,
              const std::vector<testing::Wall>& further) {
    Rng rng(3);
    testing::Finder finder;
    finder.most_m = 8.0;
    for (std::uint32_t i = 0; i < visit + since; ++i) {
      const double x = i < visit ? 0.25 * i : 2.0 + 0.25 * (i - visit);
      const Pose2 seen{{x, 0.0}, 0.0};  // where it saw what it saw, in the frame of the hall
      const Pose2 pose{{i < visit ? x : x + away_m, 0.0}, 0.0};
      driven.push_back(pose);
      const auto& walls = i <= visit ? hall : further;
      graph.keyframes.push_back({pose, 0.25 * i, testing::scan_from(walls, seen, finder, rng)});
      const double information = i == visit ? 1.0 : 1e4;
      if (i > 0) graph.add_constraint(i - 1, i, pose, information * Eigen::Matrix3d::Identity());
    }
    graph.add_constraint(loop.first, loop.second, {{2.0, 0.0}, 0.0}, 1e4 * Eigen::Matrix3d::Identity());
    EXPECT_TRUE(graph.optimise());
  }

  [[nodiscard]] double moved_m() const {
    return distance(graph.keyframes.back().pose.position, driven.back().position);
  }
};

std::vector<testing::Wall> wide_hall() { return testing::box_walls({-4, -3}, {9, 3}); }

std::vector<testing::Wall> narrow_hall() { return testing::box_walls({-4, -1.2}, {4.8, 1.2}); }

TEST(LoopReview, ALoopIsUndoneThatLaterScansContradict) {
  LoopedDrive drive(9.0, wide_hall(), narrow_hall());
  ASSERT_GT(drive.moved_m(), 8.0) << "the loop pulled the robot";
  LoopSearch search;
  search.closed = {drive.loop};
  ASSERT_EQ(drive.loop.second + 12, drive.graph.keyframes.size() - 1) << "the moment at which it is judged";
  ASSERT_TRUE(search.review(drive.graph, {}));
  EXPECT_LT(drive.moved_m(), 0.01);
  EXPECT_TRUE(search.closed.empty());
  EXPECT_EQ(search.undone, (std::vector<KeyframePair>{drive.loop}));
  EXPECT_EQ(drive.graph.constraints().size(), drive.graph.keyframes.size() - 1);
}

TEST(LoopReview, ALoopStaysThatLaterScansConfirm) {
  LoopedDrive drive(9.0, wide_hall(), wide_hall());
  LoopSearch search;
  search.closed = {drive.loop};
  EXPECT_FALSE(is_contradicted_since(drive.graph, {}, drive.loop));
  EXPECT_FALSE(search.review(drive.graph, {}));
  EXPECT_GT(drive.moved_m(), 8.0);
  EXPECT_EQ(search.closed.size(), 1U);
}

/// The robot did not move away: the walls did, and they contradict the map with the loop and without.
TEST(LoopReview, ALoopIsNotBlamedForWhatMoved) {
  LoopedDrive drive(0.0, wide_hall(), narrow_hall());
  ASSERT_TRUE(is_contradicted_since(drive.graph, {}, drive.loop));
  LoopSearch search;
  search.closed = {drive.loop};
  const std::vector<Pose2> before = drive.graph.poses();
  EXPECT_FALSE(search.review(drive.graph, {}));
  EXPECT_EQ(drive.graph.poses(), before);
  EXPECT_EQ(drive.graph.constraints().size(), drive.graph.keyframes.size());
}

/// Twice round a square of 40 m without scans. The odometry drifts as stated.
struct Rounds {
  static constexpr std::uint32_t round = 40, count = 2 * round;
  std::vector<Pose2> truth;
  KeyframeGraph graph;

  Rounds() {
    Rng rng(5);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 2.0 * pi * i / round;
      truth.push_back({6.4 * direction(angle), wrap_angle(angle + 0.5 * pi)});
      Pose2 pose = truth.back();
      if (i > 0) {
        const Pose2 step = relative_pose(truth[i - 1], truth[i]);
        const Pose2 off{{0.1 * rng.normal(), 0.1 * rng.normal()}, 0.01 * rng.normal()};
        pose = compose(graph.keyframes[i - 1].pose, compose(step, off));
      }
      graph.keyframes.push_back({pose, 1.0 * i, {}});
      const Eigen::Vector3d information(100.0, 100.0, 1e4);
      if (i > 0) graph.add_constraint(i - 1, i, pose, information.asDiagonal());
    }
  }
  /// Adds the constraint that `to` is seen from `from` as from `place`.
  void add_loop(std::uint32_t from, std::uint32_t to, std::uint32_t place) {
    const Pose2 there = compose(graph.keyframes[from].pose, relative_pose(truth[place], truth[to]));
    graph.add_constraint(from, to, there, Eigen::Vector3d(1e3, 1e3, 1e5).asDiagonal());
  }
  /// The largest error of a pose in the second round as seen from the same place in the first.
  [[nodiscard]] double worst_error_m() const {
    double worst_m = 0.0;
    for (std::uint32_t i = 0; i < round; ++i) {
      const Pose2 off = relative_pose(graph.keyframes[i].pose, graph.keyframes[i + round].pose);
      worst_m = std::max(worst_m, norm(off.position));
    }
    return worst_m;
  }
};

TEST(LoopReview, AWrongLoopGivesWayToTheLoopsThatItContradicts) {
  Rounds rounds;
  LoopSearch search;
  rounds.add_loop(3, 43, 0);  // it is at 3, and was taken for being where 0 is
  search.closed.emplace_back(3, 43);
  ASSERT_TRUE(rounds.graph.optimise());
  ASSERT_GT(rounds.worst_error_m(), 2.5);
  for (const std::uint32_t place : {8U, 20U}) {
    const std::vector<Pose2> before = rounds.graph.poses();
    rounds.add_loop(place, place + Rounds::round, place);
    search.rivals.push_back(rounds.graph.last_constraint());
    ++search.rivals_found;
    rounds.graph.remove_last_constraint(before);
  }
  ASSERT_TRUE(search.review(rounds.graph, {}));
  EXPECT_LT(rounds.worst_error_m(), 1.0);
  EXPECT_EQ(search.undone, (std::vector<KeyframePair>{{3, 43}}));
  EXPECT_EQ(search.closed, (std::vector<KeyframePair>{{8, 48}, {20, 60}}));
  EXPECT_TRUE(search.rivals.empty());
}

TEST(LoopReview, ARivalThatContradictsRightLoopsStaysRefused) {
  Rounds rounds;
  LoopSearch search;
  for (const std::uint32_t place : {2U, 8U, 20U}) {
    rounds.add_loop(place, place + Rounds::round, place);
    search.closed.emplace_back(place, place + Rounds::round);
  }
  ASSERT_TRUE(rounds.graph.optimise());
  const std::vector<Pose2> before = rounds.graph.poses();
  rounds.add_loop(14, 54, 10);
  search.rivals.push_back(rounds.graph.last_constraint());
  ++search.rivals_found;
  rounds.graph.remove_last_constraint(before);
  EXPECT_FALSE(search.review(rounds.graph, {}));
  EXPECT_EQ(search.closed.size(), 3U);
  EXPECT_TRUE(search.undone.empty());
  EXPECT_EQ(rounds.graph.poses(), before);
}

}  // namespace
}  // namespace outrider
