// Runs jobs: from a scenario file, or from options.
//
//   const auto run = run_job(jobs(), "scenarios/yard/yard.yaml", {{"seed", "2"}});
//   for (const auto& [name, value] : run->report.metrics) ...
//
// Paths in a scenario are relative to its file; those among the changes to the folder of the process.
// Faults: bad_input with file and line, or the key; those of the job.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "outrider/job/job.hpp"

namespace outrider {

/// Options to set after the scenario: a key such as "seed" or "robot.radius", and its value as text.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// The job of that name; the fault names `where`.
Outcome<Job> find_job(const std::vector<Job>& jobs, std::string_view name, std::string where = "job");

/// The job that a scenario file names, or its text, which the fault calls `name`.
Outcome<Job> job_of_scenario(const std::vector<Job>& jobs, const std::string& path);
Outcome<Job> job_of_scenario_text(const std::vector<Job>& jobs, const std::string& text,
                                  const std::string& name);

/// Sets the options of the task that the scenario has. It must be one of the task's job. Files that it names
/// are made relative to the folder of the process; with `as_if`, as if the scenario lay at that path.
Status read_scenario(JobTask& task, const std::string& path, const std::string& as_if = {});

/// Sets options by key. On a fault those before it are set.
Status change(JobTask& task, const Changes& changes);

/// Loads and runs a task. Its report has the settings and warnings, and a run that was stopped has the
/// status "cancelled", however early that was.
Outcome<Run> run_task(const Job& job, JobTask& task, const RunWatch& watch = {});

/// Reads a scenario, sets the changes, loads and runs.
Outcome<Run> run_job(const std::vector<Job>& jobs, const std::string& scenario_path,
                     const Changes& changes = {}, const RunWatch& watch = {});

/// The key of an option as it stands in changes and reports: "seed", or "robot.radius" of a section.
std::string key_of(const OptionGroup& group, const Option& option);

/// Each option and its value with the unit, as reports keep them.
std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<OptionGroup>& groups);

}  // namespace outrider
