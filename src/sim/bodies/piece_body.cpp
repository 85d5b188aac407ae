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
constexpr double carried_s = 1.0;               // how long somebody carries the robot who puts it elsewhere

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

  /// Turns in place from then on, and stops at `end_s` at the latest.
  void turn(double begin_s, double angle_rad, const Limits& limits, double end_s) {
    const Motion motion(std::abs(angle_rad), limits);
    const double from_rad = pose_.heading_rad;
    std::vector<double> times;
    motion.add_times(0.0, std::min(motion.duration_s(), end_s - begin_s), off_rad, times);
    for (const double time_s : times) {
      const double turned = std::copysign(motion.at(time_s), angle_rad);
      note(begin_s + time_s, {pose_.position, from_rad + turned});
    }
  }

  void stand_until(double time_s) { note(time_s, pose_); }

  /// Is put there, which is no drive.
  void put(double time_s, const Pose2& pose) {
    drive_.carried.push_back({drive_.track.back().time_s, time_s});
    note(time_s, pose);
    drive_.way.push_back(pose.position);
    drive_.times_s.push_back(time_s);
  }

  /// Drives along the points from then on, where it looks along `headings`, and is there at the end,
  /// `last_s` after the motion began.
  void drive(double begin_s, double end_s, const std::vector<Vec2>& points,
             const std::vector<double>& headings, const Motion& motion, double last_s) {
    const double length = length_of(points), bend_rad = std::abs(headings.back() - headings.front());
    const double off = bend_rad > 0.0 ? std::min(off_m, off_rad * length / bend_rad) : off_m;
    double far = 0.0, reached_s = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double leg = distance(points[i - 1], points[i]), before = far;
      far += leg;
      const bool last = i + 1 == points.size();
      const double from_s = std::exchange(reached_s, last ? last_s : motion.when(far));
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
                     const PolygonGround& ground, const Rng& rng, const TrackFaults& faults)
    : pace_(pace),
      tracking_error_m_(tracking_error_m * faults.tracking_ratio),
      ground_(&ground),
      speed_rng_(rng.child("pace")),
      offset_rng_(rng.child("stray")),
      heading_rad_(start.heading_rad),
      faults_(faults),
      faulty_(faults.any()),
      hindrance_(faults.way, ground.radius_m, [&ground](Segment line) {
        return ground.point_free(line.a) && (line.a == line.b || ground.segment_free(line));
      }) {
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

std::optional<double> PieceBody::touch_rad() const {
  const auto towards_rad = hindrance_.touches_post(pose().position, drive_.time_s);
  return towards_rad ? std::optional(wrap_angle(*towards_rad - pose().heading_rad)) : std::nullopt;
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

/// The points beside the piece; by its beginning, if those are not free.
std::vector<Vec2> PieceBody::free_points(const PathPiece& piece, Vec2 at_begin, Vec2 at_end) const {
  std::vector<Vec2> points = points_beside(piece, at_begin, at_end);
  if (!faulty_ || at_begin == Vec2{} || is_free(piece, points, *ground_)) return points;
  points = points_beside(piece, {}, at_end);
  points.insert(points.begin(), piece.from + at_begin);
  return points;
}

/// Ends the way after that length. On an arc its end is on the true arc, beside it by the blend.
void PieceBody::shorten(Way& way, double way_m) {
  const PathPiece& piece = way.piece;
  std::vector<Vec2>& points = way.points;
  std::vector<double>& headings = way.headings;
  double far_m = 0.0;
  std::size_t i = 1;
  for (; i + 1 < points.size() && far_m + distance(points[i - 1], points[i]) < way_m; ++i)
    far_m += distance(points[i - 1], points[i]);
  const double leg_m = distance(points[i - 1], points[i]);
  const double part = leg_m > 0.0 ? std::clamp((way_m - far_m) / leg_m, 0.0, 1.0) : 0.0;
  points[i] = points[i - 1] + part * (points[i] - points[i - 1]);
  headings[i] = headings[i - 1] + part * (headings[i] - headings[i - 1]);
  points.resize(i + 1);
  headings.resize(i + 1);
  way.end_rad = headings.back();
  if (piece.turn_rad == 0.0 || (way.by_beginning && i == 1)) return;
  const double blend = way_m / way.whole_m;
  const Vec2 centre = piece.centre + (1.0 - blend) * way.at_begin + blend * way.at_end;
  const Vec2 arm = points[i] - centre;
  points[i] = centre + distance(piece.centre, piece.from) / norm(arm) * arm;
}

/// With slip it is shorter and slower.
PieceBody::Way PieceBody::way_of(const PathPiece& piece, std::vector<Vec2> points, const Pace& pace) const {
  Way way{.piece = piece, .points = std::move(points), .limits = limits_on(piece, pace)};
  const std::size_t last = way.points.size() - 1;
  const std::size_t chords = points_along(piece.from, {piece}, arc_step_rad).size() - 1;
  way.by_beginning = last > chords;
  if (!way.by_beginning) way.at_begin = way.points[0] - piece.from;
  way.at_end = way.points[last] - piece.to;
  way.whole_m = length_of(way.points);
  const bool moves = way.whole_m > 0.0, backward = piece.backward;
  // The tangent at an end of an arc is half a step away from its first chord.
  const double half_rad = 0.5 * piece.turn_rad / static_cast<double>(chords);
  const double begin = moves ? looks_along(way.points[0], way.points[1], backward) - half_rad : heading_rad_;
  way.end_rad =
      moves ? looks_along(way.points[last - 1], way.points[last], backward) + half_rad : heading_rad_;
  way.headings = headings_along(way.points, begin, way.end_rad, backward);
  if (faults_.slip > 0.0 && moves) {
    const double part = 1.0 - faults_.slip;
    shorten(way, part * way.whole_m);
    way.limits = {part * way.limits.speed, part * way.limits.acceleration};
  }
  return way;
}

/// Turns in place and pauses. Returns the angle that it turned.
double PieceBody::turn(double angle_rad, const Limits& limits, double pause_s) {
  const double begin_s = drive_.time_s, whole_s = duration(std::abs(angle_rad), limits);
  const double moving_s = begin_s + whole_s + pause_s;
  const auto cut_s = faulty_ ? hindrance_.cuts_turn(begin_s, moving_s) : std::nullopt;
  drive_.time_s = cut_s.value_or(moving_s);
  Recorder recorder(drive_);
  recorder.turn(begin_s, angle_rad, limits, cut_s.value_or(std::numeric_limits<double>::infinity()));
  recorder.stand_until(drive_.time_s);
  if (!cut_s) return std::abs(angle_rad);
  give_up();
  return covered(std::abs(angle_rad), limits, *cut_s - begin_s);
}

/// Returns the part that it drove.
double PieceBody::drive_along(Way way) {
  const double begin_s = drive_.time_s, length = length_of(way.points);
  const Motion motion(length, way.limits);
  const auto cut_s = faulty_
                         ? hindrance_.cuts_leg({way.points, way.limits, begin_s, motion.duration_s(), true})
                         : std::nullopt;
  const double last_s = cut_s.value_or(motion.duration_s());
  const double part = cut_s && length > 0.0 ? covered(length, way.limits, *cut_s) / length : 1.0;
  if (cut_s && part > 0.0) shorten(way, part * length);
  drive_.time_s = begin_s + last_s;
  if (part > 0.0) {
    Recorder(drive_).drive(begin_s, drive_.time_s, way.points, way.headings, motion, last_s);
    drive_.length_m += cut_s ? length_of(way.points) : length;
    heading_rad_ = way.end_rad;
  }
  if (cut_s) give_up();
  return part;
}

/// Stands for a while before it gives the piece up. May be carried away.
void PieceBody::give_up() {
  stopped_ = true;
  hindrance_.note_cut();
  drive_.time_s += hindrance_.gives_up_after_s(drive_.time_s);
  Recorder recorder(drive_);
  recorder.stand_until(drive_.time_s);
  const Pose2 here = pose();
  heading_rad_ = here.heading_rad;
  if (const auto elsewhere = hindrance_.put_elsewhere(here, drive_.time_s)) {
    drive_.time_s += carried_s;
    recorder.put(drive_.time_s, *elsewhere);
    carried_from_ = here;
    heading_rad_ = elsewhere->heading_rad;
  }
}

void PieceBody::follow(const FollowPiece& command) {
  const PathPiece& piece = command.piece;
  if (faulty_) offset_ = pose().position - piece.from;
  const Vec2 offset = next_offset(command);
  const auto points = free_points(piece, std::exchange(offset_, offset), offset);
  Pace now = pace_;
  now.speed_mps = speed_rng_.uniform(pace_.slowest_speed_mps, pace_.speed_mps);
  now.turn_rate_radps = speed_rng_.uniform(pace_.slowest_turn_rate_radps, pace_.turn_rate_radps);
  const Way way = way_of(piece, points, now);
  stopped_ = false;
  const double turned_rad =
      turn(turn_in_place(heading_rad_, way.headings.front()), now.turning(), command.pause_s);
  const double part = stopped_ ? 0.0 : drive_along(way);
  drive_.ends_s.push_back(drive_.time_s);
  drive_.turned_rad += turned_rad + part * std::abs(piece.turn_rad);
  drive_.tracking_error_m = std::max(drive_.tracking_error_m, norm(offset));
}

}  // namespace outrider
