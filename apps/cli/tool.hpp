// The command line of Outrider for a catalogue of jobs: main() of the tool, and of programs with jobs of
// their own.
#pragma once

#include <vector>

#include "outrider/job/job.hpp"

namespace outrider::cli {

/// Runs the command line. Returns the exit status: 0 done, 1 not done, 2 refused, 3 not written.
int run_tool(const std::vector<Job>& jobs, int argc, char** argv);

}  // namespace outrider::cli
