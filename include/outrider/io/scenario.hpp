// Scenario files: YAML whose keys are options.
//
// The options of the group with the empty name stand at the top of the file; every other group is a
// section of its name:
//     seed: 3
//     robot:
//       radius: 0.26
// Keys that are left out keep their value. The same groups give the JSON schema, a commented scenario
// and the tables of the manual, so that none of them is written by hand.
//
// Errors: bad_input with file:line and the key; an unknown key names the nearest known one. On a fault
// every option has the value it had before. Degrees stand in files, radians in memory.
// Bounds: 1 MiB. O(keys x options).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

/// Refuses unknown sections and keys, duplicate keys, wrong types (a quoted number is text) and values
/// out of range.
Status load_scenario(const std::string& path, const std::vector<OptionGroup>& groups);
Status scenario_from_text(std::string_view text, const std::string& name,
                          const std::vector<OptionGroup>& groups);

/// The value of the key `job` in a scenario file; empty when there is none. Reads the text once and keeps
/// nothing of it.
Outcome<std::string> scenario_job(const std::string& path);
Outcome<std::string> scenario_job_from_text(const std::string& text, const std::string& name);

/// The keys that stand in a scenario file, those of sections as in `robot.radius`.
Outcome<std::vector<std::string>> scenario_keys(const std::string& path);

/// JSON schema (draft 2020-12) of the scenarios that load_scenario() accepts, with present values as
/// defaults.
std::string scenario_schema(const std::vector<OptionGroup>& groups, const std::string& title);

/// A scenario with every option at its present value and its sentence as a comment; load_scenario()
/// reads it back to the same values.
std::string scenario_text(const std::vector<OptionGroup>& groups);

/// A scenario of the options whose value differs from that of the same option in `defaults`, without
/// comments.
std::string scenario_changes(const std::vector<OptionGroup>& groups,
                             const std::vector<OptionGroup>& defaults);

/// A Markdown table for each group: key, default (the present value), unit, range, sentence.
std::string options_markdown(const std::vector<OptionGroup>& groups);

}  // namespace outrider
