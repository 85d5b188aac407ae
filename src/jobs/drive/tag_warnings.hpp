// Warnings about tags that a closed loop will miss.
#pragma once

#include <string>
#include <vector>

#include "outrider/jobs/drive/task.hpp"

namespace outrider {

/// Returns a sentence for each reason why stops of a closed loop cannot be confirmed: no tags, or no tag in
/// view of the camera at a stop. O(stops tags obstacles).
std::vector<std::string> tag_warnings(const DriveTask& task);

}  // namespace outrider
