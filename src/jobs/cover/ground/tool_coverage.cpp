#include "ground/tool_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "ground/bar_sweep.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double pose_step_rad = radians(2.0);
constexpr double outside_m = 1e-5;  // more than the rounding of regions
constexpr std::size_t batch = 24;   // sweeps that are judged at once

/// Returns what both cover; what both cover counts as overlap.
Coverage together(Coverage a, const Coverage& b, const Region& area) {
  a.overlap = united({a.overlap, b.overlap, common(a.covered, b.covered)});
  a.covered = united(a.covered, b.covered);
  a.missed = without(area, a.covered);
  a.covered_m2 = area_of(a.covered);
  a.missed_m2 = area_of(a.missed);
  a.overlap_m2 = area_of(a.overlap);
  const double all_m2 = area_of(area);
  a.fraction = all_m2 > 0.0 ? a.covered_m2 / all_m2 : 1.0;
  return a;
}

/// Returns what a drive without a carriage covered between two times.
Coverage coverage_between(const PieceDrive& drive, double from_s, double until_s, const CoverProblem& problem,
                          const Region& area, const std::stop_token& stop) {
  const auto within = [&](double time_s) { return time_s >= from_s && time_s <= until_s; };
  if (const auto bar = problem.bar()) {
    std::vector<Pose2> poses;
    for (const TimedPose& sample : drive.track) {
      if (within(sample.time_s)) add_pose(poses, sample.pose);
    }
    return coverage_of(poses, *bar, area, stop);
  }
  std::vector<Vec2> way;
  for (std::size_t i = 0; i < drive.way.size(); ++i) {
    if (within(drive.times_s[i])) way.push_back(drive.way[i]);
  }
  return coverage_of(way, problem.body_radius_m(), area, stop);
}

}  // namespace

std::vector<Pose2> poses_along(const Pose2& start, const std::vector<PathPiece>& pieces) {
  std::vector<Pose2> poses{start};
  for (const PathPiece& piece : pieces) {
    double heading = poses.back().heading_rad;
    const double turn = turn_in_place(heading, heading_in(piece));
    heading += turn;
    if (std::abs(turn) > no_turn_rad) poses.push_back({piece.from, heading});
    const std::vector<Vec2> points = points_along(piece.from, {piece}, pose_step_rad);
    const double steps = static_cast<double>(points.size() - 1);
    for (std::size_t i = 1; i < points.size(); ++i)
      poses.push_back({points[i], heading + piece.turn_rad * static_cast<double>(i) / steps});
  }
  return poses;
}

void add_pose(std::vector<Pose2>& poses, Pose2 next) {
  if (!poses.empty())
    next.heading_rad = poses.back().heading_rad + wrap_angle(next.heading_rad - poses.back().heading_rad);
  poses.push_back(next);
}

Coverage coverage_along(const Pose2& start, const std::vector<PathPiece>& pieces, const CoverProblem& problem,
                        const Region& area, bool surely, const std::stop_token& stop) {
  if (const auto bar = problem.bar()) return coverage_of(poses_along(start, pieces), *bar, area, stop);
  const std::vector<Vec2> points = points_along(start.position, pieces, pose_step_rad);
  return coverage_of(points, surely ? problem.sure_radius_m() : problem.body_radius_m(), area, stop);
}

Coverage coverage_of_drive(const PieceDrive& drive, const CoverProblem& problem, const Region& area,
                           const std::stop_token& stop) {
  constexpr double ever_s = std::numeric_limits<double>::infinity();
  double from_s = -ever_s;
  std::optional<Coverage> all;
  const auto add = [&](double until_s) {
    Coverage part = coverage_between(drive, from_s, until_s, problem, area, stop);
    all = all ? together(std::move(*all), part, area) : std::move(part);
  };
  for (const Carried& carried : drive.carried) {
    add(carried.from_s);
    from_s = carried.until_s;
  }
  add(ever_s);
  return std::move(all).value_or(Coverage{});
}

Region outside_of(const std::vector<Pose2>& poses, const Bar& bar, const Region& area,
                  const std::stop_token& stop) {
  const std::vector<Pose2> all = with_small_turns(poses);
  const Region allowed = grown(area, outside_m, 0.1 * outside_m);
  std::vector<Region> parts, sweeps;
  for (std::size_t i = 0; i < all.size() && !stop.stop_requested(); ++i) {
    sweeps.push_back(bar_sweep(all[i > 0 ? i - 1 : 0], all[i], bar, Approximation::around));
    if (sweeps.size() < batch && i + 1 < all.size()) continue;
    Region part = without(united(sweeps), allowed);
    if (!part.empty()) parts.push_back(std::move(part));
    sweeps.clear();
  }
  return united(parts);
}

}  // namespace outrider::cover
