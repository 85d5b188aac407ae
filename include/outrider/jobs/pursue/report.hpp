// The report of a pursuit. A pure function of its arguments; times on the wall are left out, so that the
// same run gives the same bytes.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/jobs/pursue/run.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// status is "done" when the target was caught. A cell is 1 m. The map is drawn with at most 500 cells a
/// side: larger ones as means over square blocks, a block with more walls than free cells as a wall.
Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const std::string& name);

/// The report of a pursuit that was proven to be impossible before it began.
Report pursuit_report(const PursuitProblem& problem, const Fault& fault, const std::string& name);

}  // namespace outrider
