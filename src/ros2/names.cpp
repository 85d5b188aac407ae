#include "outrider/ros2/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"

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
                  excerpt(topic)));
}

Outcome<std::string> resolve_namespace(std::string_view name) {
  while (name.starts_with('/')) name.remove_prefix(1);
  if (name.empty()) return "/";
  return resolve_topic(fmt::format("/{}", name));
}

Outcome<TopicNames> TopicNames::of(const RosNamespace& space, const std::vector<std::string>& rules) {
  TopicNames names;
  names.space_ = space;
  for (const std::string& rule : rules) {
    const std::size_t at = rule.find(":=");
    if (at == std::string::npos)
      return bad_input(fmt::format("'{}' does not rename a topic; give from:=to", excerpt(rule)), "--remap");
    auto from = resolve_topic(std::string_view(rule).substr(0, at), space);
    if (!from) return pass_on(from);
    auto to = resolve_topic(std::string_view(rule).substr(at + 2), space);
    if (!to) return pass_on(to);
    names.renamed_.insert_or_assign(std::move(*from), std::move(*to));
  }
  return names;
}

Outcome<std::string> TopicNames::name_of(std::string_view topic) const {
  auto name = resolve_topic(topic, space_);
  if (!name) return name;
  const auto renamed = renamed_.find(*name);
  return renamed == renamed_.end() ? *name : renamed->second;
}

std::string topic_on_wire(std::string_view topic) { return fmt::format("rt{}", topic); }

std::string request_on_wire(std::string_view service) { return fmt::format("rq{}Request", service); }
std::string reply_on_wire(std::string_view service) { return fmt::format("rr{}Reply", service); }

std::string type_on_wire(std::string_view type) {
  std::string name;
  for (std::size_t slash = type.find('/'); slash != std::string_view::npos; slash = type.find('/')) {
    name += fmt::format("{}::", type.substr(0, slash));
    type.remove_prefix(slash + 1);
  }
  return fmt::format("{}dds_::{}_", name, type);
}

}  // namespace outrider
