// Camera: a pinhole camera with the "plumb bob" lens model of ROS and OpenCV.
//
// Frame: x to the right in the image, y down, z along the view. Image points are measured from the upper left
// corner of the image, so pixel (i, j) has its centre at (i + 0.5, j + 0.5). Calibration files and this
// struct measure cx and cy from the centre of the first pixel instead. Only project() and ray_through() have
// to add the half pixel.
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
  double cx = 962.4;  ///< principal point, from the centre of the first pixel, px
  double cy = 524.4;
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3
};

/// Checks a camera. Faults: focal lengths that are not above 0, values that are not finite, sides outside 1
/// to 100,000 px, and a distortion that folds the image.
Status check_camera(const Camera& camera);

/// Projects a point in the camera frame to the image plane. Returns nothing if the point is not in front of
/// the camera, or so far off the axis that the distortion model folds back. The result may lie outside the
/// image. O(1).
std::optional<Vec2> project(const Camera& camera, Vec3 point);

/// Inverts project(): returns the point of the plane z = 1 that appears at `image`. Uses Newton's method;
/// accurate to 1e-12 where the distortion is invertible. O(1).
Vec2 ray_through(const Camera& camera, Vec2 image);

/// A camera and its mounting on the robot.
struct RobotCamera {
  Camera camera;
  Pose3 robot_T_camera;
};

/// Returns robot_T_camera for a camera at `position` on the robot (m) that looks along the x axis of the
/// robot, turned left by `yaw_rad` and then down by `pitch_rad`.
Pose3 looking_ahead(Vec3 position, double yaw_rad = 0.0, double pitch_rad = 0.0);

}  // namespace outrider
