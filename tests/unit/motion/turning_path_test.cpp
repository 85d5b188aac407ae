#include "outrider/motion/turning_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <queue>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Pose2 drawn(Rng& rng, double half_m) {
  return {{rng.uniform(-half_m, half_m), rng.uniform(-half_m, half_m)}, rng.uniform(-pi, pi)};
}

Pose2 mirrored(const Pose2& pose) { return {{pose.position.x, -pose.position.y}, -pose.heading_rad}; }
Pose2 turned_about(const Pose2& pose) { return {pose.position, pose.heading_rad + pi}; }

double dubins(const Pose2& a, const Pose2& b, double r) { return dubins_paths(a, b, r).front().length_m; }
double reeds_shepp(const Pose2& a, const Pose2& b, double r) {
  return reeds_shepp_paths(a, b, r).front().length_m;
}

void expect_good(const std::vector<TurningPath>& paths, const Pose2& from, const Pose2& to, double radius_m,
                 bool reverse) {
  ASSERT_FALSE(paths.empty());
  double before = 0.0;
  for (const TurningPath& path : paths) {
    const Pose2 end = end_of(path, from, radius_m);
    EXPECT_LT(distance(end.position, to.position), 1e-8);
    EXPECT_LT(std::abs(wrap_angle(end.heading_rad - to.heading_rad)), 1e-8);
    EXPECT_GE(path.length_m, before);
    before = path.length_m;
    for (std::size_t i = 0; i < path.count; ++i) EXPECT_TRUE(reverse || path.pieces[i].length_m > 0.0);
  }
  EXPECT_GE(paths.front().length_m, distance(from.position, to.position) - 1e-9);
}

TEST(TurningPath, LaysOutCasesThatAreKnown) {
  EXPECT_NEAR(dubins({}, {{5, 0}, 0}, 1.0), 5.0, 1e-12);
  EXPECT_NEAR(reeds_shepp({}, {{-5, 0}, 0}, 1.0), 5.0, 1e-12);
  EXPECT_NEAR(dubins({}, {{0, 4}, pi}, 2.0), 2.0 * pi, 1e-9) << "half a circle";
  EXPECT_NEAR(dubins({}, {{0, 10}, pi}, 2.0), 2.0 * pi + 6.0, 1e-9) << "two quarters and a leg";
  EXPECT_NEAR(dubins({}, {{-1e-3, 0}, 0}, 1.0), 2.0 * pi, 0.1) << "no way back but all around";
  EXPECT_NEAR(dubins({}, {{0, 0}, pi}, 1.0), 2.0 * pi * (1.0 / 6.0) * 2.0 + 2.0 * pi * (5.0 / 6.0), 1e-9)
      << "a turn about on the spot: 60, 300 and 60 degrees";
  EXPECT_NEAR(reeds_shepp({}, {{0, 0}, pi}, 1.0), pi, 1e-9) << "three arcs of 60 degrees";
  EXPECT_NEAR(dubins({{3, 4}, 1.0}, {{3, 4}, 1.0}, 1.0), 0.0, 1e-12);
}

TEST(TurningPath, RandomPosesAreJoinedAndReverseNeverCostsMore) {
  Rng rng(5);
  for (int k = 0; k < testing::cases(10'000); ++k) {
    const double radius = rng.uniform(0.2, 3.0), half = rng.below(2) == 0 ? 2.0 : 20.0;
    const Pose2 from = drawn(rng, half), to = drawn(rng, half);
    const auto forwards = dubins_paths(from, to, radius), both = reeds_shepp_paths(from, to, radius);
    expect_good(forwards, from, to, radius, false);
    expect_good(both, from, to, radius, true);
    EXPECT_DOUBLE_EQ(shortest_turning_length(from, to, radius, false), forwards.front().length_m);
    EXPECT_DOUBLE_EQ(shortest_turning_length(from, to, radius, true), both.front().length_m);
    const double one = forwards.front().length_m, two = both.front().length_m;
    EXPECT_LE(two, one + 1e-9);
    // The same length mirrored, and driven from the other end: forwards with the headings turned about.
    EXPECT_NEAR(dubins(mirrored(from), mirrored(to), radius), one, 1e-7);
    EXPECT_NEAR(dubins(turned_about(to), turned_about(from), radius), one, 1e-7);
    EXPECT_NEAR(reeds_shepp(mirrored(from), mirrored(to), radius), two, 1e-7);
    EXPECT_NEAR(reeds_shepp(to, from, radius), two, 1e-7);
    EXPECT_NEAR(reeds_shepp(turned_about(from), turned_about(to), radius), two, 1e-7);
  }
}

/// Any two paths, one after the other, are a path: the shortest keep the triangle inequality.
TEST(TurningPath, KeepsTheTriangleInequality) {
  Rng rng(6);
  for (int k = 0; k < testing::cases(5000); ++k) {
    const Pose2 a = drawn(rng, 4.0), b = drawn(rng, 4.0), c = drawn(rng, 4.0);
    EXPECT_LE(dubins(a, c, 1.0), dubins(a, b, 1.0) + dubins(b, c, 1.0) + 1e-7);
    EXPECT_LE(reeds_shepp(a, c, 1.0), reeds_shepp(a, b, 1.0) + reeds_shepp(b, c, 1.0) + 1e-7);
  }
}

/// The twin: random strings of arcs and legs, three to five long, whose end is the goal. None may be shorter.
TEST(TurningPath, NoRandomDriveIsShorter) {
  Rng rng(7);
  for (int k = 0; k < testing::cases(20'000); ++k) {
    Pose2 forwards, both;
    double one = 0.0, two = 0.0;
    for (std::uint64_t i = 2 + rng.below(4); i > 0; --i) {
      const int side = static_cast<int>(rng.below(3)) - 1;
      const double length = rng.uniform(0.0, 2.5);
      const double sign = rng.below(2) == 0 ? 1.0 : -1.0;
      // Any radius of at least 1 is allowed to the drive.
      const double radius = rng.below(2) == 0 ? 1.0 : rng.uniform(1.0, 3.0);
      forwards = after(forwards, {side, length}, radius);
      both = after(both, {side, sign * length}, radius);
      one += length;
      two += length;
    }
    EXPECT_LE(dubins({}, forwards, 1.0), one + 1e-7);
    EXPECT_LE(reeds_shepp({}, both, 1.0), two + 1e-7);
  }
}

/// Another twin: the shortest drives of a best-first search over a lattice of poses (steps of 0.2 along arcs
/// and legs, one pose for each cell of 0.1 and 6 degrees).
TEST(TurningPath, ASearchOverALatticeFindsNothingShorter) {
  struct Node {
    double length;
    Pose2 pose;
    bool operator<(const Node& other) const { return length > other.length; }
  };
  constexpr double step = 0.2, cell = 0.1, half = 3.0;
  constexpr int across = 60, turns = 60;
  const auto index = [&](const Pose2& p) -> std::ptrdiff_t {
    const int x = static_cast<int>(std::floor((p.position.x + half) / cell)),
              y = static_cast<int>(std::floor((p.position.y + half) / cell));
    if (x < 0 || y < 0 || x >= across || y >= across) return -1;
    const int h = static_cast<int>(std::floor((wrap_angle(p.heading_rad) + pi) / (2.0 * pi) * turns)) % turns;
    return (static_cast<std::ptrdiff_t>(h) * across + y) * across + x;
  };
  for (const bool reverse : {false, true}) {
    std::vector<double> least(static_cast<std::size_t>(across * across * turns), 1e9);
    std::priority_queue<Node> open;
    open.push({0.0, {}});
    int judged = 0;
    while (!open.empty()) {
      const Node node = open.top();
      open.pop();
      const auto at = index(node.pose);
      if (at < 0 || least[static_cast<std::size_t>(at)] <= node.length) continue;
      least[static_cast<std::size_t>(at)] = node.length;
      const double exact = reverse ? reeds_shepp({}, node.pose, 1.0) : dubins({}, node.pose, 1.0);
      EXPECT_LE(exact, node.length + 1e-7) << "it really drove here";
      ++judged;
      if (node.length > (reverse ? 2.0 : 3.0)) continue;
      for (const int side : {-1, 0, 1}) {
        for (const double sign : {1.0, -1.0}) {
          if (sign < 0.0 && !reverse) continue;
          open.push({node.length + step, after(node.pose, {side, sign * step}, 1.0)});
        }
      }
    }
    EXPECT_GT(judged, 1000);
  }
}

}  // namespace
}  // namespace outrider
