#include "outrider/jobs/cover/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double arc_part = 2.5e-4;  // of the stride, between a true arc and its chords

Status check_polygons(const CoverProblem& problem) {
  if (auto good = check_polygon(problem.boundary, "the boundary"); !good) {
    good.error().where = "boundary";
    return good;
  }
  const Region inside = region_of(problem.boundary, {});
  for (std::size_t i = 0; i < problem.holes.size(); ++i) {
    const std::string name = fmt::format("hole {}", i + 1);
    if (auto good = check_polygon(problem.holes[i], name); !good) {
      good.error().where = name;
      return good;
    }
    const double out = area_of(without(region_of(problem.holes[i], {}), inside));
    if (out <= 1e-6 * area_of(inside)) continue;
    return bad_input(
        fmt::format("{:.4g} m2 of it lie outside the boundary; cut it off or move the hole in", out), name);
  }
  return {};
}

Status check_numbers(const CoverProblem& problem) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(problem.width_m, 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m)) {
    return bad_input(fmt::format("a robot {:g} m wide is none; give {:g} to {:g} m", problem.width_m,
                                 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m),
                     "width");
  }
  if (!within(problem.overlap, 0.0, 0.9)) {
    return bad_input(
        fmt::format("{:g} is no part of the width that strips share; give 0 to 0.9", problem.overlap),
        "overlap");
  }
  if (!within(problem.uncovered, 0.0, 0.5)) {
    return bad_input(
        fmt::format("{:g} is no part of the area that may stay uncovered; give 0 to 0.5", problem.uncovered),
        "uncovered");
  }
  const double most_error_m = 0.5 * problem.width_m * problem.overlap;
  if (!within(problem.tracking_error_m, 0.0, most_error_m * (1.0 + 1e-9))) {
    return bad_input(
        fmt::format(
            "strips of {:g} m that share {:g} of their width leave gaps when the tracking error is {:g} "
            "m; give a tracking error of 0 to {:g} m, or an overlap of at least {:.4f}",
            problem.width_m, problem.overlap, problem.tracking_error_m, most_error_m,
            2.0 * std::abs(problem.tracking_error_m) / problem.width_m),
        "tracking_error");
  }
  return check(problem.pace);
}

/// The widest disk that may stand somewhere, m, from below: where half the size of the area is bisected.
double widest_m(const Region& area) {
  const Vec2 size = bounds_of(area).size();
  double low = 0.0, high = std::min(size.x, size.y);
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (shrunk(area, 0.5 * middle, 1e-3 * middle).empty() ? high : low) = middle;
  }
  return low;
}

/// The part of the standing room where the robot starts; the largest without a start.
Outcome<Region> part_of(const CoverProblem& problem, const PolygonGround& ground, const Region& standing) {
  const RingedPolygon* chosen = &standing.front();
  for (const RingedPolygon& part : standing) {
    if (area_of(part) > area_of(*chosen)) chosen = &part;
  }
  if (!problem.start) return Region{*chosen};
  const Vec2 at = problem.start->position;
  if (ground.outside(at)) {
    return fault(FaultCode::outside_map, fmt::format("({:g}, {:g}) lies outside the area", at.x, at.y),
                 "start");
  }
  if (!ground.point_free(at)) {
    return fault(FaultCode::start_blocked,
                 fmt::format("a robot {:g} m wide cannot stand at ({:g}, {:g}), {:.4g} m from an edge",
                             problem.width_m, at.x, at.y, ground.edge_distance(at)),
                 "start");
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const RingedPolygon& part : standing) {
    if (contains(part, at)) return Region{part};
    const double away = distance_to_border(part, at);
    if (away < nearest) chosen = &part;
    nearest = std::min(nearest, away);
  }
  return Region{*chosen};
}

}  // namespace

Outcome<CoverageArea> cover_ground(const CoverProblem& problem) {
  if (auto good = check_numbers(problem); !good) return pass_on(good);
  if (auto good = check_polygons(problem); !good) return pass_on(good);
  auto ground = PolygonGround::of(problem.boundary, problem.holes, problem.radius_m());
  if (!ground) return pass_on(ground);
  CoverageArea made;
  made.arc_m = arc_part * problem.stride_m();
  made.area = region_of(problem.boundary, problem.holes);
  const Region standing = shrunk(made.area, problem.radius_m(), made.arc_m);
  if (standing.empty()) {
    return bad_input(
        fmt::format("a robot {:g} m wide fits nowhere in the area; the widest that does has {:.3g} m",
                    problem.width_m, widest_m(made.area)),
        "width");
  }
  auto part = part_of(problem, *ground, standing);
  if (!part) return pass_on(part);
  made.standing = *part;
  made.reach = common(grown(made.standing, problem.radius_m(), made.arc_m), made.area);
  made.ground = std::make_shared<const PolygonGround>(std::move(*ground));
  return made;
}

}  // namespace outrider
