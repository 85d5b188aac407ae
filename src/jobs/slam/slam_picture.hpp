// A map of landmarks or a pose graph, drawn.
#pragma once

#include <string>
#include <vector>

#include "outrider/slam/landmark_slam.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

struct SlamPicture {
  std::vector<std::vector<Vec2>> driven;    ///< estimated tracks
  std::vector<std::vector<Vec2>> odometry;  ///< what odometry alone makes of them
  std::vector<std::vector<Vec2>> loops;     ///< edges that join poses which do not follow each other
  LandmarkMap landmarks;                    ///< with the ellipses that hold 95 %
  std::vector<Vec2> truth;                  ///< places of landmarks, in the frame of the estimate
};

/// SVG, of itself, on a light and a dark ground.
std::string to_svg(const SlamPicture& picture);

}  // namespace outrider
