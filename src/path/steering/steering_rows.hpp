// The rows of the catalogue for robots that steer.
#pragma once

#include <vector>

#include "outrider/path/catalog.hpp"

namespace outrider {

std::vector<PathPlanner> planners_that_steer();

}  // namespace outrider
