// Flags derived from described options: --name for the top level, --group-name for the groups.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider::cli {

/// What was given on the command line, by flag; applied after the scenario file so that flags win.
using GivenFlags = std::map<std::string, std::string>;

/// "--targets-block", "--robot-radius", ...
std::string flag_of(const std::string& group, const std::string& option);

/// Adds one flag for each option; the values land in `given`, which must outlive the parse.
void add_flags(CLI::App& app, const std::vector<OptionGroup>& groups, GivenFlags& given);

/// Assigns what was given to the options; the fault names the flag.
Status apply_flags(const GivenFlags& given, const std::vector<OptionGroup>& groups);

}  // namespace outrider::cli
