#include <cmath>
#include <optional>
#include <span>

#include "turning_words.hpp"

namespace outrider {
namespace {

/// The free lengths of a word, in radii: of its first, a middle and its last piece.
struct Lengths {
  double t = 0.0;
  double u = 0.0;
  double v = 0.0;
};
using Formula = std::optional<Lengths> (*)(const Pose2& goal);

enum class Length { t, u, minus_u, v, quarter };

/// A word of the paper with its equation there.
struct Word {
  Formula formula;
  std::array<std::pair<int, Length>, 5> pieces;
  std::size_t count;
  bool reversible;  ///< the word in the opposite order is another one
};

/// From the centre of the circle at the left of the start to that at the left or the right of the goal.
Vec2 to_left(const Pose2& goal) {
  return goal.position + perpendicular(direction(goal.heading_rad)) - Vec2{0.0, 1.0};
}
Vec2 to_right(const Pose2& goal) {
  return goal.position - perpendicular(direction(goal.heading_rad)) - Vec2{0.0, 1.0};
}

std::optional<Lengths> left_straight_left(const Pose2& goal) {  // (8.1)
  const Vec2 c = to_left(goal);
  const double t = heading_of(c);
  return Lengths{t, norm(c), wrap_angle(goal.heading_rad - t)};
}

std::optional<Lengths> left_straight_right(const Pose2& goal) {  // (8.2)
  const Vec2 c = to_right(goal);
  const double inner = squared_norm(c) - 4.0;
  if (inner < 0.0) return std::nullopt;
  const double u = std::sqrt(inner), t = wrap_angle(heading_of(c) + std::atan2(2.0, u));
  return Lengths{t, u, wrap_angle(t - goal.heading_rad)};
}

std::optional<Lengths> three_arcs(const Pose2& goal) {  // (8.3), (8.4)
  const Vec2 c = to_left(goal);
  if (norm(c) > 4.0) return std::nullopt;
  const double u = -2.0 * std::asin(0.25 * norm(c)), t = wrap_angle(heading_of(c) + 0.5 * u + pi);
  return Lengths{t, u, wrap_angle(goal.heading_rad - t + u)};
}

/// The outer arcs of four, whose inner ones are u and v long: (8.5), (8.6).
std::optional<Lengths> around(const Pose2& goal, double u, double v) {
  const Vec2 c = to_right(goal);
  const double delta = wrap_angle(u - v), a = std::sin(u) - std::sin(delta),
               b = std::cos(u) - std::cos(delta) - 1.0;
  const double angle = std::atan2(c.y * a - c.x * b, c.x * a + c.y * b);
  const bool flip = 2.0 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3.0 < 0.0;
  const double t = wrap_angle(flip ? angle + pi : angle);
  return Lengths{t, u, wrap_angle(t - u + v - goal.heading_rad)};
}

std::optional<Lengths> four_arcs_one_cusp(const Pose2& goal) {  // (8.7)
  const double rho = 0.25 * (2.0 + norm(to_right(goal)));
  if (rho > 1.0) return std::nullopt;
  const double u = std::acos(rho);
  return around(goal, u, -u);
}

std::optional<Lengths> four_arcs_two_cusps(const Pose2& goal) {  // (8.8)
  const double rho = (20.0 - squared_norm(to_right(goal))) / 16.0;
  if (rho < 0.0 || rho > 1.0) return std::nullopt;
  const double u = -std::acos(rho);
  return around(goal, u, u);
}

std::optional<Lengths> quarter_to_left(const Pose2& goal) {  // (8.9)
  const Vec2 c = to_left(goal);
  if (norm(c) < 2.0) return std::nullopt;
  const double r = std::sqrt(squared_norm(c) - 4.0), t = wrap_angle(heading_of(c) + std::atan2(r, -2.0));
  return Lengths{t, 2.0 - r, wrap_angle(goal.heading_rad - 0.5 * pi - t)};
}

std::optional<Lengths> quarter_to_right(const Pose2& goal) {  // (8.10)
  const Vec2 c = to_right(goal);
  if (norm(c) < 2.0) return std::nullopt;
  const double t = heading_of({-c.y, c.x});
  return Lengths{t, 2.0 - norm(c), wrap_angle(t + 0.5 * pi - goal.heading_rad)};
}

std::optional<Lengths> two_quarters(const Pose2& goal) {  // (8.11)
  const Vec2 c = to_right(goal);
  if (norm(c) < 2.0) return std::nullopt;
  const double u = 4.0 - std::sqrt(squared_norm(c) - 4.0);
  if (u > 0.0) return std::nullopt;
  const double t = wrap_angle(std::atan2((4.0 - u) * c.x - 2.0 * c.y, -2.0 * c.x + (u - 4.0) * c.y));
  return Lengths{t, u, wrap_angle(t - goal.heading_rad)};
}

/// The words that begin to the left; the others are their mirror images, driven the other way, and in the
/// opposite order.
std::span<const Word> words() {
  using enum Length;
  static constexpr std::array<Word, 8> all{
      {{left_straight_left, {{{1, t}, {0, u}, {1, v}}}, 3, false},
       {left_straight_right, {{{1, t}, {0, u}, {-1, v}}}, 3, false},
       {three_arcs, {{{1, t}, {-1, u}, {1, v}}}, 3, true},
       {four_arcs_one_cusp, {{{1, t}, {-1, u}, {1, minus_u}, {-1, v}}}, 4, false},
       {four_arcs_two_cusps, {{{1, t}, {-1, u}, {1, u}, {-1, v}}}, 4, false},
       {quarter_to_left, {{{1, t}, {-1, quarter}, {0, u}, {1, v}}}, 4, true},
       {quarter_to_right, {{{1, t}, {-1, quarter}, {0, u}, {-1, v}}}, 4, true},
       {two_quarters, {{{1, t}, {-1, quarter}, {0, u}, {1, quarter}, {-1, v}}}, 5, false}}};
  return all;
}

double length_of(Length which, const Lengths& lengths) {
  switch (which) {
    case Length::t: return lengths.t;
    case Length::u: return lengths.u;
    case Length::minus_u: return -lengths.u;
    case Length::v: return lengths.v;
    case Length::quarter: break;
  }
  return -0.5 * pi;
}

}  // namespace

void turning::add_reeds_shepp_words(const Pose2& goal, Words& found) {
  for (const Word& word : words()) {
    for (const bool opposite : {false, true}) {
      if (opposite && !word.reversible) continue;
      // Seen from the goal, a path driven the other way round leads to the start.
      const Pose2 base = opposite ? Pose2{{dot(direction(goal.heading_rad), goal.position),
                                           -cross(direction(goal.heading_rad), goal.position)},
                                          goal.heading_rad}
                                  : goal;
      for (const double time : {1.0, -1.0}) {
        for (const int mirror : {1, -1}) {
          const auto lengths = word.formula({{time * base.position.x, mirror * base.position.y},
                                             wrap_angle(time * mirror * base.heading_rad)});
          if (!lengths) continue;
          TurningPath path;
          for (std::size_t i = 0; i < word.count; ++i) {
            const auto& [side, which] = word.pieces[opposite ? word.count - 1 - i : i];
            path.add({mirror * side, time * length_of(which, *lengths)});
          }
          found.add(path);
        }
      }
    }
  }
}

std::vector<TurningPath> reeds_shepp_paths(const Pose2& from, const Pose2& to, double radius_m) {
  const Pose2 goal = turning::normalised(from, to, radius_m);
  turning::Words words;
  turning::add_reeds_shepp_words(goal, words);
  return turning::arriving(words, goal, radius_m);
}

}  // namespace outrider
