// An exploration in words for people, from its report alone.
#pragma once

#include <string>
#include <vector>

#include "outrider/job/table.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

std::string explore_summary(const Report& report);

/// `refused`: x, y (m) and reason of each frontier that was left as it was.
std::vector<Table> explore_tables(const Report& report);

}  // namespace outrider
