// Which elements of an SDF world say where its collisions stand, and how many of them are read.
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

/// What stands in a text.
struct SdfCounts {
  std::map<std::string, std::size_t, std::less<>> by_kind;  ///< elements by name
  int model_levels = 0;                                     ///< 1: no model is in another
};

/// Models in models are described to sdformat on so many levels. It looks up a deeper one by itself, as a
/// whole, which costs 1.7 MiB.
inline constexpr int described_model_levels = 2;

/// The parts of a world, each of which costs sdformat some ten kilobytes and the others little.
inline constexpr auto sdf_parts = {"model", "link", "collision", "frame", "joint"};

inline bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

inline bool is_sdf_part(std::string_view name) {
  return std::ranges::find(sdf_parts, name) != sdf_parts.end();
}

/// False for what says nothing about collisions: visuals, plugins, lights ...
bool sdf_matters(std::string_view parent, std::string_view child);

/// Refuses text with more tags than are read, together with those counted in `tags` before; this is cheap,
/// and comes before anything is built of them.
Status count_tags(std::string_view text, const std::string& file, std::size_t& tags);

/// The elements below `root` by kind; refuses more parts, and more deeply nested models, than sdformat is
/// given.
Outcome<SdfCounts> count_elements(const SdfElement& root, const std::string& file);

}  // namespace outrider
