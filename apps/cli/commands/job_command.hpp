// The commands of the tool that run jobs, made from the job catalogue: one for each job, and `run`.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "command.hpp"
#include "outrider/job/job.hpp"

namespace outrider::cli {

/// Adds a command for each job, with the options of the job and the common output options as flags. The stop
/// token ends the run.
void add_jobs(Command& tool, const std::vector<Job>& jobs, const std::stop_token& stop);

/// Returns true if the arguments run a job: the command of a job, or `run`.
bool runs_job(const std::vector<Job>& jobs, const std::vector<std::string>& words);

/// Adds `run`, which takes a scenario and the flags of its job.
void add_run(Command& tool);

/// Rewrites `run FILE FLAGS` to `JOB --scenario FILE FLAGS`. Returns every other command line unchanged, also
/// `run` without a file. If --stdin is among the flags, the text on standard input becomes the content of
/// FILE.
Outcome<std::vector<std::string>> expand_run(const std::vector<Job>& jobs, std::vector<std::string> words);

}  // namespace outrider::cli
