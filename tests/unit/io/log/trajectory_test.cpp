#include "outrider/io/log/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

Trajectory random_trajectory(std::uint64_t seed) {
  Rng rng(seed);
  Trajectory trajectory;
  std::int64_t time_ns = 1'600'000'000'123'456'789;
  for (int i = 0; i < 50; ++i) {
    geometry_msgs::Quaternion q{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1),
                                rng.uniform(-1, 1)};
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    q = {q.x / length, q.y / length, q.z / length, q.w / length};
    trajectory.push_back({time_ns, {{rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9)}, q}});
    time_ns += static_cast<std::int64_t>(rng.uniform(0, 3e9));
  }
  return trajectory;
}

TEST(Trajectory, TumComesBackBitByBit) {
  const Trajectory trajectory = random_trajectory(1);
  const auto back = trajectory_from_tum(tum_text(trajectory), "a.tum");
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(tum_text(*back), tum_text(trajectory));
  EXPECT_EQ(back->at(7).time_ns, trajectory[7].time_ns);
}

TEST(Trajectory, KittiComesBackWithTheSamePoses) {
  const Trajectory trajectory = random_trajectory(2);
  const auto back = trajectory_from_kitti(kitti_text(trajectory), "a.kitti");
  ASSERT_TRUE(back) << to_string(back.error());
  ASSERT_EQ(back->size(), trajectory.size());
  for (std::size_t i = 0; i < back->size(); ++i) {
    const auto& [at, q] = trajectory[i].message;
    const auto& [other_at, p] = (*back)[i].message;
    EXPECT_EQ(other_at.x, at.x);
    EXPECT_NEAR(std::abs(q.x * p.x + q.y * p.y + q.z * p.z + q.w * p.w), 1.0,
                1e-12);  // q and -q are one rotation
    EXPECT_EQ((*back)[i].time_ns, static_cast<std::int64_t>(i) * 100'000'000);
  }
}

TEST(Trajectory, TheFormatsAreThoseOfTheBenchmarks) {
  const Trajectory quarter = {stamped_pose(1.5, {{1.0, 2.0}, 0.5 * pi})};
  const auto tum = tum_text({{1'500'000'000, {{1, 2, 3}, {0, 0, 0, 1}}}});
  EXPECT_EQ(tum, "# time x y z qx qy qz qw\n1.500000000 1 2 3 0 0 0 1\n");
  EXPECT_EQ(kitti_text({{0, {{1, 2, 3}, {0, 0, 0, 1}}}}), "1 0 0 1 0 1 0 2 0 0 1 3\n");
  const auto read = trajectory_from_kitti("0 -1 0 1 1 0 0 2 0 0 1 0\n", "a");
  ASSERT_TRUE(read);
  EXPECT_NEAR(heading_of(read->front().message.orientation), heading_of(quarter[0].message.orientation),
              1e-12);
}

TEST(Trajectory, TimesInOtherFormsAreRead) {
  const auto back = trajectory_from_tum("1.5e9 0 0 0 0 0 0 1\n1500000000.25 0 0 0 0 0 0 1 # late\n", "a");
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->at(0).time_ns, 1'500'000'000'000'000'000);
  EXPECT_EQ(back->at(1).time_ns, 1'500'000'000'250'000'000);
}

TEST(Trajectory, WrongLinesAreRefusedWithTheirPlace) {
  const auto tum = [](const char* text) {
    const auto read = trajectory_from_tum(text, "a.tum");
    return read ? "it was read" : to_string(read.error());
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(tum("1 0 0 0 0 0 0\n"), "a.tum:1: 6 numbers where a line is 'time x y z qx qy qz qw'");
  has(tum("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), "a.tum:2: the time goes back to 1 s");
  has(tum("-1 0 0 0 0 0 0 1\n"), "'-1' is no time from 0");
  has(tum("1e30 0 0 0 0 0 0 1\n"), "is no time");
  has(tum("x 0 0 0 0 0 0 1\n"), "'x' is no time");
  has(tum("1 0 0 0 0 0 0 2\n"), "has the length 2.000, and not 1");
  has(tum("1 0 nan 0 0 0 0 1\n"), "'nan' is no number");
  has(tum("# nothing\n"), "a.tum: it has no pose");
  const auto kitti = [](const char* text) { return to_string(trajectory_from_kitti(text, "k").error()); };
  has(kitti("1 0 0 0 0 1 0 0 0 0 -1 0\n"), "k:1: the rotation in it is none");
  has(kitti("1 2 3\n"), "k:1: 3 numbers");
  has(kitti(""), "k: it has no pose");
}

}  // namespace
}  // namespace outrider
