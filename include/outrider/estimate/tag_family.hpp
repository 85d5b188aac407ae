// Families of AprilTags: which tags there are, how they look, and how easily other things look like them.
//
// A tag is a square of cells. The square that a detector measures is the one whose edge separates black from
// white all around: in the classic families (tag16h5, tag25h9, tag36h10, tag36h11) the outer edge of the
// black border, which white paper surrounds; in the others the inner edge of a black ring, with a white ring
// inside and bits on both sides. The size of a tag, in metres, is the side of that square in every family;
// the paper is larger by `paper_per_size()`.
//
// Source: Olson, AprilTag: A robust and flexible visual fiducial system (ICRA 2011); Krogius, Haggenmiller
// and Olson, Flexible layouts for fiducial tags (IROS 2019).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

enum class TagFamily : std::uint8_t {
  tag16h5,
  tag25h9,
  tag36h10,
  tag36h11,
  tag_circle21h7,
  tag_circle49h12,
  tag_custom48h12,
  tag_standard41h12,
  tag_standard52h13,
};

struct TagLayout {
  TagFamily family;
  std::string_view name;  ///< e.g. tag36h11: 36 bits, of which two tags differ in at least 11
  int ids;                ///< they go from 0 to ids - 1
  int bits;               ///< cells that tell the tags apart
  int distance;           ///< least number of bits in which two tags differ, turned or not
  int cells;              ///< along a side of the paper
  int measured_cells;     ///< along a side of the square that is measured
  bool white_inside;      ///< the measured square is white at its edge and has black around it

  /// Returns the side of the paper divided by the size of the tag.
  [[nodiscard]] constexpr double paper_per_size() const {
    return static_cast<double>(cells) / static_cast<double>(measured_cells);
  }
};

/// Returns all families, in the order of the enumeration.
const std::array<TagLayout, 9>& tag_layouts();
const TagLayout& layout(TagFamily family);

/// Returns the families named in a text, with commas between them, or all of them for "all". Fault: bad_input
/// for a name that is none, or a text without any.
Outcome<std::vector<TagFamily>> parse_tag_families(std::string_view text);
std::string tag_family_names(const std::vector<TagFamily>& families);

/// Fault: bad_input for an id outside the family.
Status check_tag_id(int id, TagFamily family);

/// Returns the chance that random bits are read as some tag of the family, in any of four turns, if up to
/// `corrected_bits` bits are corrected. It is one in 550 for tag16h5 even without correction, and one in four
/// with two bits.
double chance_of_random_bits(const TagLayout& family, int corrected_bits);

/// Returns how many bits a detector may correct: the most, up to two, for which random bits are a tag once in
/// 500 times at most and the table of the detector takes less than 200 MB. It is 0 for tag16h5, 1 for
/// tag_circle21h7 and the families with more than 40,000 tags, and 2 for the others.
int most_corrected_bits(const TagLayout& family);

/// The cells of the paper of a tag.
struct TagPattern {
  std::size_t cells = 0;    ///< along a side
  std::vector<bool> white;  ///< row by row from the top; false: black
};

/// Returns the pattern of a tag. Cells that the family leaves open are black. Fault: bad_input for an id
/// outside the family.
Outcome<TagPattern> tag_pattern(int id, TagFamily family = TagFamily::tag36h11);

}  // namespace outrider
