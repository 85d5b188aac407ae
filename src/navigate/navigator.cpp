#include "outrider/navigate/navigator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace outrider {
namespace {

constexpr double remembered_s = 1.0;   // of the track, for scans that come late
constexpr double measured_part = 0.3;  // of the measured twist in the believed one
constexpr double leave_part = 1.5;     // of within_m: a robot at its place may be so far off while it turns
constexpr double at_rest_mps = 0.03;
constexpr double at_rest_radps = 0.05;
constexpr double plan_again_m = 1.0;                  // from where it was planned
constexpr double around_m = 0.5;                      // that is looked at beyond where a motion may lead
constexpr double stands_m = 0.1;                      // a robot that has not come so far stands
constexpr double map_again_s = 2.0;                   // least time between two plans on the known map
constexpr double longer_part = 1.15, longer_s = 1.5;  // than on the known map, which is planned on again then
constexpr double moving_trail_s = 0.4, moving_rim_m = 0.1;  // around what moves, where marks are of it
constexpr double most_time_s = 1e12, most_place_m = 1e6;    // of what makes sense
constexpr double faster_part = 1.2;                         // of its limits, than which no robot is
constexpr double least_step_rad = 1e-6;                     // from beam to beam

bool makes_sense(const Pose2& pose) {
  return std::abs(pose.position.x) <= most_place_m && std::abs(pose.position.y) <= most_place_m &&
         std::abs(pose.heading_rad) <= most_place_m;
}

bool makes_sense(const GoTo& order) {
  return makes_sense(Pose2{order.place, order.heading_rad.value_or(0.0)}) && order.within_m >= 0.0 &&
         order.within_m <= most_place_m && order.within_rad >= 0.0;
}

std::vector<std::string> names_of_localisers() {
  auto names = names_of(robot_localisers());
  names.insert(names.begin(), "auto");
  return names;
}

}  // namespace

std::vector<Option> describe(NavigatorOptions& options) {
  return {
      choice_option("localiser", "how the robot knows where it is", &options.localiser,
                    names_of_localisers()),
      {"period", "s", 0.005, 1.0, "time between two commands", &options.period_s},
      {"plan_again", "s", 0.0, 60.0, "least time between two plans", &options.plan_again_s},
      {"patience", "s", 0.1, 1e4, "time without progress after which it recovers", &options.patience_s},
      {"blind", "s", 0.05, 1e4, "time without a scan after which the robot stands", &options.blind_s},
      {"most_recoveries", "", 0, 1000, "recoveries in a row after which it gives up",
       &options.most_recoveries},
      {"most_search", "m", 0.0, 1e6, "way after which a robot that does not recognise where it is gives up",
       &options.most_search_m},
  };
}

Outcome<Navigator> Navigator::make(NavigatorSetup setup, const std::optional<Pose2>& start) {
  std::string& name = setup.options.localiser;
  if (name == "auto") name = setup.known ? "laser_on_map" : "laser_mapping";
  auto known = find_row(robot_localisers(), "localiser", name, "localiser");
  if (!known) return pass_on(known);
  auto localiser = known->make({start, setup.robot_T_laser, setup.known, std::move(setup.tags)});
  if (!localiser) return pass_on(localiser);
  return make(std::move(setup), std::move(*localiser));
}

Outcome<Navigator> Navigator::make(NavigatorSetup setup, std::unique_ptr<RobotLocaliser> localiser) {
  auto row = find_row(local_motions(), "rule of motion", setup.motion.rule, "rule");
  if (!row) return pass_on(row);
  auto rule = row->make(setup.motion);
  return Navigator(std::move(setup), std::move(localiser), std::move(rule));
}

Navigator::Navigator(NavigatorSetup setup, std::unique_ptr<RobotLocaliser> localiser,
                     std::unique_ptr<LocalMotion> motion)
    : setup_(std::move(setup)),
      localiser_(std::move(localiser)),
      rule_(std::move(motion)),
      map_(setup_.map, localiser_->world_T_odometry().position),
      zones_(std::exchange(setup_.zones, {}), setup_.keep.margin_m),
      limits_(setup_.robot) {
  if (setup_.allowed) map_.limit(*setup_.allowed);
  if (!setup_.known) return;
  far_.emplace(*setup_.known);
  far_->keep_to(zones_, room_of_zones_m());
  setup_.known.reset();
  if (localiser_->is_located()) map_.know(far_->walls());
}

// ---- Perceiving ----------------------------------------------------------------------------------

/// Notes the odometry, and how fast the robot goes: as commanded, corrected by what was measured.
void Navigator::note_odometry(const Observation& seen) {
  const TimedOdometry last = track_.empty() ? TimedOdometry{} : track_.back();
  Pose2 odometry = makes_sense(seen.odometry) ? seen.odometry : last.odometry;
  double time_s = std::abs(seen.time_s) <= most_time_s ? seen.time_s + clock_s_ : last.time_s;
  if (!track_.empty()) {
    // A heading that was wrapped is no whole turn.
    odometry.heading_rad =
        last.odometry.heading_rad + wrap_angle(odometry.heading_rad - last.odometry.heading_rad);
    if (time_s < last.time_s - remembered_s) {  // the clock was put back
      clock_s_ += last.time_s + setup_.options.period_s - time_s;
      time_s = last.time_s + setup_.options.period_s;
    }
    const double passed_s = time_s - last.time_s;
    if (passed_s <= 0.0) return;
    const Twist2 then = twist_after(twist_, commanded_, setup_.robot, passed_s);
    const Twist2 expected = 0.5 * (twist_ + then);
    const Twist2 measured = twist_between(last.odometry, odometry, passed_s);
    const Twist2 believed = then + measured_part * (measured + -1.0 * expected);
    const double most_mps = faster_part * setup_.robot.speed_mps;
    const double most_radps = faster_part * setup_.robot.turn_rate_radps;
    twist_ = {std::clamp(believed.ahead_mps, -most_mps, most_mps), 0.0,
              std::clamp(believed.turn_radps, -most_radps, most_radps)};
  }
  track_.push_back({time_s, odometry});
  while (track_.size() > 2 && track_.front().time_s < time_s - remembered_s) track_.pop_front();
  time_s_ = time_s;
}

/// Returns the scan in the time of the navigator; nothing if it cannot be used or is too old to be placed.
std::optional<LaserScan> Navigator::usable(const std::optional<LaserScan>& seen) const {
  if (!seen || !check(*seen) || std::abs(seen->step_rad) < least_step_rad) return std::nullopt;
  LaserScan scan = *seen;
  scan.time_s += clock_s_;
  return std::abs(scan.time_s - time_s_) <= remembered_s ? std::optional(std::move(scan)) : std::nullopt;
}

Situation Navigator::perceive(const Observation& seen) {
  note_odometry(seen);
  if (seen.image) {
    TagImage image = *seen.image;
    image.taken_s += clock_s_;
    see(image);
  }
  if (const auto scan = usable(seen.scan)) take(*scan);
  const Pose2 here = pose();
  map_.follow(here.position);
  note_bumper(seen);
  map_.forget(time_s_);
  note_moving();
  note_lost();
  if (order_) judge(*order_);
  const bool looks = !localiser_->is_located() && progress_.state != Progress::State::lost;
  return {time_s_ - clock_s_, here, localiser_->covariance(), twist_, looks ? Progress{} : progress()};
}

void Navigator::note_touched(const std::vector<Vec2>& places) {
  for (const Vec2 place : places) map_.note_touch(place, time_s_);
}

/// Notes what moves now. What is marked of it does not stand.
void Navigator::note_moving() {
  moving_ = followed_.at(time_s_);
  std::vector<RoundedPolygon> disks;
  for (const MovingThing& thing : moving_)
    disks.push_back({{thing.place, thing.place_after(-moving_trail_s)}, thing.radius_m + moving_rim_m});
  map_.set_moving(disks);
}

void Navigator::note_lost() {
  if (!order_ && !follower_) return;
  std::string lost = localiser_->lost();
  if (progress_.state == Progress::State::underway && !lost.empty())
    progress_ = {Progress::State::lost, {}, std::move(lost)};
}

/// Judges how far the order is.
void Navigator::judge(const GoTo& order) {
  if (progress_.state != Progress::State::underway) return;
  const Pose2 here = pose();
  const double away_m = distance(here.position, order.place);
  if (order.heading_rad) {
    at_place_ = away_m <= (at_place_ ? leave_part : 1.0) * order.within_m;
    const bool stands =
        std::abs(twist_.ahead_mps) < at_rest_mps && std::abs(twist_.turn_radps) < at_rest_radps;
    if (at_place_ && stands &&
        std::abs(wrap_angle(*order.heading_rad - here.heading_rad)) <= order.within_rad)
      progress_ = {Progress::State::arrived, 0.0};
  } else if (away_m <= order.within_m) {
    progress_ = {Progress::State::arrived, 0.0};
  }
  if (progress_.state == Progress::State::arrived) return;
  progress_.left_s = left_s_;
}

// ---- Acting --------------------------------------------------------------------------------------

MotionState Navigator::state_of(const GoTo& order, const Surroundings& near) const {
  return {pose(),      twist_,         setup_.footprint,        limits_, near, field_,
          order.place, order.within_m, setup_.options.period_s, &moving_};
}

Command Navigator::act(const Order& order) {
  const double until_s = time_s_ - clock_s_ + setup_.options.period_s;
  commanded_ = {};
  const auto* const go = std::get_if<GoTo>(&order);
  const auto* const track = std::get_if<Follow>(&order);
  if (go != nullptr) follower_.reset();
  if (std::holds_alternative<Hold>(order)) {
    nearer_s_ = on_track_s_ = time_s_;
    if (std::exchange(progress_, {}).state != Progress::State::underway) order_.reset();
  }
  const bool backs_off = time_s_ < back_until_s_ - instant_s;
  if ((std::holds_alternative<Hold>(order) && !backs_off) || track_.empty()) return DriveTwist{{}, until_s};
  if (!localiser_->is_located())
    commanded_ = look_for_itself();
  else if (backs_off)
    commanded_ = back_from_touch();
  else
    commanded_ = go != nullptr ? this->go(*go) : follow(*track);
  commanded_.ahead_mps = std::clamp(commanded_.ahead_mps, -limits_.speed_mps, limits_.speed_mps);
  return DriveTwist{commanded_, until_s};
}

/// Returns the next twist on the way to a place.
Twist2 Navigator::go(const GoTo& order) {
  if (!makes_sense(order)) {
    order_.reset();
    progress_ = {Progress::State::blocked, {}, "the order is no place to go to"};
    return {};
  }
  const bool goes_on = (!order_ || *order_ != order) && begin(order);
  if (progress_.state != Progress::State::underway || is_blind()) return {};
  follow_zones();
  if (setup_.robot.steers()) return go_in_curves(order);
  plan(order);
  if (goes_on && left_s_) least_left_s_ = best_left_s_ = *left_s_;
  if (in_zone_) return leave_zone(state_of(order, near_));
  note_progress(order);
  if (progress_.state != Progress::State::underway) return {};
  const MotionState state = state_of(order, near_);
  if (recovery_ == Recovery::turn || recovery_ == Recovery::back_off) return recovery_twist(state);
  if (!at_place_) return rule_->choose(state);
  if (order.within_rad >= pi) return {};
  const Twist2 turn = turn_to(state.pose, *order.heading_rad);
  return can_brake(state, turn, setup_.motion.margin_m) ? turn : Twist2{};
}

/// A new order. Returns true if the robot stands since another was underway, and goes on to recover.
bool Navigator::begin(const GoTo& order) {
  const Vec2 here = pose().position;
  const bool goes_on =
      order_ && progress_.state == Progress::State::underway && distance(begun_at_, here) < stands_m;
  order_ = order;
  progress_ = {};
  planned_s_.reset();
  planned_far_s_.reset();
  at_place_ = false;
  curves_.reset();
  no_curves_.clear();
  left_s_.reset();
  least_left_s_ = best_left_s_ = std::numeric_limits<double>::infinity();
  if (!goes_on) {
    recovery_ = Recovery::none;
    recoveries_ = 0;
    nearer_s_ = time_s_;
    begun_at_ = here;
  }
  note_lost();
  judge(order);
  return goes_on;
}

/// Looks around, and plans anew if something has come or gone.
void Navigator::plan(const GoTo& order) {
  const Vec2 here = pose().position;
  const bool due = !planned_s_ || time_s_ - *planned_s_ >= setup_.options.plan_again_s - instant_s;
  const bool far = distance(planned_at_, here) > plan_again_m || !field_.time_s(here);
  if (due && (!planned_s_ || far || map_.changes() != planned_changes_)) {
    const bool is_new = plan_on_map(order, false);
    plan_window(order);
    if (!is_new && plan_on_map(order, true)) plan_window(order);
  }
  look_around();
  near_.find_distances();
  left_s_ = field_.time_s(here);
}

void Navigator::look_around() {
  const double reach_m =
      setup_.robot.speed_mps * setup_.motion.horizon_s + setup_.footprint.outer_m() + around_m;
  near_.look(map_, pose().position, std::min(reach_m, setup_.map.reach_m), true,
             localiser_->is_located() && !in_zone_ ? &zones_ : nullptr, setup_.motion.margin_m);
  near_.leave_inside(setup_.footprint, pose());
}

GoalQuery Navigator::query_of(const GoTo& order) const {
  const std::string& side = setup_.keep.side;
  return {order.place,
          order.within_m,
          setup_.motion.wide_m,
          setup_.motion.margin_m,
          {},
          side == "right" ? -1 : (side == "left" ? 1 : 0),
          setup_.keep.passage_m};
}

void Navigator::plan_window(const GoTo& order) {
  const Vec2 here = pose().position;
  GoalQuery query = query_of(order);
  if (planned_far_s_) query.beyond = [this](Vec2 place) { return far_->time_s(place); };
  field_.compute({map_.frame(), map_.places(), nullptr, zones_on_window()}, setup_.footprint, setup_.robot,
                 query, here);
  planned_s_ = time_s_;
  planned_changes_ = map_.changes();
  planned_at_ = here;
}

/// Plans on the known map for a new order; or anew where the way in the window is longer than it should be,
/// for what stands there, which counts as a recovery. Returns true if it did.
bool Navigator::plan_on_map(const GoTo& order, bool anew) {
  if (!far_ || !localiser_->is_located()) return false;
  const Vec2 here = pose().position;
  if (anew) {
    const auto left_s = field_.time_s(here), expected_s = far_->time_s(here);
    const bool is_longer = !left_s || (expected_s && *left_s > longer_part * *expected_s + longer_s);
    if (!is_longer || time_s_ - *planned_far_s_ < map_again_s) return false;
    if (recoveries_ >= setup_.options.most_recoveries) return false;
  } else if (planned_far_s_) {
    return false;
  }
  far_->compute(map_, setup_.footprint, setup_.robot, query_of(order), true);
  if (!far_->time_s(here)) far_->compute(map_, setup_.footprint, setup_.robot, query_of(order), false);
  planned_far_s_ = time_s_;
  if (!anew || !far_->time_s(here)) return true;
  ++recoveries_;  // this way out takes as long as it takes
  nearer_s_ = time_s_;
  least_left_s_ = std::numeric_limits<double>::infinity();
  return true;
}

/// Returns the twist of a turn in place.
Twist2 Navigator::turn_to(const Pose2& here, double heading_rad) const {
  const double off_rad = wrap_angle(heading_rad - here.heading_rad);
  // From that rate it comes to rest at the heading.
  const double rate = std::sqrt(setup_.robot.turn_acceleration_radps2 * std::abs(off_rad));
  const double most =
      std::min({rate, setup_.robot.turn_rate_radps, std::abs(off_rad) / setup_.options.period_s});
  return {0.0, 0.0, std::copysign(most, off_rad)};
}

}  // namespace outrider
