// The verbs of the tool that run jobs, made from their catalogue: one for each job, and `run`.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "command.hpp"
#include "outrider/job/job.hpp"

namespace outrider::cli {

/// Adds a verb for each job: its options as flags, and the flags about output that all have. The token ends
/// the run.
void add_jobs(Command& tool, const std::vector<Job>& jobs, const std::stop_token& stop);

/// True when the words run a job: its verb, or `run`.
bool runs_job(const std::vector<Job>& jobs, const std::vector<std::string>& words);

/// Adds `run`, which takes a scenario and the flags of its job.
void add_run(Command& tool);

/// The command line of `run FILE FLAGS` as that of the verb of its job: `JOB --scenario FILE FLAGS`. Every
/// other command line stays as it is, `run` without a file too. With --stdin among the flags the text on
/// standard input becomes the content of FILE.
Outcome<std::vector<std::string>> expand_run(const std::vector<Job>& jobs, std::vector<std::string> words);

}  // namespace outrider::cli
