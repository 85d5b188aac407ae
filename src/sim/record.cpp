#include "outrider/sim/record.hpp"

#include <utility>

namespace outrider {

void swap_entries(SimRecord& record, Report& report) {
  std::swap(record.track, report.track);
  std::swap(record.paths, report.paths);
  std::swap(record.shots, report.shots);
  std::swap(record.events, report.events);
  if (report.supplies) std::swap(record.levels, report.supplies->levels);
}

}  // namespace outrider
