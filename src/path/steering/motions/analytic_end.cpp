#include "analytic_end.hpp"

#include <algorithm>
#include <cmath>

#include "turning_pieces.hpp"

namespace outrider {
namespace {

constexpr double least_gain = 1e-6;  // relative

/// Adds the arcs to one side whose tangent leads to the goal, which lies at `to_goal` as the robot sees it,
/// in radii. `side` is 1 to the left.
void add_tangents(Vec2 to_goal, int side, bool reverse, std::vector<TurningPath>& paths) {
  const Vec2 from_centre = Vec2{to_goal.x, side * to_goal.y} - Vec2{0.0, 1.0};
  const double beyond = squared_norm(from_centre) - 1.0;
  if (beyond < 0.0) return;
  const double straight = std::sqrt(beyond);
  for (const double ahead : {1.0, -1.0}) {
    if (ahead < 0.0 && !reverse) continue;
    const double turn =
        std::remainder(heading_of(from_centre) - std::atan2(-1.0, ahead * straight), 2.0 * pi);
    for (const double arc : {turn < 0.0 ? turn + 2.0 * pi : turn, turn < 0.0 ? turn : turn - 2.0 * pi}) {
      if (arc < 0.0 && !reverse) continue;
      TurningPath path;
      if (std::abs(arc) > no_length && std::abs(arc) < 2.0 * pi - no_length) path.add({side, arc});
      if (straight > no_length) path.add({0, ahead * straight});
      paths.push_back(path);
    }
  }
}

std::vector<TurningPath> paths_to(const SteeringQuery& query, const Pose2& pose, const AnalyticGoal& goal) {
  if (goal.heading_rad) {
    const Pose2 to{goal.position, *goal.heading_rad};
    return query.reverse ? reeds_shepp_paths(pose, to, query.radius) : dubins_paths(pose, to, query.radius);
  }
  std::vector<TurningPath> paths;
  const Vec2 to_goal = (1.0 / query.radius) * pose.to_local(goal.position);
  for (const int side : {1, -1}) add_tangents(to_goal, side, query.reverse, paths);
  for (TurningPath& path : paths) {
    path.length_m *= query.radius;
    for (TurningPiece& piece : path.pieces) piece.length_m *= query.radius;
  }
  return paths;
}

bool touches_nothing(const SteeringQuery& query, Pose2 pose, const TurningPath& path) {
  for (std::size_t i = 0; i < path.count; ++i) {
    if (!clear_of_cells(query, piece_of(pose, path.pieces[i], query.radius), pose.heading_rad)) return false;
    pose = after(pose, path.pieces[i], query.radius);
  }
  return true;
}

}  // namespace

double cost_of(const SteeringQuery& query, std::span<const TurningPiece> pieces, int direction) {
  double cost = 0.0;
  for (const TurningPiece& piece : pieces) {
    const int now = piece.length_m < 0.0 ? -1 : 1;
    cost += query.price_of(piece.length_m) + (direction == -now ? query.cusp : 0.0);
    direction = now;
  }
  return cost;
}

std::optional<AnalyticEnd> analytic_end(const SteeringQuery& query, const Pose2& pose, int direction,
                                        const AnalyticGoal& goal, double most) {
  std::vector<AnalyticEnd> ends;
  for (const TurningPath& path : paths_to(query, pose, goal)) {
    const double cost = cost_of(query, {path.pieces.data(), path.count}, direction);
    if (cost < most) ends.push_back({path, cost});
  }
  std::ranges::stable_sort(ends, {}, &AnalyticEnd::cost);
  for (const AnalyticEnd& end : ends) {
    if (touches_nothing(query, pose, end.path)) return end;
  }
  return std::nullopt;
}

std::vector<TurningPiece> shortened(const SteeringQuery& query, double heading_rad,
                                    const std::vector<TurningPiece>& motions) {
  std::vector<Pose2> poses{{query.start, heading_rad}};
  for (const TurningPiece& motion : motions) poses.push_back(after(poses.back(), motion, query.radius));
  std::vector<TurningPiece> shorter;
  int direction = 0;
  for (std::size_t i = 0; i < motions.size();) {
    std::optional<AnalyticEnd> way;
    std::size_t span = motions.size() - i;
    for (; span > 1 && !way; span = way ? span : span * 3 / 4) {
      const std::span<const TurningPiece> old = std::span(motions).subspan(i, span);
      const std::span<const TurningPiece> next =
          std::span(motions).subspan(i + span).first(i + span < motions.size());
      const auto cost = [&](std::span<const TurningPiece> pieces) {
        std::vector<TurningPiece> all(pieces.begin(), pieces.end());
        all.insert(all.end(), next.begin(), next.end());
        return cost_of(query, all, direction);
      };
      const Pose2& to = poses[i + span];
      const double now = cost(old);
      way = analytic_end(query, poses[i], direction, {to.position, to.heading_rad}, now);
      if (way && !(cost({way->path.pieces.data(), way->path.count}) < (1.0 - least_gain) * now)) way.reset();
      if (way) break;
    }
    if (way) {
      shorter.insert(shorter.end(), way->path.pieces.begin(),
                     way->path.pieces.begin() + static_cast<std::ptrdiff_t>(way->path.count));
      i += span;
    } else {
      shorter.push_back(motions[i++]);
    }
    if (!shorter.empty()) direction = shorter.back().length_m < 0.0 ? -1 : 1;
  }
  return joined(shorter, query.radius);
}

}  // namespace outrider
