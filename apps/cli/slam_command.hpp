// The job slam, for the commands that can be asked for it.
#pragma once

#include <string>

#include "command.hpp"

namespace outrider::cli {

/// Does the job in a scenario file on behalf of `run`, whose flags are those of the output and of guard;
/// refuses the latter. Returns the exit status.
int run_slam_scenario(const std::string& path, const Command& flags);

}  // namespace outrider::cli
