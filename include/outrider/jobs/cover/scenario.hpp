// The scenario of covering an area: every setting under the name it has in files and flags.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/jobs/cover/plan.hpp"

namespace outrider {

struct CoverScenario {
  std::string area;            ///< path of an area (io/cover_area.hpp)
  std::string units = "auto";  ///< of its numbers: auto, degrees or metres
  std::string method = "quickest";
  std::string start;          ///< "x,y,heading"; empty: where the track begins
  double error_factor = 1.0;  ///< see cover/time_bound.hpp
  std::int64_t seed = 1;
  CoverProblem problem;  ///< its numbers are options; its polygons come from the file
  CoverOptions options;
};

/// The top-level keys first, then the sections pace and order.
std::vector<OptionGroup> describe(CoverScenario& scenario);

/// All that a job is made of.
struct CoverTask {
  CoverProblem problem;
  CoverMethod method;
  std::string note;  ///< how numbers of the file were understood, where that is not certain

  /// Where the boundary and the holes stand in the file.
  std::string boundary_where;
  std::vector<std::string> hole_wheres;
};

/// Reads the area and the names. Faults: bad_input with the file and line, or the key.
Outcome<CoverTask> load_task(const CoverScenario& scenario);

/// A fault of the job with "boundary" or "hole 2" as its place, told with the place in the file instead.
Fault placed(Fault fault, const CoverTask& task);

}  // namespace outrider
