#include "outrider/navigate/navigator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double remembered_s = 1.0;    // of the track, for scans that come late
constexpr double better_s = 0.2;        // by which the time left has to fall to count as progress
constexpr double lately_s = 0.5;        // what was seen within that is not forgotten
constexpr double touch_ahead_m = 0.03;  // of the footprint, where a bumper was pressed
constexpr double measured_part = 0.3;   // of the measured twist in the believed one
constexpr double back_off_mps = 0.2;
constexpr double turn_s = 2.5;
constexpr double back_off_s = 1.5;

}  // namespace

std::vector<Option> describe(NavigatorOptions& options) {
  return {
      choice_option("localiser", "how the robot knows where it is", &options.localiser,
                    names_of(pose_estimators())),
      {"period", "s", 0.005, 1.0, "time between two commands", &options.period_s},
      {"plan_again", "s", 0.0, 60.0, "least time between two plans", &options.plan_again_s},
      {"patience", "s", 0.1, 1e4, "time without progress after which it recovers", &options.patience_s},
      {"blind", "s", 0.05, 1e4, "time without a scan after which the robot stands", &options.blind_s},
      {"most_recoveries", "", 0, 1000, "recoveries in a row after which it gives up",
       &options.most_recoveries},
  };
}

Outcome<Navigator> Navigator::make(NavigatorSetup setup, const Pose2& start) {
  auto row = find_row(local_motions(), "rule of motion", setup.motion.rule, "rule");
  if (!row) return pass_on(row);
  auto known = find_row(pose_estimators(), "localiser", setup.options.localiser, "localiser");
  if (!known) return pass_on(known);
  auto estimator = known->make(start, setup.robot_T_laser);
  if (!estimator) return pass_on(estimator);
  auto rule = row->make(setup.motion);
  return Navigator(std::move(setup), start, std::move(*estimator), std::move(rule));
}

Navigator::Navigator(NavigatorSetup setup, const Pose2& start, std::unique_ptr<PoseEstimator> estimator,
                     std::unique_ptr<LocalMotion> motion)
    : setup_(std::move(setup)),
      estimator_(std::move(estimator)),
      rule_(std::move(motion)),
      map_(setup_.map, start.position) {}

// ---- Perceiving ----------------------------------------------------------------------------------

/// Notes the odometry, and how fast the robot goes: as commanded, corrected by what was measured.
void Navigator::note_odometry(const Observation& seen) {
  const Pose2 odometry = finite(seen.odometry) || track_.empty() ? seen.odometry : track_.back().odometry;
  if (!track_.empty()) {
    const double passed_s = seen.time_s - track_.back().time_s;
    if (passed_s <= 0.0) return;
    const Twist2 then = twist_after(twist_, commanded_, setup_.robot, passed_s);
    const Twist2 expected = 0.5 * (twist_ + then);
    const Twist2 measured = twist_between(track_.back().odometry, odometry, passed_s);
    twist_ = then + measured_part * (measured + -1.0 * expected);
    twist_.left_mps = 0.0;
  }
  track_.push_back({seen.time_s, odometry});
  while (track_.size() > 2 && track_.front().time_s < seen.time_s - remembered_s) track_.pop_front();
  time_s_ = seen.time_s;
}

/// Returns the odometry at a time not long ago.
Pose2 Navigator::odometry_at(double time_s) const {
  for (std::size_t i = track_.size() - 1; i > 0; --i) {
    const TimedOdometry &from = track_[i - 1], &to = track_[i];
    if (time_s < from.time_s) continue;
    const double part = std::clamp((time_s - from.time_s) / (to.time_s - from.time_s), 0.0, 1.0);
    return moved(from.odometry, twist_between(from.odometry, to.odometry, 1.0), part);
  }
  return track_.front().odometry;
}

/// Takes a scan. If it corrects the pose, what is marked moves along, since it was seen from about here.
void Navigator::take(const LaserScan& scan) {
  const Pose2 then = odometry_at(scan.time_s);
  const Pose2 before = estimator_->world_T_odometry();
  estimator_->take(scan, then);
  const Pose2 after = estimator_->world_T_odometry();
  if (after != before) map_.correct(compose(after, inverse(before)));
  map_.note(scan, compose(compose(after, then), setup_.robot_T_laser));
  scan_s_ = scan.time_s;
}

Situation Navigator::perceive(const Observation& seen) {
  note_odometry(seen);
  if (seen.scan && check(*seen.scan)) take(*seen.scan);
  const Pose2 here = pose();
  map_.follow(here.position);
  touching_ = seen.touching;
  if (seen.touching) {
    const double bearing_rad = seen.touch_rad.value_or(twist_.ahead_mps < 0.0 ? pi : 0.0);
    const double away_m = setup_.footprint.outer_m() + touch_ahead_m;
    map_.note_touch(here * (away_m * direction(bearing_rad)), seen.time_s);
  } else {
    map_.keep_open(here.position, 0.8 * setup_.footprint.inner_m());
  }
  map_.forget(time_s_);
  if (order_) judge(*order_);
  return {time_s_, here, twist_, progress_};
}

/// Judges how far the order is.
void Navigator::judge(const GoTo& order) {
  if (progress_.state != Progress::State::underway) return;
  if (std::string lost = estimator_->lost(); !lost.empty()) {
    progress_ = {Progress::State::lost, {}, std::move(lost)};
    return;
  }
  if (distance(pose().position, order.place) <= order.within_m) {
    progress_ = {Progress::State::arrived, 0.0};
    return;
  }
  progress_.left_s = left_s_;
}

// ---- Acting --------------------------------------------------------------------------------------

MotionState Navigator::state_of(const GoTo& order) const {
  return {pose(), twist_,      setup_.footprint, setup_.robot,           near_,
          field_, order.place, order.within_m,   setup_.options.period_s};
}

Command Navigator::act(const Order& order) {
  const double until_s = time_s_ + setup_.options.period_s;
  commanded_ = {};
  choice_ = {{}, {}, true};
  const auto* const go = std::get_if<GoTo>(&order);
  const bool blind = !scan_s_ || time_s_ - *scan_s_ > setup_.options.blind_s;
  if (go == nullptr || blind || track_.empty()) {
    nearer_s_ = time_s_;
    return DriveTwist{{}, until_s};
  }
  if (!order_ || order_->place != go->place || order_->within_m != go->within_m) {
    order_ = *go;
    progress_ = {};
    planned_s_.reset();
    recovery_ = Recovery::none;
    recoveries_ = 0;
    left_s_.reset();
    least_left_s_ = std::numeric_limits<double>::infinity();
    nearer_s_ = time_s_;
    judge(*go);
  }
  if (progress_.state != Progress::State::underway) return DriveTwist{{}, until_s};

  const Vec2 here = pose().position;
  if (!planned_s_ ||
      (time_s_ - *planned_s_ >= setup_.options.plan_again_s - 1e-9 && map_.changes() != planned_changes_)) {
    field_.compute(map_, setup_.footprint, setup_.robot,
                   {go->place, go->within_m, setup_.motion.wide_m, setup_.motion.margin_m}, here);
    planned_s_ = time_s_;
    planned_changes_ = map_.changes();
  }
  const double reach_m = setup_.robot.speed_mps * setup_.motion.horizon_s + setup_.footprint.outer_m() + 0.5;
  near_.look(map_, here, std::min(reach_m, setup_.map.reach_m));
  left_s_ = field_.time_s(here);
  if (left_s_ && *left_s_ < least_left_s_ - better_s) {
    least_left_s_ = *left_s_;
    nearer_s_ = time_s_;
    if (recovery_ == Recovery::none) recoveries_ = 0;
  }
  if (recovery_ != Recovery::none && time_s_ >= recovers_until_s_) {
    recovery_ = Recovery::none;
    nearer_s_ = time_s_;
    least_left_s_ = left_s_.value_or(std::numeric_limits<double>::infinity());
  }
  if (recovery_ == Recovery::none && time_s_ - nearer_s_ > setup_.options.patience_s) recover();
  if (progress_.state != Progress::State::underway) return DriveTwist{{}, until_s};

  const MotionState state = state_of(*go);
  if (recovery_ == Recovery::turn || recovery_ == Recovery::back_off) {
    commanded_ = recovery_twist(state);
  } else {
    choice_ = rule_->choose(state);
    commanded_ = choice_.twist;
  }
  return DriveTwist{commanded_, until_s};
}

/// Begins the next way out, or gives up.
void Navigator::recover() {
  if (recoveries_ >= setup_.options.most_recoveries) {
    progress_ = {Progress::State::blocked, left_s_,
                 left_s_ ? fmt::format("no progress towards ({:.2f}, {:.2f}) after {} recoveries",
                                       order_->place.x, order_->place.y, recoveries_)
                         : fmt::format("no way to ({:.2f}, {:.2f}) around what stands there", order_->place.x,
                                       order_->place.y)};
    return;
  }
  constexpr Recovery ways[] = {Recovery::forget, Recovery::turn, Recovery::back_off};
  recovery_ = ways[recoveries_ % 3];
  ++recoveries_;
  if (recovery_ == Recovery::forget) map_.forget_but(time_s_, lately_s);
  recovers_until_s_ = time_s_ + (recovery_ == Recovery::turn       ? turn_s
                                 : recovery_ == Recovery::back_off ? back_off_s
                                                                   : 0.0);
}

/// Returns the twist of a way out: a turn to where the way leads, or straight back; none if it is not safe.
Twist2 Navigator::recovery_twist(const MotionState& state) const {
  Twist2 twist;
  if (recovery_ == Recovery::turn) {
    const auto down = field_.downhill(state.pose.position);
    const double off_rad = down ? wrap_angle(heading_of(*down) - state.pose.heading_rad) : 1.0;
    twist.turn_radps = std::clamp(off_rad, -setup_.robot.turn_rate_radps, setup_.robot.turn_rate_radps);
  } else {
    twist.ahead_mps = -std::min(back_off_mps, setup_.robot.speed_mps);
  }
  return can_brake(state, twist, setup_.motion.margin_m) ? twist : Twist2{};
}

}  // namespace outrider
