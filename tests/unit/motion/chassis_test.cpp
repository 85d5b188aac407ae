#include "outrider/motion/chassis.hpp"

#include <gtest/gtest.h>

#include "outrider/motion/wheel_faults.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

std::vector<Chassis> all() {
  return {differential_chassis(0.03, 0.1), mecanum_chassis(0.03, 0.1225), holonomic_chassis(0.03, 0.15)};
}

TEST(Chassis, MecanumAsPublished) {
  constexpr double r = 0.03, l = 0.1225;
  const double matrix[4][3] = {{1, -1, -l}, {1, 1, l}, {1, 1, -l}, {1, -1, l}};
  const Twist2 twist{0.2, -0.1, 0.7};
  const WheelSpeeds4 speeds = wheel_speeds(mecanum_chassis(r, l), twist);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(speeds[i], (matrix[i][0] * 0.2 + matrix[i][1] * -0.1 + matrix[i][2] * 0.7) / r, 1e-12);
  }
}

TEST(Chassis, ForwardAndInverseAgree) {
  Rng rng(1);
  for (const Chassis& chassis : all()) {
    for (int round = 0; round < testing::cases(200); ++round) {
      Twist2 twist{rng.normal(), rng.normal(), rng.normal()};
      if (!chassis.moves_sideways()) twist.left_mps = 0.0;
      const Twist2 back = twist_of(chassis, wheel_speeds(chassis, twist));
      EXPECT_NEAR(back.ahead_mps, twist.ahead_mps, 1e-12) << chassis.kind;
      EXPECT_NEAR(back.left_mps, twist.left_mps, 1e-12) << chassis.kind;
      EXPECT_NEAR(back.turn_radps, twist.turn_radps, 1e-12) << chassis.kind;
    }
  }
}

/// The rim of a wheel that rolls moves as the body does at its hub, along the way it can roll.
TEST(Chassis, WheelsRollWithTheirHubs) {
  const Twist2 twist{0.3, 0.2, -0.5};
  const auto hub = [&](Vec2 at) {
    return Vec2{twist.ahead_mps, twist.left_mps} + twist.turn_radps * perpendicular(at);
  };
  const WheelSpeeds4 two = wheel_speeds(differential_chassis(0.05, 0.1), twist);
  EXPECT_NEAR(0.05 * two[0], hub({0, 0.1}).x, 1e-12);
  EXPECT_NEAR(0.05 * two[1], hub({0, -0.1}).x, 1e-12);
  const WheelSpeeds4 three = wheel_speeds(holonomic_chassis(0.05, 0.2), twist);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 out = direction(2.0 * pi / 3.0 * static_cast<double>(i));
    EXPECT_NEAR(0.05 * three[i], dot(hub(0.2 * out), perpendicular(out)), 1e-12);
  }
}

TEST(Chassis, ForwardIsTheBestFit) {
  Rng rng(2);
  for (const Chassis& chassis : all()) {
    for (int round = 0; round < testing::cases(50); ++round) {
      WheelSpeeds4 speeds{};
      for (std::size_t i = 0; i < chassis.wheels.size(); ++i) speeds[i] = rng.uniform(-10.0, 10.0);
      const auto misfit = [&](const Twist2& twist) {
        double sum = 0.0;
        const WheelSpeeds4 explained = wheel_speeds(chassis, twist);
        for (std::size_t i = 0; i < most_wheels; ++i) {
          sum += (explained[i] - speeds[i]) * (explained[i] - speeds[i]);
        }
        return sum;
      };
      const Twist2 best = twist_of(chassis, speeds);
      for (int k = 0; k < 20; ++k) {
        EXPECT_LE(misfit(best), misfit(best + 0.1 * Twist2{rng.normal(), rng.normal(), rng.normal()}) + 1e-9);
      }
    }
  }
}

TEST(Chassis, ByName) {
  EXPECT_EQ(make_chassis("mecanum", 0.03, 0.1)->wheels.size(), 4U);
  EXPECT_FALSE(make_chassis("differential", 0.03, 0.1)->moves_sideways());
  const auto refused = make_chassis("mecanumm", 0.03, 0.1);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("did you mean 'mecanum'"), std::string::npos);
}

TEST(WheelFaults, DefaultsLieInTheirRanges) {
  WheelFaults faults;
  LinkFaults link;
  for (const auto& options : {describe(faults), describe(link)}) {
    for (const Option& option : options) EXPECT_TRUE(assign(option, value_text(option))) << option.name;
  }
}

}  // namespace
}  // namespace outrider
