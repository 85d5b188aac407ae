// Flags derived from described options: --name for the top level, --group-name for the groups.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider::cli {

/// "--targets-block", "--robot-radius", ...
std::string flag_of(const std::string& group, const std::string& option);

/// Adds one flag for each option. What is given waits in `app` until apply_flags() reads it, so that
/// flags can win over a file that is read in between.
void add_flags(CLI::App& app, const std::vector<OptionGroup>& groups);

/// Assigns what was given to the options; the fault names the flag.
Status apply_flags(const CLI::App& app, const std::vector<OptionGroup>& groups);

/// What was wrong with words that the parser refused, in one sentence with the nearest that would do.
Fault misunderstanding(const CLI::App& app, const CLI::ParseError& error);

}  // namespace outrider::cli
