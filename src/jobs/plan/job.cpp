#include "outrider/jobs/plan/job.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "outrider/core/text.hpp"
#include "outrider/job/run_job.hpp"
#include "plan_log.hpp"
#include "report.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

/// Returns the place that the fault of a single question names: the end at which the robot cannot stand, or
/// the planner.
std::string place_of(const PlanRow& row) {
  const Vec2 from = row.query.from, to = row.query.to;
  if (row.fault->code == FaultCode::start_blocked) return fmt::format("from {},{}", from.x, from.y);
  if (row.fault->code == FaultCode::goal_blocked) return fmt::format("to {},{}", to.x, to.y);
  return "planner " + row.planner;
}

/// Returns the fault of a single question that cannot be asked. "No path" is an answer to a single question,
/// as it is to several.
Status check_single(const PlanAnswer& answer) {
  if (answer.rows.size() != 1 || answer.rows.front().found()) return {};
  Fault refusal = *answer.rows.front().fault;
  if (refusal.code == FaultCode::no_path || refusal.code == FaultCode::budget_exhausted) return {};
  if (refusal.where.empty()) refusal.where = place_of(answer.rows.front());
  return tl::unexpected<Fault>(std::move(refusal));
}

std::vector<std::pair<std::string, std::string>> settled_settings(const PlanScenario& settled) {
  PlanJob job;
  job.scenario = settled;
  return settings_of(job.options());
}

}  // namespace

Outcome<Warnings> PlanJob::load() {
  auto loaded = load_plan(scenario, given);
  if (!loaded) return pass_on(loaded);
  task = std::move(*loaded);
  return task->map.warnings;
}

Status PlanJob::run(Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 1 + static_cast<int>(task->planners.size()));
  if (auto ok = steps.next("preparing the map"); !ok) return ok;
  const auto question = question_of(*task, watch.stop);
  if (!question) return pass_on(question);
  if (question->queries.size() == 1) {
    if (auto ok = check_query(*question->ground, question->queries.front()); !ok) return ok;
  }
  Trace trace;
  const bool traces = task->settled.trace;
  const auto found =
      answer(*question,
             {.trace = traces ? &trace : nullptr,
              .index_file = task->settled.index,
              .before = [&](std::string_view planner) { return steps.next(std::string(planner)); }},
             watch.budget());
  if (!found) return pass_on(found);
  if (auto ok = check_single(*found); !ok) return ok;
  run.report = plan_report(*question, *found);
  log_answer(run.log, *task, *question, *found, traces ? &trace : nullptr);
  run.report.world_name = printable(std::filesystem::path(task->settled.map).filename().string());
  run.report.settings = settled_settings(task->settled);
  if (traces) run.files.push_back({"trace.json", trace_json(trace, *question->ground->grid)});
  return {};
}

Job plan_job() {
  return {.name = "plan",
          .sentence = "Find a collision-free path for a disk robot.",
          .example = "plan scenarios/yard/yard.sdf --from 0,-6 --to 4,4 --compare --out out",
          .blank = [] { return std::make_unique<PlanJob>(); },
          .file_option = "map",
          .file_sentence =
              "map: map_server YAML, SDF world, MovingAI .map, polygons .txt, PGM or PNG image; may "
              "be gzip-compressed",
          .aliases = {{"hub-memory", "octile_labels.hub_memory"},
                      {"hub-memory", "hub_labels.hub_memory"},
                      {"hub-memory", "terrain_labels.hub_memory"}},
          .summary = plan_summary};
}

}  // namespace outrider
