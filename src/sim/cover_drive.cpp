#include "outrider/sim/cover_drive.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"

namespace outrider {
namespace {

constexpr double arc_step_rad = radians(2.0);
constexpr int most_halvings = 12;

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

}  // namespace

CoverDrive drive_track(const CoverTrack& track, const PolygonGround& ground, const Pace& pace, double stray_m,
                       std::uint64_t seed) {
  const Rng rng(seed);
  Rng speeds = rng.child("pace");
  const auto offsets = offsets_of(track, ground, stray_m, rng.child("stray"));
  CoverDrive drive;
  drive.way.push_back(track.start.position);
  double heading = track.start.heading_rad, planned_heading = heading;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const PathPiece& piece = track.pieces[i];
    const auto points = moved(piece, offsets[i], offsets[i + 1]);
    Pace now = pace;
    now.speed_mps = speeds.uniform(pace.slowest_speed_mps, pace.speed_mps);
    now.turn_rate_radps = speeds.uniform(pace.slowest_turn_rate_radps, pace.turn_rate_radps);
    const bool moves = length_of(points) > 0.0;
    // The tangent at an end of an arc is half a step away from its first chord.
    const double half_rad = 0.5 * piece.turn_rad / static_cast<double>(points.size() - 1);
    const double begin = moves ? heading_of(points[1] - points[0]) - half_rad : heading;
    const double turn = std::abs(wrap_angle(begin - heading));
    if (std::abs(wrap_angle(heading_in(piece) - planned_heading)) > no_turn_rad) drive.time_s += pace.pause_s;
    drive.time_s += duration(turn, now.turning()) + duration(length_of(points), limits_on(piece, now));
    drive.turned_rad += turn + std::abs(piece.turn_rad);
    drive.length_m += length_of(points);
    drive.strayed_m = std::max(drive.strayed_m, norm(offsets[i + 1]));
    drive.way.insert(drive.way.end(), points.begin() + 1, points.end());
    planned_heading = heading_out(piece);
    if (moves) heading = heading_of(points.back() - points[points.size() - 2]) + half_rad;
  }
  return drive;
}

}  // namespace outrider
