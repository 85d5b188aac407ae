#include "outrider/sim/bodies/wheel_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

const Chassis chassis = mecanum_chassis(0.03, 0.1225);
constexpr double held_s = 1e9;  // a command is held until the next one

/// Returns the pose of the robot after that command was held for so long and it has come to rest.
Pose2 after(const Twist2& command, double time_s, const WheelFaults& faults, const LinkFaults& link = {}) {
  WheelBody motion(chassis, faults, link, held_s, {}, Rng(1));
  motion.send({});
  motion.run_until(1.0);
  motion.send(wheel_speeds(chassis, command));
  motion.run_until(1.0 + time_s);
  motion.send({});
  motion.run_until(5.0 + time_s);
  return motion.pose();
}

TEST(WheelBody, WithoutFaultsItDoesWhatItIsTold) {
  const Twist2 twist{0.2, 0.1, 0.3};
  const Pose2 end = after(twist, 2.0, {});
  const Pose2 exact = moved({}, twist, 2.0);
  EXPECT_NEAR(distance(end.position, exact.position), 0.0, 1e-9);
  EXPECT_NEAR(end.heading_rad, exact.heading_rad, 1e-9);
}

/// distance = a t + b with b = -a times the dead time: a lag gives back at the end what it took at first.
TEST(WheelBody, DeadTimeAndLagMakeTheLaw) {
  WheelFaults faults;
  faults.dead_time_s = 0.1;
  faults.lag_s = 0.08;
  for (const double time_s : {1.0, 2.0, 4.0}) {
    EXPECT_NEAR(after({0.2, 0.0, 0.0}, time_s, faults).position.x, 0.2 * (time_s - 0.1), 0.002);
  }
}

TEST(WheelBody, EachFaultDoesItsHarm) {
  WheelFaults faults;
  faults.strafe_slip = 0.2;
  EXPECT_NEAR(after({0.0, 0.2, 0.0}, 2.0, faults).position.y, 0.8 * 0.4, 1e-9);
  faults = {};
  faults.gains = {0.9, 1.1, 0.9, 1.1};
  EXPECT_NEAR(after({0.2, 0.0, 0.0}, 2.0, faults).heading_rad, 0.1 * 0.4 / 0.1225, 1e-9);
  faults = {};
  faults.backwards = 0.9;
  EXPECT_NEAR(after({-0.2, 0.0, 0.0}, 2.0, faults).position.x, -0.36, 1e-9);
  EXPECT_NEAR(after({0.2, 0.0, 0.0}, 2.0, faults).position.x, 0.4, 1e-9);
  faults = {};
  faults.deadband_radps = 1.0;
  EXPECT_EQ(after({0.02, 0.0, 0.0}, 2.0, faults).position.x, 0.0);
  faults = {};
  faults.sag_per_min = 0.3;
  EXPECT_NEAR(after({0.2, 0.0, 0.0}, 4.0, faults).position.x, 0.8 * (1.0 - 0.5 * 0.3 * 4.0 / 60.0), 1e-3);
}

TEST(WheelBody, TheLinkLosesTheFirstMessageAndDelays) {
  const WheelSpeeds4 speeds = wheel_speeds(chassis, {0.2, 0.0, 0.0});
  WheelBody lossy(chassis, {}, {1, 0.0, 0.0}, held_s, {}, Rng(1));
  lossy.send(speeds);
  lossy.run_until(1.0);
  EXPECT_EQ(lossy.driven_m(), 0.0);
  lossy.send(speeds);
  lossy.run_until(2.0);
  EXPECT_NEAR(lossy.driven_m(), 0.2, 1e-9);
  WheelBody late(chassis, {}, {0, 0.25, 0.0}, held_s, {}, Rng(1));
  late.send(speeds);
  late.run_until(1.0);
  EXPECT_NEAR(late.driven_m(), 0.2 * 0.75, 1e-3);
}

TEST(WheelBody, MessagesKeepTheirOrder) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(20); ++round) {
    WheelBody motion(chassis, {}, {0, 0.05, 0.2}, held_s, {}, rng.child(static_cast<std::uint64_t>(round)));
    for (int i = 0; i < 10; ++i) {
      motion.send(wheel_speeds(chassis, {0.1, 0.0, 0.0}));
      motion.run_until(0.02 * (i + 1));
    }
    motion.send({});
    motion.run_until(2.0);
    EXPECT_EQ(motion.twist(), Twist2{}) << "an older message overtook the last one";
  }
}

TEST(WheelBody, StopsWhenNoCommandComes) {
  LinkFaults link;
  link.down_from_s = 1.0;
  for (const double patience_s : {0.2, 0.5, held_s}) {
    WheelBody motion(chassis, {}, link, patience_s, {}, Rng(1));
    for (int i = 0; i < 30; ++i) {
      motion.send(wheel_speeds(chassis, {0.2, 0.0, 0.0}));
      motion.run_until(0.1 * (i + 1));
    }
    EXPECT_NEAR(motion.driven_m(), 0.2 * std::min(3.0, 0.9 + patience_s), 0.002);
  }
}

TEST(WheelBody, NoiseHasItsDeviation) {
  WheelFaults faults;
  faults.noise = 0.05;
  double square = 0.0;
  const int count = testing::cases(200);
  for (int k = 0; k < count; ++k) {
    WheelBody motion(chassis, faults, {}, held_s, {}, Rng(static_cast<std::uint64_t>(k)));
    motion.send(wheel_speeds(chassis, {0.2, 0.0, 0.0}));
    motion.run_until(2.0);
    const double off = motion.twist().ahead_mps / 0.2 - 1.0;
    square += off * off / count;
  }
  EXPECT_NEAR(std::sqrt(square), 0.05 / 2.0, 0.004);  // the mean of four wheels
}

TEST(WheelBody, AWheelSticksForAWhile) {
  WheelFaults faults;
  faults.stuck_wheel = 2;
  faults.stuck_from_s = 1.5;
  faults.stuck_for_s = 0.5;
  const Pose2 end = after({0.2, 0.0, 0.0}, 2.0, faults);
  const Pose2 free = after({0.2, 0.0, 0.0}, 2.0, {});
  EXPECT_GT(std::abs(end.heading_rad), 0.05);
  faults.stuck_from_s = 20.0;
  EXPECT_EQ(after({0.2, 0.0, 0.0}, 2.0, faults).position.x, free.position.x);
}

}  // namespace
}  // namespace outrider
