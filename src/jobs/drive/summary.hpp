// A drive in words for people, from its report alone.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/table.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

std::string drive_summary(const Report& report);

/// `waypoints`: dx, dy (m) and dtheta (rad) of each, off its pose when it was reached; NaN where it was not.
std::vector<Table> drive_tables(const Report& report);

}  // namespace outrider
