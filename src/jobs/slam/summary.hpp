// A summary of a mapping run in words, made from its report alone.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

std::string slam_summary(const Report& report);

}  // namespace outrider
