// YAML documents as maps of keys, with faults that name the line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// file:line of a node; the file alone for a node without a place.
std::string yaml_where(const std::string& name, const YAML::Node& node);

/// The document's top map (an empty document is an empty map). Refuses broken YAML, anything but a map,
/// keys that are no plain words, duplicate keys of the top map and of the maps in it, several documents
/// and more than 1 MiB.
Outcome<YAML::Node> yaml_map(std::string_view text, const std::string& name);

/// The text of a key of the top map, and nothing else of the document; empty when it is not there or is no
/// single value. The same faults as yaml_map(), but for keys that stand twice. O(length), and the memory of
/// the deepest nesting.
Outcome<std::string> yaml_top_value(const std::string& text, const std::string& name, const std::string& key);

}  // namespace outrider
