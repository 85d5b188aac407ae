// Output of a run: on the terminal, as JSON and in a folder.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/job.hpp"
#include "outrider/report/run_json.hpp"
#include "run_log.hpp"

namespace outrider::cli {

struct RunOutput {
  bool json = false;
  std::string folder;  ///< if empty, nothing is written
  bool html = false;   ///< also write a page that plays the run
};

/// Refuses a folder that cannot be created, a page without a folder, and a page if the tool was built without
/// one.
Status check(const RunOutput& output, bool folder_given);

/// Returns the text of run.json: the printed JSON with the settings, and without the machine times, which
/// differ from run to run.
std::string result_text(const Run& run);

/// Completes the log, and writes run.json, its plan view run.svg, the page, and the
/// files of the job: all of them or none. A run without messages has no log. Writes nothing for a run that
/// was cancelled before its mission began, so the files of an earlier run stay whole. Takes the contents of
/// the files from the run.
Outcome<WrittenFiles> write_run(const Job& job, Run& run, RunLog& log, const RunOutput& output);

/// Returns a page that plays the run whose log is in that file. Fault: bad_input if the log is larger than
/// 256 MiB.
Outcome<std::string> page_text(const Report& report, const std::string& log_path);

/// Returns the report as text for people.
std::string text_of(const Job& job, const Report& report);

/// Prints the warnings, then the run as JSON or for people.
void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json);

}  // namespace outrider::cli
