#include "outrider/control/speed_profile.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/bisect.hpp"

namespace outrider {
namespace {

constexpr int halvings = 50;

/// The bend of the path between two points.
struct Bend {
  double length_m = 0.0;
  double curvature = 0.0;
  double curvature_per_m = 0.0;
};

/// Accelerations along the path that the limits allow.
struct Range {
  double least = 0.0, most = 0.0;
};

/// Returns the accelerations at the square x of the speed; `least` > `most` if there are none.
Range accelerations(const Bend& bend, double x, const PathLimits& limits) {
  const double centripetal = bend.curvature * x;
  const double square = limits.acceleration_mps2 * limits.acceleration_mps2 - centripetal * centripetal;
  if (square < 0.0) return {1.0, 0.0};
  Range range{-std::sqrt(square), std::sqrt(square)};
  if (!limits.turns_with_path) return range;
  const double turning = bend.curvature_per_m * x, most = limits.turn_acceleration_radps2;
  if (bend.curvature == 0.0) return std::abs(turning) <= most ? range : Range{1.0, 0.0};
  const double a = (-most - turning) / bend.curvature, b = (most - turning) / bend.curvature;
  range.least = std::max(range.least, std::min(a, b));
  range.most = std::min(range.most, std::max(a, b));
  return range;
}

/// The square of the speed that limits of speeds allow.
double square_of_speed(double curvature, const PathLimits& limits) {
  double speed = std::min(limits.speed_mps, limits.wheel_radps / limits.per_speed);
  if (limits.turns_with_path) {
    const double bend = std::abs(curvature);
    speed = std::min({speed, limits.turn_rate_radps / bend,
                      limits.wheel_radps / (limits.per_speed + limits.per_turn * bend)});
  }
  return speed * speed;
}

std::vector<Bend> bends_of(const std::vector<PathPoint>& path) {
  std::vector<Bend> bends;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length_m = path[i].along_m - path[i - 1].along_m;
    bends.push_back({length_m, 0.5 * (path[i].curvature + path[i - 1].curvature),
                     length_m > 0.0 ? (path[i].curvature - path[i - 1].curvature) / length_m : 0.0});
  }
  return bends;
}

}  // namespace

double greatest_speed(double curvature, double curvature_per_m, const PathLimits& limits) {
  const Bend bend{0.0, curvature, curvature_per_m};
  return std::sqrt(largest_up_to(square_of_speed(curvature, limits), halvings, [&](double x) {
    const Range range = accelerations(bend, x, limits);
    return range.least <= range.most;
  }));
}

SpeedProfile speed_profile(const std::vector<PathPoint>& path, const PathLimits& limits) {
  const std::vector<Bend> bends = bends_of(path);
  std::vector<double> most(path.size());  // from which the rest of the path can be driven
  for (std::size_t i = 0; i < path.size(); ++i) most[i] = square_of_speed(path[i].curvature, limits);
  most.back() = 0.0;
  for (std::size_t i = bends.size(); i-- > 0;) {
    const double twice_m = 2.0 * bends[i].length_m, next = most[i + 1];
    most[i] = largest_up_to(most[i], halvings, [&](double x) {
      const Range range = accelerations(bends[i], x, limits);
      return range.least <= range.most && x + twice_m * range.least <= next &&
             x + twice_m * range.most >= 0.0;
    });
  }
  SpeedProfile profile{{0.0}, {0.0}};
  double x = 0.0;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const double length_m = bends[i].length_m;
    const Range range = accelerations(bends[i], x, limits);
    const double before = profile.speeds_mps.back();
    x = std::clamp(x + 2.0 * length_m * range.most, 0.0, most[i + 1]);
    const double speed = std::sqrt(x), mean = 0.5 * (before + speed);
    profile.speeds_mps.push_back(speed);
    profile.times_s.push_back(profile.times_s.back() + (length_m > 0.0 ? length_m / mean : 0.0));
  }
  return profile;
}

}  // namespace outrider
