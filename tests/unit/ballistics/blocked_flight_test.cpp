#include "outrider/ballistics/blocked_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace outrider {
namespace {

/// A yard of 8 m x 4 m in which the robot stands to the left of x = 0, and a target to the right.
struct Yard {
  ShotRules rules;
  Target target{"cat", {3.0, 0.0, 0.0}, {0.3, 0.3, 0.4}, 0.0};
  GridFrame frame = covering({{-4.0, -2.0}, {4.0, 2.0}}, 0.1);
  std::vector<std::uint8_t> standable;

  Yard() : standable(frame.size(), 0) {
    for (std::size_t i = 0; i < frame.size(); ++i) standable[i] = frame.centre(frame.cell(i)).x < 0.0 ? 1 : 0;
  }

  [[nodiscard]] std::optional<BlockedFlight> best(const FlightSpace& space) const {
    return best_blocked_flight(rules, space, target, frame, standable);
  }
};

Solid wall(std::string name, double x, double height) {
  return {std::move(name), {{x, 0.0, 0.5 * height}, {}}, BoxShape{{0.1, 20.0, 0.5 * height}}};
}

TEST(BlockedFlight, IsStoppedByTheWallThatStandsBetween) {
  const Yard yard;
  const FlightSpace space({wall("low", 1.0, 0.2), wall("tall", 2.0, 30.0)});
  const auto best = yard.best(space);
  ASSERT_TRUE(best);
  EXPECT_EQ(space.solids()[best->solid].name, "tall");
  EXPECT_FALSE(best->impact.hit);
  EXPECT_NEAR(best->at.x, 1.9 - yard.rules.gun.ball_radius_m, 1e-3);
  EXPECT_LT(best->position.x, 0.0);
  // From the wall to the target in a straight line, as near as a ball gets.
  EXPECT_NEAR(best->short_m, 0.95, 0.01);
}

TEST(BlockedFlight, IsTheOneAmongManyThatEndsNearest) {
  const Yard yard;
  const FlightSpace space({wall("tall", 2.0, 30.0)});
  const auto best = yard.best(space);
  ASSERT_TRUE(best);
  for (const double x : {-3.0, -2.0, -1.0}) {  // twin: level shots from a few places end no nearer
    for (const double pitch : {0.2, 0.5, 0.8}) {
      for (const double speed : {4.0, 6.0, 8.0}) {
        const Flight flight = launch(yard.rules, {{x, 0.0}, {}}, yard.target, {0.0, pitch, speed});
        const Impact impact =
            fly(flight, yard.rules.gun.ball_radius_m, space, yard.target, yard.rules.floor_z_m);
        const double away = distance(impact.position, solid_of(yard.target)) - yard.rules.gun.ball_radius_m;
        EXPECT_GT(away, best->short_m - 0.1) << x << " " << pitch << " " << speed;
      }
    }
  }
}

TEST(BlockedFlight, ThatHitsIsTheOneWithTheMostClearance) {
  const Yard yard;
  const FlightSpace space({wall("low", 1.0, 0.2)});
  const auto best = yard.best(space);
  ASSERT_TRUE(best);
  EXPECT_TRUE(best->impact.hit);
  EXPECT_EQ(best->short_m, 0.0);
  EXPECT_GT(best->clearance_m, 0.1);
}

TEST(BlockedFlight, IsNoneOutOfReach) {
  Yard yard;
  yard.target.base.x = 300.0;
  EXPECT_FALSE(yard.best(FlightSpace({})));
}

}  // namespace
}  // namespace outrider
