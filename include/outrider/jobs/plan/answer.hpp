// What path planners answer: the one form of it for the tool, scenarios and the server. As JSON it is
// run_json() of plan_report() and table_of().
//
// Every plan is judged before anybody sees it: by check(), by the exact shapes of a world where there are
// some, and on polygons by exact distances, also the plans on their grid. A plan that the judge refuses is a
// bug, and throws std::logic_error.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/job/table.hpp"
#include "outrider/jobs/plan/ground.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

struct PlanQuery {
  std::optional<std::size_t> number;  ///< in the file, or among several goals, from 1
  Vec2 from;                          ///< in the world, m
  Vec2 to;
};

struct PlanQuestion {
  std::shared_ptr<const PlanGround> ground;  ///< may be shared by many questions
  std::vector<ChosenPlanner> planners;
  std::vector<PlanQuery> queries;
};

/// What one planner answers to one query. Numbers that are not known are NaN: all of a path that was not
/// found.
struct PlanRow {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string planner;
  PlanQuery query;
  std::string status = "done";  ///< or the code of the fault
  std::string reason = {};      ///< the sentence of the fault
  double cost = unknown;        ///< in cost_unit
  std::string cost_unit = {};
  double length_m = unknown;
  double lower_bound = unknown;       ///< proven: no path of the planner's class costs less
  bool optimal = false;               ///< proven
  std::string guarantee = {};         ///< none, bounded, grid_optimal, any_angle_optimal or disk_optimal
  double clearance_m = unknown;       ///< the least, as safety_of() has it
  double exposure = unknown;          ///< the integral of 1 / clearance; infinite where the path touches
  double reached_within_m = unknown;  ///< from the end of the path to the goal
  double waypoint_error_m = unknown;  ///< of the legs between waypoints from the pieces
  double expansions = unknown;
  double line_of_sight_checks = unknown;
  double time_s = 0.0;                 ///< that the search took; the share of one for many goals
  double build_s = 0.0;                ///< that an index took that was built beforehand
  std::vector<Vec2> waypoints = {};    ///< in the world
  std::vector<PathPiece> pieces = {};  ///< the path itself on polygons, with its arcs
  std::optional<Fault> fault = {};     ///< why there is no path
  std::optional<Plan> plan = {};       ///< in the frame of the ground

  [[nodiscard]] bool found() const { return plan.has_value(); }
};

struct PlanAnswer {
  std::vector<PlanRow> rows;  ///< of the first query by each planner, then of the next query
};

/// What an answer may use.
struct PlanTools {
  Trace* trace = nullptr;          ///< filled by the searches
  Workspace* workspace = nullptr;  ///< what earlier answers left; without one each planner begins afresh,
                                   ///< and the time of building an index is measured
  std::function<Status(std::string_view planner)> before = {};  ///< asked before each planner
};

/// A row for each planner and query; a query that is refused or has no path says so in its row. Fault:
/// cancelled, and those of PlanTools::before. The budget holds for each search.
Outcome<PlanAnswer> answer(const PlanQuestion& question, const PlanTools& tools = {},
                           const Budget& budget = {});

/// Refuses a query from or to where the robot cannot stand. Faults: outside_map, start_blocked,
/// goal_blocked, which name the end and the point, as in "from 1,2".
Status check_query(const PlanGround& ground, const PlanQuery& query);

/// The verdict: status, reason and metrics, those of the shortest path that was found.
Report plan_report(const PlanQuestion& question, const PlanAnswer& answer);

/// The table "rows": a column for each member of PlanRow down to the pieces, the same in words and units.
Table table_of(const PlanAnswer& answer);

}  // namespace outrider
