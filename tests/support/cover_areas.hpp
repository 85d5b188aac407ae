// Areas to cover, made at random, and a count of what a disk covers that shares nothing with the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"

namespace outrider::testing {

/// A star-shaped polygon about a point: simple, with sharp and blunt corners.
inline std::vector<Vec2> random_star(Rng& rng, Vec2 centre, double low_m, double high_m, int corners) {
  std::vector<Vec2> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * pi * (i + rng.uniform(0.0, 0.7)) / corners;
    polygon.push_back(centre + rng.uniform(low_m, high_m) * direction(angle));
  }
  return polygon;
}

/// A star of up to 12 m with up to two holes near its middle, and a robot that fits.
inline CoverProblem random_cover_problem(Rng& rng) {
  CoverProblem problem;
  problem.boundary = random_star(rng, {0.0, 0.0}, 4.0, 6.0, 5 + static_cast<int>(rng.below(8)));
  for (std::uint64_t i = rng.below(3); i > 0; --i) {
    const Vec2 centre = (i == 1 ? 1.2 : -1.2) * direction(rng.uniform(0.0, pi));
    problem.holes.push_back(random_star(rng, centre, 0.2, 0.8, 3 + static_cast<int>(rng.below(4))));
  }
  problem.width_m = rng.uniform(0.4, 0.9);
  problem.overlap = rng.uniform(0.02, 0.3);
  problem.tracking_error_m = rng.uniform() * 0.5 * problem.overlap * problem.width_m;
  return problem;
}

/// Options for tests that need a track and not the best one: a short search for the order, and no bound of
/// it.
inline CoverOptions any_order() {
  CoverOptions options;
  options.order.iterations = 200;
  options.order.gap = 1.0;
  return options;
}

/// How often a disk on the way comes over a point: maximal stretches of the way within the radius, where a
/// stretch goes on through the joint of two legs.
inline int passes_over(Vec2 p, const std::vector<Vec2>& way, double radius_m) {
  int passes = 0;
  bool over = false;  // at the end of the leg before
  for (std::size_t i = 1; i < way.size(); ++i) {
    const bool during = distance(p, Segment{way[i - 1], way[i]}) <= radius_m;
    if (during && !over) ++passes;
    // A leg meets a disk in one stretch, so it goes on only where its end is within.
    over = during && distance(p, way[i]) <= radius_m;
  }
  return passes;
}

}  // namespace outrider::testing
