// RobotLocaliser: where a robot is, by its odometry and what else it senses.
//
// Rows of robot_localisers():
//   exact          the odometry is the truth, as of a robot that is measured from outside
//   odometry       the odometry of the wheels is believed
//   laser_mapping  scans are matched with each other on a map that grows (laser_slam.hpp)
//   laser_on_map   scans are matched with a known map, from anywhere (map_localiser.hpp)
//   tags           tags that a camera sees tell where it is, from anywhere (localise.hpp); an extended Kalman
//                  filter carries that on by odometry. Five images in a row that agree on another place count
//                  for more than the belief
//
// Frames: the world is that of the known map, or begins at the start that the robot is given. Thread rule:
// one at a time.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/localise.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/slam/map/map_localiser.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// The tags of the world, and the camera that sees them.
struct TagsInSight {
  TagMap map;
  RobotCamera camera;
  LocaliseOptions options = {};
};

/// The beginning of a localiser: the place that the robot is told, its laser, its map, its tags.
struct LocaliserStart {
  std::optional<Pose2> pose;         ///< where the odometry begins; none: anywhere on the map
  Pose2 robot_T_laser;               ///< the mount of its laser
  std::optional<KnownMap> map = {};  ///< a map of the world
  std::optional<TagsInSight> tags = {};
};

class RobotLocaliser {
 public:
  virtual ~RobotLocaliser() = default;
  /// Takes a scan that was measured where the odometry was `odometry_T_robot`. Returns true if that corrected
  /// earlier poses too, so that what was seen from there lies elsewhere.
  virtual bool take(const LaserScan& scan, const Pose2& odometry_T_robot) = 0;
  /// Takes the tags of an image in the same way.
  virtual bool see(const TagImage& /*image*/, const Pose2& /*odometry_T_robot*/) { return false; }
  /// Returns the pose of the frame of the odometry.
  [[nodiscard]] virtual Pose2 world_T_odometry() const = 0;
  /// Returns the covariance of x, y and heading in the world, m^2, m rad, rad^2; zero if odometry is
  /// believed.
  [[nodiscard]] virtual Eigen::Matrix3d covariance() const { return Eigen::Matrix3d::Zero(); }
  /// Returns true if it knows where the robot is. Until then the world is another one, that of the odometry,
  /// and the robot has to look around.
  [[nodiscard]] virtual bool is_located() const { return true; }
  /// Returns why the pose is not known any more; empty if it is.
  [[nodiscard]] virtual std::string lost() const { return {}; }

 protected:
  RobotLocaliser() = default;
  RobotLocaliser(const RobotLocaliser&) = default;
  RobotLocaliser& operator=(const RobotLocaliser&) = default;
};

struct RobotLocaliserRow {
  std::string_view name;
  std::string_view sentence;
  /// Faults: bad_input for a start that is not finite, or that is missing; for a map that cannot be used, or
  /// that is missing.
  Outcome<std::unique_ptr<RobotLocaliser>> (*make)(LocaliserStart start);
};
const std::vector<RobotLocaliserRow>& robot_localisers();

}  // namespace outrider
