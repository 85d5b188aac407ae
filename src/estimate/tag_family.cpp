#include "outrider/estimate/tag_family.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ranges>

#include "outrider/core/options.hpp"
#include "outrider/core/text.hpp"
#include "tag_library.hpp"

namespace outrider {
namespace {

constexpr double most_chance = 1.0 / 500.0;
constexpr double most_table_bytes = 200e6;
constexpr double bytes_per_code = 48.0;  // libapriltag hashes them into three times as many entries of 16

/// Frees an image of libapriltag, which does not export its own function for that.
struct FreePicture {
  void operator()(image_u8_t* picture) const {
    std::free(picture->buf);
    std::free(picture);
  }
};
using Picture = std::unique_ptr<image_u8_t, FreePicture>;

/// Returns the number of words that differ from a given one in at most that many bits.
double ball(int bits, int radius) {
  double all = 0.0, here = 1.0;
  for (int k = 0; k <= radius; ++k) {
    all += here;
    here *= static_cast<double>(bits - k) / static_cast<double>(k + 1);
  }
  return all;
}

}  // namespace

const std::array<TagLayout, 9>& tag_layouts() {
  using enum TagFamily;
  static constexpr std::array<TagLayout, 9> layouts{{
      {tag16h5, "tag16h5", 30, 16, 5, 8, 6, false},
      {tag25h9, "tag25h9", 35, 25, 9, 9, 7, false},
      {tag36h10, "tag36h10", 2320, 36, 10, 10, 8, false},
      {tag36h11, "tag36h11", 587, 36, 11, 10, 8, false},
      {tag_circle21h7, "tagCircle21h7", 38, 21, 7, 9, 5, true},
      {tag_circle49h12, "tagCircle49h12", 65535, 49, 12, 11, 5, true},
      {tag_custom48h12, "tagCustom48h12", 42211, 48, 12, 10, 6, true},
      {tag_standard41h12, "tagStandard41h12", 2115, 41, 12, 9, 5, true},
      {tag_standard52h13, "tagStandard52h13", 48714, 52, 13, 10, 6, true},
  }};
  return layouts;
}

const TagLayout& layout(TagFamily family) { return tag_layouts()[static_cast<std::size_t>(family)]; }

Outcome<std::vector<TagFamily>> parse_tag_families(std::string_view text) {
  std::vector<TagFamily> families;
  std::vector<std::string> known{"all"};
  for (const TagLayout& row : tag_layouts()) known.emplace_back(row.name);
  if (trimmed(text).empty()) return bad_input("no family is named; take tag36h11, or all", "family");
  for (const auto part : std::views::split(text, ',')) {
    const std::string_view name = trimmed({part.begin(), part.end()});
    const auto row = std::ranges::find(tag_layouts(), name, &TagLayout::name);
    if (row == tag_layouts().end() && name != "all") {
      return no_such_row("family of tags", name, known, "family");
    }
    for (const TagLayout& each : tag_layouts()) {
      if ((name == "all" || each.name == name) && std::ranges::find(families, each.family) == families.end())
        families.push_back(each.family);
    }
  }
  return families;
}

std::string tag_family_names(const std::vector<TagFamily>& families) {
  std::vector<std::string_view> names;
  for (const TagFamily family : families) names.push_back(layout(family).name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Status check_tag_id(int id, TagFamily family) {
  const TagLayout& row = layout(family);
  if (id >= 0 && id < row.ids) return {};
  return bad_input(fmt::format("there is no tag {} in {}; ids go from 0 to {}", id, row.name, row.ids - 1));
}

double chance_of_random_bits(const TagLayout& family, int corrected_bits) {
  return 4.0 * family.ids * ball(family.bits, corrected_bits) / std::exp2(family.bits);
}

int most_corrected_bits(const TagLayout& family) {
  int bits = 2;  // libapriltag corrects no more
  while (bits > 0 && (chance_of_random_bits(family, bits) > most_chance ||
                      bytes_per_code * family.ids * ball(family.bits, bits) > most_table_bytes))
    --bits;
  return bits;
}

Outcome<TagPattern> tag_pattern(int id, TagFamily family) {
  const TagLayout& row = layout(family);
  if (auto ok = check_tag_id(id, family); !ok) return pass_on(ok);
  const TagLibraryFamily library = make_family(family);
  const Picture picture{apriltag_to_image(library.get(), id)};
  TagPattern pattern{static_cast<std::size_t>(row.cells), {}};
  for (int y = 0; y < row.cells; ++y) {
    for (int x = 0; x < row.cells; ++x) pattern.white.push_back(picture->buf[y * picture->stride + x] > 127);
  }
  return pattern;
}

}  // namespace outrider
