// A job as a value: all that the tool, the server, Python, a sweep or a test needs to run one.
//
//   struct Patrol : JobTask { ... };                      // its options, its inputs, its run
//   const Job patrol{.name = "patrol", .sentence = "...", .blank = [] { return std::make_unique<Patrol>();
//   }};
//
// jobs/catalog.hpp lists the jobs of Outrider, job/run_job.hpp runs one; tests/unit/job/run_job_test.cpp
// has one of its own.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/files.hpp"
#include "outrider/job/table.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// What was repaired in an input or left out of it, a sentence each.
using Warnings = std::vector<std::string>;

/// What a run gives. Verdict, reason and metrics stand in the report.
struct Run {
  Report report;                         ///< status "done", "not_done" or "cancelled"
  std::vector<NamedContent> files = {};  ///< what else the job made, by name, such as "map.yaml"
  std::vector<Report> parts = {};  ///< missions within the mission that have pictures of their own, by job
  std::vector<Table> tables = {};  ///< those that are not made from the report by Job::tables
};

/// One task: options first, then the inputs that they name, then a run. Thread rule: one thread.
class JobTask {
 public:
  virtual ~JobTask() = default;
  JobTask(const JobTask&) = delete;
  JobTask& operator=(const JobTask&) = delete;

  /// The options with their present values, the key `job` first. They point into the task.
  std::vector<OptionGroup> options();

  /// Reads every file that the options name, and checks the options against each other. Faults: bad_input
  /// with file and line, or the key.
  virtual Outcome<Warnings> load() = 0;

  /// Plans and carries out; after load(). A pure function of the task, machine_times of the report left out.
  /// A run that is stopped while its mission is under way returns what was done so far, with the status
  /// "cancelled"; before that the fault is cancelled.
  virtual Outcome<Run> run(const RunWatch& watch) = 0;

  std::string job;              ///< the value of the key `job`
  std::set<std::string> given;  ///< keys that a scenario or a caller has set, as "seed" or "robot.radius"

 protected:
  explicit JobTask(std::string_view name) : job(name) {}
  /// The options but for `job`: those of the group "" stand at the top of a scenario.
  virtual std::vector<OptionGroup> describe() = 0;
};

/// A row of a catalogue of jobs.
struct Job {
  std::string_view name;
  std::string_view sentence;
  std::string_view example = {};  ///< words of a command line after "outrider"
  /// A task with all options at their defaults.
  std::function<std::unique_ptr<JobTask>()> blank;
  /// The option that a file named without a flag stands for, and what it may be; empty: none.
  std::string_view file_option = {};
  std::string_view file_sentence = {};
  /// Second names of flags: {"planner", "plan.planner"}.
  std::vector<std::pair<std::string_view, std::string_view>> aliases = {};
  double picture_s = 24.0;  ///< length of its moving picture
  /// A report of this job in text that a person enjoys.
  std::function<std::string(const Report&)> summary = {};
  /// The same of a whole run, where its report does not hold what a person wants to read.
  std::function<std::string(const Run&)> run_summary = {};
  /// Its tables, such as the targets.
  std::function<std::vector<Table>(const Report&)> tables = {};
};

}  // namespace outrider
