#include "outrider/jobs/cover/drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"

namespace outrider {
namespace {

constexpr double arc_step_rad = radians(2.0);
constexpr int most_halvings = 12;
constexpr double off_m = 3e-3, off_rad = 4e-3;  // of what is interpolated between two samples

/// The piece with its ends moved by the offsets, and what lies between by a blend of them.
std::vector<Vec2> moved(const PathPiece& piece, Vec2 at_begin, Vec2 at_end) {
  std::vector<Vec2> points = points_along({{piece.from, 0.0}, {piece}}, arc_step_rad);
  const auto last = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double part = static_cast<double>(i) / last;
    points[i] = points[i] + (1.0 - part) * at_begin + part * at_end;
  }
  return points;
}

/// Whether the robot may drive there. Between the points of an arc it is off by the sagitta at most.
bool is_free(const PathPiece& piece, const std::vector<Vec2>& points, const PolygonGround& ground) {
  if (piece.turn_rad == 0.0)
    return ground.point_free(points[0]) && ground.segment_free({points[0], points[1]});
  return std::all_of(points.begin(), points.end(), [&](Vec2 p) { return ground.point_free(p); });
}

Vec2 drawn_offset(Rng& rng, double most_m) {
  const double away = most_m * std::sqrt(rng.uniform());
  return away * direction(rng.uniform(0.0, 2.0 * pi));
}

/// Offsets of all ends of pieces that keep the whole way free; the start is where it is.
std::vector<Vec2> offsets_of(const CoverTrack& track, const PolygonGround& ground, double stray_m, Rng rng) {
  std::vector<Vec2> offsets(track.pieces.size() + 1);
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const PathPiece& piece = track.pieces[i];
    Vec2 offset = drawn_offset(rng, stray_m);
    // The next piece must still be free with its other end in place, so that a way out remains.
    const auto fits = [&] {
      if (!is_free(piece, moved(piece, offsets[i], offset), ground)) return false;
      if (i + 1 == track.pieces.size()) return true;
      const PathPiece& next = track.pieces[i + 1];
      return is_free(next, moved(next, offset, {}), ground);
    };
    for (int halvings = 0; halvings < most_halvings && !fits(); ++halvings) offset = 0.5 * offset;
    offsets[i + 1] = fits() ? offset : Vec2{};
  }
  return offsets;
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
  Recorder(CoverDrive& drive, const Pose2& start) : drive_(drive), pose_(start) {
    drive_.way.push_back(start.position);
    drive_.times_s.push_back(0.0);
    note(0.0, start);
  }

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

  /// Drives along the points from then on, where it looks along `headings`, and is there at the end.
  void drive(double begin_s, double end_s, const std::vector<Vec2>& points,
             const std::vector<double>& headings, const Limits& limits) {
    const double length = length_of(points), bend_rad = std::abs(headings.back() - headings.front());
    const double off = bend_rad > 0.0 ? std::min(off_m, off_rad * length / bend_rad) : off_m;
    const Motion motion(length, limits);
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
      const double at_s = last ? end_s : begin_s + reached_s;
      note(at_s, {points[i], headings[i]});
      drive_.way.push_back(points[i]);
      drive_.times_s.push_back(at_s);
    }
  }

 private:
  /// Nothing is told twice.
  void note(double time_s, const Pose2& pose) {
    pose_ = pose;
    if (!drive_.track.empty() && drive_.track.back().time_s >= time_s) drive_.track.pop_back();
    drive_.track.push_back({time_s, pose, 0.0, 0.0});
  }

  CoverDrive& drive_;
  Pose2 pose_;
};

/// Of a curve through the points that begins and ends in these headings: between two legs the mean of theirs.
std::vector<double> headings_along(const std::vector<Vec2>& points, double begin_rad, double end_rad) {
  std::vector<double> headings{begin_rad};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before = heading_of(points[i] - points[i - 1]);
    const double after = heading_of(points[i + 1] - points[i]);
    const double mean = before + 0.5 * wrap_angle(after - before);
    headings.push_back(headings.back() + wrap_angle(mean - headings.back()));
  }
  headings.push_back(headings.back() + wrap_angle(end_rad - headings.back()));
  return headings;
}

}  // namespace

CoverDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace, double stray_m,
                       std::uint64_t seed) {
  const Rng rng(seed);
  Rng speeds = rng.child("pace");
  const auto offsets = offsets_of(track, ground, stray_m, rng.child("stray"));
  CoverDrive drive;
  Recorder recorder(drive, track.start);
  double heading = track.start.heading_rad, planned_heading = heading;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const PathPiece& piece = track.pieces[i];
    const auto points = moved(piece, offsets[i], offsets[i + 1]);
    Pace now = pace;
    now.speed_mps = speeds.uniform(pace.slowest_speed_mps, pace.speed_mps);
    now.turn_rate_radps = speeds.uniform(pace.slowest_turn_rate_radps, pace.turn_rate_radps);
    const double length = length_of(points);
    const bool moves = length > 0.0;
    // The tangent at an end of an arc is half a step away from its first chord.
    const double half_rad = 0.5 * piece.turn_rad / static_cast<double>(points.size() - 1);
    const double begin = moves ? heading_of(points[1] - points[0]) - half_rad : heading;
    const double end = moves ? heading_of(points.back() - points[points.size() - 2]) + half_rad : heading;
    const double turn = wrap_angle(begin - heading), turning_s = duration(std::abs(turn), now.turning());
    const bool pauses = std::abs(wrap_angle(heading_in(piece) - planned_heading)) > no_turn_rad;
    const double begin_s = drive.time_s, moving_s = begin_s + turning_s + (pauses ? pace.pause_s : 0.0);
    drive.time_s = moving_s + duration(length, limits_on(piece, now));
    recorder.turn(begin_s, turn, now.turning());
    recorder.stand_until(moving_s);
    recorder.drive(moving_s, drive.time_s, points, headings_along(points, begin, end), limits_on(piece, now));
    drive.ends_s.push_back(drive.time_s);
    drive.turned_rad += std::abs(turn) + std::abs(piece.turn_rad);
    drive.length_m += length;
    drive.strayed_m = std::max(drive.strayed_m, norm(offsets[i + 1]));
    planned_heading = heading_out(piece);
    heading = end;
  }
  return drive;
}

}  // namespace outrider
