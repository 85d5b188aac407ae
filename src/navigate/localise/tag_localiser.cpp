#include "localise/tag_localiser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace outrider {
namespace {

constexpr double way_sigma = 0.03;       // of a metre by odometry, m; grows with the square root of the way
constexpr double way_turn_sigma = 0.05;  // the same of the heading, rad
constexpr double turn_sigma = 0.03;      // of the heading in a turn of 1 rad, rad; with its square root
constexpr double start_sigma = 0.01;     // of a start that is told, m and rad
constexpr double lost_by_tags_m = 1.0;   // standard deviation of the position at which the robot is lost
constexpr int most_refused = 5;          // images in a row that agree on another place, where it is then

/// Returns a belief after a motion by odometry.
PoseBelief moved_belief(const PoseBelief& belief, const Pose2& motion) {
  PoseBelief next{wrap_heading(compose(belief.world_T_robot, motion)), belief.covariance};
  const Vec2 way = next.world_T_robot.position - belief.world_T_robot.position;
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -way.y;
  by_pose(1, 2) = way.x;
  next.covariance = by_pose * belief.covariance * by_pose.transpose();
  const double way_m = norm(way), turned_rad = std::abs(motion.heading_rad);
  next.covariance(0, 0) += way_sigma * way_sigma * way_m;
  next.covariance(1, 1) += way_sigma * way_sigma * way_m;
  next.covariance(2, 2) += way_turn_sigma * way_turn_sigma * way_m + turn_sigma * turn_sigma * turned_rad;
  return next;
}

class TagsInView final : public RobotLocaliser {
 public:
  TagsInView(TagsInSight view, const std::optional<Pose2>& start) : view_(std::move(view)) {
    if (!start) return;
    belief_ = PoseBelief{*start, start_sigma * start_sigma * Eigen::Matrix3d::Identity()};
    world_T_odometry_ = *start;
  }

  bool take(const LaserScan&, const Pose2&) override { return false; }

  bool see(const TagImage& image, const Pose2& odometry_T_robot) override {
    const Pose2 motion =
        wrap_heading(relative_pose(std::exchange(odometry_, odometry_T_robot), odometry_T_robot));
    if (belief_) belief_ = moved_belief(*belief_, motion);
    if (other_) other_ = moved_belief(*other_, motion);
    const bool corrected = correct(image);
    if (belief_) world_T_odometry_ = compose(belief_->world_T_robot, inverse(odometry_T_robot));
    return corrected;
  }

  [[nodiscard]] Pose2 world_T_odometry() const override { return world_T_odometry_; }
  [[nodiscard]] Eigen::Matrix3d covariance() const override {
    return belief_ ? belief_->covariance : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
  }
  [[nodiscard]] bool is_located() const override { return belief_.has_value(); }
  [[nodiscard]] std::string lost() const override {
    const Eigen::Matrix3d now = covariance();
    const double sigma_m = std::sqrt(std::max(now(0, 0), now(1, 1)));
    if (sigma_m <= lost_by_tags_m) return {};
    return fmt::format(
        "its position has a standard deviation of {:.2f} m, since it has seen no tag for so long", sigma_m);
  }

 private:
  /// Corrects the belief by the tags of an image. Returns true if they put the robot elsewhere.
  bool correct(const TagImage& image) {
    const TagFix fix = localise(image.sightings, view_.map, view_.camera, belief_, view_.options);
    if (belief_ && fix.belief) {
      other_.reset();
      belief_ = fuse(*belief_, *fix.belief);
      return false;
    }
    const bool refused = std::ranges::any_of(fix.verdicts, [](TagVerdict verdict) {
      return verdict == TagVerdict::off_prior || verdict == TagVerdict::outvoted;
    });
    return (!belief_ || refused) && look_elsewhere(image);
  }

  /// Notes where tags put the robot that contradict its belief, or without one. Returns true once enough
  /// images agree: it is there then.
  bool look_elsewhere(const TagImage& image) {
    const TagFix fix = localise(image.sightings, view_.map, view_.camera, std::nullopt, view_.options);
    if (!fix.belief) return false;
    const bool agrees = other_ && squared_mahalanobis(*other_, *fix.belief) <= most_plausible_distance;
    images_ = agrees ? images_ + 1 : 1;
    other_ = agrees ? fuse(*other_, *fix.belief) : *fix.belief;
    if (images_ < most_refused) return false;
    belief_ = std::exchange(other_, std::nullopt);
    return true;
  }

  TagsInSight view_;
  std::optional<PoseBelief> belief_;
  Pose2 world_T_odometry_;
  Pose2 odometry_;  // of the last image
  std::optional<PoseBelief> other_;
  int images_ = 0;  // that agree on the other place
};

}  // namespace

Outcome<std::unique_ptr<RobotLocaliser>> make_tag_localiser(LocaliserStart start) {
  if (!start.tags || start.tags->map.tags.empty())
    return bad_input("there are no tags; give their places, or take a localiser by laser", "localiser");
  if (auto ok = check_tags(start.tags->map); !ok) return pass_on(ok);
  if (start.pose && !finite(*start.pose)) return bad_input("the start is not finite", "start");
  return std::make_unique<TagsInView>(std::move(*start.tags), start.pose);
}

}  // namespace outrider
