// Flags derived from described options: --name at the top level, --group-name within groups.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "command.hpp"
#include "outrider/core/options.hpp"

namespace outrider::cli {

/// Returns the flag of an option: "--targets-block", "--robot-radius", ...
std::string flag_of(const std::string& group, const std::string& option);

/// Adds one flag for each option. The given values wait in `command` until apply_flags() reads them, so that
/// flags can override a file that is read in between.
void add_flags(Command& command, const std::vector<OptionGroup>& groups);

/// Assigns the given values to the options; a fault names the flag. Options for which the command has no flag
/// are unchanged. Adds the keys of the assigned options, such as "robot.radius", to `given`.
Status apply_flags(const Command& command, const std::vector<OptionGroup>& groups,
                   std::set<std::string>* given = nullptr);

}  // namespace outrider::cli
