#include "outrider/navigate/track_follower.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double smooth_rad = radians(3.0);  // a smaller corner is none
constexpr double looks_along_rad = radians(1.0);
constexpr double about_rad = radians(10.0);
constexpr double reached_m = 0.004;      // from the end of a piece
constexpr double leap_m = 0.3;           // by which a robot may come ahead in a period
constexpr double damping_s = 0.4;        // of the way in which it comes back to the track, at its speed
constexpr double least_length_m = 0.12;  // the same at rest
constexpr double brake_part = 0.8;       // of the acceleration, with which it brakes
constexpr double look_step_m = 0.025;    // between places that are looked at

}  // namespace

std::vector<PathPiece> pieces_of(const TrackPieces& track, const TrackSection& section) {
  std::vector<PathPiece> pieces;
  for (std::size_t i = section.from.piece; i < track.size() && i <= section.to.piece; ++i) {
    const double from = i == section.from.piece ? section.from.part : 0.0;
    const double to = i == section.to.piece ? section.to.part : 1.0;
    if (to > from) pieces.push_back(section_of(track[i], from, to));
  }
  return pieces;
}

Pose2 TrackFollower::pose_at(const TrackPlace& place) const {
  if (place.piece >= track_->size()) return {track_->back().to, heading_out(track_->back())};
  const PathPiece& piece = (*track_)[place.piece];
  return {point_on(piece, place.part), heading_in(piece) + place.part * piece.turn_rad};
}

double TrackFollower::beside_m(Vec2 robot) const { return distance(robot, pose_at(at_).position); }

/// Returns true if the robot goes from a piece to the next without a turn.
bool TrackFollower::joins_smoothly(std::size_t piece) const {
  if (piece + 1 >= track_->size()) return false;
  const PathPiece &from = (*track_)[piece], &to = (*track_)[piece + 1];
  return from.backward == to.backward &&
         std::abs(wrap_angle(heading_in(to) - heading_out(from))) < smooth_rad;
}

void TrackFollower::note(const Pose2& robot) {
  while (!is_done()) {
    const double length_m = length_of(piece());
    const double part = nearest_part(piece(), robot.position);
    if (looks_along_ && part > at_.part && (part - at_.part) * length_m < leap_m) at_.part = part;
    if ((1.0 - at_.part) * length_m > reached_m) return;
    looks_along_ = joins_smoothly(at_.piece);
    at_ = {at_.piece + 1, 0.0};
  }
}

void TrackFollower::go_on(const Pose2& robot) {
  looks_along_ = !is_done() && std::abs(wrap_angle(pose_at(at_).heading_rad - robot.heading_rad)) < about_rad;
}

std::optional<double> TrackFollower::heading_to_turn_to(const Pose2& robot) {
  if (looks_along_) return {};
  const double heading_rad = pose_at(at_).heading_rad;
  looks_along_ = std::abs(wrap_angle(heading_rad - robot.heading_rad)) < looks_along_rad;
  return looks_along_ ? std::nullopt : std::optional(heading_rad);
}

/// Returns the curvature of the track where the turn rate that begins to change now is that of the track.
double TrackFollower::curvature_soon(double speed_mps, const RobotModel& model, double period_s) const {
  const auto curvature_of = [](const PathPiece& one) { return one.turn_rad / length_of(one); };
  const double now = curvature_of(piece());
  if (!joins_smoothly(at_.piece)) return now;
  const double next = curvature_of((*track_)[at_.piece + 1]);
  const double change_s = std::abs(next - now) * speed_mps / model.turn_acceleration_radps2;
  const double left_m = (1.0 - at_.part) * length_of(piece());
  return left_m < speed_mps * 0.5 * (change_s + period_s) ? next : now;
}

Twist2 TrackFollower::twist(const Pose2& robot, const RobotModel& model, double period_s,
                            double room_m) const {
  const PathPiece& now = piece();
  const double brake = brake_part * model.acceleration_mps2;
  const auto most_on = [&](const PathPiece& one) {
    if (one.turn_rad == 0.0) return model.speed_mps;
    return std::min(model.speed_mps, model.turn_rate_radps * distance(one.centre, one.from));
  };
  double speed = most_on(now);
  double left_m = (1.0 - at_.part) * length_of(now);
  std::size_t last = at_.piece;
  for (; joins_smoothly(last) && left_m < speed * speed / brake; ++last) {
    speed = std::min(speed, std::hypot(most_on((*track_)[last + 1]), std::sqrt(2.0 * brake * left_m)));
    left_m += length_of((*track_)[last + 1]);
  }
  left_m = std::min(left_m, room_m);
  const double late_mps = brake * period_s;  // what it drives on before a command takes effect
  if (!joins_smoothly(last) || left_m == room_m)
    speed = std::min({speed, std::hypot(std::sqrt(2.0 * brake * left_m), late_mps) - late_mps});

  const Pose2 wanted = pose_at(at_);
  const double looks = now.backward ? -1.0 : 1.0;
  const Vec2 along = looks * direction(wanted.heading_rad);
  const double off_m = dot(robot.position - wanted.position, perpendicular(along));
  const double angle_rad = wrap_angle(robot.heading_rad - wanted.heading_rad);
  const double curvature = curvature_soon(speed, model, period_s);
  const double length_m = std::max(least_length_m, damping_s * speed);
  const double turn =
      speed * (curvature - off_m / (length_m * length_m) - 2.0 * std::sin(angle_rad) / length_m);
  return {looks * speed, 0.0, std::clamp(turn, -model.turn_rate_radps, model.turn_rate_radps)};
}

std::optional<TrackPlace> TrackFollower::ahead_of(TrackPlace from, double way_m) const {
  for (; from.piece < track_->size(); from = {from.piece + 1, 0.0}) {
    const double length_m = length_of((*track_)[from.piece]);
    const double left_m = (1.0 - from.part) * length_m;
    if (way_m < left_m) return TrackPlace{from.piece, from.part + way_m / length_m};
    way_m -= left_m;
  }
  return {};
}

double TrackFollower::free_m(const IsFree& is_free, double most_m) const {
  for (double way_m = 0.0; way_m < most_m; way_m += look_step_m) {
    const auto place = ahead_of(at_, way_m);
    if (!place) return most_m;
    if (!is_free(pose_at(*place))) return way_m;
  }
  return most_m;
}

std::optional<TrackPlace> TrackFollower::next_free(TrackPlace from, const IsFree& is_free,
                                                   double free_m) const {
  std::optional<TrackPlace> first;  // of the free places that follow each other
  double so_far_m = 0.0;
  std::optional<TrackPlace> place = from;
  for (; place; place = ahead_of(*place, look_step_m)) {
    if (!is_free(pose_at(*place))) {
      first.reset();
      continue;
    }
    if (!first) so_far_m = 0.0;
    if (!first) first = place;
    so_far_m += look_step_m;
    if (so_far_m >= free_m) return first;
  }
  return first;
}

void TrackFollower::skip_to(const std::optional<TrackPlace>& place) {
  const TrackPlace to = place.value_or(TrackPlace{track_->size(), 0.0});
  if (to > at_) left_out_.push_back({at_, to});
  at_ = to;
  looks_along_ = false;
}

}  // namespace outrider
