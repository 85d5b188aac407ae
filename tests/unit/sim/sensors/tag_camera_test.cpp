#include "outrider/sim/sensors/tag_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/estimate/localise.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const RobotCamera mount{Camera{}, looking_ahead({0.05, 0.0, 0.15})};

Solid box(Vec3 centre, Vec3 half_size) { return {"box", {centre, {}}, BoxShape{half_size}}; }

/// Walls to the east and to the north with three tags.
TagScene corner() {
  TagScene scene;
  scene.world.solids = {box({2.05, 1.0, 0.25}, {0.05, 1.5, 0.25}), box({1.0, 2.55, 0.25}, {1.5, 0.05, 0.25})};
  scene.tags = {{upright_tag(1, {2.0, 1.0, 0.25}, pi), upright_tag(2, {1.0, 2.5, 0.2}, -pi / 2),
                 upright_tag(4, {2.0, 0.2, 0.2}, pi)}};
  return scene;
}

Pose3 camera_at(const Pose2& robot) {
  return Pose3{{robot.position.x, robot.position.y, 0.0}, Rotation::from_rpy(0, 0, robot.heading_rad)} *
         mount.robot_T_camera;
}

Pose2 random_robot(Rng& rng) {
  return {{rng.uniform(-0.2, 1.2), rng.uniform(-0.4, 1.2)}, rng.uniform(0.0, pi / 2)};
}

std::vector<Vec2> corners_seen(const Tag& tag, const Pose3& world_T_camera) {
  std::vector<Vec2> seen;
  for (const Vec3 corner : tag_corners(tag.size_m)) {
    if (const auto p = project(mount.camera, world_T_camera.to_local(tag.world_T_tag * corner))) {
      seen.push_back(*p);
    }
  }
  return seen;
}

bool is_in_image(Vec2 p) {
  return p.x >= 4 && p.y >= 4 && p.x <= mount.camera.width_px - 4 && p.y <= mount.camera.height_px - 4;
}

TEST(TagCamera, WhatIsRenderedIsDetectedWhereItIs) {
  Rng rng(41);
  const TagScene scene = corner();
  TagCamera eye(scene, mount, {}, Rng(1));
  double squares = 0.0, position = 0.0, heading = 0.0;
  int corners = 0, expected = 0, seen = 0, fixes = 0;
  for (int i = 0; i < testing::cases(25); ++i) {
    const Pose2 robot = random_robot(rng);
    const auto sightings = eye.look(robot, robot);
    for (const Tag& tag : scene.tags.tags) {
      const auto there = corners_seen(tag, camera_at(robot));
      expected += there.size() == 4 && std::ranges::all_of(there, is_in_image) ? 1 : 0;
    }
    for (const TagSighting& sighting : sightings) {
      ++seen;
      const auto there = corners_seen(*scene.tags.find(sighting.id), camera_at(robot));
      for (std::size_t c = 0; c < 4; ++c) squares += squared_norm(there[c] - sighting.corners_px[c]);
      corners += 4;
    }
    const PoseBelief prior{robot, 1e-2 * Eigen::Matrix3d::Identity()};
    const TagFix fix = localise(sightings, scene.tags, mount, prior);
    if (!fix.belief || sightings.size() < 2) continue;
    ++fixes;
    position += distance(fix.belief->world_T_robot.position, robot.position);
    heading += std::abs(wrap_angle(fix.belief->world_T_robot.heading_rad - robot.heading_rad));
  }
  EXPECT_GE(seen, expected * 95 / 100);
  EXPECT_LT(std::sqrt(squares / corners), 0.5) << "px";
  ASSERT_GT(fixes, 5);
  EXPECT_LT(position / fixes, 0.02);
  EXPECT_LT(heading / fixes, 0.01);
}

TEST(TagCamera, SeesNothingBehindBoxesOrFromBehind) {
  TagScene scene;
  scene.tags = {{upright_tag(9, {1.5, 0.0, 0.15}, pi)}};
  const Pose2 robot;
  const auto seen = [&] { return TagCamera(scene, mount, {}, Rng(2)).look(robot, robot).size(); };
  EXPECT_EQ(seen(), 1U);
  scene.world.solids = {box({1.0, 0.0, 0.15}, {0.05, 0.3, 0.3})};
  EXPECT_EQ(seen(), 0U);
  EXPECT_TRUE(tag_boxes(mount.camera, scene, camera_at(robot), camera_at(robot)).empty()) << "not rendered";
  scene.world.solids = {box({1.0, 0.2, 0.15}, {0.05, 0.18, 0.3})};  // hides a part
  EXPECT_EQ(seen(), 0U);
  EXPECT_EQ(tag_boxes(mount.camera, scene, camera_at(robot), camera_at(robot)).size(), 1U);
  scene.world.solids = {box({1.6, 0.0, 0.15}, {0.1, 0.3, 0.3})};  // its wall
  EXPECT_EQ(seen(), 1U);
  scene.world.solids = {{"post", {{1.0, 0.0, 0.2}, {}}, CylinderShape{0.2, 0.2}}};
  EXPECT_EQ(seen(), 0U);
  scene.world.solids.clear();
  scene.tags = {{upright_tag(9, {1.5, 0.0, 0.15}, 0.0)}};
  EXPECT_EQ(seen(), 0U) << "its back";
  scene.tags = {{upright_tag(9, {0.55, 0.62, 0.15}, pi)}};
  EXPECT_EQ(seen(), 0U) << "half out of the image";
}

TEST(TagCamera, BoxesShowWhatTheWholeImageShows) {
  TagScene scene = corner();
  scene.world.solids.push_back(box({1.4, 0.9, 0.1}, {0.1, 0.1, 0.12}));
  Camera small = mount.camera;  // the same view, of a quarter of the pixels
  small.width_px = 480;
  small.height_px = 270;
  small.fx *= 0.25, small.fy *= 0.25, small.cx *= 0.25, small.cy *= 0.25;
  small.distortion = {0.013, -0.013, -0.0002, 0.0006, 0.0};
  TagCameraOptions options;
  options.noise_grey = 0.0;
  options.least_tag_px = 5.0;
  const Pose3 from = camera_at({{0.2, 0.4}, 0.7}), to = camera_at({{0.21, 0.4}, 0.71});
  const auto boxes = tag_boxes(small, scene, from, to, options);
  ASSERT_FALSE(boxes.empty());
  const RenderedImage parts = render_tags(small, scene, from, to, boxes, options, Rng(1));
  const RenderedImage whole = render_tags(small, scene, from, to, {{0, 0, 480, 270}}, options, Rng(1));
  for (const PixelBox& b : boxes) {
    for (int y = b.top; y < b.bottom; ++y) {
      for (int x = b.left; x < b.right; ++x) {
        ASSERT_EQ(parts.image.at(x, y), whole.image.at(x, y)) << x << ' ' << y;
      }
    }
  }
}

/// The grey of a wall with one tag by points spread over a pixel and over the exposure, each found by
/// solving for the plane: nothing of the renderer is used.
double grey_by_points(const Tag& tag, const TagPattern& pattern, const std::vector<Pose3>& cameras, int x,
                      int y) {
  constexpr int across = 12;
  double sum = 0.0;
  for (const Pose3& camera : cameras) {
    for (int i = 0; i < across * across; ++i) {
      const Vec2 image{x + (i % across + 0.5) / across, y + (i / across + 0.5) / across};
      const Vec2 ray = ray_through(mount.camera, image);
      const Vec3 along = camera.rotation * Vec3{ray.x, ray.y, 1.0};
      const Vec3 normal = tag.world_T_tag.rotation.axes[2];
      const double t = dot(normal, tag.world_T_tag.position - camera.position) / dot(normal, along);
      const Vec3 on_paper = tag.world_T_tag.to_local(camera.position + t * along);
      const double cell = tag.size_m / 8.0;
      const auto column = static_cast<std::size_t>(on_paper.x / cell + 5.0);
      const auto row = static_cast<std::size_t>(on_paper.y / cell + 5.0);
      sum += pattern.white.at(row * 10 + column) ? 220.0 : 30.0;
    }
  }
  return sum / (across * across * static_cast<double>(cameras.size()));
}

TEST(TagCamera, PixelsAreMeansOverAreaAndExposure) {
  TagScene scene;
  const Tag tag = upright_tag(17, {1.2, 0.1, 0.2}, pi - 0.5);
  scene.tags = {{tag}};
  TagCameraOptions options;
  options.noise_grey = 0.0;
  options.samples = 8;
  for (const double turned : {0.0, 0.006}) {
    const Pose3 from = camera_at({{0, 0}, 0.0}), to = camera_at({{0, 0}, turned});
    const auto boxes = tag_boxes(mount.camera, scene, from, to, options);
    ASSERT_EQ(boxes.size(), 1U);
    const CameraImage image = render_tags(mount.camera, scene, from, to, boxes, options, Rng(1)).image;
    std::vector<Pose3> cameras;
    const int times = turned == 0.0 ? 1 : 32;
    for (int i = 0; i < times; ++i) cameras.push_back(camera_at({{0, 0}, turned * (i + 0.5) / times}));
    const Vec2 middle = *project(mount.camera, from.to_local(tag.world_T_tag.position));
    double sum = 0.0, worst = 0.0;
    for (int y = -30; y < 30; ++y) {
      for (int x = -20; x < 20; ++x) {
        const int px = static_cast<int>(middle.x) + x, py = static_cast<int>(middle.y) + y;
        const double off = image.at(px, py) - grey_by_points(tag, *tag_pattern(17), cameras, px, py);
        sum += off;
        worst = std::max(worst, std::abs(off));
      }
    }
    EXPECT_LT(std::abs(sum) / 2400.0, 0.5);
    EXPECT_LT(worst, 40.0) << "of 190 between paper and ink";
  }
}

TEST(TagCamera, RendersEveryFamilySoThatItIsMeasured) {
  for (const TagLayout& family : tag_layouts()) {
    TagScene scene;
    scene.tags = {{upright_tag(29, {1.0, 0.1, 0.2}, pi - 0.4, 0.1)}, family.family};
    const Pose2 robot;
    const auto sightings = TagCamera(scene, mount, {}, Rng(5)).look(robot, robot);
    ASSERT_EQ(sightings.size(), 1U) << family.name;
    EXPECT_EQ(sightings[0].id, 29);
    ASSERT_FALSE(sightings[0].poses.empty());
    const Vec3 truth = camera_at(robot).to_local(scene.tags.tags[0].world_T_tag.position);
    EXPECT_LT(norm(sightings[0].poses[0].camera_T_tag.position - truth), 0.02) << family.name;
  }
}

TEST(TagCamera, TheSameSeedGivesTheSameBytes) {
  const Pose2 robot{{0.2, 0.3}, 0.9};
  TagCamera a(corner(), mount, {}, Rng(7)), b(corner(), mount, {}, Rng(7)), c(corner(), mount, {}, Rng(8));
  const auto sightings = a.look(robot, robot);
  b.look(robot, robot);
  c.look(robot, robot);
  EXPECT_EQ(a.image().image.values, b.image().image.values);
  EXPECT_NE(a.image().image.values, c.image().image.values);
  const auto first = a.image().image.values;
  a.look(robot, robot);
  EXPECT_NE(a.image().image.values, first) << "each image has noise of its own";
  EXPECT_FALSE(sightings.empty());
}

TEST(TagCamera, NoiseHasTheStatedSpread) {
  TagScene scene;
  TagCameraOptions options;
  options.noise_grey = 5.0;
  const Pose3 up = camera_at({});
  const CameraImage image =
      render_tags(mount.camera, scene, up, up, {{0, 0, 200, 100}}, options, Rng(3)).image;
  double mean = 0.0, square = 0.0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      mean += image.at(x, y) / 20000.0;
      square += image.at(x, y) * image.at(x, y) / 20000.0;
    }
  }
  EXPECT_NEAR(std::sqrt(square - mean * mean), 5.0, 0.15);
}

}  // namespace
}  // namespace outrider
