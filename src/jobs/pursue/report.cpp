#include "outrider/jobs/pursue/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Costs drawn `block` true cells to one, from the lowest row; -1 for walls.
std::vector<double> drawn_costs(const PursuitProblem& problem, int block, int columns, int rows) {
  const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<double> sums(size, 0.0);
  std::vector<int> free(size, 0), walls(size, 0);
  const CostGrid& costs = *problem.costs;
  for (std::size_t i = 0; i < costs.cells.size(); ++i) {
    const Cell cell = costs.frame.cell(i);
    const auto at = static_cast<std::size_t>(cell.y / block) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(cell.x / block);
    const bool wall = costs.cells[i] >= problem.threshold;
    ++(wall ? walls : free)[at];
    if (!wall) sums[at] += costs.cells[i];
  }
  for (std::size_t at = 0; at < size; ++at) sums[at] = walls[at] > free[at] ? -1.0 : sums[at] / free[at];
  return sums;
}

outrider_msgs::CostGrid drawn_map(const PursuitProblem& problem) {
  constexpr int most_cells = 500;
  const GridFrame& frame = problem.costs->frame;
  const int block = (std::max(frame.width, frame.height) + most_cells - 1) / most_cells;
  const int columns = (frame.width + block - 1) / block, rows = (frame.height + block - 1) / block;
  return {point_of(frame.bounds().low), block * frame.resolution_m, static_cast<std::uint32_t>(columns),
          static_cast<std::uint32_t>(rows), drawn_costs(problem, block, columns, rows)};
}

std::string not_caught(const PursuitProblem& problem, const PursuitState& state, bool faulty) {
  if (state.time_s >= problem.last_s()) {
    return fmt::format("the target was gone after second {} without being caught", problem.last_s());
  }
  return fmt::format("from second {} on no catch was possible any more{}", state.time_s,
                     faulty ? ", as far as the robots knew" : "");
}

/// Returns true if the robot on duty and the target truly are in one cell.
bool is_caught(const PursuitProblem& problem, const PursuitState& state) {
  const auto now_s = static_cast<std::size_t>(state.time_s);
  return state.caught && now_s > 0 && state.paths[state.duty][now_s] == problem.target[now_s];
}

/// Returns the faults that occurred, as text to append to a reason.
std::string faults_text(const TeamFaultCounts& faults) {
  std::string text;
  const auto add = [&](int count, std::string_view what) {
    if (count > 0) text += fmt::format("; {} {}", count, what);
  };
  add(faults.missing, "sightings of it did not come");
  add(faults.late, "sightings came late");
  add(faults.wrong, "sightings were wrong");
  add(faults.stuck_s, "seconds long a robot did not move when it was sent on");
  add(faults.blocked, "steps led into closed cells");
  if (faults.kidnapped) text += "; a robot was put elsewhere";
  return text;
}

/// Adds the metrics of a pursuit with faults.
void add_metrics(std::vector<std::pair<std::string, double>>& metrics, const PursuitRun& run,
                 const TeamFaultCounts& faults, bool false_catch) {
  const std::vector<std::pair<std::string, double>> more = {
      {"time_s", run.state.time_s},          {"false_catch", false_catch ? 1.0 : 0.0},
      {"missing_sightings", faults.missing}, {"late_sightings", faults.late},
      {"wrong_sightings", faults.wrong},     {"stuck_s", faults.stuck_s},
      {"blocked_steps", faults.blocked},     {"kidnapped", faults.kidnapped ? 1.0 : 0.0},
      {"contacts", faults.into_walls}};
  metrics.insert(metrics.end(), more.begin(), more.end());
}

std::string pose_topic(std::size_t robot) {
  return robot == 0 ? std::string(topic::pose) : fmt::format("/robot_{}/pose", robot + 1);
}

}  // namespace

PursuitLog::PursuitLog(Log& log, const PursuitProblem& problem, const std::string& name,
                       double robot_radius_m)
    : log_(log), problem_(problem), robot_logs_(robot_radius_m > 0.0) {
  const Box2 bounds = problem.costs->frame.bounds();
  outrider_msgs::RunInfo info;
  info.job = "pursue";
  info.world = name;
  info.low = point_of(bounds.low);
  info.high = point_of(bounds.high);
  info.robot_radius = robot_radius_m;
  log.append(topic::run, 0.0, std::move(info));
  log.append(topic::cost_grid, 0.0, drawn_map(problem));
  if (!robot_logs_) log_place(std::string(topic::pose), 0, problem.start);
  log_place(std::string(topic::target_pose), 0, problem.target.front());
  log.append(topic::paid, 0.0, outrider_msgs::PaidCost{0.0});
}

void PursuitLog::log_place(const std::string& topic, int second, Cell cell) {
  const auto time_s = static_cast<double>(second);
  log_.append(topic, time_s, stamped(log_.time_of(time_s), {problem_.costs->frame.centre(cell), 0.0}));
}

void PursuitLog::note(const PursuitRun& run) {
  const PursuitState& state = run.state;
  for (; second_ < state.time_s; ++second_) {
    const auto s = static_cast<std::size_t>(second_);
    paid_ += (*problem_.costs)[state.paths[state.duties[s]][s]];
    for (std::size_t robot = 0; !robot_logs_ && robot < state.paths.size(); ++robot) {
      if (s == 0 && robot > 0) log_place(pose_topic(robot), 0, state.paths[robot][0]);
      log_place(pose_topic(robot), second_ + 1, state.paths[robot][s + 1]);
    }
    log_place(std::string(topic::target_pose), second_ + 1, problem_.target[s + 1]);
    log_.append(topic::paid, static_cast<double>(second_ + 1), outrider_msgs::PaidCost{paid_});
  }
  for (; moments_ < run.moments.size(); ++moments_) {
    const PursuitMoment& moment = run.moments[moments_];
    log_.append(topic::bounds, static_cast<double>(moment.time_s),
                outrider_msgs::CostBound{static_cast<double>(moment.expansions),
                                         moment.cost ? static_cast<double>(*moment.cost) : unknown,
                                         static_cast<double>(moment.lower_bound)});
  }
}

Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const std::string& name) {
  const PursuitState& state = run.state;
  const bool caught = is_caught(problem, state);
  Report report;
  report.world_name = name;
  report.status = caught ? "done" : "not_done";
  if (!caught) {
    report.reason = state.caught ? "the mission took the target for caught, which it was not"
                                 : not_caught(problem, state, run.faults.has_value());
    if (run.faults) report.reason += faults_text(*run.faults);
  }
  const auto cost = static_cast<double>(state.cost), bound = static_cast<double>(run.lower_bound);
  report.metrics = {
      {"caught", caught ? 1.0 : 0.0},
      {"catch_time_s", caught ? state.time_s : unknown},
      {"moves", static_cast<double>(state.moves)},
      {"cost", cost},
      {"lower_bound", bound},
      {"optimal", caught && state.cost == run.lower_bound ? 1.0 : 0.0},
      {"earliest_catch_s", run.earliest_catch_s < 0 ? unknown : run.earliest_catch_s},
      {"robots", static_cast<double>(state.robots.size())},
      {"catcher", caught ? static_cast<double>(state.duty + 1) : unknown},
      {"handovers", static_cast<double>(state.handovers)},
      {"planning_calls", static_cast<double>(run.calls)},
      {"expansions", static_cast<double>(run.expansions)},
  };
  if (run.faults) add_metrics(report.metrics, run, *run.faults, state.caught && !caught);
  return report;
}

Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const NavigatedBody& robot,
                      const std::string& name) {
  Report report = pursuit_report(problem, run, name);
  const TwistBody& wheels = robot.wheels();
  const auto add = [&](const std::string& reason) {
    report.reason += (report.reason.empty() ? "" : "; ") + reason;
    report.status = "not_done";
  };
  if (wheels.contacts() > 0) add("something was touched");
  if (report.status != "done" && robot.belief_error_m() > problem.costs->frame.resolution_m)
    add(fmt::format("the robot took itself to be up to {:.1f} m from where it was", robot.belief_error_m()));
  const bool false_catch = run.state.caught && !is_caught(problem, run.state);
  report.metrics.insert(report.metrics.end(), {{"time_s", run.state.time_s},
                                               {"false_catch", false_catch ? 1.0 : 0.0},
                                               {"blocked_s", wheels.walk_ins().blocked_s().value_or(-1.0)},
                                               {"driven_m", wheels.driven_m()},
                                               {"turned_rad", wheels.turned_rad()},
                                               {"contacts", static_cast<double>(wheels.contacts())},
                                               {"walked_into", static_cast<double>(wheels.walked_into())},
                                               {"recoveries", static_cast<double>(robot.recoveries())},
                                               {"belief_error_m", robot.belief_error_m()}});
  return report;
}

Report pursuit_report(const Fault& fault, const std::string& name) {
  Report report;
  report.world_name = name;
  report.status = "not_done";
  report.reason = fault.sentence;
  report.metrics = {{"caught", 0.0},
                    {"catch_time_s", unknown},
                    {"moves", 0.0},
                    {"cost", unknown},
                    {"lower_bound", unknown},
                    {"optimal", 0.0},
                    {"earliest_catch_s", unknown}};
  return report;
}

}  // namespace outrider
