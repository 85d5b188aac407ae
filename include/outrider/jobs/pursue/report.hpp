// pursuit_report() makes the report of a pursuit. It is a pure function of its arguments and contains no
// wall-clock times, so the same run gives the same bytes.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/jobs/pursue/run.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Returns the report. Its status is "done" if the target was caught. A cell is 1 m. The map is drawn with at
/// most 500 cells a side: a larger map is averaged over square blocks, and a block with more walls than free
/// cells is a wall.
Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const std::string& name);

/// Returns the report of a pursuit that was proven impossible before it began.
Report pursuit_report(const PursuitProblem& problem, const Fault& fault, const std::string& name);

}  // namespace outrider
