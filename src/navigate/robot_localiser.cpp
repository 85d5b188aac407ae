#include "outrider/navigate/robot_localiser.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "localise/tag_localiser.hpp"
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

class LaserOnMap final : public RobotLocaliser {
 public:
  LaserOnMap(MapLocaliser localiser, const Pose2& start)
      : localiser_(std::move(localiser)), world_T_odometry_(start) {}

  bool take(const LaserScan& scan, const Pose2& odometry_T_robot) override {
    if (taken_s_ && scan.time_s - *taken_s_ < match_s - 1e-9) return false;
    const auto step = localiser_.advance(wrap_heading(relative_pose(odometry_, odometry_T_robot)), scan);
    if (!step) return false;
    taken_s_ = scan.time_s;
    odometry_ = odometry_T_robot;
    if (step->located) world_T_odometry_ = compose(step->pose, inverse(odometry_T_robot));
    return step->found;
  }
  [[nodiscard]] Pose2 world_T_odometry() const override { return world_T_odometry_; }
  [[nodiscard]] Eigen::Matrix3d covariance() const override { return localiser_.pose_covariance(); }
  [[nodiscard]] bool is_located() const override { return localiser_.is_located(); }

 private:
  MapLocaliser localiser_;
  Pose2 world_T_odometry_;
  Pose2 odometry_;  // of the scan that was taken last
  std::optional<double> taken_s_;
};

using Made = Outcome<std::unique_ptr<RobotLocaliser>>;

Status needs_start(const LocaliserStart& start) {
  if (start.pose && finite(*start.pose)) return {};
  return bad_input(
      "this localiser has to be told where the robot starts; only laser_on_map and tags find that", "start");
}

LaserSlamOptions slam_options(const LocaliserStart& start) {
  LaserSlamOptions options;
  options.robot_T_laser = start.robot_T_laser;
  options.draw_late = true;
  options.odometry_turn_per_distance_rad = 0.1;
  return options;
}

Made make_odometry(LocaliserStart start) {
  if (auto ok = needs_start(start); !ok) return pass_on(ok);
  return std::make_unique<BelievedOdometry>(*start.pose);
}

Made make_laser_mapping(LocaliserStart start) {
  if (auto ok = needs_start(start); !ok) return pass_on(ok);
  auto slam = LaserSlam::begin(slam_options(start), *start.pose);
  if (!slam) return pass_on(slam);
  return std::make_unique<LaserMapping>(std::move(*slam), *start.pose);
}

Made make_laser_on_map(LocaliserStart start) {
  if (!start.map) return bad_input("there is no map; give one, or take laser_mapping", "localiser");
  const LaserSlamOptions options = slam_options(start);
  auto localiser = MapLocaliser::begin(std::move(*start.map), options, start.pose);
  if (!localiser) return pass_on(localiser);
  return std::make_unique<LaserOnMap>(std::move(*localiser), start.pose.value_or(Pose2{}));
}

}  // namespace

const std::vector<RobotLocaliserRow>& robot_localisers() {
  static const std::vector<RobotLocaliserRow> rows = {
      {"exact", "the odometry is the truth, as of a robot that is measured from outside", make_odometry},
      {"odometry", "the odometry of the wheels is believed", make_odometry},
      {"laser_mapping", "scans are matched with each other on a map that grows", make_laser_mapping},
      {"laser_on_map", "scans are matched with a known map, from anywhere", make_laser_on_map},
      {"tags", "tags that a camera sees tell where the robot is, from anywhere", make_tag_localiser},
  };
  return rows;
}

}  // namespace outrider
