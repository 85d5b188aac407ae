// The pose of a scan on the surfaces around the robot.
//
// Odometry is believed first: the best pose is searched within three of its standard deviations. If few
// points lie on surfaces there, or another scan looked through them, the window is widened to 0.6 m and 0.6
// rad. If nothing is found there either, the scan may show something new: behind a door, most of it is. Only
// if another scan contradicts it where odometry says, odometry is wrong, and the window is widened to 4 m and
// the full turn. In a window that is large enough for several places, the scan must be recognised: nearly all
// points lie on surfaces, no other pose scores nearly as well, and hardly any point is one that another scan
// looked through.
#pragma once

#include <functional>
#include <optional>

#include "back_off.hpp"
#include "motion_noise.hpp"
#include "scan/surface_map.hpp"

namespace outrider {

/// A window of more than this may hold several places.
constexpr double most_correction_m = 3.0;

/// Returns the window about a pose by odometry, three standard deviations to each side.
MatchWindow odometry_window(const Pose2& pose, const Driven& since_match, const LaserSlamOptions& options);

/// Returns the pose of a surface on a map; nothing unless most points lie on surfaces of the map and no other
/// pose in the window scores nearly as well. A window with many poses is searched sooner for a high score.
std::optional<Fit> recognise_place(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                                   double least_score = 0.5);

/// Returns the pose of a surface in or close to a window, as match_scan() does before it searches wide.
std::optional<Fit> match_nearby(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                                const std::function<double(const Pose2&)>& contradiction);

/// Returns the pose of a surface in or around a window whose centre and deviations are those of the odometry;
/// nothing if too few points match. `contradiction` returns the share of the points that another scan looked
/// through at a pose; a pose with a large share is not returned. The fewer points match, the less is large.
/// `wide` tells whether a search of a wide window is due.
std::optional<Fit> match_scan(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                              const std::function<double(const Pose2&)>& contradiction, BackOff& wide);

}  // namespace outrider
