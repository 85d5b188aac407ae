// The order Follow of a navigator: along a track, around what stands on it, and back to it.
#include <algorithm>
#include <cmath>

#include "outrider/navigate/navigator.hpp"

namespace outrider {
namespace {

constexpr double beyond_m = 0.3;  // that is looked at ahead of where the robot could stop
constexpr double moved_m = 0.01, moved_rad = radians(2.0);  // by which a robot has moved
constexpr double stop_short_m = 0.1;   // before what stands on the track, with room to turn away
constexpr double wait_s = 1.0;         // for what stands on the track to go
constexpr double edge_room_m = 0.005;  // from the edges of the ground, along the track
// So much of the track is left out where no way leads back or the robot does not get on; then twice that.
constexpr double first_skip_m = 0.3;
constexpr double back_m = 0.15;            // beside the track, from where it is steered back
constexpr double back_rad = radians(8.0);  // the same of a robot that steers
constexpr std::int64_t most_tries = 4;     // recoveries on the way back to a place

}  // namespace

Progress Navigator::progress() const {
  if (!track_.follower) return progress_;
  if (progress_.state == Progress::State::lost) return progress_;
  return {track_.follower->is_done() ? Progress::State::arrived : Progress::State::underway};
}

GoTo Navigator::order_to(const TrackPlace& place) const {
  if (!track_.follower) return {pose().position, back_m};
  const Pose2 to = track_.follower->pose_at(place);
  if (!setup_.robot.steers()) return {to.position, back_m};
  return {to.position, back_m, to.heading_rad, back_rad};
}

/// Begins to follow another track.
TrackFollower& Navigator::begin_track(const Follow& order) {
  const bool follows = track_.follower && !track_.follower->is_done();
  if (!follows) track_.moved_s = now_s();
  TrackFollower& follower = track_.follower.emplace(order.track);
  if (follows || odometry_.twist().ahead_mps > moved_mps) follower.go_on(pose());
  progress_ = {};
  order_.reset();
  track_.comes_back.reset();
  track_.comes_in = true;
  track_.skip_m = first_skip_m;
  track_.came_in = {};
  return follower;
}

Twist2 Navigator::follow(const Follow& order) {
  const bool goes_on = track_.follower && track_.follower->track() == order.track;
  TrackFollower& follower = goes_on ? *track_.follower : begin_track(order);
  if (progress_.state == Progress::State::lost || is_blind()) return {};
  const Twist2 twist = track_.comes_back ? Twist2{} : along_track(order, follower);
  return track_.comes_back ? back_to_track(*track_.comes_back) : twist;
}

/// Returns the next twist along the track, or begins to drive back to it.
Twist2 Navigator::along_track(const Follow& order, TrackFollower& follower) {
  const Pose2 here = pose();
  follower.note(here);
  if (follower.is_done()) return {};
  const auto gets_on = follower.ahead_of(track_.came_in, first_skip_m);
  if (!gets_on || *gets_on <= follower.at()) track_.skip_m = first_skip_m;
  follow_zones();
  look_around();
  const double beside_m = follower.beside_m(here.position);
  track_.comes_in = track_.comes_in && beside_m > 0.5 * order.beside_m;
  if (in_zone_ || beside_m > (track_.comes_in ? 2.0 * back_m : order.beside_m)) {
    track_.comes_back = follower.at();
    return {};
  }
  note_motion(here);
  if (now_s() - track_.moved_s > wait_s + instant_s) {
    leave_track(first_skip_m);
    return {};
  }
  // The track keeps its own distance from the edges of the ground; from what was seen the robot keeps its
  // own.
  const double speed_mps = std::abs(odometry_.twist().ahead_mps);
  const double look_m = speed_mps * speed_mps / setup_.robot.acceleration_mps2 + beyond_m;
  const double margin_m = std::min(order.margin_m, setup_.motion.margin_m);
  on_track_.look(map_, here.position, look_m + setup_.footprint.outer_m(), false);
  on_track_.leave_inside(setup_.footprint, here);
  const GoTo next{follower.pose_at(follower.at()).position, order.beside_m};
  const MotionState state = state_of(next, near_), among_seen = state_of(next, on_track_);
  const auto is_safe = [&](const Twist2& twist) {
    return can_brake(state, twist, std::min(edge_room_m, margin_m)) && can_brake(among_seen, twist, margin_m);
  };
  auto heading_rad = follower.heading_to_turn_to(here);
  if (heading_rad && setup_.robot.steers()) {
    follower.go_on(here);  // it steers to the track, if it about looks along it
    heading_rad = follower.heading_to_turn_to(here);
    if (heading_rad) {
      track_.comes_back = follower.at();
      return {};
    }
  }
  if (heading_rad) {
    const Twist2 turn = turn_to(here, *heading_rad);
    return is_safe(turn) ? turn : Twist2{};
  }
  const auto is_free = [&](const Pose2& at) {
    return on_track_.gap(setup_.footprint, at, Surroundings::most_m) >= margin_m;
  };
  const double free_m = follower.free_m(is_free, look_m);
  const double room_m = free_m < look_m ? std::max(0.0, free_m - stop_short_m) : look_m;
  limits_.speed_mps = std::min(limits_.speed_mps, order.most_mps);
  Twist2 twist = drivable(follower.twist(here, limits_, setup_.options.period_s, room_m), setup_.robot);
  for (int i = 0; i < 3 && !is_safe(twist); ++i) twist = 0.5 * twist;
  return is_safe(twist) ? twist : Twist2{};
}

/// Notes when the robot last moved.
void Navigator::note_motion(const Pose2& here) {
  const double turned_rad = std::abs(wrap_angle(here.heading_rad - track_.stood.heading_rad));
  if (distance(here.position, track_.stood.position) < moved_m && turned_rad < moved_rad) return;
  track_.stood = here;
  track_.moved_s = now_s();
}

/// Leaves out the track up to where it is free again, with room to come in if there is such a place, and
/// drives there.
void Navigator::leave_track(double again_m) {
  on_track_.look(map_, pose().position, setup_.map.reach_m, false);
  const auto from = track_.follower->ahead_of(track_.follower->at(), again_m);
  std::optional<TrackPlace> to;
  for (const double room_m : {stop_short_m, 0.0}) {
    if (!from || to) break;
    const auto is_free = [&](const Pose2& at) {
      return on_track_.gap(setup_.footprint, at, Surroundings::most_m) >= setup_.motion.margin_m + room_m;
    };
    to = track_.follower->next_free(*from, is_free, setup_.footprint.outer_m());
  }
  track_.follower->skip_to(to);
  track_.comes_back = to;
}

/// Returns the next twist on the way back to the track.
Twist2 Navigator::back_to_track(const TrackPlace& place) {
  track_.moved_s = now_s();
  const GoTo order = order_to(place);
  const Twist2 twist = go(order);
  if (progress_.state == Progress::State::arrived) {
    track_.came_in = place;
    track_.comes_back.reset();
    track_.comes_in = true;
  } else if (progress_.state == Progress::State::blocked || recoveries_ >= (left_.now_s ? most_tries : 1)) {
    leave_track(track_.skip_m);
    track_.skip_m *= 2.0;
  }
  if (progress_.state == Progress::State::lost ||
      (track_.comes_back && order_to(*track_.comes_back) == order))
    return twist;
  order_.reset();
  progress_ = {};
  return {};
}

}  // namespace outrider
