#include "outrider/estimate/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr std::array<double, 5> reference_lens{0.013206, -0.013362, -0.000168, 0.000592, 0.0};

TEST(Camera, PixelCentresLieHalfAPixelIn) {
  const Camera camera;
  const auto ahead = project(camera, {0, 0, 2});
  ASSERT_TRUE(ahead);
  EXPECT_DOUBLE_EQ(ahead->x, camera.cx + 0.5);
  EXPECT_DOUBLE_EQ(ahead->y, camera.cy + 0.5);
  EXPECT_FALSE(project(camera, {0, 0, 0}));
  EXPECT_FALSE(project(camera, {0, 0, -1}));
}

TEST(Camera, LensIsThatOfTheManual) {
  Camera camera;
  camera.distortion = {0.1, -0.05, 0.002, -0.003, 0.01};
  const auto [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = 0.3, y = -0.2, r2 = x * x + y * y;
  const double radial = 1 + k1 * r2 + k2 * std::pow(r2, 2) + k3 * std::pow(r2, 3);
  const auto seen = project(camera, {0.6, -0.4, 2});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, camera.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + camera.cx + 0.5,
              1e-9);
  EXPECT_NEAR(seen->y, camera.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + camera.cy + 0.5,
              1e-9);
}

TEST(Camera, RaysGoThroughWhatTheyProjectTo) {
  Rng rng(1);
  Camera camera;
  for (const auto& lens : {std::array<double, 5>{}, reference_lens, {-0.28, 0.07, 0.001, -0.0005, 0.0}}) {
    camera.distortion = lens;
    ASSERT_TRUE(check_camera(camera) || lens[0] < 0);
    for (int i = 0; i < testing::cases(200); ++i) {
      const Vec2 image{rng.uniform(400, 1500), rng.uniform(100, 900)};
      const Vec2 ray = ray_through(camera, image);
      const auto again = project(camera, 3.0 * Vec3{ray.x, ray.y, 1.0});
      ASSERT_TRUE(again);
      EXPECT_LT(distance(*again, image), 1e-9);
    }
  }
}

TEST(Camera, RefusesWhatIsNone) {
  Camera camera;
  EXPECT_TRUE(check_camera(camera));
  camera.fx = 0.0;
  ASSERT_FALSE(check_camera(camera));
  EXPECT_NE(check_camera(camera).error().sentence.find("singular"), std::string::npos);
  camera.fx = std::nan("");
  EXPECT_FALSE(check_camera(camera));
  camera = {};
  camera.width_px = 0;
  EXPECT_FALSE(check_camera(camera));
  camera = {};
  camera.distortion = {-2.0, 0, 0, 0, 0};
  ASSERT_FALSE(check_camera(camera));
  EXPECT_NE(check_camera(camera).error().sentence.find("folds"), std::string::npos);
}

TEST(Camera, LooksAhead) {
  const Pose3 robot_T_camera = looking_ahead({0.1, 0.0, 0.2}, radians(90.0));
  const Vec3 left = robot_T_camera * Vec3{0, 0, 2};
  EXPECT_NEAR(left.x, 0.1, 1e-12);
  EXPECT_NEAR(left.y, 2.0, 1e-12);
  EXPECT_NEAR(left.z, 0.2, 1e-12);
  EXPECT_LT((looking_ahead({}, 0.0, radians(10.0)) * Vec3{0, 0, 1}).z, 0.0);
}

}  // namespace
}  // namespace outrider
