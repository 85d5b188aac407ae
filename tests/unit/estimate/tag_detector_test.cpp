#include "outrider/estimate/tag_detector.hpp"

#include <gtest/gtest.h>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr int cell_px = 6;

/// The tag as it is printed, its paper's corner at (x, y).
void paint(CameraImage& image, const TagPattern& pattern, int x, int y) {
  for (int j = 0; j < cell_px * static_cast<int>(tag_cells); ++j) {
    for (int i = 0; i < cell_px * static_cast<int>(tag_cells); ++i) {
      const auto cell =
          static_cast<std::size_t>(j / cell_px) * tag_cells + static_cast<std::size_t>(i / cell_px);
      if (x + i < 0 || y + j < 0 || x + i >= image.width || y + j >= image.height) continue;
      image.at(x + i, y + j) = pattern[cell] ? 230 : 20;
    }
  }
}

CameraImage grey(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), 140)};
}

TEST(TagDetector, ReadsEveryTagItIsShown) {
  Rng rng(31);
  TagDetector detector;
  for (int i = 0; i < testing::cases(30); ++i) {
    const int id = static_cast<int>(rng.below(tag_family_size));
    CameraImage image = grey(160, 120);
    const int x = static_cast<int>(rng.below(90)), y = static_cast<int>(rng.below(50));
    paint(image, *tag_pattern(id), x, y);
    const auto found = detector.detect(image);
    ASSERT_EQ(found.size(), 1U) << id;
    EXPECT_EQ(found[0].id, id);
    EXPECT_EQ(found[0].corrected_bits, 0);
    const double low = cell_px, high = 9.0 * cell_px;  // the black square within the paper
    const Vec2 expected[] = {{low, high}, {high, high}, {high, low}, {low, low}};
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_LT(distance(found[0].corners_px[c], expected[c] + Vec2{double(x), double(y)}), 0.1);
    }
  }
}

TEST(TagDetector, MendsTwoBitsAndNoMore) {
  for (const int damaged : {1, 2, 3}) {
    TagPattern pattern = *tag_pattern(42);
    for (int bit = 0; bit < damaged; ++bit) {
      const std::size_t cell = (3 + static_cast<std::size_t>(bit)) * tag_cells + 4;
      pattern[cell] = !pattern[cell];
    }
    CameraImage image = grey(120, 120);
    paint(image, pattern, 30, 30);
    const auto found = TagDetector().detect(image);
    ASSERT_EQ(found.size(), damaged > 2 ? 0U : 1U);
    if (damaged <= 2) {
      EXPECT_EQ(found[0].corrected_bits, damaged);
    }
    EXPECT_TRUE(TagDetector({.most_corrected_bits = 0}).detect(image).empty());
  }
}

TEST(TagDetector, HalfATagAndNoiseAreNoTags) {
  TagDetector detector;
  CameraImage image = grey(160, 120);
  paint(image, *tag_pattern(5), -30, 20);
  paint(image, *tag_pattern(6), 80, 80);
  EXPECT_TRUE(detector.detect(image).empty());

  image = grey(120, 120);
  paint(image, *tag_pattern(7), 30, 30);
  for (int y = 0; y < 120; ++y) {
    for (int x = 60; x < 120; ++x) image.at(x, y) = 140;  // something stands before it
  }
  EXPECT_TRUE(detector.detect(image).empty());

  Rng rng(32);
  for (int i = 0; i < testing::cases(5); ++i) {
    for (std::uint8_t& value : image.values) value = static_cast<std::uint8_t>(rng.below(256));
    EXPECT_TRUE(detector.detect(image).empty());
  }
}

TEST(TagDetector, BoxesGiveWhatTheWholeImageGives) {
  TagDetector detector;
  CameraImage image = grey(320, 240);
  paint(image, *tag_pattern(11), 40, 40);
  paint(image, *tag_pattern(12), 200, 120);
  const auto whole = detector.detect(image);
  const std::vector<PixelBox> boxes{{190, 110, 280, 190}, {30, 30, 110, 110}, {150, 0, 160, 8}};
  const auto parts = detector.detect(image, boxes);
  ASSERT_EQ(whole.size(), 2U);
  ASSERT_EQ(parts.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(parts[i].id, whole[i].id);
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_LT(distance(parts[i].corners_px[c], whole[i].corners_px[c]), 0.05);
    }
  }
  EXPECT_TRUE(detector.detect(image, std::vector<PixelBox>{{30, 30, 70, 110}}).empty());
}

TEST(TagDetector, TinyImagesHoldNone) {
  TagDetector detector;
  for (const int side : {0, 1, 3, 15, 16, 17, 31}) {
    EXPECT_TRUE(detector.detect(grey(side, side)).empty());
    EXPECT_TRUE(detector.detect(grey(side, 40)).empty());
  }
}

TEST(TagDetector, PatternsAreThoseOfTheFamily) {
  EXPECT_FALSE(tag_pattern(-1));
  EXPECT_FALSE(tag_pattern(tag_family_size));
  const TagPattern pattern = *tag_pattern(0);
  for (std::size_t i = 0; i < tag_cells; ++i) {
    EXPECT_TRUE(pattern[i]) << "a white margin";
    EXPECT_EQ(pattern[tag_cells + i], i == 0 || i == 9) << "and a black border in it";
  }
}

}  // namespace
}  // namespace outrider
