#include "steering_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/motion/footprint.hpp"
#include "steering/motions/outline_sweep.hpp"

namespace outrider {
namespace {

constexpr double most_radius = 1e6;  // cells

Status check_ground(const Problem& problem, std::string_view planner) {
  if (!problem.grid || problem.grid->model == GridModel::cells) return {};
  return bad_input(fmt::format("{} takes a grid of cells, not of {}; take the model cells", planner,
                               to_string(problem.grid->model)),
                   "model");
}

/// Returns true if the robot touches no blocked cell at the pose; without a heading, if its origin touches
/// none, and there may be a heading in which nothing does.
bool stands(SteeringQuery query, Vec2 p, std::optional<double> heading_rad) {
  if (!heading_rad) {
    if (query.room->is_blocked(p)) return false;
    query.outline = {Vec2{}};
  }
  return clear_of_cells(query, {p, p, {}, 0.0}, heading_rad.value_or(0.0));
}

Status check_end(const SteeringQuery& query, Vec2 p, std::optional<double> heading_rad, const char* name,
                 FaultCode code) {
  if (stands(query, p, heading_rad)) return {};
  return fault(code,
               fmt::format("the robot at the {} touches a blocked cell; move it away from there, or take a "
                           "finer grid",
                           name));
}

}  // namespace

Outcome<SteeringQuery> steering_query(const Problem& problem, const SteeringOptions& options,
                                      std::string_view planner, OutlineRoom& room,
                                      const std::stop_token& stop) {
  if (auto ok = check_ground(problem, planner); !ok) return pass_on(ok);
  auto vertices = grid_query(problem);
  if (!vertices) return pass_on(vertices);
  if (auto ok = check(options); !ok) return pass_on(ok);
  for (const auto heading : {problem.start_heading_rad, problem.goal_heading_rad}) {
    if (heading && !(std::abs(*heading) <= 1e6)) return bad_input("a heading is no angle; give a finite one");
  }
  const GridFrame& frame = problem.grid->frame;
  const double per_m = 1.0 / frame.resolution_m;
  SteeringQuery query{problem.grid.get(),
                      per_m * (problem.start - frame.origin),
                      per_m * (problem.goal - frame.origin),
                      problem.start_heading_rad,
                      problem.goal_heading_rad,
                      per_m * options.turning_radius_m,
                      options.reverse,
                      per_m * options.cusp_price_m,
                      options.backward_price,
                      {},
                      &room};
  if (!(query.radius <= most_radius && query.radius >= 1.0 / most_radius)) {
    return bad_input(fmt::format("{} m is not valid on cells of {} m; expected 1e-6 to 1e6 cells",
                                 short_number(options.turning_radius_m), short_number(frame.resolution_m)),
                     "turning_radius");
  }
  if (!problem.outline.empty()) {
    if (auto ok = check_footprint({problem.outline, 0.0}); !ok) return pass_on(ok);
  }
  for (const Vec2 corner : problem.outline) query.outline.push_back(per_m * corner);
  if (query.outline.empty()) query.outline = {Vec2{}};
  if (auto ok = room.begin(*query.ground, query.outline, stop); !ok) return pass_on(ok);
  if (auto ok = check_end(query, query.start, query.start_heading_rad, "start", FaultCode::start_blocked);
      !ok)
    return pass_on(ok);
  if (auto ok = check_end(query, query.goal, query.goal_heading_rad, "goal", FaultCode::goal_blocked); !ok)
    return pass_on(ok);
  return query;
}

bool clear_of_cells(const SteeringQuery& query, const PathPiece& piece, double heading_rad) {
  if (query.outline.size() == 1) return clear_of_cells(*query.ground, piece);
  if (query.room->is_wide(piece.from, length_of(piece))) return true;
  if (!clear_of_cells(query.room->narrowed(), piece)) return false;
  std::vector<MonotonePart> border;
  return for_each_section({query.outline, piece, heading_rad}, [&](const OutlineSweep& section) {
    border.clear();
    add_border_parts(section, border);
    return clear_of_cells(*query.ground, section, border, {});
  });
}

}  // namespace outrider
