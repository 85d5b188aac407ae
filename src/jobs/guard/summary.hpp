// A guarded yard in words for people, from its report alone.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/table.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

std::string guard_summary(const Report& report);

/// `targets`: name, status, reason, x, y, heading_rad of the robot, pitch_rad, yaw_rad, speed_mps and
/// clearance_m of the shot; NaN where no shot was fired.
std::vector<Table> guard_tables(const Report& report);

}  // namespace outrider
