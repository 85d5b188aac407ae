#include "outrider/navigate/navigator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace outrider {
namespace {

constexpr double leave_part = 1.5;  // of within_m: a robot at its place may be so far off while it turns
constexpr double at_rest_mps = 0.03;
constexpr double at_rest_radps = 0.05;
constexpr double plan_again_m = 1.0;                  // from where it was planned
constexpr double around_m = 0.5;                      // that is looked at beyond where a motion may lead
constexpr double stands_m = 0.1;                      // a robot that has not come so far stands
constexpr double map_again_s = 2.0;                   // least time between two plans on the known map
constexpr double longer_part = 1.15, longer_s = 1.5;  // than on the known map, which is planned on again then
constexpr double moving_trail_s = 0.4, moving_rim_m = 0.1;  // around what moves, where marks are of it
constexpr double about_s = 3.0, about_m = 3.0;  // since and within which whoever moved may be behind it
constexpr double most_place_m = 1e6;            // of what makes sense
constexpr double least_step_rad = 1e-6;         // from beam to beam

bool makes_sense(const GoTo& order) {
  return std::abs(order.place.x) <= most_place_m && std::abs(order.place.y) <= most_place_m &&
         std::abs(order.heading_rad.value_or(0.0)) <= most_place_m && order.within_m >= 0.0 &&
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

/// Returns the scan in the time of the navigator; nothing if it cannot be used or is too old to be placed.
std::optional<LaserScan> Navigator::usable(const std::optional<LaserScan>& seen) const {
  if (!seen || !check(*seen) || std::abs(seen->step_rad) < least_step_rad) return std::nullopt;
  LaserScan scan = *seen;
  scan.time_s = odometry_.time_of(scan.time_s);
  return std::abs(scan.time_s - now_s()) <= RecentOdometry::remembered_s ? std::optional(std::move(scan))
                                                                         : std::nullopt;
}

Situation Navigator::perceive(const Observation& seen) {
  odometry_.note(seen, commanded_, setup_.robot, setup_.options.period_s);
  if (seen.image) {
    TagImage image = *seen.image;
    image.taken_s = odometry_.time_of(image.taken_s);
    see(image);
  }
  if (const auto scan = usable(seen.scan)) take(*scan);
  const Pose2 here = pose();
  map_.follow(here.position);
  note_bumper(seen);
  map_.forget(now_s());
  note_moving();
  note_lost();
  if (order_) judge(*order_);
  const bool looks = !localiser_->is_located() && progress_.state != Progress::State::lost;
  return {odometry_.clock_s(), here, localiser_->covariance(), odometry_.twist(),
          looks ? Progress{} : progress()};
}

void Navigator::note_touched(const std::vector<Vec2>& places) {
  for (const Vec2 place : places) map_.note_touch(place, now_s());
}

/// Notes what moves now. What is marked of it does not stand.
void Navigator::note_moving() {
  moving_ = followed_.at(now_s());
  const Vec2 here = pose().position;
  if (std::ranges::any_of(moving_, [&](const auto& thing) { return distance(thing.place, here) < about_m; }))
    met_s_ = now_s();
  std::vector<RoundedPolygon> disks;
  for (const MovingThing& thing : moving_)
    disks.push_back({{thing.place, thing.place_after(-moving_trail_s)}, thing.radius_m + moving_rim_m});
  map_.set_moving(disks);
}

void Navigator::note_lost() {
  if (!order_ && !track_.follower) return;
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
    const bool stands = std::abs(odometry_.twist().ahead_mps) < at_rest_mps &&
                        std::abs(odometry_.twist().turn_radps) < at_rest_radps;
    if (at_place_ && stands &&
        std::abs(wrap_angle(*order.heading_rad - here.heading_rad)) <= order.within_rad)
      progress_ = {Progress::State::arrived, 0.0};
  } else if (away_m <= order.within_m) {
    progress_ = {Progress::State::arrived, 0.0};
  }
  if (progress_.state == Progress::State::arrived) return;
  progress_.left_s = left_.now_s;
}

// ---- Acting --------------------------------------------------------------------------------------

MotionState Navigator::state_of(const GoTo& order, const Surroundings& near) const {
  const bool alone = !met_s_ || now_s() - *met_s_ > about_s;
  return {pose(),
          odometry_.twist(),
          setup_.footprint,
          limits_,
          near,
          field_,
          order.place,
          order.within_m,
          setup_.options.period_s,
          &moving_,
          looks_back_ || alone};
}

Command Navigator::act(const Order& order) {
  const double until_s = odometry_.clock_s() + setup_.options.period_s;
  commanded_ = {};
  const auto* const go = std::get_if<GoTo>(&order);
  const auto* const track = std::get_if<Follow>(&order);
  if (go != nullptr) track_.follower.reset();
  if (std::holds_alternative<Hold>(order)) {
    left_.nearer_s = track_.moved_s = now_s();
    if (std::exchange(progress_, {}).state != Progress::State::underway) order_.reset();
  }
  const bool backs_off = now_s() < back_until_s_ - instant_s;
  if ((std::holds_alternative<Hold>(order) && !backs_off) || odometry_.empty())
    return DriveTwist{{}, until_s};
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
  if (goes_on && left_.now_s) left_.least_s = left_.best_s = *left_.now_s;
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
  planned_.window_s.reset();
  planned_.far_s.reset();
  at_place_ = false;
  curves_.way.reset();
  curves_.why_none.clear();
  left_.now_s.reset();
  left_.least_s = left_.best_s = std::numeric_limits<double>::infinity();
  if (!goes_on) {
    recovery_ = Recovery::none;
    recoveries_ = 0;
    left_.nearer_s = now_s();
    begun_at_ = here;
  }
  note_lost();
  judge(order);
  return goes_on;
}

/// Looks around, and plans anew if something has come or gone.
void Navigator::plan(const GoTo& order) {
  const Vec2 here = pose().position;
  const bool due =
      !planned_.window_s || now_s() - *planned_.window_s >= setup_.options.plan_again_s - instant_s;
  const bool far = distance(planned_.at, here) > plan_again_m || !field_.time_s(here);
  if (due && (!planned_.window_s || far || map_.changes() != planned_.changes)) {
    const bool is_new = plan_on_map(order, false);
    plan_window(order);
    if (!is_new && plan_on_map(order, true)) plan_window(order);
  }
  look_around();
  near_.find_distances();
  left_.now_s = field_.time_s(here);
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
  if (planned_.far_s) query.beyond = [this](Vec2 place) { return far_->time_s(place); };
  field_.compute({map_.frame(), map_.places(), nullptr, zones_on_window()}, setup_.footprint, setup_.robot,
                 query, here);
  planned_.window_s = now_s();
  planned_.changes = map_.changes();
  planned_.at = here;
}

/// Plans on the known map for a new order; or anew where the way in the window is longer than it should be,
/// for what stands there, which counts as a recovery. Returns true if it did.
bool Navigator::plan_on_map(const GoTo& order, bool anew) {
  if (!far_ || !localiser_->is_located()) return false;
  const Vec2 here = pose().position;
  if (anew) {
    const auto left_s = field_.time_s(here), expected_s = far_->time_s(here);
    const bool is_longer = !left_s || (expected_s && *left_s > longer_part * *expected_s + longer_s);
    if (!is_longer || now_s() - *planned_.far_s < map_again_s) return false;
    if (recoveries_ >= setup_.options.most_recoveries) return false;
  } else if (planned_.far_s) {
    return false;
  }
  far_->compute(map_, setup_.footprint, setup_.robot, query_of(order), true);
  if (!far_->time_s(here)) far_->compute(map_, setup_.footprint, setup_.robot, query_of(order), false);
  planned_.far_s = now_s();
  if (!anew || !far_->time_s(here)) return true;
  ++recoveries_;  // this way out takes as long as it takes
  left_.nearer_s = now_s();
  left_.least_s = std::numeric_limits<double>::infinity();
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
