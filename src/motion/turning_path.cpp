#include "outrider/motion/turning_path.hpp"

#include <algorithm>
#include <cmath>

#include "turning_words.hpp"

namespace outrider {

void TurningPath::add(TurningPiece piece) {
  pieces[count++] = piece;
  length_m += std::abs(piece.length_m);
}

Pose2 after(const Pose2& pose, const TurningPiece& piece, double radius_m) {
  const Vec2 ahead = direction(pose.heading_rad);
  if (piece.side == 0) return {pose.position + piece.length_m * ahead, pose.heading_rad};
  const double turn = piece.side * piece.length_m / radius_m;
  const Vec2 arm = -piece.side * radius_m * perpendicular(ahead);  // from the centre of the arc
  return {pose.position - arm + rotated(turn, arm), pose.heading_rad + turn};
}

Pose2 end_of(const TurningPath& path, const Pose2& from, double radius_m) {
  Pose2 pose = from;
  for (std::size_t i = 0; i < path.count; ++i) pose = after(pose, path.pieces[i], radius_m);
  return pose;
}

namespace turning {
namespace {

constexpr double no_length = 1e-9;  // of the radius
constexpr double arrived = 1e-9;

}  // namespace

Pose2 normalised(const Pose2& from, const Pose2& to, double radius_m) {
  const Pose2 goal = relative_pose(from, to);
  return {(1.0 / radius_m) * goal.position, wrap_angle(goal.heading_rad)};
}

std::vector<TurningPath> arriving(const std::vector<TurningPath>& paths, const Pose2& goal, double radius_m) {
  std::vector<TurningPath> good;
  for (const TurningPath& path : paths) {
    TurningPath scaled;
    Pose2 end;
    for (std::size_t i = 0; i < path.count; ++i) {
      const TurningPiece& piece = path.pieces[i];
      if (!(std::abs(piece.length_m) > no_length)) continue;
      end = after(end, piece, 1.0);
      scaled.add({piece.side, radius_m * piece.length_m});
    }
    const double off = std::max(distance(end.position, goal.position),
                                std::abs(wrap_angle(end.heading_rad - goal.heading_rad)));
    if (off <= arrived * std::max(1.0, norm(goal.position))) good.push_back(scaled);
  }
  std::stable_sort(good.begin(), good.end(),
                   [](const TurningPath& a, const TurningPath& b) { return a.length_m < b.length_m; });
  return good;
}

}  // namespace turning
}  // namespace outrider
