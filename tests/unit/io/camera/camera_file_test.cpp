#include "outrider/io/camera/camera_file.hpp"

#include <gtest/gtest.h>

#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr const char* ros = R"(image_width: 1920
image_height: 1080
camera_name: front
camera_matrix:
  rows: 3
  cols: 3
  data: [ 701.1,    0.     ,  962.4,
            0.     ,  697.1,  524.4,
            0.     ,    0.     ,    1.     ]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.013206, -0.013362, -0.000168, 0.000592, 0.000000]
)";

TEST(CameraFile, ReadsWhatRosWrites) {
  const auto camera = camera_from_text(ros, "ost.yaml");
  ASSERT_TRUE(camera) << to_string(camera.error());
  EXPECT_EQ(camera->width_px, 1920);
  EXPECT_EQ(camera->height_px, 1080);
  EXPECT_EQ(camera->fx, 701.1);
  EXPECT_EQ(camera->fy, 697.1);
  EXPECT_EQ(camera->cx, 962.4);
  EXPECT_EQ(camera->cy, 524.4);
  EXPECT_EQ(camera->distortion, (std::array{0.013206, -0.013362, -0.000168, 0.000592, 0.0}));
}

TEST(CameraFile, ReadsABareMatrixAndSections) {
  const auto bare = camera_from_text("K: [300, 0, 320, 0, 310, 240, 0, 0, 1]\n", "k.yaml");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->fy, 310.0);
  EXPECT_EQ(bare->width_px, 0) << "the file does not tell";
  const std::string two =
      "left:\n  K: [300, 0, 320, 0, 310, 240, 0, 0, 1]\n  width: 640\nright:\n"
      "  K: [301, 0, 320, 0, 310, 240, 0, 0, 1]\n";
  EXPECT_EQ(camera_from_text(two, "k.yaml", "right")->fx, 301.0);
  for (const char* section : {"", "middle"}) {
    const auto none = camera_from_text(two, "k.yaml", section);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().sentence.find("left, right"), std::string::npos);
  }
}

TEST(CameraFile, RefusesWhatIsNoCameraByItsLine) {
  const auto refused = [](const std::string& text, const std::string& says) {
    const auto camera = camera_from_text(text, "k.yaml");
    ASSERT_FALSE(camera) << text;
    EXPECT_NE(to_string(camera.error()).find(says), std::string::npos) << to_string(camera.error());
  };
  refused("K: [0, 0, 320, 0, 310, 240, 0, 0, 1]\n", "k.yaml:1: the camera matrix is singular (fx = 0");
  refused("K: [300, 0, 320, 0, 310, 240, 0, 0, 0]\n", "singular");
  refused("K: [-300, 0, 320, 0, 310, 240, 0, 0, 1]\n", "above 0");
  refused("K: [300, 5, 320, 0, 310, 240, 0, 0, 1]\n", "no pinhole");
  refused("K: [300, 0, 320]\n", "nine numbers");
  refused("K: [300, 0, 320, 0, x, 240, 0, 0, 1]\n", "nine numbers");
  refused("K: 300\n", "nine numbers");
  refused("", "no camera matrix");
  refused("a: 1\n", "no camera matrix");
  const std::string good = "K: [300, 0, 320, 0, 310, 240, 0, 0, 1]\n";
  refused(good + "D: [1, 2]\n", "k.yaml:2: the distortion is not valid");
  refused(good + "distortion_model: fisheye\n", "plumb_bob");
  refused(good + "width: 0\n", "from 1 to 100000");
  refused(good + "width: 640\nheight: 480\nD: [-9, 0, 0, 0]\n", "folds");
}

TEST(CameraFile, DamagedTextIsRefusedOrRead) {
  Rng rng(4);
  for (int i = 0; i < testing::cases(300); ++i) {
    const auto camera = camera_from_text(test::damaged(ros, rng), "ost.yaml");
    if (camera) {
      EXPECT_GT(camera->fx, 0.0);
    }
  }
}

TEST(CameraFile, ReadsThePublishedCalibration) {
  const auto path = test::data_folder() / "waypoints" / "camera_ost.yaml";
  OUTRIDER_NEEDS_DATA(path);
  const auto camera = load_camera(path.string());
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->fx, 701.12395);
}

}  // namespace
}  // namespace outrider
