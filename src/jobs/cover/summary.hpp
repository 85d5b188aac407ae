// A covered area in words for people, from its report alone.
#pragma once

#include <string>

#include "outrider/report/report.hpp"

namespace outrider {

std::string cover_summary(const Report& report);

}  // namespace outrider
