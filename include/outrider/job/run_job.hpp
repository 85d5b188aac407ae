// Functions that run a job, from a scenario file or from options.
//
//   const auto run = run_job(jobs(), "scenarios/yard/yard.yaml", {{"seed", "2"}});
//   for (const auto& [name, value] : run->report.metrics) ...
//
// A path in a scenario is relative to the scenario file; a path in the changes is relative to the working
// directory. Faults: bad_input with file and line, or with the key; and the faults of the job.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "outrider/job/job.hpp"

namespace outrider {

/// Options that override the scenario: a key such as "seed" or "robot.radius", and its value as text.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// Returns the job of that name. Fault: bad_input; its message begins with `where`.
Outcome<Job> find_job(const std::vector<Job>& jobs, std::string_view name, std::string where = "job");

/// Returns the job that a scenario file names under the key `job`. The second function reads the scenario
/// from text; its faults name the text `name`.
Outcome<Job> job_of_scenario(const std::vector<Job>& jobs, const std::string& path);
Outcome<Job> job_of_scenario_text(const std::vector<Job>& jobs, const std::string& text,
                                  const std::string& name);

/// Sets the options that the scenario has in the task. The scenario must be of the same job. Paths in it
/// become relative to the working directory. If `as_if` is given, they are resolved as if the scenario were
/// the file `as_if`.
Status read_scenario(JobTask& task, const std::string& path, const std::string& as_if = {});

/// Sets options by key, in order. If one of them is refused, the options before it stay set.
Status change(JobTask& task, const Changes& changes);

/// Loads and runs a task. The report contains the settings and warnings. A stopped run has the status
/// "cancelled", even if it was stopped before its mission began.
Outcome<Run> run_task(const Job& job, JobTask& task, const RunWatch& watch = {});

/// Reads a scenario, applies the changes, then loads and runs the task.
Outcome<Run> run_job(const std::vector<Job>& jobs, const std::string& scenario_path,
                     const Changes& changes = {}, const RunWatch& watch = {});

/// Returns the full key of an option, as used in changes and reports: "seed", or "robot.radius" for an option
/// of the section "robot".
std::string key_of(const OptionGroup& group, const Option& option);

/// Returns the key and the value with unit of each option, as stored in reports.
std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<OptionGroup>& groups);

}  // namespace outrider
