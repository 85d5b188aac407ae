#include "outrider/sim/sensors/tag_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

const CollisionMap open_ground({{-5, -5}, {5, 5}}, {});

const RobotCamera camera{{}, looking_ahead({0.0, 0.0, 0.2})};

std::size_t seen(const Tag& tag, const Pose2& pose, const CollisionMap& ground = open_ground) {
  Rng rng(1);
  return modelled_sightings({{tag}}, camera, {.missed = 0.0}, ground, pose, rng).size();
}

TEST(TagModel, SeesWhatIsInFrontOnly) {
  const Tag tag = upright_tag(1, {2, 0, 0.2}, pi);
  EXPECT_EQ(seen(tag, {{0, 0}, 0.0}), 1U);
  EXPECT_EQ(seen(tag, {{0, 0}, pi}), 0U) << "behind";
  EXPECT_EQ(seen(tag, {{0, 0}, 0.95}), 0U) << "beside the image";
  EXPECT_EQ(seen(tag, {{4, 0}, pi}), 0U) << "from its back";
  EXPECT_EQ(seen(tag, {{1.95, 1}, -pi / 2}), 0U) << "too flat";
  EXPECT_EQ(seen(upright_tag(1, {40, 0, 0.2}, pi), {{0, 0}, 0.0}, {{{-5, -5}, {50, 5}}, {}}), 0U)
      << "too small";
}

TEST(TagModel, WallsHideWhatIsBehindThem) {
  const Tag tag = upright_tag(1, {2, 0, 0.2}, pi);
  const auto wall = [](double x) {
    return CollisionMap({{-5, -5}, {5, 5}}, {{{{x, -1}, {x + 0.1, -1}, {x + 0.1, 1}, {x, 1}}, 0.0}});
  };
  EXPECT_EQ(seen(tag, {{0, 0}, 0.0}, wall(1.0)), 0U);
  EXPECT_EQ(seen(tag, {{0, 0}, 0.0}, wall(2.0)), 1U) << "the wall that bears it";
}

TEST(TagModel, PosesAreNearTheTruth) {
  const Tag tag = upright_tag(7, {1.5, 0.3, 0.2}, pi - 0.4);
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    const auto sightings = modelled_sightings({{tag}}, camera, {}, open_ground, {}, rng);
    if (sightings.empty()) continue;
    EXPECT_EQ(sightings[0].id, 7);
    const Vec3 at = (camera.robot_T_camera * sightings[0].poses[0].camera_T_tag).position;
    EXPECT_NEAR(at.x, 1.5, 0.05);
    EXPECT_NEAR(at.y, 0.3, 0.02);
    EXPECT_NEAR(at.z, 0.2, 0.02);
  }
}

}  // namespace
}  // namespace outrider
