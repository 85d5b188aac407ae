// A picture of a map of landmarks or of a pose graph.
#pragma once

#include <string>
#include <vector>

#include "outrider/slam/landmark_slam.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

struct SlamPicture {
  std::vector<std::vector<Vec2>> driven;    ///< estimated tracks
  std::vector<std::vector<Vec2>> odometry;  ///< the same tracks by odometry alone
  std::vector<std::vector<Vec2>> loops;     ///< edges between poses that are not consecutive
  LandmarkMap landmarks;                    ///< drawn with 95 % ellipses
  std::vector<Vec2> truth;                  ///< places of landmarks, in the frame of the estimate
};

/// Returns a self-contained SVG for light and dark backgrounds.
std::string to_svg(const SlamPicture& picture);

}  // namespace outrider
