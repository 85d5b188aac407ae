// YAML documents as maps of keys, with faults that name the line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Returns file:line of a node, or only the file for a node without a position.
std::string yaml_where(const std::string& name, const YAML::Node& node);

/// Returns the top-level map of a document; an empty document is an empty map. Refuses broken YAML, anything
/// but a map, keys that are not scalars, duplicate keys in the top-level map and in the maps in it, several
/// documents and more than 1 MiB.
Outcome<YAML::Node> yaml_map(std::string_view text, const std::string& name);

/// Returns the text of one key of the top-level map without storing the document; empty if the key is missing
/// or its value is not a scalar. Faults: those of yaml_map(), except duplicate keys. Time O(length), memory
/// O(depth of the nesting).
Outcome<std::string> yaml_top_value(const std::string& text, const std::string& name, const std::string& key);

}  // namespace outrider
