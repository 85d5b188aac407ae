// A picture of a covered area: what was covered, what was covered more than once, what was missed, and the
// track.
#pragma once

#include <string>

#include "outrider/jobs/cover/plan.hpp"

namespace outrider {

/// A self-contained SVG 900 pixels wide, or as high where the area is higher than wide.
std::string cover_picture(const CoverPlan& plan, const Coverage& coverage, const std::vector<Vec2>& driven);

}  // namespace outrider
