#include "outrider/motion/turning_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Adds the pieces that have a length, scaled, and returns how far the path ends from the goal.
double follow(const TurningPath& path, const Pose2& goal, double radius_m, TurningPath& scaled) {
  Pose2 end;
  for (std::size_t i = 0; i < path.count; ++i) {
    const TurningPiece& piece = path.pieces[i];
    if (!(std::abs(piece.length_m) > no_length)) continue;
    end = after(end, piece, 1.0);
    scaled.add({piece.side, radius_m * piece.length_m});
  }
  return std::max(distance(end.position, goal.position),
                  std::abs(wrap_angle(end.heading_rad - goal.heading_rad)));
}

std::vector<TurningPath> arriving(const Words& words, const Pose2& goal, double radius_m) {
  const double slack = arrived * std::max(1.0, norm(goal.position));
  std::vector<TurningPath> good;
  for (const TurningPath& path : words.found()) {
    TurningPath scaled;
    if (follow(path, goal, radius_m, scaled) <= slack) good.push_back(scaled);
  }
  std::stable_sort(good.begin(), good.end(),
                   [](const TurningPath& a, const TurningPath& b) { return a.length_m < b.length_m; });
  return good;
}

double shortest_length(Words& words, const Pose2& goal) {
  const double slack = arrived * std::max(1.0, norm(goal.position));
  const std::span<TurningPath> left = words.found();
  while (true) {
    const auto first = std::ranges::min_element(left, {}, &TurningPath::length_m);
    TurningPath scaled;
    if (first == left.end() || std::isinf(first->length_m))
      return first == left.end() ? 0.0 : first->length_m;
    if (follow(*first, goal, 1.0, scaled) <= slack) return scaled.length_m;
    first->length_m = std::numeric_limits<double>::infinity();
  }
}

}  // namespace turning

double shortest_turning_length(const Pose2& from, const Pose2& to, double radius_m, bool reverse) {
  const Pose2 goal = turning::normalised(from, to, radius_m);
  turning::Words words;
  reverse ? turning::add_reeds_shepp_words(goal, words) : turning::add_dubins_words(goal, words);
  return radius_m * turning::shortest_length(words, goal);
}

}  // namespace outrider
