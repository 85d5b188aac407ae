#include "steering_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../outline_way.hpp"
#include "../visibility/polygon_ground_check.hpp"
#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double slack_rad = 1e-6;

tl::unexpected<Fault> refused(std::string sentence) { return bad_input(std::move(sentence), "plan"); }

double slack_m(const Problem& problem) { return 1e-6 * problem.grid->frame.resolution_m; }

/// Returns how much the heading of a piece may be off, as its ends are rounded.
double rounding_rad(const PathPiece& piece) {
  return slack_rad + 1e-14 * (1.0 + norm(piece.from) + norm(piece.centre)) / length_of(piece);
}

bool agree(double heading_rad, double other_rad, double slack) {
  return std::abs(wrap_angle(heading_rad - other_rad)) <= slack;
}

/// Checks that the robot can drive the piece.
Status check_piece(const PathPiece& piece, const Steering& steering, double slack, std::size_t i) {
  if (piece.backward && !steering.reverse) return refused(fmt::format("piece {} is driven backwards", i));
  if (piece.turn_rad == 0.0) return {};
  const double radius = distance(piece.centre, piece.from);
  const Vec2 end = piece.centre + rotated(piece.turn_rad, piece.from - piece.centre);
  const bool arc = std::abs(piece.turn_rad) < 2.0 * pi && distance(end, piece.to) <= slack;
  if (!arc) return refused(fmt::format("piece {} is no arc from its begin to its end", i));
  if (radius >= steering.turning_radius_m - slack) return {};
  return refused(fmt::format("piece {} has a radius of {} m, below the {} m of the robot", i,
                             short_number(radius), short_number(steering.turning_radius_m)));
}

/// Returns true if the path may begin or end at p instead of at the given point.
bool stands_for(Vec2 p, Vec2 given, const Plan& plan, const Problem& problem) {
  if (!plan.steering->snap_rad) return distance(p, given) <= slack_m(problem);
  const double most = 0.5 * problem.grid->frame.resolution_m + slack_m(problem);
  return std::abs(p.x - given.x) <= most && std::abs(p.y - given.y) <= most;
}

Status check_ends(const Plan& plan, const Problem& problem) {
  const PathPiece &first = plan.pieces.front(), &last = plan.pieces.back();
  const double snap = plan.steering->snap_rad.value_or(0.0);
  if (!stands_for(first.from, problem.start, plan, problem)) return refused("it does not begin at the start");
  if (!stands_for(last.to, problem.goal, plan, problem)) return refused("it does not end at the goal");
  if (problem.start_heading_rad &&
      !agree(*problem.start_heading_rad, heading_in(first), snap + rounding_rad(first))) {
    return refused("it does not begin with the heading of the start");
  }
  if (problem.goal_heading_rad &&
      !agree(*problem.goal_heading_rad, heading_out(last), snap + rounding_rad(last))) {
    return refused("it does not end with the heading of the goal");
  }
  return {};
}

Status check_chain(const Plan& plan, const Problem& problem) {
  const double slack = slack_m(problem);
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    const PathPiece& piece = plan.pieces[i];
    if (auto ok = check_piece(piece, *plan.steering, slack, i); !ok) return ok;
    if (i == 0) continue;
    const PathPiece& before = plan.pieces[i - 1];
    if (!(distance(before.to, piece.from) <= slack))
      return refused(fmt::format("piece {} begins elsewhere", i));
    if (!agree(heading_out(before), heading_in(piece), rounding_rad(piece) + rounding_rad(before))) {
      return refused(fmt::format("the robot would turn in place before piece {}", i));
    }
  }
  return check_ends(plan, problem);
}

/// Returns a blocked cell that the robot touches.
std::optional<Cell> touched(const OutlineWay& way, const GridMap& ground) {
  const Box2& box = way.bounds();
  for (int y = static_cast<int>(std::floor(box.low.y)) - 1; y <= box.high.y + 1.0; ++y) {
    for (int x = static_cast<int>(std::floor(box.low.x)) - 1; x <= box.high.x + 1.0; ++x) {
      const Cell cell{x, y};
      if (ground.blocked(cell) && way.may_come_to(cell, 0.0) && !(way.gap(cell) > 0.0)) return cell;
    }
  }
  return {};
}

Status check_room(const Plan& plan, const Problem& problem) {
  const GridMap& ground = *problem.grid;
  for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
    const PathPiece& piece = plan.pieces[i];
    if (const auto cell = touched({piece, heading_in(piece), problem.outline, ground.frame}, ground))
      return refused(fmt::format("the robot touches the cell ({}, {}) on piece {}", cell->x, cell->y, i));
  }
  return {};
}

/// Checks a path without pieces: the robot stays where it is. Of a lattice its heading is not known.
Status check_stay(const Plan& plan, const Problem& problem, bool is_snapped) {
  const Vec2 p = plan.waypoints.front();
  if (plan.waypoints.size() > 1) return refused("it has no pieces");
  if (!stands_for(p, problem.start, plan, problem) || !stands_for(p, problem.goal, plan, problem))
    return refused("it has no pieces");
  if (!problem.start_heading_rad || is_snapped) return {};
  const OutlineWay way({p, p, {}, 0.0}, *problem.start_heading_rad, problem.outline, problem.grid->frame);
  if (const auto cell = touched(way, *problem.grid))
    return refused(fmt::format("the robot touches the cell ({}, {})", cell->x, cell->y));
  return {};
}

Status check_waypoints(const Plan& plan, const Problem& problem) {
  const double error = plan.waypoint_error_m + slack_m(problem);
  const auto near = [&](Vec2 p) {
    return std::ranges::any_of(plan.pieces,
                               [&](const PathPiece& piece) { return distance_to(piece, p) <= error; });
  };
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    const Vec2 before = plan.waypoints[i == 0 ? 0 : i - 1];
    if (near(plan.waypoints[i]) && near(0.5 * (before + plan.waypoints[i]))) continue;
    return refused(fmt::format("the leg to waypoint {} strays by more than {} m", i,
                               short_number(plan.waypoint_error_m)));
  }
  if (distance(plan.waypoints.front(), plan.pieces.front().from) <= error) return {};
  return refused("its waypoints do not begin at the start");
}

}  // namespace

Status check_steering(const Plan& plan, const Problem& problem) {
  if (!plan.vertices.empty()) return refused("it has vertices, though the robot steers");
  if (!(plan.steering->turning_radius_m > 0.0)) return refused("it has no turning radius");
  if (plan.waypoints.empty()) return refused("it has no waypoints");
  if (plan.pieces.empty()) return check_stay(plan, problem, plan.steering && plan.steering->snap_rad);
  if (auto ok = check_chain(plan, problem); !ok) return ok;
  if (auto ok = check_room(plan, problem); !ok) return ok;
  return check_waypoints(plan, problem);
}

}  // namespace outrider
