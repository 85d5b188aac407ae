#include "sdf_elements.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider {
namespace {

constexpr std::size_t most_tags = 2'000'000;
constexpr std::size_t most_parts = 20'000;
constexpr std::size_t most_deep_models = 50;

/// Counts the elements below an element that is nested in `levels` models. Returns the number of deeply
/// nested models.
std::size_t count_below(const SdfElement& element, int levels, SdfCounts& counts) {
  std::size_t deep = 0;
  for (const SdfElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view name = child->Name();
    auto found = counts.by_kind.find(name);
    if (found == counts.by_kind.end()) found = counts.by_kind.emplace(name, 0).first;
    ++found->second;
    const int inside = name == "model" ? levels + 1 : levels;
    counts.model_levels = std::max(counts.model_levels, inside);
    if (name == "model" && inside > described_model_levels) ++deep;
    deep += count_below(*child, inside, counts);
  }
  return deep;
}

}  // namespace

bool sdf_matters(std::string_view parent, std::string_view child) {
  if (parent == "sdf") return one_of(child, {"world", "model", "include"});
  if (parent == "world") return one_of(child, {"model", "include", "frame", "gravity", "physics"});
  if (parent == "physics") return child == "gravity";
  if (parent == "model") {
    return one_of(child, {"model", "include", "frame", "link", "joint", "pose", "static"});
  }
  if (parent == "link") return one_of(child, {"pose", "collision"});
  if (parent == "collision") return one_of(child, {"pose", "geometry"});
  if (parent == "joint") return one_of(child, {"parent", "child", "pose", "axis", "axis2"});
  if (one_of(parent, {"axis", "axis2"})) return one_of(child, {"xyz", "use_parent_model_frame"});
  if (parent == "heightmap") return one_of(child, {"uri", "size", "pos"});
  return true;
}

Status count_tags(std::string_view text, const std::string& file, std::size_t& tags) {
  tags += static_cast<std::size_t>(std::ranges::count(text, '<'));
  if (tags <= most_tags) return {};
  return bad_input(
      fmt::format("it has {} tags with what it includes, and at most {} are read; leave out what "
                  "has no collisions, or cut the world in two",
                  tags, most_tags),
      file);
}

Outcome<SdfCounts> count_elements(const SdfElement& root, const std::string& file) {
  SdfCounts counts;
  const std::size_t deep = count_below(root, 0, counts);
  std::size_t parts = 0;
  for (const char* part : sdf_parts) {
    if (const auto found = counts.by_kind.find(part); found != counts.by_kind.end()) parts += found->second;
  }
  if (parts > most_parts) {
    return bad_input(
        fmt::format("it has {} models, links, collisions, frames and joints with what it includes, "
                    "and at most {} are read; join small shapes in a mesh, or cut the world in two",
                    parts, most_parts),
        file);
  }
  if (deep > most_deep_models) {
    return bad_input(
        fmt::format("{} of its models are more than {} deep in other models, and at most {} such "
                    "models are read; put models beside each other",
                    deep, described_model_levels, most_deep_models),
        file);
  }
  return counts;
}

}  // namespace outrider
