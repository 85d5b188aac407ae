#include "outrider/motion/closest_approach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double tolerance = 1e-6;  // places and times that differ by less are one
constexpr double forever_s = std::numeric_limits<double>::infinity();

/// Motion with constant acceleration, until the next piece begins.
struct Piece {
  double begin_s = 0.0;
  Vec2 position;
  Vec2 velocity_mps = {};
  Vec2 acceleration_mps2 = {};
};

/// Time of a turn or a straight leg from rest to rest.
double rest_to_rest_s(double way, double speed, double acceleration) {
  const double ramps = speed * speed / acceleration;  // to speed up and to slow down
  return way < ramps ? 2.0 * std::sqrt(way / acceleration) : way / speed + speed / acceleration;
}

/// Appends a straight leg: speed up, drive, slow down, stand. Returns the time of its end.
double add_leg(std::vector<Piece>& pieces, const RobotModel& robot, double time_s, Vec2 from, Vec2 to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const Vec2 along = 1.0 / length * (to - from);
  const double a = robot.acceleration_mps2;
  const double peak = std::min(robot.speed_mps, std::sqrt(length * a));
  const double ramp_s = peak / a, ramp_m = 0.5 * peak * ramp_s;
  const double cruise_s = std::max(0.0, (length - 2.0 * ramp_m) / peak);
  pieces.push_back({time_s, from, {}, a * along});
  pieces.push_back({time_s + ramp_s, from + ramp_m * along, peak * along});
  pieces.push_back({time_s + ramp_s + cruise_s, to - ramp_m * along, peak * along, -a * along});
  pieces.push_back({time_s + 2.0 * ramp_s + cruise_s, to});
  return pieces.back().begin_s;
}

bool has_finite_numbers(const TimedDrive& drive) {
  return std::isfinite(drive.begin_s) && std::isfinite(drive.heading_rad.value_or(0.0)) &&
         std::ranges::all_of(drive.waypoints,
                             [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

Outcome<std::vector<Piece>> pieces_of(const RobotModel& robot, const TimedDrives& driven, std::size_t index) {
  std::vector<Piece> pieces{{0.0, driven.start.position}};
  double heading = driven.start.heading_rad, free_s = 0.0;
  for (std::size_t i = 0; i < driven.drives.size(); ++i) {
    const TimedDrive& drive = driven.drives[i];
    const auto refuse = [&](const char* what) {
      return bad_input(fmt::format("drive {} of robot {} {}", i + 1, index + 1, what));
    };
    if (!has_finite_numbers(drive)) return refuse("has a number that is not finite");
    if (drive.waypoints.empty()) continue;
    if (drive.begin_s < free_s - tolerance) return refuse("begins before the one before has ended");
    const Vec2 away = drive.waypoints.front() - pieces.back().position;
    if (std::hypot(away.x, away.y) > tolerance) return refuse("begins elsewhere than the robot stands");
    double time_s = std::max(drive.begin_s, free_s);
    heading = drive.heading_rad.value_or(heading);
    for (std::size_t k = 1; k < drive.waypoints.size(); ++k) {
      const Vec2 from = drive.waypoints[k - 1], to = drive.waypoints[k];
      if (from == to) continue;
      const double next = std::atan2(to.y - from.y, to.x - from.x);
      const double turn = std::abs(std::remainder(next - heading, 2.0 * pi));
      time_s += rest_to_rest_s(turn, robot.turn_rate_radps, robot.turn_acceleration_radps2);
      time_s = add_leg(pieces, robot, time_s, from, to);
      heading = next;
    }
    free_s = time_s;
  }
  return pieces;
}

/// A cubic polynomial; the first coefficient is that of the constant.
struct Cubic {
  double c0, c1, c2, c3;
  [[nodiscard]] double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
};

/// Times in (0, end_s) at which the cubic may turn round: the zeros of its derivative, in order.
std::vector<double> turning_points(const Cubic& f, double end_s) {
  const double a = 3.0 * f.c3, b = 2.0 * f.c2, c = f.c1;
  std::vector<double> zeros;
  if (const double root = b * b - 4.0 * a * c; root >= 0.0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    if (a != 0.0) zeros.push_back(q / a);
    if (q != 0.0) zeros.push_back(c / q);
  }
  std::erase_if(zeros, [&](double t) { return !(t > 0.0 && t < end_s); });
  std::ranges::sort(zeros);
  return zeros;
}

/// All zeros of the cubic in [0, end_s] at which it changes its sign.
std::vector<double> zeros_of(const Cubic& f, double end_s) {
  std::vector<double> ends{0.0};
  for (const double t : turning_points(f, end_s)) ends.push_back(t);
  ends.push_back(end_s);
  std::vector<double> zeros;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    double low = ends[i - 1], high = ends[i];
    if ((f.at(low) > 0.0) == (f.at(high) > 0.0)) continue;
    const bool rises = f.at(high) > 0.0;
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      ((f.at(middle) > 0.0) == rises ? high : low) = middle;
    }
    zeros.push_back(low);
  }
  return zeros;
}

/// The piece moved to a later time within it.
Piece later(const Piece& piece, double time_s) {
  const double t = time_s - piece.begin_s;
  const Vec2 gained = t * piece.acceleration_mps2;
  return {time_s, piece.position + t * piece.velocity_mps + 0.5 * t * gained, piece.velocity_mps + gained,
          piece.acceleration_mps2};
}

/// Takes the least distance of two robots over the time in which both pieces last, if it is nearer.
void approach(const Piece& one, const Piece& other, double end_s, ClosestApproach& nearest) {
  const double length_s = end_s - one.begin_s;
  const Vec2 p = other.position - one.position;
  const Vec2 v = other.velocity_mps - one.velocity_mps;
  const Vec2 a = other.acceleration_mps2 - one.acceleration_mps2;
  std::vector<double> times{0.0};
  if (std::isfinite(length_s)) {  // beyond the last piece of both, everybody stands
    const Cubic slope{dot(p, v), dot(v, v) + dot(p, a), 1.5 * dot(v, a), 0.5 * dot(a, a)};
    for (const double t : zeros_of(slope, length_s)) times.push_back(t);
    times.push_back(length_s);
  }
  for (const double t : times) {
    const Vec2 apart = p + t * v + 0.5 * t * t * a;
    const double distance_m = std::hypot(apart.x, apart.y);
    if (distance_m >= nearest.distance_m) continue;
    nearest.distance_m = distance_m;
    nearest.time_s = one.begin_s + t;
  }
}

ClosestApproach closest_of(const std::vector<Piece>& one, const std::vector<Piece>& other) {
  ClosestApproach nearest{forever_s, 0.0, 0, 0};
  const auto end_of = [](const std::vector<Piece>& pieces, std::size_t i) {
    return i + 1 < pieces.size() ? pieces[i + 1].begin_s : forever_s;
  };
  for (std::size_t i = 0, k = 0; i < one.size() && k < other.size();) {
    const double begin_s = std::max(one[i].begin_s, other[k].begin_s);
    const double end_s = std::min(end_of(one, i), end_of(other, k));
    if (end_s >= begin_s) approach(later(one[i], begin_s), later(other[k], begin_s), end_s, nearest);
    if (end_of(one, i) <= end_of(other, k)) {
      ++i;
    } else {
      ++k;
    }
  }
  return nearest;
}

}  // namespace

Outcome<ClosestApproach> closest_approach(const RobotModel& robot, const std::vector<TimedDrives>& robots) {
  std::vector<std::vector<Piece>> pieces;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    auto of_robot = pieces_of(robot, robots[i], i);
    if (!of_robot) return pass_on(of_robot);
    pieces.push_back(std::move(*of_robot));
  }
  ClosestApproach nearest{forever_s, 0.0, 0, 0};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = i + 1; k < pieces.size(); ++k) {
      const ClosestApproach pair = closest_of(pieces[i], pieces[k]);
      if (pair.distance_m < nearest.distance_m) nearest = {pair.distance_m, pair.time_s, i, k};
    }
  }
  return nearest;
}

}  // namespace outrider
