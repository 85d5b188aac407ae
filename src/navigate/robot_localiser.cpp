#include "outrider/navigate/robot_localiser.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {
namespace {

constexpr double match_s = 0.1;  // a scan is matched no sooner after the last one
constexpr double lost_m = 3.0;   // standard deviation of the position at which the robot is lost

class BelievedOdometry final : public RobotLocaliser {
 public:
  explicit BelievedOdometry(const Pose2& start) : start_(start) {}
  bool take(const LaserScan&, const Pose2&) override { return false; }
  [[nodiscard]] Pose2 world_T_odometry() const override { return start_; }

 private:
  Pose2 start_;
};

class LaserMapping final : public RobotLocaliser {
 public:
  LaserMapping(LaserSlam slam, const Pose2& start) : slam_(std::move(slam)), world_T_odometry_(start) {}

  bool take(const LaserScan& scan, const Pose2& odometry_T_robot) override {
    if (taken_ && scan.time_s - taken_s_ < match_s - 1e-9) return false;
    const Pose2 motion = wrap_heading(relative_pose(taken_ ? odometry_ : Pose2{}, odometry_T_robot));
    const auto step = slam_.advance(motion, scan);
    if (!step) return false;
    taken_ = true;
    taken_s_ = scan.time_s;
    odometry_ = odometry_T_robot;
    world_T_odometry_ = compose(step->pose, inverse(odometry_T_robot));
    covariance_ = slam_.pose_covariance();
    const double sigma_m = std::sqrt(std::max(covariance_(0, 0), covariance_(1, 1)));
    lost_ =
        sigma_m > lost_m
            ? fmt::format("its position has a standard deviation of {:.2f} m by laser and odometry", sigma_m)
            : std::string{};
    return step->closed_loop;
  }
  [[nodiscard]] Pose2 world_T_odometry() const override { return world_T_odometry_; }
  [[nodiscard]] Eigen::Matrix3d covariance() const override { return covariance_; }
  [[nodiscard]] std::string lost() const override { return lost_; }

 private:
  LaserSlam slam_;
  Pose2 world_T_odometry_;
  Pose2 odometry_;  // of the scan that was taken last
  bool taken_ = false;
  double taken_s_ = 0.0;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  std::string lost_;
};

Outcome<std::unique_ptr<RobotLocaliser>> make_odometry(const Pose2& start, const Pose2&) {
  if (!finite(start)) return bad_input("the start must be finite");
  return std::make_unique<BelievedOdometry>(start);
}

Outcome<std::unique_ptr<RobotLocaliser>> make_laser_mapping(const Pose2& start, const Pose2& robot_T_laser) {
  LaserSlamOptions options;
  options.robot_T_laser = robot_T_laser;
  options.draw_late = true;
  options.odometry_turn_per_distance_rad = 0.1;
  auto slam = LaserSlam::begin(options, start);
  if (!slam) return pass_on(slam);
  return std::make_unique<LaserMapping>(std::move(*slam), start);
}

}  // namespace

const std::vector<RobotLocaliserRow>& robot_localisers() {
  static const std::vector<RobotLocaliserRow> rows = {
      {"odometry", "the odometry is believed", make_odometry},
      {"laser_mapping", "scans are matched with each other on a map that grows", make_laser_mapping},
  };
  return rows;
}

}  // namespace outrider
