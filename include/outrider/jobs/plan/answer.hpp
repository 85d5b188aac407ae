// PlanAnswer: the results of path planners, in the same form for the tool, scenarios and the server. Their
// JSON form is run_json() of plan_report() and table_of().
//
// Every plan is verified before it is returned: by check(), by the exact shapes of a world if there are any,
// and on polygons by exact distances, including plans on a grid made from polygons. A plan that fails is a
// bug and throws std::logic_error.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/plan/ground.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/motion/fastest_drive.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// A start and a goal.
struct PlanQuery {
  std::optional<std::size_t> number;  ///< number of the query in the file, or of the goal, from 1
  Vec2 from;                          ///< start, world frame, m
  Vec2 to;                            ///< goal, world frame, m
  /// Headings there, world frame, for planners of robots that steer; unset: any.
  std::optional<double> from_heading_rad = std::nullopt;
  std::optional<double> to_heading_rad = std::nullopt;
};

/// Queries for a set of planners on one ground.
struct PlanQuestion {
  std::shared_ptr<const PlanGround> ground;  ///< may be shared by many questions
  std::vector<ChosenPlanner> planners;
  std::vector<PlanQuery> queries;
  DriveLimits drive = {};  ///< limits of the robot, for PlanRow::drive_s
};

/// The result of one planner for one query. Unknown numbers are NaN; without a path, all numbers that
/// describe it are unknown.
struct PlanRow {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string planner;
  PlanQuery query;
  std::string status = "done";  ///< or the code of the fault
  std::string reason = {};      ///< message of the fault
  double cost = unknown;        ///< cost of the path, in cost_unit
  std::string cost_unit = {};   ///< "m", "s" or "m eq"
  double length_m = unknown;
  double drive_s = unknown;           ///< least time to drive the path (path/timing.hpp)
  double lower_bound = unknown;       ///< proven: no path of the planner's class costs less
  bool optimal = false;               ///< the path is proven optimal
  std::string guarantee = {};         ///< none, bounded, grid_optimal, any_angle_optimal, disk_optimal,
                                      ///< widest_optimal or lattice_optimal
  double clearance_m = unknown;       ///< least distance of the middle of the robot to what stands there
  double exposure = unknown;          ///< integral of 1 / clearance; infinite if the path touches an obstacle
  double reached_within_m = unknown;  ///< distance from the end of the path to the goal
  double waypoint_error_m = unknown;  ///< largest distance of the legs between waypoints from the pieces
  double expansions = unknown;
  double line_of_sight_checks = unknown;
  double time_s = 0.0;               ///< time of the search; its share if one search serves many goals
  double build_s = 0.0;              ///< time to build an index before the search
  std::vector<Vec2> waypoints = {};  ///< world frame
  std::vector<PathPiece> pieces =
      {};                           ///< on polygons, or of a robot that steers: the exact path with its arcs
  std::optional<Fault> fault = {};  ///< the reason if there is no path
  std::optional<Plan> plan = {};    ///< the plan in the frame of the ground

  [[nodiscard]] bool found() const { return plan.has_value(); }
};

/// The results of all planners for all queries.
struct PlanAnswer {
  std::vector<PlanRow> rows;  ///< query by query; for each query, one row per planner
};

/// Optional tools of answer().
struct PlanTools {
  Trace* trace = nullptr;  ///< receives the trace of the searches
  /// Memory kept from earlier calls. If null, each planner starts without an index, and the time to build it
  /// is measured.
  Workspace* workspace = nullptr;
  /// If not empty, the file in which the planner keeps its index (io/files/index_file.hpp): it is read if it
  /// exists, else written. Only for one planner, which has such an index.
  std::string index_file = {};
  std::function<Status(std::string_view planner)> before =
      {};  ///< called before each planner; a fault ends answer()
};

/// Runs each planner on each query and returns one row for each. If a query is refused or has no path, its
/// row says so. Faults: bad_input for limits of the drive that are out of range, cancelled, and those of
/// PlanTools::before and of the index file. The budget applies to each search separately.
Outcome<PlanAnswer> answer(const PlanQuestion& question, const PlanTools& tools = {},
                           const Budget& budget = {});

/// Checks that the robot can stand at the start and the goal of a query. Faults: outside_map, start_blocked,
/// goal_blocked; their messages name the point, such as "from 1,2".
Status check_query(const PlanGround& ground, const PlanQuery& query);

/// Returns a report with status and reason. Its metrics are those of the shortest path found. Its tables are
/// that of table_of(), and "speed_profile" of the fastest drive along that path: a row for each phase, with
/// the time and the place where it begins, the speed there, the acceleration until the next row and the angle
/// of a turn in place, and one for the end; empty without a path.
Report plan_report(const PlanQuestion& question, const PlanAnswer& answer);

/// Returns the table "rows". It has one column for each member of PlanRow from `planner` to `pieces`.
Table table_of(const PlanAnswer& answer);

}  // namespace outrider
