#include "outrider/ros2/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider {
namespace {

bool good_part(std::string_view part) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !part.empty() && letter(part.front()) &&
         std::all_of(part.begin(), part.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

bool good_name(std::string_view name) {
  if (!name.starts_with('/')) return false;
  for (name.remove_prefix(1);;) {
    const std::size_t slash = name.find('/');
    if (!good_part(name.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    name.remove_prefix(slash + 1);
  }
}

}  // namespace

Outcome<std::string> resolve_topic(std::string_view name, const RosNamespace& of) {
  const std::string within = of.space == "/" ? "" : of.space;
  std::string topic(name);
  if (name.starts_with("~/")) {
    topic = fmt::format("{}/{}{}", within, of.node, name.substr(1));
  } else if (!name.starts_with('/')) {
    topic = fmt::format("{}/{}", within, name);
  }
  if (good_name(topic)) return topic;
  return bad_input(
      fmt::format("'{}' is no name of a topic; its parts between slashes are letters, digits and "
                  "underscores, and do not begin with a digit",
                  topic));
}

std::string topic_on_wire(std::string_view topic) { return fmt::format("rt{}", topic); }

std::string type_on_wire(std::string_view type) {
  std::string name;
  for (std::size_t slash = type.find('/'); slash != std::string_view::npos; slash = type.find('/')) {
    name += fmt::format("{}::", type.substr(0, slash));
    type.remove_prefix(slash + 1);
  }
  return fmt::format("{}dds_::{}_", name, type);
}

}  // namespace outrider
