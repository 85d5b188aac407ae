#include "outrider/nodes/missions/piece_driver.hpp"

#include <algorithm>
#include <cmath>

#include "missions/limits.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double turned_rad = 0.01;     // nearer to its heading it has turned
constexpr double arrived_m = 0.004;     // nearer to its end a piece is driven
constexpr double stiffest_per_m = 5.0;  // k at low speeds
constexpr double steers_back_s = 0.5;   // at high speeds, about which a step of e takes
constexpr double longest_step_s = 0.1;

double towards(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

void PieceDriver::begin(const FollowPiece& command, double time_s) {
  command_ = command;
  stage_ = turns_ ? Stage::turn : Stage::wait;
  until_s_ = time_s_ = time_s;
  stopped();
}

PieceDriver::Place PieceDriver::place_of(Vec2 point) const {
  const PathPiece& piece = command_.piece;
  if (piece.turn_rad == 0.0) {
    const Vec2 way = piece.to - piece.from;
    const Vec2 along = norm(way) > 0.0 ? (1.0 / norm(way)) * way : Vec2{1.0, 0.0};
    return {dot(point - piece.from, along), cross(along, point - piece.from), std::atan2(along.y, along.x)};
  }
  const Vec2 first = piece.from - piece.centre, spoke = point - piece.centre;
  const double side = piece.turn_rad > 0.0 ? 1.0 : -1.0, radius_m = norm(first);
  const double middle = 0.5 * piece.turn_rad;  // angles are told apart about the middle of the arc
  const double begin_rad = std::atan2(first.y, first.x);
  const double turned = middle + wrap_angle(std::atan2(spoke.y, spoke.x) - begin_rad - middle);
  return {side * turned * radius_m, side * (radius_m - norm(spoke)),
          begin_rad + turned + side * 0.5 * std::numbers::pi};
}

double PieceDriver::distance_from(Vec2 point) const {
  const PathPiece& piece = command_.piece;
  if (piece.turn_rad == 0.0) return distance(point, Segment{piece.from, piece.to});
  const Place place = place_of(point);
  const bool beside = place.along_m >= 0.0 && place.along_m <= length_of(piece);
  return beside ? std::abs(place.left_m) : std::min(distance(point, piece.from), distance(point, piece.to));
}

Twist2 PieceDriver::turn(double step_s, double error_rad) {
  const double fastest = std::min(
      pace_.turn_rate_radps, std::sqrt(2.0 * careful * pace_.turn_acceleration_radps2 * std::abs(error_rad)));
  const double gentle = std::min(fastest, 4.0 * std::abs(error_rad));
  turn_rate_ = towards(turn_rate_, std::copysign(gentle, error_rad), pace_.turn_acceleration_radps2 * step_s);
  return {0.0, 0.0, turn_rate_};
}

Twist2 PieceDriver::drive(double step_s, const Pose2& pose) {
  const PathPiece& piece = command_.piece;
  const Place place = place_of(pose.position);
  const double left_m = length_of(piece) - place.along_m;
  const Limits limits = limits_on(piece, pace_);
  const double wanted =
      std::min(limits.speed, std::sqrt(2.0 * careful * limits.acceleration * std::max(0.0, left_m)));
  speed_ = towards(speed_, std::max(wanted, 0.02), limits.acceleration * step_s);
  const double travel_rad = pose.heading_rad + (piece.backward ? std::numbers::pi : 0.0);
  const double angle_rad = wrap_angle(travel_rad - place.heading_rad);
  const double k = std::min(stiffest_per_m, 1.0 / (steers_back_s * std::max(speed_, 1e-3)));
  const double curvature = piece.turn_rad == 0.0 ? 0.0 : piece.turn_rad / length_of(piece);
  const double most = std::numbers::pi / 4.0;  // farther away the equation would turn it around
  const double back_rad = std::clamp(2.0 * angle_rad + k * place.left_m, -most, most);
  turn_rate_ = std::clamp(speed_ * (curvature - k * back_rad), -pace_.turn_rate_radps, pace_.turn_rate_radps);
  return {piece.backward ? -speed_ : speed_, 0.0, turn_rate_};
}

std::optional<Twist2> PieceDriver::twist(double time_s, const Pose2& pose) {
  const double step_s = std::clamp(time_s - time_s_, 0.0, longest_step_s);
  time_s_ = time_s;
  if (stage_ == Stage::turn) {
    const double error_rad = wrap_angle(heading_in(command_.piece) - pose.heading_rad);
    if (std::abs(error_rad) > turned_rad) return turn(step_s, error_rad);
    stage_ = Stage::wait;
    until_s_ = time_s + command_.pause_s;
    turn_rate_ = 0.0;
  }
  if (stage_ == Stage::wait) {
    if (time_s < until_s_) return Twist2{};
    stage_ = Stage::drive;
  }
  if (stage_ == Stage::done) return std::nullopt;
  if (length_of(command_.piece) - place_of(pose.position).along_m > arrived_m) return drive(step_s, pose);
  stage_ = Stage::done;
  return std::nullopt;
}

}  // namespace outrider
