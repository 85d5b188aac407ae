// Flags derived from described options: --name for the top level, --group-name for the groups.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "command.hpp"
#include "outrider/core/options.hpp"

namespace outrider::cli {

/// "--targets-block", "--robot-radius", ...
std::string flag_of(const std::string& group, const std::string& option);

/// Adds one flag for each option. What is given waits in `command` until apply_flags() reads it, so that
/// flags can win over a file that is read in between.
void add_flags(Command& command, const std::vector<OptionGroup>& groups);

/// Assigns what was given to the options; the fault names the flag. Options that the command does not have as
/// flags stay as they are. The keys of what was given, as "robot.radius", go to `given`.
Status apply_flags(const Command& command, const std::vector<OptionGroup>& groups,
                   std::set<std::string>* given = nullptr);

}  // namespace outrider::cli
