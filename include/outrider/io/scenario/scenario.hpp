// Scenario files: YAML files whose keys are options.
//
// The options of the group with the empty name are at the top of the file; every other group is a section
// with its name:
//     seed: 3
//     robot:
//       radius: 0.26
// Options without a key keep their value. The JSON schema, a commented scenario and the tables of the manual
// are generated from the same groups, so none of them is written by hand.
//
// Faults: bad_input with file:line and the key; for an unknown key, with the nearest known one. After a
// fault, every option has its previous value. Angles are in degrees in files and in radians in memory.
// Bounds: 1 MiB. O(keys x options).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

/// Reads a scenario into the options. Refuses unknown sections and keys, duplicate keys, wrong types (a
/// quoted number is text) and values out of range.
Status load_scenario(const std::string& path, const std::vector<OptionGroup>& groups);
Status scenario_from_text(std::string_view text, const std::string& name,
                          const std::vector<OptionGroup>& groups);

/// Returns the value of the key `job` in a scenario file; empty if there is none.
Outcome<std::string> scenario_job(const std::string& path);
Outcome<std::string> scenario_job_from_text(const std::string& text, const std::string& name);

/// Returns the keys in a scenario file; those in sections have the form `robot.radius`.
Outcome<std::vector<std::string>> scenario_keys(const std::string& path);

/// Returns the JSON schema (draft 2020-12) of the scenarios that load_scenario() accepts, with the present
/// values as defaults.
std::string scenario_schema(const std::vector<OptionGroup>& groups, const std::string& title);

/// Returns a scenario with every option at its present value and its sentence as a comment. load_scenario()
/// reads it back to the same values.
std::string scenario_text(const std::vector<OptionGroup>& groups);

/// Returns a scenario, without comments, of the options whose values differ from those of the same options in
/// `defaults`.
std::string scenario_changes(const std::vector<OptionGroup>& groups,
                             const std::vector<OptionGroup>& defaults);

/// Returns a Markdown table for each group: key, default (the present value), unit, range, sentence.
std::string options_markdown(const std::vector<OptionGroup>& groups);

}  // namespace outrider
