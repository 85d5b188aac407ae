// Output of a run: on the terminal, as JSON and in a folder.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/job.hpp"
#include "outrider/job/write_run.hpp"

namespace outrider::cli {

struct RunOutput {
  bool json = false;
  std::string folder;  ///< if empty, nothing is written
  bool html = false;   ///< also write a page that plays the run
};

/// Refuses a folder that cannot be created, a page without a folder, and a page if the tool was built without
/// one.
Status check(const RunOutput& output, bool folder_given);

/// Writes the run and, if asked for, its page, as job/write_run.hpp says.
Outcome<WrittenFiles> write_run(const Job& job, Run& run, RunLog& log, const RunOutput& output);

/// Returns a page that plays the run whose log is in that file. Fault: bad_input if the log is larger than
/// 256 MiB.
Outcome<std::string> page_text(const Report& report, const std::string& log_path);

/// Returns the report as text for people.
std::string text_of(const Job& job, const Report& report);

/// Prints the warnings, then the run as JSON or for people.
void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json);

}  // namespace outrider::cli
