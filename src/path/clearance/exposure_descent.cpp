#include "exposure_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "polygon_clearance.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_points = 65;
constexpr int most_refinements = 4;
constexpr int most_sweeps = 40;
constexpr double least_gain = 2e-5;     // of the cost, in a sweep
constexpr double least_removal = 1e-9;  // of the cost of two legs, for which one replaces them
constexpr double first_step = 0.25;     // of the shorter leg beside a corner
constexpr double least_step = 1e-3;     // of the same

/// A polyline with the costs of its legs.
struct Bend {
  const LegCost& cost;
  std::vector<Vec2> points;
  std::vector<double> legs{};
  std::vector<double> steps{};  ///< of each point, as shares of the shorter leg beside it

  void begin() {
    legs.clear();
    for (std::size_t i = 1; i < points.size(); ++i) legs.push_back(cost(points[i - 1], points[i]));
    steps.assign(points.size(), first_step);
  }
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const double leg : legs) sum += leg;
    return sum;
  }
  /// Moves a corner across the path, or along it, to where a parabola through three costs is least, or to the
  /// best of them.
  void move(std::size_t i, bool lengthwise = false) {
    const Vec2 along = points[i + 1] - points[i - 1];
    const double width = norm(along);
    if (!(width > 0.0)) return;
    const double shorter = std::min(distance(points[i - 1], points[i]), distance(points[i], points[i + 1]));
    const double step = steps[i] * shorter;
    const Vec2 across = (step / width) * (lengthwise ? along : perpendicular(along));
    const Vec2 from = points[i];
    const double here = legs[i - 1] + legs[i];
    double best = here, at = 0.0;
    const auto tried = [&](double share) {
      const Vec2 p = from + share * across;
      const double first = cost(points[i - 1], p);
      const double both = first < best ? first + cost(p, points[i + 1]) : first;
      if (both < best) {
        best = both;
        at = share;
        points[i] = p;
        legs[i - 1] = first;
        legs[i] = both - first;
      }
      return both;
    };
    const double right = tried(1.0), left = tried(-1.0);
    const double curved = right - 2.0 * here + left;
    if (std::isfinite(curved) && curved > 0.0) {
      const double least = std::clamp(0.5 * (left - right) / curved, -3.0, 3.0);
      if (std::abs(least) > 0.05) tried(least);
    }
    steps[i] = std::clamp(std::abs(at) < 0.5   ? 0.5 * steps[i]
                          : std::abs(at) > 1.5 ? 2.0 * steps[i]
                                               : steps[i],
                          least_step, 1.0);
  }
  /// Leaves a corner out if one leg costs less than two.
  bool removed(std::size_t i) {
    const double leg = cost(points[i - 1], points[i + 1]);
    if (!(leg < (1.0 - least_removal) * (legs[i - 1] + legs[i]))) return false;
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
    legs.erase(legs.begin() + static_cast<std::ptrdiff_t>(i));
    legs[i - 1] = leg;
    return true;
  }
  void settle(bool lengthwise) {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      const double before = total();
      for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        move(i);
        if (lengthwise) move(i, true);
        if (removed(i)) --i;
      }
      if (total() > (1.0 - least_gain) * before) break;
    }
  }
  void halve() {
    std::vector<Vec2> finer{points.front()};
    for (std::size_t i = 1; i < points.size(); ++i) {
      finer.push_back(0.5 * (points[i - 1] + points[i]));
      finer.push_back(points[i]);
    }
    points = std::move(finer);
  }
};

}  // namespace

double LegCost::operator()(Vec2 a, Vec2 b) const {
  const Segment leg{a, b};
  if (stop.stop_requested()) return std::numeric_limits<double>::infinity();
  if (leg_clearance(ground, leg) < least_m) return std::numeric_limits<double>::infinity();
  return distance(a, b) + weight_m * leg_exposure(ground, leg);
}

std::vector<Vec2> settled(std::vector<Vec2> points, const LegCost& cost) {
  Bend bend{cost, std::move(points)};
  bend.begin();
  bend.settle(true);
  return std::move(bend.points);
}

std::vector<Vec2> descended(std::vector<Vec2> points, const LegCost& cost) {
  Bend bend{cost, std::move(points)};
  for (int level = 0;; ++level) {
    bend.begin();
    bend.settle(false);
    if (level == most_refinements || 2 * bend.points.size() > most_points) return std::move(bend.points);
    bend.halve();
  }
}

}  // namespace outrider
