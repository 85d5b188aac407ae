#include "outrider/sim/bodies/piece_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double arc_step_rad = radians(2.0);
constexpr int most_halvings = 12;
constexpr double off_m = 3e-3, off_rad = 4e-3;  // of what is interpolated between two samples

/// The piece with its ends moved by the offsets, and what lies between by a blend of them.
std::vector<Vec2> points_beside(const PathPiece& piece, Vec2 at_begin, Vec2 at_end) {
  std::vector<Vec2> points = points_along(piece.from, {piece}, arc_step_rad);
  const auto last = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double part = static_cast<double>(i) / last;
    points[i] = points[i] + (1.0 - part) * at_begin + part * at_end;
  }
  return points;
}

/// Returns true if the robot may drive there. Between the points of an arc the check is off by the sagitta at
/// most.
bool is_free(const PathPiece& piece, const std::vector<Vec2>& points, const PolygonGround& ground) {
  if (piece.turn_rad == 0.0)
    return ground.point_free(points[0]) && ground.segment_free({points[0], points[1]});
  return std::all_of(points.begin(), points.end(), [&](Vec2 p) { return ground.point_free(p); });
}

Vec2 drawn_offset(Rng& rng, double most_m) {
  const double away = most_m * std::sqrt(rng.uniform());
  return away * direction(rng.uniform(0.0, 2.0 * pi));
}

/// A motion from rest to rest, and when it is how far.
class Motion {
 public:
  Motion(double distance, const Limits& limits)
      : distance_(distance),
        limits_(limits),
        duration_s_(duration(distance, limits)),
        peak_(speed_after(distance, limits, 0.5 * duration_s_)),
        ramp_s_(distance > 0.0 ? peak_ / limits.acceleration : 0.0) {}

  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double at(double time_s) const { return covered(distance_, limits_, time_s); }
  /// When it has come so far: the inverse of at().
  [[nodiscard]] double when(double far) const {
    const double ramp = 0.5 * peak_ * ramp_s_, left = distance_ - far;
    if (far <= 0.0) return 0.0;
    if (left <= 0.0) return duration_s_;
    if (far < ramp) return std::sqrt(2.0 * far / limits_.acceleration);
    if (left < ramp) return duration_s_ - std::sqrt(2.0 * left / limits_.acceleration);
    return 0.5 * ramp_s_ + far / peak_;
  }
  /// Times between the two, the later one included, between which a line is off by at most `off`: on a ramp
  /// it is off by acceleration x time^2 / 8.
  void add_times(double from_s, double to_s, double off, std::vector<double>& times) const {
    std::vector<double> knots{from_s};
    for (const double knot : {ramp_s_, duration_s_ - ramp_s_}) {
      if (knot > knots.back() + no_time_s && knot < to_s - no_time_s) knots.push_back(knot);
    }
    knots.push_back(to_s);
    const double step_s = std::sqrt(8.0 * off / limits_.acceleration);
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const double middle_s = 0.5 * (knots[i - 1] + knots[i]), span_s = knots[i] - knots[i - 1];
      const bool cruises = middle_s > ramp_s_ && middle_s < duration_s_ - ramp_s_;
      const int steps = cruises ? 1 : std::max(1, static_cast<int>(std::ceil(span_s / step_s)));
      for (int k = 1; k <= steps; ++k)
        times.push_back(k < steps ? knots[i - 1] + span_s * k / steps : knots[i]);
    }
  }

 private:
  static constexpr double no_time_s = 1e-9;

  double distance_;
  Limits limits_;
  double duration_s_;
  double peak_;
  double ramp_s_;
};

/// Writes down where the robot is when.
class Recorder {
 public:
  explicit Recorder(PieceDrive& drive) : drive_(drive), pose_(drive.track.back().pose) {}

  /// Turns in place from then on.
  void turn(double begin_s, double angle_rad, const Limits& limits) {
    const Motion motion(std::abs(angle_rad), limits);
    const double from_rad = pose_.heading_rad;
    std::vector<double> times;
    motion.add_times(0.0, motion.duration_s(), off_rad, times);
    for (const double time_s : times) {
      const double turned = std::copysign(motion.at(time_s), angle_rad);
      note(begin_s + time_s, {pose_.position, from_rad + turned});
    }
  }

  void stand_until(double time_s) { note(time_s, pose_); }

  /// Drives along the points from then on, where it looks along `headings`.
  void drive(double begin_s, const std::vector<Vec2>& points, const std::vector<double>& headings,
             const Motion& motion) {
    const double length = length_of(points), bend_rad = std::abs(headings.back() - headings.front());
    const double off = bend_rad > 0.0 ? std::min(off_m, off_rad * length / bend_rad) : off_m;
    double far = 0.0, reached_s = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double leg = distance(points[i - 1], points[i]), before = far;
      far += leg;
      const bool last = i + 1 == points.size();
      const double from_s = std::exchange(reached_s, last ? motion.duration_s() : motion.when(far));
      std::vector<double> times;
      motion.add_times(from_s, reached_s, off, times);
      times.pop_back();
      for (const double time_s : times) {
        const double part = leg > 0.0 ? std::clamp((motion.at(time_s) - before) / leg, 0.0, 1.0) : 1.0;
        note(begin_s + time_s, {points[i - 1] + part * (points[i] - points[i - 1]),
                                headings[i - 1] + part * (headings[i] - headings[i - 1])});
      }
      const double at_s = begin_s + reached_s;
      note(at_s, {points[i], headings[i]});
      drive_.way.push_back(points[i]);
      drive_.times_s.push_back(at_s);
    }
  }

 private:
  /// Nothing is told twice.
  void note(double time_s, const Pose2& pose) {
    pose_ = pose;
    if (drive_.track.back().time_s >= time_s) drive_.track.pop_back();
    drive_.track.push_back({time_s, pose});
  }

  PieceDrive& drive_;
  Pose2 pose_;
};

/// The heading of a robot that drives from a to b.
double looks_along(Vec2 a, Vec2 b, bool backward) { return heading_of(backward ? a - b : b - a); }

/// Returns the headings along a curve through the points that begins and ends in these headings; between two
/// legs, the mean of theirs.
std::vector<double> headings_along(const std::vector<Vec2>& points, double begin_rad, double end_rad,
                                   bool backward) {
  std::vector<double> headings{begin_rad};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before = looks_along(points[i - 1], points[i], backward);
    const double after = looks_along(points[i], points[i + 1], backward);
    const double mean = before + 0.5 * wrap_angle(after - before);
    headings.push_back(headings.back() + wrap_angle(mean - headings.back()));
  }
  headings.push_back(headings.back() + wrap_angle(end_rad - headings.back()));
  return headings;
}

}  // namespace

PieceBody::PieceBody(const Pose2& start, const Pace& pace, double tracking_error_m,
                     const PolygonGround& ground, const Rng& rng)
    : pace_(pace),
      tracking_error_m_(tracking_error_m),
      ground_(&ground),
      speed_rng_(rng.child("pace")),
      offset_rng_(rng.child("stray")),
      heading_rad_(start.heading_rad) {
  drive_.way.push_back(start.position);
  drive_.times_s.push_back(0.0);
  drive_.track.push_back({0.0, start});
}

double PieceBody::begin(const Command& command) {
  if (const auto* follows = std::get_if<FollowPiece>(&command)) follow(*follows);
  if (const auto* waits = std::get_if<Wait>(&command); waits != nullptr && waits->until_s > drive_.time_s) {
    drive_.time_s = waits->until_s;
    Recorder(drive_).stand_until(drive_.time_s);
  }
  return drive_.time_s;
}

/// The offset of the end of the piece, with which the whole way stays free.
Vec2 PieceBody::next_offset(const FollowPiece& command) {
  Vec2 offset = drawn_offset(offset_rng_, tracking_error_m_);
  // The next piece must still be free with its other end in place, so that a way out remains.
  const auto fits = [&] {
    return is_free(command.piece, points_beside(command.piece, offset_, offset), *ground_) &&
           (!command.next || is_free(*command.next, points_beside(*command.next, offset, {}), *ground_));
  };
  for (int halvings = 0; halvings < most_halvings && !fits(); ++halvings) offset = 0.5 * offset;
  return fits() ? offset : Vec2{};
}

void PieceBody::follow(const FollowPiece& command) {
  const PathPiece& piece = command.piece;
  const Vec2 offset = next_offset(command);
  const auto points = points_beside(piece, std::exchange(offset_, offset), offset);
  Pace now = pace_;
  now.speed_mps = speed_rng_.uniform(pace_.slowest_speed_mps, pace_.speed_mps);
  now.turn_rate_radps = speed_rng_.uniform(pace_.slowest_turn_rate_radps, pace_.turn_rate_radps);
  const bool moves = length_of(points) > 0.0;
  // The tangent at an end of an arc is half a step away from its first chord.
  const double half_rad = 0.5 * piece.turn_rad / static_cast<double>(points.size() - 1);
  const std::size_t last = points.size() - 1;
  const double begin_rad =
      moves ? looks_along(points[0], points[1], piece.backward) - half_rad : heading_rad_;
  const double end_rad =
      moves ? looks_along(points[last - 1], points[last], piece.backward) + half_rad : heading_rad_;
  const auto headings = headings_along(points, begin_rad, end_rad, piece.backward);
  const double turned_rad = turn(turn_in_place(heading_rad_, begin_rad), now.turning(), command.pause_s);
  drive_along(points, headings, limits_on(piece, now));
  heading_rad_ = end_rad;
  drive_.ends_s.push_back(drive_.time_s);
  drive_.turned_rad += turned_rad + std::abs(piece.turn_rad);
  drive_.tracking_error_m = std::max(drive_.tracking_error_m, norm(offset));
}

/// Turns in place and pauses. Returns the angle that it turned.
double PieceBody::turn(double angle_rad, const Limits& limits, double pause_s) {
  Recorder recorder(drive_);
  recorder.turn(drive_.time_s, angle_rad, limits);
  drive_.time_s = drive_.time_s + duration(std::abs(angle_rad), limits) + pause_s;
  recorder.stand_until(drive_.time_s);
  return std::abs(angle_rad);
}

void PieceBody::drive_along(const std::vector<Vec2>& points, const std::vector<double>& headings,
                            const Limits& limits) {
  const double length_m = length_of(points);
  const Motion motion(length_m, limits);
  Recorder(drive_).drive(drive_.time_s, points, headings, motion);
  drive_.time_s += motion.duration_s();
  drive_.length_m += length_m;
}

}  // namespace outrider
