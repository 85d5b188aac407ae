#include "outrider/estimate/tag_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr int cell_px = 6;

/// The tag as it is printed, its paper's corner at (x, y), each cell that many pixels wide.
void paint(CameraImage& image, const TagPattern& pattern, int x, int y, int cell = cell_px) {
  const int side = cell * static_cast<int>(pattern.cells);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const std::size_t at =
          static_cast<std::size_t>(j / cell) * pattern.cells + static_cast<std::size_t>(i / cell);
      if (x + i < 0 || y + j < 0 || x + i >= image.width || y + j >= image.height) continue;
      image.at(x + i, y + j) = pattern.white[at] ? 230 : 20;
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
    const int id = static_cast<int>(rng.below(587));
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
      const std::size_t cell = (3 + static_cast<std::size_t>(bit)) * pattern.cells + 4;
      pattern.white[cell] = !pattern.white[cell];
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

TEST(TagDetector, ReadsEveryFamilyAndMeasuresItsSquare) {
  for (const TagLayout& family : tag_layouts()) {
    TagDetector detector({.families = {family.family}});
    for (const int id : {0, family.ids / 2, family.ids - 1}) {
      CameraImage image = grey(160, 120);
      paint(image, *tag_pattern(id, family.family), 40, 25);
      const auto found = detector.detect(image);
      ASSERT_EQ(found.size(), 1U) << family.name << ' ' << id;
      EXPECT_EQ(found[0].id, id);
      EXPECT_EQ(found[0].family, family.family);
      const double low = 0.5 * cell_px * (family.cells - family.measured_cells);
      const double high = low + cell_px * family.measured_cells;
      const Vec2 expected[] = {{low, high}, {high, high}, {high, low}, {low, low}};
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_LT(distance(found[0].corners_px[c], expected[c] + Vec2{40.0, 25.0}), 0.1) << family.name;
      }
    }
  }
}

TEST(TagDetector, ManyFamiliesInOneImage) {
  CameraImage image = grey(480, 320);
  std::vector<TagFamily> families;
  int column = 0;
  for (const TagLayout& family : tag_layouts()) {
    families.push_back(family.family);
    paint(image, *tag_pattern(7, family.family), 10 + 90 * (column % 5), 20 + 120 * (column / 5));
    ++column;
  }
  const auto found = TagDetector({.families = families}).detect(image);
  ASSERT_EQ(found.size(), families.size());
  for (std::size_t i = 0; i < families.size(); ++i) {
    EXPECT_EQ(found[i].family, families[i]);
    EXPECT_EQ(found[i].id, 7);
  }
}

/// An image full of squares with a black border, within white paper, and random bits inside.
CameraImage random_squares(Rng& rng, const TagLayout& family) {
  CameraImage image = grey(480, 400);
  const int side = cell_px * family.cells + 4;
  for (int y = 2; y + side < image.height; y += side) {
    for (int x = 2; x + side < image.width; x += side) {
      TagPattern pattern = *tag_pattern(0, family.family);
      const std::size_t last = pattern.cells - 2;
      for (std::size_t v = 2; v < last; ++v) {
        for (std::size_t u = 2; u < last; ++u) pattern.white[v * pattern.cells + u] = rng.below(2) == 1;
      }
      paint(image, pattern, x, y);
    }
  }
  return image;
}

TEST(TagDetector, RandomSquaresAreTagsAsOftenAsStated) {
  Rng rng(33);
  const TagLayout& family = layout(TagFamily::tag16h5);
  TagDetector detector({.families = {family.family}});
  int found = 0;
  const int images = 30, squares = 7 * 9;
  for (int i = 0; i < images; ++i)
    found += static_cast<int>(detector.detect(random_squares(rng, family)).size());
  const double expected = images * squares * chance_of_random_bits(family, 0);
  EXPECT_NEAR(found, expected, 4.0 * std::sqrt(expected)) << "one square in 546";
  for (const TagFamily large : {TagFamily::tag25h9, TagFamily::tag36h10, TagFamily::tag36h11}) {
    TagDetector other({.families = {large}});
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(other.detect(random_squares(rng, layout(large))).empty());
  }
}

/// The image with means of `factor` x `factor` pixels in place of those.
CameraImage reduced(const CameraImage& image, int factor) {
  CameraImage small{image.width / factor, image.height / factor, {}};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      int sum = 0;
      for (int k = 0; k < factor * factor; ++k)
        sum += image.at(factor * x + k % factor, factor * y + k / factor);
      small.values.push_back(static_cast<std::uint8_t>(sum / (factor * factor)));
    }
  }
  return small;
}

/// The number of tags that are read once and with other scales, of those on images that `worsen` makes worse.
template <class Worsen>
std::array<int, 2> tags_read(int tags, int cell, const Worsen& worsen) {
  Rng rng(34);
  TagDetector once, again({.few = 1});
  std::array<int, 2> read{};
  for (int i = 0; i < tags; ++i) {
    const int id = static_cast<int>(rng.below(587));
    CameraImage image = grey(240, 240);
    paint(image, *tag_pattern(id), 40 + static_cast<int>(rng.below(8)), 40 + static_cast<int>(rng.below(8)),
          cell);
    image = worsen(image, rng);
    const auto found = again.detect(image);
    for (const TagSighting& tag : found) EXPECT_EQ(tag.id, id);
    EXPECT_LE(found.size(), 1U) << "each once";
    read[0] += static_cast<int>(once.detect(image).size());
    read[1] += static_cast<int>(found.size());
  }
  return read;
}

TEST(TagDetector, OtherScalesFindSmallTags) {
  const auto [first, both] =  // 1.125 pixels for each cell
      tags_read(40, 9, [](const CameraImage& image, Rng&) { return reduced(image, 8); });
  EXPECT_LE(first, 10);
  EXPECT_GE(both, 20);
}

TEST(TagDetector, OtherScalesFindTagsInBlurAndNoise) {
  const auto blurred = [](const CameraImage& image, Rng& rng) {
    CameraImage out = image;
    for (int y = 3; y < image.height - 3; ++y) {
      for (int x = 3; x < image.width - 3; ++x) {
        int sum = 0;
        for (int k = 0; k < 49; ++k) sum += image.at(x - 3 + k % 7, y - 3 + k / 7);
        out.at(x, y) = static_cast<std::uint8_t>(std::clamp(sum / 49.0 + 40.0 * rng.normal(), 0.0, 255.0));
      }
    }
    return out;
  };
  const auto [first, both] = tags_read(20, 8, blurred);
  EXPECT_LE(first, 15);
  EXPECT_EQ(both, 20);
}

}  // namespace
}  // namespace outrider
