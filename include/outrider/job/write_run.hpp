// Writes what a run leaves: run.json, its log run.mcap, its plan view run.svg, and the files of the job.
//
//   RunLog log(folder, scenario_text(task.options()));
//   auto run = run_task(job, task, {.sinks = {&log}});
//   const auto written = write_run(*run, log, folder);
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "outrider/io/files/files.hpp"
#include "outrider/job/job.hpp"
#include "outrider/job/run_log.hpp"
#include "outrider/report/run_json.hpp"

namespace outrider {

/// Returns the text of run.json: that of run_json() with the settings, and without the machine times, which
/// differ from run to run.
std::string result_text(const Run& run);

/// Makes the page of a run from its complete log, whose path is given.
using MakePage = std::function<Outcome<NamedContent>(const std::string& log_path)>;

/// Completes the log and writes the files into the folder: all of them or none. A run without messages has no
/// log, no picture and no page. Writes nothing for a run that was cancelled before its mission began,
/// so the files of an earlier run stay whole. Takes the contents of the files from the run. Faults: bad_input
/// for the folder; cannot_write; those of `page`.
Outcome<WrittenFiles> write_run(Run& run, RunLog& log, const std::string& folder, const MakePage& page = {});

}  // namespace outrider
