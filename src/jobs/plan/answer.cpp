#include "outrider/jobs/plan/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "outrider/core/units.hpp"
#include "outrider/io/files/index_file.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/pieces.hpp"
#include "outrider/path/safety.hpp"
#include "outrider/path/timing.hpp"

namespace outrider {
namespace {

/// Among what the path is promised to be shortest.
std::string_view name_of(const Guarantee& guarantee) {
  if (std::isinf(guarantee.most_ratio)) return "none";
  if (guarantee.most_ratio != 1.0) return "bounded";
  switch (guarantee.among) {
    case PathClass::along_moves: return "grid_optimal";
    case PathClass::any_direction: return "any_angle_optimal";
    case PathClass::any_curve: return "disk_optimal";
    case PathClass::widest_curve: return "widest_optimal";
    case PathClass::turning_curve: return "none";
    case PathClass::lattice_curve: return "lattice_optimal";
  }
  return "none";
}

Problem problem_of(const PathPlanner& planner, const PlanGround& ground, const PlanQuery& query) {
  Problem problem{nullptr, ground.to_grid(query.from), ground.to_grid(query.to)};
  if (query.from_heading_rad) problem.start_heading_rad = *query.from_heading_rad - ground.yaw_rad;
  if (query.to_heading_rad) problem.goal_heading_rad = *query.to_heading_rad - ground.yaw_rad;
  const bool on_polygons = planner.polygons && ground.polygons;
  if (on_polygons) problem.polygons = ground.polygons;
  if (!on_polygons) problem.grid = ground.grid;
  if (planner.weighs) problem.costs = ground.costs;
  problem.outline = ground.outline;
  return problem;
}

/// The least distance of the middle of the robot, or of its outline, to what stands on the ground, whatever
/// it is planned on.
double clearance_of(const PlanGround& ground, const Plan& plan) {
  if (ground.shapes) return clearance_m(plan, *ground.shapes, ground.outline);
  return clearance_m(plan, *ground.standing, ground.outline, std::numeric_limits<double>::infinity());
}

/// Returns how safe the plan is on the ground that is known best. Throws std::logic_error if the plan is
/// invalid. After a stop request the result is meaningless.
Safety judge(const PathPlanner& planner, const PlanGround& ground, const PlanQuery& query, const Plan& plan,
             const std::stop_token& stop) {
  const Problem problem = problem_of(planner, ground, query);
  auto verdict = check(plan, problem, stop);
  if (verdict && ground.shapes) verdict = check(plan, *ground.shapes, ground.radius_m, ground.outline);
  Problem exact = problem;
  if (ground.polygons) exact = {nullptr, problem.start, problem.goal, ground.polygons};
  Safety safety = safety_of(plan, exact, stop);
  if (stop.stop_requested()) return safety;
  if (!ground.polygons) safety.clearance_m = clearance_of(ground, plan);
  if (verdict && ground.polygons && !(safety.clearance_m >= ground.radius_m - 2.0 * contact_m)) {
    verdict = bad_input("the disk touches an edge");
  }
  if (!verdict) {
    throw std::logic_error(fmt::format("{} from {},{} to {},{}: {}", planner.name, query.from.x, query.from.y,
                                       query.to.x, query.to.y, to_string(verdict.error())));
  }
  return safety;
}

void fill(PlanRow& row, const PathPlanner& planner, const PlanGround& ground, Plan plan,
          const std::stop_token& stop) {
  const Safety safety = judge(planner, ground, row.query, plan, stop);
  row.cost = plan.cost;
  row.length_m = length_of(plan);
  row.lower_bound = plan.lower_bound;
  const Guarantee& guarantee = planner.guarantee_on(ground.polygons != nullptr);
  row.optimal = guarantee.most_ratio == 1.0 && plan.cost <= plan.lower_bound * (1.0 + 1e-9) + 1e-12;
  row.clearance_m = safety.clearance_m;
  row.exposure = safety.exposure;
  row.reached_within_m = plan.reached_within;
  row.waypoint_error_m = plan.waypoint_error_m;
  row.expansions = static_cast<double>(plan.counters.expansions);
  row.line_of_sight_checks = static_cast<double>(plan.counters.line_of_sight_checks);
  for (const Vec2 p : plan.waypoints) row.waypoints.push_back(ground.to_world(p));
  row.pieces = plan.pieces;
  row.plan = std::move(plan);
}

/// On polygons a start or a goal that they do not allow is refused in their words, with the distance, also
/// to a planner on the grid.
PlanRow row_of(const PathPlanner& planner, const PlanGround& ground, const PlanQuery& query,
               Outcome<Plan> plan, const std::stop_token& stop) {
  PlanRow row{std::string(planner.name), query};
  const Guarantee& guarantee = planner.guarantee_on(ground.polygons != nullptr);
  row.cost_unit = unit_of(guarantee.measure);
  row.guarantee = name_of(guarantee);
  if (ground.polygons) {
    auto stands = polygon_query({nullptr, query.from, query.to, ground.polygons});
    if (!stands) plan = pass_on(stands);
  }
  if (plan) {
    fill(row, planner, ground, std::move(*plan), stop);
    return row;
  }
  row.status = to_string(plan.error().code);
  row.reason = plan.error().sentence;
  row.fault = std::move(plan.error());
  return row;
}

/// One planner and its searches on a ground.
struct Asked {
  const ChosenPlanner& planner;
  const PlanQuestion& question;
  const Budget& budget;
  Workspace& workspace;

  /// All these queries from one start, in one search where the planner has one; each has its share of the
  /// time.
  void ask(const std::vector<PlanQuery>& queries, std::vector<PlanRow>& rows) const {
    const PlanGround& ground = *question.ground;
    const Problem problem = problem_of(planner.first, ground, queries.front());
    std::vector<Vec2> goals;
    for (const PlanQuery& query : queries) goals.push_back(ground.to_grid(query.to));
    const double begin_s = wall_s();
    auto plans = goals.size() == 1
                     ? std::vector<Outcome<Plan>>{planner.second.plan(problem, budget, workspace)}
                     : plan_each(planner.second, problem, goals, budget, workspace);
    const double share_s = (wall_s() - begin_s) / static_cast<double>(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      rows.push_back(row_of(planner.first, ground, queries[i], std::move(plans[i]), budget.stop));
      rows.back().time_s = share_s;
      if (rows.back().found()) rows.back().drive_s = drive_s(*rows.back().plan);
    }
  }
  [[nodiscard]] double drive_s(const Plan& plan) const {
    const auto drive = fastest_drive(plan, question.drive);
    return drive ? drive->time_s : PlanRow::unknown;
  }
  [[nodiscard]] std::vector<PlanRow> ask_all() const {
    const auto& queries = question.queries;
    std::vector<PlanRow> rows;
    const bool one_start = std::all_of(queries.begin(), queries.end(), [&](const PlanQuery& query) {
      return query.from == queries.front().from;
    });
    if (one_start && !queries.empty()) {
      ask(queries, rows);
    } else {
      for (const PlanQuery& query : queries) ask({query}, rows);
    }
    return rows;
  }
  /// Returns the time in s by which the first search on the ground takes longer than the same search again.
  [[nodiscard]] double building_s() const {
    if (!planner.first.index || question.queries.empty()) return 0.0;
    const Problem problem = problem_of(planner.first, *question.ground, question.queries.front());
    const auto time_s = [&] {
      const double begin_s = wall_s();
      [[maybe_unused]] const auto plan = planner.second.plan(problem, budget, workspace);
      return wall_s() - begin_s;
    };
    const double first_s = time_s();
    return std::max(0.0, first_s - time_s());
  }
};

Outcome<std::vector<PlanRow>> rows_of(const ChosenPlanner& planner, const PlanQuestion& question,
                                      const PlanTools& tools, const Budget& budget) {
  Workspace fresh;
  Workspace& workspace = tools.workspace != nullptr ? *tools.workspace : fresh;
  const bool keeps = !tools.index_file.empty();
  const IndexedGround indexed{question.ground->grid, planner.first.weighs ? question.ground->costs : nullptr};
  Outcome<bool> loaded = false;
  if (keeps) {
    loaded = load_index_file(tools.index_file, planner.second, indexed, workspace);
    if (!loaded) return pass_on(loaded);
  }
  const Asked asked{planner, question, budget, workspace};
  const double build_s = tools.workspace != nullptr ? 0.0 : asked.building_s();
  workspace.trace = tools.trace;
  std::vector<PlanRow> rows = asked.ask_all();
  workspace.trace = nullptr;
  for (PlanRow& row : rows) row.build_s = build_s;
  if (!keeps || *loaded) return rows;
  auto saved = save_index_file(tools.index_file, planner.second, indexed, budget, workspace);
  if (!saved) return pass_on(saved);
  return rows;
}

}  // namespace

Outcome<PlanAnswer> answer(const PlanQuestion& question, const PlanTools& tools, const Budget& budget) {
  if (auto ok = check(question.drive); !ok) return pass_on(ok);
  std::vector<PlanRow> rows;
  for (const ChosenPlanner& planner : question.planners) {
    if (tools.before) {
      if (auto ok = tools.before(planner.first.name); !ok) return pass_on(ok);
    }
    auto found = rows_of(planner, question, tools, budget);
    if (!found) return pass_on(found);
    for (PlanRow& row : *found) {
      if (row.fault && row.fault->code == FaultCode::cancelled) return tl::unexpected<Fault>(*row.fault);
      rows.push_back(std::move(row));
    }
  }
  if (budget.stop.stop_requested()) return BudgetMeter(budget).refusal();
  PlanAnswer by_query;
  const std::size_t queries = question.queries.size();
  for (std::size_t q = 0; q < queries; ++q) {
    for (std::size_t i = q; i < rows.size(); i += queries) by_query.rows.push_back(std::move(rows[i]));
  }
  return by_query;
}

Status check_query(const PlanGround& ground, const PlanQuery& query) {
  const auto stands = [&](Vec2 start, Vec2 goal) -> Status {
    const Problem problem{ground.grid, ground.to_grid(start), ground.to_grid(goal), ground.polygons};
    if (ground.polygons) {
      auto found = polygon_query(problem);
      return found ? Status{} : Status(pass_on(found));
    }
    auto found = grid_query(problem);
    return found ? Status{} : Status(pass_on(found));
  };
  auto ok = stands(query.from, query.to);
  if (ok) return ok;
  const bool bad_start = !stands(query.from, query.from);
  const Vec2 end = bad_start ? query.from : query.to;
  ok.error().where = fmt::format("{} {},{}", bad_start ? "from" : "to", end.x, end.y);
  if (ground.yaw_rad != 0.0) {
    ok.error().where += fmt::format(" in the map turned by {:.4g} degrees", degrees(ground.yaw_rad));
  }
  return ok;
}

Table table_of(const PlanAnswer& answer) {
  Table table{"rows",
              {"planner",
               "query",
               "from",
               "to",
               "status",
               "reason",
               "cost",
               "cost_unit",
               "length_m",
               "drive_s",
               "lower_bound",
               "optimal",
               "guarantee",
               "clearance_m",
               "exposure",
               "reached_within_m",
               "waypoint_error_m",
               "expansions",
               "line_of_sight_checks",
               "time_s",
               "build_s",
               "waypoints",
               "pieces"},
              {},
              {"time_s", "build_s"}};
  for (const PlanRow& row : answer.rows) {
    std::vector<TableArc> pieces;
    for (const PathPiece& p : row.pieces) pieces.push_back({p.from, p.to, p.centre, p.turn_rad});
    const double number = row.query.number ? static_cast<double>(*row.query.number) : PlanRow::unknown;
    const double optimal = row.optimal ? 1.0 : 0.0;
    table.rows.push_back({row.planner,
                          number,
                          row.query.from,
                          row.query.to,
                          row.status,
                          row.reason,
                          row.cost,
                          row.cost_unit,
                          row.length_m,
                          row.drive_s,
                          row.lower_bound,
                          optimal,
                          row.guarantee,
                          row.clearance_m,
                          row.exposure,
                          row.reached_within_m,
                          row.waypoint_error_m,
                          row.expansions,
                          row.line_of_sight_checks,
                          row.time_s,
                          row.build_s,
                          row.waypoints,
                          std::move(pieces)});
  }
  return table;
}

}  // namespace outrider
