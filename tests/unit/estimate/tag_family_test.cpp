#include "outrider/estimate/tag_family.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace outrider {
namespace {

struct Published {
  TagFamily family;
  int id;
  std::string_view rows;  // '#' white, '.' black, ' ' open
};

/// Pictures of the repository AprilRobotics/apriltag-imgs (BSD-2), read with a PNG reader of its own.
// clang-format off: a row a line
constexpr Published pictures[] = {
    {TagFamily::tag16h5, 17,
     "########"
     "#......#"
     "#.#..#.#"
     "#...##.#"
     "#.#.##.#"
     "#..#...#"
     "#......#"
     "########"},
    {TagFamily::tag25h9, 17,
     "#########"
     "#.......#"
     "#..#..#.#"
     "#.##.##.#"
     "#...##..#"
     "#.###...#"
     "#.....#.#"
     "#.......#"
     "#########"},
    {TagFamily::tag36h11, 17,
     "##########"
     "#........#"
     "#..##.#..#"
     "#.....##.#"
     "#.#.###..#"
     "#.##.##..#"
     "#.##...#.#"
     "#...##...#"
     "#........#"
     "##########"},
    {TagFamily::tag_circle21h7, 17,
     "   ###   "
     " ....... "
     " .#####. "
     "..###.#.#"
     "..#.###.."
     "..##.##.#"
     " .#####. "
     " ....... "
     "   #..   "},
    {TagFamily::tag_circle49h12, 65000,
     "    .#.    "
     "  #.#####  "
     " #.......# "
     " #.#####.# "
     "...###.#..."
     ".#.###.#.#."
     "##.#.#.#.##"
     " ..#####.. "
     " ......... "
     "  #..#.##  "
     "    ###    "},
    {TagFamily::tag_custom48h12, 42000,
     ".####....."
     ".........#"
     "..######.#"
     "..##.#.#.."
     "#.##  ##.#"
     "#.#.  .#.."
     "#.##.###.#"
     "..######.."
     "#........."
     "..##..#.#."},
    {TagFamily::tag_standard41h12, 17,
     "###....#."
     "........."
     "#.#####.#"
     "#.#...#.#"
     "#.#...#.#"
     "..##..#.."
     "..#####.#"
     "........#"
     ".#..#...#"},
    {TagFamily::tag_standard52h13, 48000,
     "..#.###..#"
     "#........."
     "..######.#"
     "..#.####.."
     "#.##..##.."
     "..###.##.."
     "..##.###.#"
     "..######.#"
     ".........."
     "###..#..##"},
};
// clang-format on

TEST(TagFamily, PatternsAreThePublishedOnes) {
  for (const Published& picture : pictures) {
    const TagPattern pattern = *tag_pattern(picture.id, picture.family);
    const TagLayout& family = layout(picture.family);
    ASSERT_EQ(pattern.white.size(), picture.rows.size()) << family.name;
    ASSERT_EQ(pattern.cells, static_cast<std::size_t>(family.cells));
    for (std::size_t i = 0; i < picture.rows.size(); ++i) {
      if (picture.rows[i] != ' ') {
        EXPECT_EQ(pattern.white[i], picture.rows[i] == '#') << family.name << ' ' << i;
      }
    }
  }
}

TEST(TagFamily, IdsOutsideAreRefused) {
  for (const TagLayout& family : tag_layouts()) {
    EXPECT_EQ(&layout(family.family), &family);
    EXPECT_FALSE(tag_pattern(-1, family.family));
    EXPECT_TRUE(tag_pattern(family.ids - 1, family.family));
    const auto beyond = tag_pattern(family.ids, family.family);
    ASSERT_FALSE(beyond);
    EXPECT_NE(beyond.error().sentence.find(family.name), std::string::npos);
  }
}

TEST(TagFamily, NamesAreReadAndRefused) {
  EXPECT_EQ(tag_family_names(*parse_tag_families("tag25h9, tag36h11,tag25h9")), "tag25h9, tag36h11");
  EXPECT_EQ(parse_tag_families("all")->size(), tag_layouts().size());
  EXPECT_EQ(parse_tag_families("tag36h12").error().sentence,
            "there is no family of tags 'tag36h12'; did you mean 'tag36h10'?");
  EXPECT_FALSE(parse_tag_families(""));
  EXPECT_FALSE(parse_tag_families("tag36h11,"));
}

/// The words that the bits of a tag16h5 make, in its four turns.
std::set<unsigned> turned_words(const TagPattern& pattern) {
  std::set<unsigned> words;
  for (int turn = 0; turn < 4; ++turn) {
    unsigned word = 0;
    for (std::size_t y = 0; y < 4; ++y) {
      for (std::size_t x = 0; x < 4; ++x) {
        std::size_t u = x, v = y;
        for (int k = 0; k < turn; ++k) {
          const std::size_t before = u;
          u = v;
          v = 3 - before;
        }
        word = 2 * word + (pattern.white[(v + 2) * 8 + u + 2] ? 1U : 0U);
      }
    }
    words.insert(word);
  }
  return words;
}

TEST(TagFamily, TheChanceOfRandomBitsIsThatOfAllWords) {
  const TagLayout& family = layout(TagFamily::tag16h5);
  std::set<unsigned> tags;
  for (int id = 0; id < family.ids; ++id) tags.merge(turned_words(*tag_pattern(id, family.family)));
  std::array<int, 3> read{};  // words that are a tag with up to so many bits corrected
  for (unsigned word = 0; word < 65536; ++word) {
    int nearest = 16;
    for (const unsigned tag : tags) nearest = std::min(nearest, std::popcount(word ^ tag));
    for (std::size_t c = 0; c < 3; ++c) read[c] += nearest <= static_cast<int>(c) ? 1 : 0;
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(chance_of_random_bits(family, c), read[static_cast<std::size_t>(c)] / 65536.0, 1e-12);
}

TEST(TagFamily, SmallFamiliesCorrectFewerBits) {
  const auto most = [](TagFamily family) { return most_corrected_bits(layout(family)); };
  EXPECT_EQ(most(TagFamily::tag16h5), 0);
  EXPECT_EQ(most(TagFamily::tag_circle21h7), 1);
  EXPECT_EQ(most(TagFamily::tag25h9), 2);
  EXPECT_EQ(most(TagFamily::tag36h11), 2);
  EXPECT_EQ(most(TagFamily::tag_standard41h12), 2);
  EXPECT_EQ(most(TagFamily::tag_standard52h13), 1);
  for (const TagLayout& family : tag_layouts())
    EXPECT_LT(chance_of_random_bits(family, most_corrected_bits(family)), 0.002) << family.name;
}

}  // namespace
}  // namespace outrider
