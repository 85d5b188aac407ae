// A run on the terminal, as JSON and in a folder.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/job.hpp"
#include "outrider/job/run_json.hpp"

namespace outrider::cli {

struct RunOutput {
  bool json = false;
  std::string folder;  ///< empty: nothing is written
  bool html = false;   ///< a page that plays the run, too
};

/// Refuses a folder that cannot be made, a page without a folder, and one where the tool has none.
Status check(const RunOutput& output, bool folder_given);

/// Writes the report (of a run with nothing to play, the object that is printed), its moving picture unless
/// the job has drawn one, the page and what the job made: all of them or none. Pictures and page are made
/// from the text of the report, so that a replay makes the same. Of a run that was cancelled before its
/// mission began nothing is written, so that what an earlier one left stays whole.
Outcome<WrittenFiles> write_run(const Job& job, const Run& run, const RunOutput& output);

/// The tables of a report; none of one that has nothing to tell, as when it was cancelled at once.
std::vector<Table> tables_of(const Job& job, const Report& report);

/// The report in words for people.
std::string text_of(const Job& job, const Report& report);

/// Prints warnings, and the run as JSON or for people.
void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json);

}  // namespace outrider::cli
