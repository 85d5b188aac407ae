#include "outrider/jobs/pursue/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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

void draw_map(ReportPursuit& pursuit, const PursuitProblem& problem) {
  constexpr int most_cells = 500;
  const GridFrame& frame = problem.costs->frame;
  const int block = (std::max(frame.width, frame.height) + most_cells - 1) / most_cells;
  pursuit.columns = (frame.width + block - 1) / block;
  pursuit.rows = (frame.height + block - 1) / block;
  pursuit.cell_m = block;
  for (const double cost : drawn_costs(problem, block, pursuit.columns, pursuit.rows)) {
    if (pursuit.cost_runs.empty() || pursuit.cost_runs[pursuit.cost_runs.size() - 2] != cost) {
      pursuit.cost_runs.insert(pursuit.cost_runs.end(), {cost, 0.0});
    }
    pursuit.cost_runs.back() += 1.0;
  }
}

std::vector<Vec2> centres(const PursuitProblem& problem, const std::vector<Cell>& cells) {
  std::vector<Vec2> points;
  for (const Cell cell : cells) points.push_back(problem.costs->frame.centre(cell));
  return points;
}

Report scene(const PursuitProblem& problem, const std::string& name) {
  Report report;
  report.job = "pursue";
  report.status = "not_done";
  report.world_name = name;
  report.bounds = problem.costs->frame.bounds();
  report.start = {problem.costs->frame.centre(problem.start), 0.0};
  report.pursuit.emplace();
  draw_map(*report.pursuit, problem);
  report.pursuit->target = centres(problem, problem.target);
  return report;
}

/// Returns the cost paid until each second. It is computed again, because the state keeps only the sum.
std::vector<double> paid_by_second(const PursuitProblem& problem, const PursuitState& state) {
  std::vector<double> paid{0.0};
  for (int s = 1; s <= state.time_s; ++s) {
    const std::size_t duty = state.duties[static_cast<std::size_t>(s) - 1];
    const Cell at = state.paths[duty][static_cast<std::size_t>(s) - 1];
    paid.push_back(paid.back() + (*problem.costs)[at]);
  }
  return paid;
}

std::string not_caught(const PursuitProblem& problem, const PursuitState& state) {
  if (state.time_s >= problem.last_s()) {
    return fmt::format("the target was gone after second {} without being caught", problem.last_s());
  }
  return fmt::format("from second {} on no catch was possible any more", state.time_s);
}

}  // namespace

Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const std::string& name) {
  const PursuitState& state = run.state;
  Report report = scene(problem, name);
  if (state.caught) {
    report.status = "done";
  } else {
    report.reason = not_caught(problem, state);
  }
  const auto cost = static_cast<double>(state.cost), bound = static_cast<double>(run.lower_bound);
  report.metrics = {
      {"caught", state.caught ? 1.0 : 0.0},
      {"catch_time_s", state.caught ? state.time_s : unknown},
      {"moves", static_cast<double>(state.moves)},
      {"cost", cost},
      {"lower_bound", bound},
      {"optimal", state.caught && state.cost == run.lower_bound ? 1.0 : 0.0},
      {"earliest_catch_s", run.earliest_catch_s < 0 ? unknown : run.earliest_catch_s},
      {"robots", static_cast<double>(state.robots.size())},
      {"catcher", state.caught ? static_cast<double>(state.duty + 1) : unknown},
      {"handovers", static_cast<double>(state.handovers)},
      {"planning_calls", static_cast<double>(run.calls)},
      {"expansions", static_cast<double>(run.expansions)},
  };
  for (const auto& path : state.paths) report.pursuit->robots.push_back(centres(problem, path));
  report.pursuit->paid = paid_by_second(problem, state);
  for (const PursuitMoment& moment : run.moments) {
    report.pursuit->bounds.push_back(
        {static_cast<double>(moment.time_s), static_cast<double>(moment.expansions),
         moment.cost ? static_cast<double>(*moment.cost) : unknown, static_cast<double>(moment.lower_bound)});
  }
  return report;
}

Report pursuit_report(const PursuitProblem& problem, const Fault& fault, const std::string& name) {
  Report report = scene(problem, name);
  report.reason = fault.sentence;
  report.metrics = {{"caught", 0.0},
                    {"catch_time_s", unknown},
                    {"moves", 0.0},
                    {"cost", unknown},
                    {"lower_bound", unknown},
                    {"optimal", 0.0},
                    {"earliest_catch_s", unknown}};
  report.pursuit->robots = {{report.start.position}};
  report.pursuit->paid = {0.0};
  return report;
}

}  // namespace outrider
