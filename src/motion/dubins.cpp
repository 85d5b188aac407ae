#include <algorithm>
#include <cmath>

#include "turning_words.hpp"

namespace outrider {
namespace {

/// Returns the angle in [0, 2 pi). Rounding just below a whole turn is none.
double forwards(double angle_rad) {
  const double angle = std::fmod(std::fmod(angle_rad, 2.0 * pi) + 2.0 * pi, 2.0 * pi);
  return angle > 2.0 * pi - 1e-12 ? 0.0 : angle;
}

TurningPath word(const std::array<int, 3>& sides, double first, double middle, double last) {
  TurningPath path;
  path.add({sides[0], first});
  path.add({sides[1], middle});
  path.add({sides[2], last});
  return path;
}

/// The words that begin to the left, radius 1: what follows is read off the circles that are left and right
/// of each pose, and of the straight line or the third circle that touches both.
void add_words(const Pose2& goal, turning::Words& found) {
  const Vec2 aside = perpendicular(direction(goal.heading_rad)), first{0.0, 1.0};
  const Vec2 same = goal.position + aside - first;      // to the last circle of left, straight, left
  const Vec2 opposite = goal.position - aside - first;  // of left, straight, right
  const double along = heading_of(same), phi = goal.heading_rad;
  found.add(word({1, 0, 1}, forwards(along), norm(same), forwards(phi - along)));
  const double inner = squared_norm(opposite) - 4.0;
  if (inner >= 0.0) {
    const double straight = std::sqrt(inner);
    const double turn = forwards(heading_of(opposite) + std::atan2(2.0, straight));
    found.add(word({1, 0, -1}, turn, straight, forwards(turn - phi)));
  }
  const double apart = norm(same);
  if (apart > 4.0) return;
  for (const double sign : {1.0, -1.0}) {  // where the third circle lies
    const double to_middle = along + sign * std::acos(apart / 4.0);
    const double from_middle = heading_of(same - 2.0 * direction(to_middle));
    found.add(word({1, -1, 1}, forwards(to_middle + 0.5 * pi), forwards(to_middle + pi - from_middle),
                   forwards(phi - 1.5 * pi - from_middle)));
  }
}

}  // namespace

void turning::add_dubins_words(const Pose2& goal, Words& words) {
  add_words(goal, words);
  Words mirrored;
  add_words({{goal.position.x, -goal.position.y}, -goal.heading_rad}, mirrored);
  for (TurningPath& path : mirrored.found()) {
    for (TurningPiece& piece : path.pieces) piece.side = -piece.side;
    words.add(path);
  }
}

std::vector<TurningPath> dubins_paths(const Pose2& from, const Pose2& to, double radius_m) {
  const Pose2 goal = turning::normalised(from, to, radius_m);
  turning::Words words;
  turning::add_dubins_words(goal, words);
  return turning::arriving(words, goal, radius_m);
}

}  // namespace outrider
