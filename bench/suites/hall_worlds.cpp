#include "hall_worlds.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider::bench {
namespace {

constexpr double hall_wall_m = 0.2, hall_high_m = 1.5;
constexpr std::int64_t fields = 60, halls = 20;

Solid wall_between(Vec2 low, Vec2 high) {
  const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  return {
      "wall", {{middle.x, middle.y, 0.5 * hall_high_m}, {}}, BoxShape{{half.x, half.y, 0.5 * hall_high_m}}};
}

/// An empty place with walls around it.
World walled(const Box2& inside) {
  const auto [low, high] = inside;
  World world;
  world.name = "hall";
  world.bounds = inside;
  world.solids = {wall_between({low.x - hall_wall_m, low.y - hall_wall_m}, {high.x + hall_wall_m, low.y}),
                  wall_between({low.x - hall_wall_m, high.y}, {high.x + hall_wall_m, high.y + hall_wall_m}),
                  wall_between({low.x - hall_wall_m, low.y}, {low.x, high.y}),
                  wall_between({high.x, low.y}, {high.x + hall_wall_m, high.y})};
  return world;
}

Vec2 point_in(const Box2& box, Rng& rng) {
  const double x = rng.uniform(box.low.x, box.high.x);
  return {x, rng.uniform(box.low.y, box.high.y)};
}

/// The polynomial through points at equal distances of its parameter (Lagrange).
Vec2 polynomial_at(const std::vector<Vec2>& points, double at) {
  Vec2 sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double weight = 1.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k != i) weight *= (at - static_cast<double>(k)) / (static_cast<double>(i) - static_cast<double>(k));
    }
    sum = sum + weight * points[i];
  }
  return sum;
}

/// A path along a polynomial of random order that stays in the field.
std::vector<Vec2> draw_path(const Box2& field, Rng& rng) {
  constexpr int pieces = 60;
  for (;;) {
    std::vector<Vec2> through(2 + rng.below(4)), path;
    for (Vec2& point : through) point = point_in(field, rng);
    for (int i = 0; i <= pieces; ++i)
      path.push_back(polynomial_at(through, static_cast<double>(through.size() - 1) * i / pieces));
    if (std::ranges::all_of(path, [&](Vec2 point) { return field.contains(point); })) return path;
  }
}

HallWorld draw_field(std::int64_t number) {
  Rng rng = Rng(static_cast<std::uint64_t>(number)).child("posts");
  HallWorld drawn;
  drawn.world = walled({{-12.0, -8.0}, {12.0, 8.0}});
  drawn.start = {{-10.0, 0.0}, 0.0};
  drawn.goal = {10.0, 0.0};
  drawn.speed_mps = 2.0;
  const Box2 field{{-7.5, -7.0}, {7.5, 7.0}};
  const auto posts = 5 + rng.below(11);
  for (std::uint64_t i = 0; i < posts; ++i) {
    MovingPost post;
    post.radius_m = rng.uniform(0.2, 0.5);
    post.speed_mps = rng.uniform(0.2, 2.0);
    post.path = draw_path(field, rng);
    post.begin_m = rng.uniform(0.0, 20.0);
    drawn.walkers.posts.push_back(std::move(post));
  }
  return drawn;
}

HallWorld draw_hall(std::int64_t number) {
  Rng rng = Rng(static_cast<std::uint64_t>(number)).child("people");
  HallWorld drawn;
  drawn.world = walled({{-9.0, -4.0}, {9.0, 4.0}});
  drawn.start = {{-8.0, 0.0}, 0.0};
  drawn.goal = {8.0, 0.0};
  const auto pillars = rng.below(5);
  for (std::uint64_t i = 0; i < pillars; ++i) {
    const Vec2 at = point_in({{-6.0, -3.0}, {6.0, 3.0}}, rng), half{0.2, 0.2};
    drawn.world.solids.push_back(wall_between(at - half, at + half));
  }
  drawn.walkers.people = 5 + (25 * (number - 1) + halls / 2) / (halls - 1);
  drawn.walkers.people_mps = rng.uniform(0.6, 1.2);
  drawn.walkers.people_social = true;
  return drawn;
}

HallWorld draw_inattentive(std::int64_t number) {
  HallWorld drawn = draw_hall(number);
  drawn.walkers.people_heed = false;
  return drawn;
}

}  // namespace

const std::vector<HallKind>& hall_kinds() {
  static const std::vector<HallKind> kinds = {
      {"posts", "posts on polynomials, in a field", fields, draw_field},
      {"social", "people who keep away, in a hall", halls, draw_hall},
      {"inattentive", "people who do not heed the robot, in a hall", halls, draw_inattentive},
  };
  return kinds;
}

}  // namespace outrider::bench
