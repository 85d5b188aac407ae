// Errors of estimated positions and maps against the truth, before and after rigid alignment.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "outrider/slam/landmark_slam.hpp"

namespace outrider {

/// world_T_estimate: the rotation and translation with the least sum of squared distances between a + (b,
/// ...) and its partner. Source: Umeyama, IEEE PAMI 13 (1991) 376-380, in the plane and without scale.
Pose2 rigid_alignment(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth);

/// Root of the mean squared distance between partners once `estimate` is moved; nothing without any.
std::optional<double> rms_distance(const std::vector<Vec2>& estimate, const std::vector<Vec2>& truth,
                                   const Pose2& motion = {});

struct MapError {
  std::size_t landmarks = 0;  ///< that are in both
  std::optional<double> rmse_m;
  std::optional<double> aligned_rmse_m;
  Pose2 alignment;  ///< truth_T_map
};

/// Of landmarks by id.
MapError map_error(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth);

/// Of a map whose ids mean nothing: each landmark goes to the place of the truth that is nearest, within
/// `reach_m`, under the rigid motion that takes most of them to different places, and of these motions the
/// one with the least error. Tries every pair of landmarks on every pair of places.
MapError map_error_by_place(const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth,
                            double reach_m);

/// Two landmarks whose ids the truth has exchanged: those whose exchange makes the aligned error least, if
/// that is a quarter of what it is or less.
std::optional<std::pair<std::int64_t, std::int64_t>> exchanged_ids(const LandmarkMap& map,
                                                                   const std::map<std::int64_t, Vec2>& truth);

}  // namespace outrider
