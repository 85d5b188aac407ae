// Which of several paths a report tells of, and its speeds.
#pragma once

#include "outrider/jobs/plan/answer.hpp"

namespace outrider {

/// The row of the shortest path, null where none was found. Planners on polygons come first: one on their
/// grid starts and ends at vertices, and may look shorter than the shortest path.
const PlanRow* shortest(const std::vector<const PlanRow*>& rows);

/// The table "speed_profile" of the path that the metrics are of: a row for each phase of its fastest drive,
/// with the time and place where it begins, the speed there and the acceleration from there on, and one for
/// its end. Empty where no path was found.
Table speed_profile_of(const PlanQuestion& question, const PlanAnswer& answer);

}  // namespace outrider
