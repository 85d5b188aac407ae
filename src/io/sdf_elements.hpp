// Defines which elements of an SDF world determine the poses of its collisions, and limits their number.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "xml.hpp"

namespace outrider {

using SdfElement = tinyxml2::XMLElement;

/// The elements of a text.
struct SdfCounts {
  std::map<std::string, std::size_t, std::less<>> by_kind;  ///< number of elements by name
  int model_levels = 0;                                     ///< depth of nested models; 1: not nested
};

/// Number of levels of nested models for which sdformat gets a reduced description. For a deeper model it
/// uses its own complete description, which costs 1.7 MiB.
inline constexpr int described_model_levels = 2;

/// The elements that cost sdformat some ten kilobytes each; all others cost little.
inline constexpr auto sdf_parts = {"model", "link", "collision", "frame", "joint"};

inline bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

inline bool is_sdf_part(std::string_view name) {
  return std::ranges::find(sdf_parts, name) != sdf_parts.end();
}

/// Returns false for elements without information about collisions: visuals, plugins, lights ...
bool sdf_matters(std::string_view parent, std::string_view child);

/// Adds the number of tags in a text to `tags` and refuses too many. This is cheap and comes before parsing.
Status count_tags(std::string_view text, const std::string& file, std::size_t& tags);

/// Counts the elements below `root`. Refuses too many parts and too many deeply nested models.
Outcome<SdfCounts> count_elements(const SdfElement& root, const std::string& file);

}  // namespace outrider
