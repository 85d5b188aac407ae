// The covariance of the pose of laser SLAM against its true error, as normalised estimation error squared
// (NEES: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 2001,
// section 5.4). It is 3 on average where the covariance is right, and 3 / k^2 where it is k times too wide.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "laser_room.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct Course {
  const char* name;
  std::vector<testing::Wall> walls;
  std::vector<Vec2> corners;
  bool close_loops = true;
};

/// A hall of 24 m with pillars at uneven distances: what drifts in it comes to no place again.
std::vector<testing::Wall> hall() {
  std::vector<testing::Wall> walls = testing::box_walls({0, 0}, {24, 5});
  for (const Vec2 post : {Vec2{2.0, 0.6},
                          {4.4, 3.9},
                          {7.5, 0.9},
                          {9.6, 4.1},
                          {12.9, 0.5},
                          {15.0, 3.7},
                          {17.1, 1.0},
                          {20.4, 4.0},
                          {22.0, 0.8}}) {
    for (const testing::Wall& wall : testing::box_walls(post, post + Vec2{0.3, 0.3})) walls.push_back(wall);
  }
  return walls;
}

std::vector<Course> courses() {
  const std::vector<Vec2> through = {{0.5, 0.5}, {2.4, 0.5}, {2.4, 3.5}, {5.5, 3.5}, {5.5, 0.5},
                                     {3.5, 0.6}, {3.5, 3.4}, {0.5, 3.5}, {0.5, 0.5}};
  const std::vector<Vec2> round = {{3, 0.8}, {12.2, 0.8}, {12.2, 8.2}, {0.8, 8.2}, {0.8, 0.8}, {7, 0.8}};
  return {{"room", testing::furnished_room(), through},
          {"ring", testing::ring(), round},
          {"ring, no loops", testing::ring(), round, false},
          {"hall", hall(), {{1, 2.5}, {23, 2.5}}}};
}

/// Returns the squared error of the last keyframe in standard deviations.
double squared_error(const Course& course, double noise_m, bool biased_wheels, std::uint64_t seed) {
  Rng rng(seed);
  const testing::Drive drive = testing::drive_along(course.corners, 0.0, rng, biased_wheels ? 0.01 : 0.0);
  testing::Finder finder;
  finder.noise_m = noise_m;
  LaserSlamOptions options;
  options.close_loops = course.close_loops;
  options.learn_odometry = biased_wheels;
  auto slam = LaserSlam::begin(options, drive.poses.front());
  Pose2 truth, belief;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    const auto step =
        slam->advance(drive.motions[i], testing::scan_from(course.walls, drive.poses[i], finder, rng));
    if (!step->kept) continue;
    truth = drive.poses[i];
    belief = step->pose;
  }
  const Vec2 off = belief.position - truth.position;
  const Eigen::Vector3d error(off.x, off.y, wrap_angle(belief.heading_rad - truth.heading_rad));
  return error.dot(slam->pose_covariance().inverse() * error);
}

TEST(LaserSlamCovariance, IsHonestForOdometryAsStatedOrLearnt) {
  double sum = 0.0;
  int kinds = 0;
  const std::vector<Course> all = courses();
  for (const Course& course : all) {
    for (const double noise_m : {0.01, 0.03}) {
      for (const bool biased_wheels : {false, true}) {
        // Half of the combinations: each pair of values is among them.
        if (testing::cases(1) == 1 && (&course - all.data() + (noise_m > 0.02) + biased_wheels) % 2 != 0)
          continue;
        double nees = 0.0;
        const int seeds = testing::cases(2);
        for (int i = 0; i < seeds; ++i)
          nees += squared_error(course, noise_m, biased_wheels, static_cast<std::uint64_t>(100 + i)) / seeds;
        EXPECT_LT(nees, 7.0) << course.name << ", " << noise_m << " m";  // a mean of 3 exceeds it once in 300
        EXPECT_GT(nees, 0.1) << course.name << ", " << noise_m << " m";
        sum += nees;
        ++kinds;
      }
    }
  }
  EXPECT_LT(sum / kinds, 3.0);
  EXPECT_GT(sum / kinds, 0.75) << "at most twice too wide on average";
}

}  // namespace
}  // namespace outrider
