#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/path/timing.hpp"

namespace outrider {
namespace {

bool on_polygons(const PlanRow& row) {
  const auto planner = find_path_planner(row.planner);
  return planner && planner->models.empty();
}

/// The sentence of the first row without a path; of several queries with the number of its own.
std::string reason_of(const PlanQuestion& question, const PlanAnswer& answer) {
  for (const PlanRow& row : answer.rows) {
    if (row.found()) continue;
    const bool numbered = question.queries.size() > 1 && row.query.number.has_value();
    return numbered ? fmt::format("query {}: {}", *row.query.number, row.reason) : row.reason;
  }
  return {};
}

std::vector<const PlanRow*> rows_of(const PlanAnswer& answer) {
  std::vector<const PlanRow*> rows;
  for (const PlanRow& row : answer.rows) rows.push_back(&row);
  return rows;
}

void add_metrics(Report& report, const PlanAnswer& answer) {
  const auto rows = rows_of(answer);
  if (const PlanRow* best = shortest(rows)) {
    report.metrics = {{"cost", best->cost},
                      {"length_m", best->length_m},
                      {"drive_s", best->drive_s},
                      {"lower_bound", best->lower_bound},
                      {"clearance_m", best->clearance_m},
                      {"exposure", best->exposure},
                      {"expansions", best->expansions}};
  }
  const auto found = std::count_if(rows.begin(), rows.end(), [](const PlanRow* row) { return row->found(); });
  report.metrics.emplace_back("paths", static_cast<double>(found));
  report.metrics.emplace_back("rows", static_cast<double>(rows.size()));
}

/// Each planner builds its index once, however many rows it has.
void add_times(Report& report, const PlanQuestion& question, const PlanAnswer& answer) {
  double search_s = 0.0, build_s = 0.0;
  for (const PlanRow& row : answer.rows) search_s += row.time_s;
  for (std::size_t i = 0; i < std::min(question.planners.size(), answer.rows.size()); ++i) {
    build_s += answer.rows[i].build_s;
  }
  report.machine_times = {{"planning_s", search_s}, {"building_s", build_s}};
}

/// The speeds of the fastest drive along the path that the metrics are of: a row where each phase begins, and
/// one for the end. Empty where no path was found.
Table speed_profile_of(const PlanQuestion& question, const PlanAnswer& answer) {
  Table table{"speed_profile", {"time_s", "along_m", "speed_mps", "acceleration_mps2", "turn_rad"}, {}};
  const PlanRow* best = shortest(rows_of(answer));
  if (best == nullptr) return table;
  const auto drive = fastest_drive(*best->plan, question.drive);
  if (!drive) return table;
  for (const DrivePhase& phase : drive->phases) {
    table.rows.push_back(
        {phase.start_s, phase.start_m, phase.speed_mps, phase.acceleration_mps2, phase.turn_rad});
  }
  table.rows.push_back({drive->time_s, drive->driven_m, 0.0, 0.0, 0.0});
  return table;
}

}  // namespace

const PlanRow* shortest(const std::vector<const PlanRow*>& rows) {
  const PlanRow* best = nullptr;
  bool best_on_polygons = false;
  for (const PlanRow* row : rows) {
    if (!row->found()) continue;
    const bool exact = on_polygons(*row);
    const bool better = best == nullptr || (exact && !best_on_polygons) ||
                        (exact == best_on_polygons && row->length_m < best->length_m - 1e-9);
    if (!better) continue;
    best = row;
    best_on_polygons = exact;
  }
  return best;
}

Report plan_report(const PlanQuestion& question, const PlanAnswer& answer) {
  Report report;
  report.job = "plan";
  report.reason = reason_of(question, answer);
  const bool all =
      std::all_of(answer.rows.begin(), answer.rows.end(), [](const PlanRow& row) { return row.found(); });
  report.status = all ? "done" : "not_done";
  add_metrics(report, answer);
  add_times(report, question, answer);
  report.tables = {table_of(answer), speed_profile_of(question, answer)};
  for (const PlanRow& row : answer.rows) {
    if (!row.plan || row.plan->remark.empty()) continue;
    auto& warnings = report.warnings;
    if (std::find(warnings.begin(), warnings.end(), row.plan->remark) == warnings.end()) {
      warnings.push_back(row.plan->remark);
    }
  }
  return report;
}

}  // namespace outrider
