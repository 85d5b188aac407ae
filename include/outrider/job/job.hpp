// Job: the description of a kind of task. It holds all that the command line tool, the server, Python, a
// sweep or a test needs to run such a task.
//
//   struct Patrol : JobTask { ... };                      // its options, its inputs, its run
//   const Job patrol{.name = "patrol", .sentence = "...", .blank = [] { return std::make_unique<Patrol>();
//   }};
//
// jobs/catalog.hpp lists the jobs of Outrider. job/run_job.hpp runs a job. tests/unit/job/run_job_test.cpp
// defines a job outside the library.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// One sentence for each repair to an input and for each part of it that was ignored.
using Warnings = std::vector<std::string>;

/// A run: its result, what happened in it, and the files that it made.
struct Run {
  Report report;                         ///< status (report.hpp), metrics, tables
  Log log;                               ///< all messages
  std::vector<NamedContent> files = {};  ///< other files that the job made, such as "map.yaml"
};

/// One task of a job. Set its options, then call load(), then run(). Thread rule: use each task from one
/// thread.
class JobTask {
 public:
  virtual ~JobTask() = default;
  JobTask(const JobTask&) = delete;
  JobTask& operator=(const JobTask&) = delete;

  /// Returns the options with their present values; the key `job` comes first. They point into the task.
  std::vector<OptionGroup> options();

  /// Reads every file that the options name and checks that the options fit together. Faults: bad_input with
  /// file and line, or with the key of the option.
  virtual Outcome<Warnings> load() = 0;

  /// Plans the task and carries it out. Call load() first, and give an empty run, whose log may have sinks.
  /// The result is a pure function of the task, except for Report::machine_times. A run that is stopped
  /// during its mission has the part done, with the status "cancelled"; if it is stopped earlier, the fault
  /// is `cancelled`.
  virtual Status run(Run& run, const RunWatch& watch) = 0;

  std::string job;              ///< the value of the key `job`
  std::set<std::string> given;  ///< keys set by a scenario or a caller, such as "seed" or "robot.radius"

 protected:
  explicit JobTask(std::string_view name) : job(name) {}
  /// Returns all options except `job`. Options of the group "" are top-level keys of a scenario.
  virtual std::vector<OptionGroup> describe() = 0;
};

/// A job: its name, its documentation, and functions that make a task and present its result.
struct Job {
  std::string_view name;
  std::string_view sentence;      ///< one sentence that says what the job does
  std::string_view example = {};  ///< arguments of an example command line, after "outrider"
  /// Makes a task with all options at their defaults.
  std::function<std::unique_ptr<JobTask>()> blank;
  /// The option that receives a file given without a flag; empty: none.
  std::string_view file_option = {};
  std::string_view file_sentence = {};  ///< which files this option accepts
  /// Alternative names of flags, such as {"planner", "plan.planner"}; one name may stand for several keys.
  std::vector<std::pair<std::string_view, std::string_view>> aliases = {};
  /// Formats what run.json has of a run of this job, metrics, tables and settings, as text for a person.
  std::function<std::string(const Report&)> summary = {};
};

}  // namespace outrider
