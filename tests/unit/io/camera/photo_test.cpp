#include "outrider/io/camera/photo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "outrider/core/units.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/io/camera/camera_file.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

std::filesystem::path tags_folder() { return test::data_folder() / "slam" / "apriltag"; }

struct Reference {
  int id = 0;
  std::array<Vec2, 4> corners;
};

std::vector<Reference> references(const std::filesystem::path& path) {
  std::vector<Reference> all;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    Reference r;
    auto& [a, b, c, d] = r.corners;
    if (std::sscanf(line.c_str(), "%d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf)", &r.id, &a.x, &a.y, &b.x,
                    &b.y, &c.x, &c.y, &d.x, &d.y) == 9) {
      all.push_back(r);
    }
  }
  return all;
}

double apart(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += 0.25 * distance(a[i], b[i]);
  return sum;
}

TEST(Photo, PublishedPhotosShowTheirTagsAndNoOther) {
  OUTRIDER_NEEDS_DATA(tags_folder());
  TagDetector detector;
  for (const char* name :
       {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c", "34139872896_defdb2f8d9_c"}) {
    const auto photo = load_photo((tags_folder() / name).string() + ".jpg");
    ASSERT_TRUE(photo) << to_string(photo.error());
    const auto found = detector.detect(*photo);
    const auto expected = references((tags_folder() / name).string() + ".txt");
    EXPECT_EQ(found.size(), expected.size()) << name;
    double sum = 0.0;
    for (const Reference& reference : expected) {
      double nearest = 1e9;
      for (const TagSighting& sighting : found) {
        if (sighting.id == reference.id) {
          nearest = std::min(nearest, apart(sighting.corners_px, reference.corners));
        }
      }
      EXPECT_LT(nearest, 2.0) << name << ": " << reference.id << " at " << reference.corners[0].x;
      sum += nearest;
    }
    EXPECT_LT(sum / static_cast<double>(expected.size()), 0.5) << name;
  }
}

TEST(Photo, PublishedRotationsGiveTheYaw) {
  OUTRIDER_NEEDS_DATA(tags_folder());
  const auto camera = load_camera((tags_folder() / "dt_test_info.yaml").string(), "rotation_test");
  ASSERT_TRUE(camera) << to_string(camera.error());
  TagDetector detector;
  double facing_deg = 0.0;
  for (const int turned_deg : {0, -40, 20, 60}) {
    const auto photo = load_photo(
        (tags_folder() / ("dt_test_image_rotation_" + std::to_string(turned_deg) + ".png")).string());
    ASSERT_TRUE(photo) << to_string(photo.error());
    const auto found = detector.detect(*photo);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].id, 76);
    const auto poses = planar_pnp(*camera, 0.065, found[0].corners_px);
    ASSERT_FALSE(poses.empty());
    const Vec3 into_tag = poses[0].camera_T_tag.rotation.axes[2];
    const double yaw_deg = -degrees(std::atan2(into_tag.x, into_tag.z));
    if (turned_deg == 0) facing_deg = yaw_deg;  // how the camera stood
    EXPECT_NEAR(yaw_deg - facing_deg, turned_deg, 2.0);
  }
  EXPECT_NEAR(facing_deg, 0.0, 2.0);
}

TEST(Photo, PngAndPgmComeBackAsTheyWere) {
  CameraImage image{7, 5, {}};
  for (int i = 0; i < 35; ++i) image.values.push_back(static_cast<std::uint8_t>(7 * i));
  const auto png = photo_from_bytes(to_png(image), "a.png");
  ASSERT_TRUE(png) << to_string(png.error());
  EXPECT_EQ(png->width, 7);
  EXPECT_EQ(png->values, image.values);
  const std::string pgm = "P5\n7 5\n255\n" + std::string(image.values.begin(), image.values.end());
  EXPECT_EQ(photo_from_bytes(pgm, "a.pgm")->values, image.values);
}

TEST(Photo, RefusesWhatIsNoImage) {
  for (const std::string& bytes : {std::string(), std::string("GIF89a"), std::string("\xFF\xD8\xFF\xE0 no"),
                                   std::string("\x89PNG\r\n\x1a\n"), std::string("tag")}) {
    const auto photo = photo_from_bytes(bytes, "photo.jpg");
    ASSERT_FALSE(photo);
    EXPECT_EQ(photo.error().where, "photo.jpg");
    EXPECT_FALSE(photo.error().sentence.empty());
  }
  EXPECT_FALSE(load_photo("/no/such/photo.jpg"));
}

TEST(Photo, FewBytesOfManyPixelsAreRefused) {
  const auto refused = photo_from_bytes(to_png({5000, 4000, std::vector<std::uint8_t>(20'000'000)}), "a.png");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("stand for 20000000 pixels"), std::string::npos)
      << refused.error().sentence;
  EXPECT_NE(refused.error().sentence.find("save it as PGM"), std::string::npos);
  EXPECT_TRUE(photo_from_bytes(to_png({4000, 4000, std::vector<std::uint8_t>(16'000'000)}), "a.png"));
  EXPECT_TRUE(photo_from_bytes("P5\n5000 4000\n255\n" + std::string(20'000'000, 'x'), "a.pgm"));
}

TEST(Photo, DamagedJpegIsRefusedOrRead) {
  const auto path = tags_folder() / "33369213973_9d9bb4cc96_c.jpg";
  OUTRIDER_NEEDS_DATA(path);
  const std::string bytes = test::bytes_of(path);
  Rng rng(6);
  for (int i = 0; i < testing::cases(10); ++i) {
    const auto photo = photo_from_bytes(test::damaged(bytes, rng), "photo.jpg");
    if (photo) {
      EXPECT_EQ(photo->values.size(),
                static_cast<std::size_t>(photo->width) * static_cast<std::size_t>(photo->height));
    }
  }
}

}  // namespace
}  // namespace outrider
