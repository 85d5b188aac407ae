// The plan view: a picture of a run from above, made from its log.
//
// The drawing follows from the channels of the log (docs/log.md), never from the job. Its layers from below
// to above:
//
//   ground   /map with /map_updates, /cost_grid, /firing_regions, /costmap, /expanded, /coverage_area,
//            /terrain, /solids or else /walls, /keep_out_zones, /slow_zones
//   lines    /plan, /robot_N/plan and /plan/NAME, /odom, /reference, /target_pose, /belief with ellipses of
//            two standard deviations, every .../pose and .../trajectory, /loops
//   marks    the robot at its start and at its end, drawn to size, /landmarks, /goal_pose, /refusals,
//            /supplies, /tags, /waypoints, /shots, /targets and /target_positions
//
// A single track is the darker the later. Several paths on /plan/NAME have one colour, but one each, of ten,
// if their poses have times: they are those of robots that drive at once. The legend names exactly what is
// drawn. Numbers that are not finite are left out.
#pragma once

#include <cstddef>
#include <string>

#include "outrider/log/log.hpp"

namespace outrider {

struct PlanViewOptions {
  double width_px = 1000.0;          ///< width of the picture; the plan is at most 0.8 times as high
  std::size_t most_bytes = 400'000;  ///< a longer picture is drawn again with coarser lines and cells
};

/// Returns a static, self-contained SVG with a white background. The same log gives the same bytes. Takes
/// time proportional to the messages, apart from the simplification of lines.
std::string plan_view(const Log& log, const PlanViewOptions& options = {});

}  // namespace outrider
