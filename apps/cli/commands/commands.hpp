// The commands of the tool that are not jobs (for jobs see job_command.hpp). Each function adds one to the
// tool.
#pragma once

#include <stop_token>
#include <vector>

#include "command.hpp"
#include "outrider/job/job.hpp"

namespace outrider::cli {

void add_detect(Command& tool);
void add_calibrate(Command& tool);
void add_convert(Command& tool, const std::stop_token& stop);
void add_ros(Command& tool, const std::stop_token& stop);
void add_sweep(Command& tool, const std::vector<Job>& jobs, const std::stop_token& stop);
void add_replay(Command& tool, const std::vector<Job>& jobs);
void add_bench(Command& tool);
void add_list(Command& tool, const std::vector<Job>& jobs);
void add_completion(Command& tool);
void add_schema(Command& tool, const std::vector<Job>& jobs);
void add_serve(Command& tool, const std::vector<Job>& jobs);

}  // namespace outrider::cli
