#include "outrider/sim/bodies/navigated_body.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "outrider/sim/navigation.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

constexpr double within_m = 0.02;

/// A robot at the origin of open ground, with these solids around it, of which it has no map.
NavigatedBody body_among(std::vector<Solid> solids) {
  NavigationOptions options;
  options.navigator.localiser = "exact";
  options.navigator.most_recoveries = 2;
  RobotModel robot;
  const Footprint footprint = Footprint::disk(robot.radius_m);
  World world;
  world.bounds = {{-5, -5}, {5, 5}};
  world.solids = std::move(solids);
  auto navigator = Navigator::make(setup_of(options, robot, footprint), Pose2{});
  return {std::make_unique<const World>(std::move(world)),
          {},
          robot,
          devices_of(options, footprint),
          1,
          std::move(*navigator),
          within_m};
}

const auto on_and_on = [] { return true; };

TEST(NavigatedBody, GoesAroundABoxAndStandsAtTheGoal) {
  NavigatedBody body = body_among({testing::box_at("box", {1.5, 0, 0.5}, {0.5, 1.0, 1.0})});
  body.begin_way();
  body.drive_to({3.0, 0.0}, on_and_on);
  EXPECT_EQ(body.why_stopped(), "");
  EXPECT_LE(distance(body.pose().position, Vec2{3.0, 0.0}), body.position_error_m());
  EXPECT_GT(body.driven_m(), 3.1);
  EXPECT_LT(std::abs(body.twist().ahead_mps), 0.05);
  EXPECT_EQ(body.wheels().contacts(), 0);
  EXPECT_EQ(body.believed_pose().position, body.pose().position);
}

TEST(NavigatedBody, SaysWhyItDoesNotGetToAPlaceThatIsTaken) {
  NavigatedBody body = body_among({testing::box_at("box", {2, 0, 0.5}, {1.0, 1.0, 1.0})});
  body.begin_way();
  body.drive_to({2.0, 0.0}, on_and_on);
  EXPECT_NE(body.why_stopped(), "");
  EXPECT_EQ(body.wheels().contacts(), 0);
  const Vec2 here = body.pose().position;
  body.begin_way();
  EXPECT_EQ(body.why_stopped(), "");
  body.drive_to({0.0, 0.0}, on_and_on);
  EXPECT_EQ(body.why_stopped(), "");
  EXPECT_GT(distance(here, body.pose().position), 0.5);
}

TEST(NavigatedBody, EndsADriveWhenAskedToAndWaits) {
  NavigatedBody body = body_among({});
  int periods = 0;
  body.drive_to({3.0, 0.0}, [&] { return ++periods < 20; });
  EXPECT_EQ(periods, 20);
  EXPECT_NEAR(body.time_s(), 1.0, 1e-9);
  body.wait_until(2.03);
  EXPECT_NEAR(body.time_s(), 2.03, 1e-9);
  EXPECT_EQ(body.twist().ahead_mps, 0.0);
}

TEST(NavigatedBody, ShowsEachPeriodAndHearsTheStop) {
  NavigatedBody body = body_among({});
  std::stop_source stop;
  int looks = 0;
  body.watch(
      [&](const Observation&, const Situation&, const Navigator&) {
        if (++looks == 10) stop.request_stop();
      },
      stop.get_token());
  body.drive_to({3.0, 0.0}, on_and_on);
  EXPECT_EQ(looks, 10);
  EXPECT_EQ(body.why_stopped(), "");
}

}  // namespace
}  // namespace outrider
