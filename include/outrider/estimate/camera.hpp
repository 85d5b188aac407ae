// Camera: a pinhole with the "plumb bob" lens of ROS and OpenCV.
//
// Frame: x to the right of the image, y down, z along the view. Points of an image are measured from its
// upper left corner, so that pixel (i, j) has its centre at (i + 0.5, j + 0.5). Calibration files measure
// cx and cy from the centre of the first pixel instead, and so does this struct: project() and ray_through()
// are where the half pixel is added, and nothing else needs to know.
// Source: Brown, Decentering distortion of lenses, 1966; OpenCV, Camera calibration and 3D reconstruction.
#pragma once

#include <array>
#include <optional>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

struct Camera {
  int width_px = 1920;
  int height_px = 1080;
  double fx = 701.1;  ///< focal lengths, px
  double fy = 697.1;
  double cx = 962.4;  ///< where the axis meets the image, from the centre of its first pixel, px
  double cy = 524.4;
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3
};

/// Refuses a singular camera matrix, values that are not finite, and a distortion that folds the image.
Status check_camera(const Camera& camera);

/// Projects a point of the camera's frame to the image plane; nothing if it is not in front of the camera, or
/// so far off the axis that the distortion model folds back. The result may lie outside the image. O(1).
std::optional<Vec2> project(const Camera& camera, Vec3 point);

/// The inverse of project(): the point of the plane z = 1 that appears at `image`. Newton's method, to 1e-12
/// where the distortion is invertible. O(1).
Vec2 ray_through(const Camera& camera, Vec2 image);

/// A camera and its mounting on the robot.
struct RobotCamera {
  Camera camera;
  Pose3 robot_T_camera;
};

/// robot_T_camera of a camera that looks along the robot's x axis from `position` on it (m), turned left by
/// `yaw_rad` and then down by `pitch_rad`.
Pose3 looking_ahead(Vec3 position, double yaw_rad = 0.0, double pitch_rad = 0.0);

}  // namespace outrider
