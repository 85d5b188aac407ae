// The job plan, for `run`.
#pragma once

#include <string>

#include "command.hpp"

namespace outrider::cli {

/// Answers the question in a scenario file on behalf of `run`, of whose flags it takes --json and --out.
/// Returns the exit status.
int run_plan_scenario(const std::string& path, const Command& flags);

}  // namespace outrider::cli
