// Errors of estimated positions and maps against the truth, before and after rigid alignment.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

/// Returns truth_T_estimate: the rotation and translation with the least sum of squared distances between the
/// estimated and the true positions, paired by index. Source: Umeyama, IEEE PAMI 13 (1991) 376-380, in the
/// plane and without scale.
Pose2 rigid_alignment(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth);

/// Returns the root mean square distance between the moved estimates and the true positions, paired by index;
/// nothing for empty input.
std::optional<double> rms_distance(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth,
                                   const Pose2& motion = {});

/// The error of a map.
struct MapError {
  std::size_t landmarks = 0;     ///< number of landmarks that are in both
  std::optional<double> rmse_m;  ///< root mean square error as estimated; nothing without common landmarks
  std::optional<double> aligned_rmse_m;  ///< the same after rigid alignment
  Pose2 alignment;                       ///< truth_T_map
};

/// Returns the error of a map, with landmarks matched by id.
MapError map_error(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth);

/// Returns the error of a map whose ids are meaningless. Each true place is matched with the nearest free
/// landmark within `reach_m` under a rigid motion. Of all motions that move a pair of landmarks onto a pair
/// of places, the function chooses the one with the most matches, and of these the one with the least error.
MapError map_error_by_place(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth,
                            double reach_m);

/// Returns two landmarks whose ids are exchanged in the truth: the pair whose exchange gives the least
/// aligned error, if that is at most a quarter of the present error.
std::optional<std::pair<std::int64_t, std::int64_t>> exchanged_ids(const LandmarkMap& map,
                                                                   const std::map<std::int64_t, Vec2>& truth);

}  // namespace outrider
