#include "outrider/sim/rigid/rigid_world.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;

RigidScene yard_of(std::vector<Solid> solids) {
  RigidScene scene;
  scene.world.solids = std::move(solids);
  scene.world.bounds = {{-10, -10}, {10, 10}};
  scene.start = {{-8.0, -8.0}, 0.5};
  scene.targets = {{"cat", {0.0, 9.0, 0.0}, {0.4, 0.4, 0.4}, 0.0}};
  return scene;
}

class RigidBodies : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto made = make_rigid_world(yard_of({floor_at(0.0)}));
    if (!made) GTEST_SKIP() << made.error().sentence;
  }

  static std::unique_ptr<RigidWorld> made(const RigidScene& scene) {
    auto bodies = make_rigid_world(scene);
    EXPECT_TRUE(bodies.has_value()) << bodies.error().sentence;
    return std::move(*bodies);
  }

  static Pose2 on_the_floor(const RigidWorld& bodies) {
    const Pose3 pose = bodies.world_T_robot();
    EXPECT_NEAR(pose.position.z, 0.0, 1e-4);
    EXPECT_GT(pose.rotation.axes[2].z, 1.0 - 1e-7);  // level within half a milliradian
    return {xy(pose.position), heading_of(xy(pose.rotation.axes[0]))};
  }
};

TEST_F(RigidBodies, ABallFliesItsParabolaButForTheStep) {
  Rng rng(601);
  const auto bodies = made(yard_of({floor_at(0.0)}));
  for (const double step : {0.25e-3, 1e-3}) {
    for (int i = 0; i < cases(5); ++i) {
      const Vec3 velocity{rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(0, 6)};
      const Flight flight{{rng.uniform(-2, 2), rng.uniform(-2, 2), 4.0}, velocity, 9.8};
      const std::size_t ball = bodies->throw_ball(flight, 0).value();
      for (int k = 1; k <= static_cast<int>(0.6 / step); ++k) {
        bodies->step(step);
        ASSERT_TRUE(bodies->touched_by_ball(ball).empty());
        const double t = k * step;
        const Vec3 expected = flight.position(t) - Vec3{0, 0, 0.5 * 9.8 * step * t};
        ASSERT_LT(norm(bodies->ball(ball) - expected), 1e-9) << t;
      }
      bodies->remove_ball(ball);
    }
  }
}

TEST_F(RigidBodies, AThinWallStopsABallFromAnySide) {
  Rng rng(602);
  const MeshShape sheet{{{Vec3{0, -3, -1}, Vec3{0, 3, -1}, Vec3{0, 0, 4}}}};
  const std::vector<Shape> thin{BoxShape{{0.5e-4, 3.0, 3.0}}, sheet};
  for (const Shape& shape : thin) {
    const Solid wall{"wall", {{0.0, 0.0, 1.0}, {}}, shape};
    const auto bodies = made(yard_of({floor_at(0.0), wall}));
    for (int i = 0; i < cases(16); ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const Flight flight{{side * 0.3, rng.uniform(-0.4, 0.4), 1.0},
                          {-side * rng.uniform(9.0, 10.0), rng.uniform(-3.0, 3.0), rng.uniform(0.0, 2.0)},
                          9.8};
      const std::size_t ball = bodies->throw_ball(flight, 0).value();
      std::vector<std::size_t> touched;
      Vec3 centre;
      for (int k = 0; k < 100 && touched.empty(); ++k) {
        centre = bodies->ball(ball);
        bodies->step(1e-3);
        touched = bodies->touched_by_ball(ball);
      }
      bodies->remove_ball(ball);
      ASSERT_EQ(touched, std::vector<std::size_t>{1}) << kind(shape) << " " << i;
      EXPECT_LT(std::abs(centre.x), 0.0102) << "it stops at the wall";
    }
  }
}

/// Returns the body that a thrown ball touches first, or nothing within 2 s.
std::vector<std::size_t> first_touch(RigidWorld& bodies, const Flight& flight) {
  const std::size_t ball = bodies.throw_ball(flight, 0).value();
  std::vector<std::size_t> touched;
  for (int k = 0; k < 8000 && touched.empty(); ++k) {
    bodies.step(0.25e-3);
    touched = bodies.touched_by_ball(ball);
  }
  bodies.remove_ball(ball);
  return touched;
}

TEST_F(RigidBodies, ABallTouchesWhatSmallStepsTouch) {
  Rng rng(603);
  int compared = 0;
  for (int i = 0; i < cases(2); ++i) {
    auto small = testing::random_small_yard(rng, 12, 2.0);
    const Rotation leaning = Rotation::from_rpy(0.0, rng.uniform(1.0, 2.0), rng.uniform(-pi, pi));
    const Vec3 uphill = leaning.axes[2];
    small.solids.push_back({"cliff", {-4.0 * uphill, leaning}, HalfSpaceShape{}});
    RigidScene scene = yard_of(small.solids);
    scene.targets = {small.target};
    const auto bodies = made(scene);
    const double radius = scene.ball_radius_m;
    const Solid box = solid_of(small.target);
    for (int k = 0; k < 6; ++k) {
      const Vec3 from{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(0.1, 1.5)};
      const Vec2 along = (1.0 / norm(xy(small.target.base) - xy(from))) * (xy(small.target.base) - xy(from));
      const double speed = rng.uniform(2.0, 8.0);
      const Vec3 velocity{speed * along.x, speed * along.y, rng.uniform(-2.0, 4.0)};
      const auto end_with = [&](double r) {
        return testing::fly_fine(from, velocity, 9.8, r, scene.world.solids, &box, -20.0, 1e-3);
      };
      // Only where a ball 4 mm thicker and one 4 mm thinner touch the same.
      const auto thick = end_with(radius + 4e-3);
      const auto thin = end_with(radius - 4e-3);
      if (thick.hit != thin.hit || thick.solid != thin.solid || thick.time_s == 0.0) continue;
      const std::size_t expected = thin.hit ? scene.world.solids.size() : thin.solid.value_or(999);
      if (expected == 999) continue;
      ++compared;
      const auto touched = first_touch(*bodies, {from, velocity, 9.8});
      ASSERT_EQ(touched, std::vector<std::size_t>{expected})
          << (thin.hit ? "the target" : scene.world.solids[expected].name) << " in yard " << i;
    }
  }
  EXPECT_GT(compared, cases(4));
}

TEST_F(RigidBodies, OnlyTheTargetThrownAtFeelsTheBall) {
  RigidScene scene = yard_of({floor_at(0.0), box_at("wall", {3, 0, 1}, {0.1, 2, 2})});
  scene.targets = {{"near", {1.0, 0.0, 0.5}, {0.3, 0.3, 1.0}, 0.0},
                   {"far", {2.0, 0.0, 0.5}, {0.3, 0.3, 1.0}, 0.0}};
  const Flight flight{{0, 0, 1}, {8, 0, 1}, 9.8};
  for (const bool block : {false, true}) {
    scene.targets_block = block;
    const auto bodies = made(scene);
    for (int twice = 0; twice < 2; ++twice) {
      for (std::size_t target = 0; target < 2; ++target) {
        const std::size_t ball = bodies->throw_ball(flight, target).value();
        std::vector<std::size_t> touched;
        for (int k = 0; k < 2000 && touched.empty(); ++k) {
          bodies->step(0.25e-3);
          touched = bodies->touched_by_ball(ball);
        }
        bodies->remove_ball(ball);
        EXPECT_EQ(touched, std::vector<std::size_t>{block ? 2 : 2 + target});
      }
    }
  }
}

TEST_F(RigidBodies, ManyBallsFlyAtOnceAndEachTouchesItsOwnTarget) {
  RigidScene scene = yard_of({floor_at(0.0), box_at("wall", {3, 0, 1}, {0.1, 4, 2})});
  scene.targets.clear();
  for (int i = 0; i < 14; ++i) {
    scene.targets.push_back({std::to_string(i), {0.5 + 0.15 * i, 0.0, 0.0}, {0.1, 1.0, 2.0}, 0.0});
  }
  const auto bodies = made(scene);
  const Flight flight{{0, 0, 1}, {4, 0, 2}, 9.8};  // through all targets, or to the floor
  for (std::size_t target = 0; target < 14; ++target) EXPECT_EQ(bodies->throw_ball(flight, target), target);
  EXPECT_EQ(bodies->throw_ball(flight, 0), std::nullopt) << "14 balls are all that it holds";
  std::map<std::size_t, std::vector<std::size_t>> touched;
  for (int k = 0; k < 4000 && touched.size() < 14; ++k) {
    bodies->step(0.25e-3);
    for (std::size_t ball = 0; ball < 14; ++ball) {
      if (touched.contains(ball)) continue;
      auto bodies_touched = bodies->touched_by_ball(ball);
      if (bodies_touched.empty()) continue;
      touched[ball] = std::move(bodies_touched);
      bodies->remove_ball(ball);
    }
  }
  for (std::size_t ball = 0; ball < 14; ++ball) {
    EXPECT_EQ(touched[ball], std::vector<std::size_t>{2 + ball}) << ball;
  }
  EXPECT_EQ(bodies->throw_ball(flight, 5), 0U) << "numbers are free again";
}

TEST_F(RigidBodies, TwoBallsAtOneTargetAreBothFelt) {
  RigidScene scene = yard_of({floor_at(0.0)});
  scene.targets = {{"box", {1.0, 0.0, 0.5}, {0.3, 0.3, 1.0}, 0.0}};
  const auto bodies = made(scene);
  const Flight soon{{0.5, 0, 1}, {4, 0, 1}, 9.8}, late{{0, 0, 1}, {4, 0, 1}, 9.8};
  const auto first_touched = [&](std::size_t ball) {
    std::vector<std::size_t> touched;
    for (int k = 0; k < 2000 && touched.empty(); ++k) {
      bodies->step(0.25e-3);
      touched = bodies->touched_by_ball(ball);
    }
    bodies->remove_ball(ball);
    return touched;
  };
  ASSERT_EQ(bodies->throw_ball(late, 0), 0U);
  ASSERT_EQ(bodies->throw_ball(soon, 0), 1U);
  EXPECT_EQ(first_touched(1), std::vector<std::size_t>{1});
  EXPECT_EQ(first_touched(0), std::vector<std::size_t>{1}) << "though the other one has gone";
}

TEST_F(RigidBodies, APointOfTheRobotMovesAsItsVelocitySays) {
  const auto bodies = made(yard_of({floor_at(0.0)}));
  const WheelBase base = wheel_base(RobotModel{});
  const Vec3 on_robot{0.1, 0.15, 0.3};
  bodies->turn_wheels({0.2 / base.wheel_radius_m, 0.4 / base.wheel_radius_m});
  for (int k = 0; k < 1000; ++k) bodies->step(1e-3);
  for (int k = 0; k < 20; ++k) {
    const Vec3 before = bodies->world_T_robot() * on_robot;
    bodies->step(1e-3);
    const Vec3 after = bodies->world_T_robot() * on_robot;
    const Vec3 told = bodies->velocity_at(after);
    EXPECT_GT(norm(told), 0.2);
    EXPECT_LT(norm(told - 1000.0 * (after - before)), 2e-3);
  }
}

TEST_F(RigidBodies, TheRobotStandsRollsTurnsAndIsStoppedByAWall) {
  for (const Solid& floor : {floor_at(0.0), box_at("slab", {0, 0, -0.1}, {30, 30, 0.2})}) {
    RigidScene scene = yard_of({floor, box_at("wall", {2, 0, 0.5}, {0.1, 4, 1})});
    scene.start = {{-1.0, 0.0}, 0.0};
    scene.targets = {{"cat", {0.8, 0.1, 0.0}, {0.4, 0.4, 0.4}, 0.0}};  // no obstacle
    const auto bodies = made(scene);
    const WheelBase base = wheel_base(scene.robot);
    const auto run = [&](WheelSpeeds speeds, double time_s) {
      bodies->turn_wheels(speeds);
      for (double t = 0.0; t < time_s; t += 1e-3) bodies->step(1e-3);
    };
    run({}, 1.0);
    EXPECT_LT(distance(on_the_floor(*bodies).position, scene.start.position), 1e-6);

    const double half_mps = 0.5 / base.wheel_radius_m;
    run({half_mps, half_mps}, 2.0);
    EXPECT_NEAR(on_the_floor(*bodies).position.x, 0.0, 0.02);
    EXPECT_NEAR(on_the_floor(*bodies).position.y, 0.0, 1e-6);
    EXPECT_TRUE(bodies->touched_by_robot().empty());

    run({}, 0.3);
    const double slow = 0.2 * half_mps;
    run({-slow, slow}, 1.0);
    EXPECT_NEAR(on_the_floor(*bodies).heading_rad, 0.1 / base.half_track_m, 0.015);
    run({slow, -slow}, 1.0);

    run({half_mps, half_mps}, 4.5);
    EXPECT_EQ(bodies->touched_by_robot(), std::vector<std::size_t>{1});
    EXPECT_NEAR(on_the_floor(*bodies).position.x, 1.95 - 0.9 * scene.robot.radius_m, 0.01);
  }
}

TEST(RigidWorldWithoutEngine, SaysWhatIsMissing) {
  const auto made = make_rigid_world(yard_of({floor_at(0.0)}));
  if (made) GTEST_SKIP() << "this build has the physics engine";
  EXPECT_EQ(made.error().code, FaultCode::bad_input);
  EXPECT_NE(made.error().sentence.find("install"), std::string::npos) << made.error().sentence;
}

}  // namespace
}  // namespace outrider
