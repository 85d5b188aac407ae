// YAML documents as maps of keys, with faults that name the line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Returns file:line of a node, or only the file for a node without a position.
std::string yaml_where(const std::string& name, const YAML::Node& node);

/// Returns the top-level map of a document; an empty document is an empty map. Refuses broken YAML, anything
/// but a map, keys that are not scalars, duplicate keys in the top-level map and in the maps in it, several
/// documents and more than 1 MiB.
Outcome<YAML::Node> yaml_map(std::string_view text, const std::string& name);

/// Returns the text of a scalar; nothing for a node that is not defined or is no scalar.
std::optional<std::string> yaml_text(const YAML::Node& node);
/// Returns the finite number of such a text, or the numbers of a list of them; nothing if it is none.
std::optional<double> yaml_number(const YAML::Node& node);
std::optional<std::vector<double>> yaml_numbers(const YAML::Node& list);

}  // namespace outrider
