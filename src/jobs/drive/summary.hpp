// A drive in words for people, from its metrics and tables.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

std::string drive_summary(const Report& report);

}  // namespace outrider
