#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "outrider/jobs/guard/plan/arrival_bound.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

using Metrics = std::vector<std::pair<std::string, double>>;

double as_number(auto value) { return static_cast<double>(value); }

/// Targets by their last status, and the time of intruders inside. A target that was not hit stays until the
/// end, unless it cannot be hit at all.
struct Tally {
  double targets = 0.0;
  double reached = 0.0;
  double failed = 0.0;
  double unreachable = 0.0;
  double inside_s = 0.0;
  double longest_s = 0.0;
  double last_s = 0.0;
};

Tally tally_of(const GuardRun& run, const std::vector<TargetRecord>& records, double end_s) {
  Tally tally;
  tally.targets = as_number(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i].status == TargetStatus::unreachable) {
      tally.unreachable += 1.0;
      continue;
    }
    const bool reached = records[i].status == TargetStatus::reached;
    if (reached) tally.reached += 1.0;
    if (records[i].status == TargetStatus::failed) tally.failed += 1.0;
    const auto* const arriving = run.mission.arriving();
    const double enters_s = arriving != nullptr ? arriving->plan().yard.intruders[i].enters_s : 0.0;
    const double leaves_s = reached ? records[i].done_s : end_s;
    tally.inside_s += std::max(0.0, leaves_s - enters_s);  // it may not have come before the end
    tally.longest_s = std::max(tally.longest_s, leaves_s - enters_s);
    tally.last_s = std::max(tally.last_s, leaves_s);
  }
  return tally;
}

const std::vector<Stamped<outrider_msgs::Shot>>& shots_of(const Log& log) {
  return log.messages<outrider_msgs::Shot>(topic::shots);
}

/// Targets that the reference's rule would have counted, whatever ours says.
double reached_by_reference_rule(const Log& log, const std::vector<Target>& targets) {
  double reached = 0.0;
  for (const Target& target : targets) {
    const auto hits = [&](const Stamped<outrider_msgs::Shot>& shot) {
      return shot.message.target == target.name && shot.message.hit_by_reference_rule;
    };
    if (std::ranges::any_of(shots_of(log), hits)) reached += 1.0;
  }
  return reached;
}

Metrics still_metrics(const GuardPlan& plan, const SimRecord& record, double by_reference_rule,
                      double end_s) {
  return {{"reached_by_reference_rule", by_reference_rule},
          {"mission_s", end_s},
          {"planned_s", plan.cost_s},
          {"expected_s", plan.bounded_s()},
          {"lower_bound_s", plan.lower_bound_s},
          {"gap", plan.gap()},
          {"anywhere_lower_bound_s", plan.anywhere_lower_bound_s},
          {"anywhere_gap", plan.anywhere_gap()},
          {"tour_proven", plan.tour_proven ? 1.0 : 0.0},
          {"stops_offered", as_number(plan.stops_offered)},
          {"driven_m", record.driven_m},
          {"turned_rad", record.turned_rad},
          {"shots", as_number(record.shots)},
          {"stops", as_number(plan.stops.size())},
          {"places", as_number(plan.places)}};
}

Metrics arrival_metrics(const GuardRun& run, const GuardMission& mission, const Tally& tally,
                        const SimRecord& record, double end_s) {
  const ArrivalPlan& plan = mission.arriving()->plan();
  const ArrivalBound bound = arrival_bound(plan.yard, plan.stops.on_the_move);
  const bool makespan = plan.objective == ArrivalObjective::makespan;
  Metrics metrics = {{"mission_s", end_s},
                     {"intruder_seconds", tally.inside_s},
                     {"makespan_s", tally.last_s},
                     {"longest_s", tally.longest_s},
                     {"lower_bound_s", makespan ? bound.makespan_s : bound.time_inside_s},
                     {"intruder_seconds_bound", bound.time_inside_s},
                     {"makespan_bound_s", bound.makespan_s},
                     {"plans", as_number(mission.arriving()->plans())},
                     {"driven_m", record.driven_m},
                     {"turned_rad", record.turned_rad},
                     {"shots", as_number(record.shots)}};
  if (run.survival.leave < 1.0) metrics.emplace_back("survived", as_number(mission.arriving()->survived()));
  return metrics;
}

Metrics walker_metrics(const Tally& tally, const SimRecord& record, double end_s, double expected_hits) {
  const double shots = as_number(record.shots);
  return {{"mission_s", end_s},
          {"intruder_seconds", tally.inside_s},
          {"makespan_s", tally.last_s},
          {"driven_m", record.driven_m},
          {"turned_rad", record.turned_rad},
          {"shots", shots},
          {"chance", shots > 0.0 ? expected_hits / shots : 0.0},
          {"expected_hits", expected_hits}};
}

/// How often a store was filled, and how low each was at least.
Metrics supply_metrics(const Log& log, const Supplies& supplies, const StoreKeeper& keeper) {
  Metrics metrics = {{"fills", as_number(events_of(log, "fill").size())},
                     {"unplanned_fills", as_number(keeper.detours())}};
  double water = supplies.full(Store::water), charge_j = supplies.full(Store::charge);
  for (const auto& [time_ns, level] : log.messages<outrider_msgs::StoreLevels>(topic::stores)) {
    water = std::min(water, level.water);
    charge_j = std::min(charge_j, level.charge);
  }
  if (std::isfinite(water)) metrics.emplace_back("least_water", water);
  if (std::isfinite(charge_j)) metrics.emplace_back("least_charge_j", charge_j);
  return metrics;
}

/// How many shots left while the robot drove, and how many of them hit.
Metrics passing_metrics(const Log& log) {
  double shots = 0.0, hits = 0.0;
  for (const auto& [time_ns, shot] : shots_of(log)) {
    if (shot.platform_velocity.x == 0.0 && shot.platform_velocity.y == 0.0) continue;
    shots += 1.0;
    hits += shot.hit ? 1.0 : 0.0;
  }
  return {{"shots_in_passing", shots}, {"hits_in_passing", hits}};
}

Metrics rigid_metrics(const RigidRecord& rigid) {
  const auto& errors = rigid.arrival_errors_m;
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {{"arrival_error_mean_m", errors.empty() ? 0.0 : sum / as_number(errors.size())},
          {"arrival_error_max_m", errors.empty() ? 0.0 : *std::ranges::max_element(errors)},
          {"flight_error_max_m", rigid.flight_error_m},
          {"shots_as_foreseen", as_number(rigid.as_foreseen)},
          {"bumps", as_number(rigid.bumps)}};
}

/// Why not every target was reached; empty where all were.
std::string reason_of(const GuardRun& run, const Tally& tally) {
  if (tally.reached == tally.targets) return {};
  if (run.mission.moving() != nullptr)
    return fmt::format("{} of {} intruders hit", tally.reached, tally.targets);
  if (run.mission.arriving() != nullptr) {
    return fmt::format("{} of {} intruders reached, {} failed, no shot found at {}", tally.reached,
                       tally.targets, tally.failed, tally.unreachable);
  }
  return fmt::format("{} of {} targets reached, {} failed, no shot found at {}", tally.reached, tally.targets,
                     tally.failed, tally.unreachable);
}

/// Returns the text to add to the reason if shots had no result; else an empty one.
std::string why_unanswered(const TaskBoard& board) {
  if (!board.given_up().empty())
    return fmt::format("; {}: is the gun jammed, or its tank empty?", board.given_up());
  int unanswered = 0;
  for (const TargetRecord& record : board.records()) unanswered += record.unanswered;
  if (unanswered == 0) return {};
  return fmt::format("; {} shot{} had no result: is the gun jammed, or its tank empty?", unanswered,
                     unanswered == 1 ? "" : "s");
}

/// Returns the targets that are called reached and that no ball hit.
double falsely_reached(const std::vector<TargetRecord>& records, const std::vector<Target>& targets,
                       const Log& log) {
  double count = 0.0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto hits = [&](const Stamped<outrider_msgs::Shot>& shot) {
      return shot.message.hit && shot.message.target == targets[i].name;
    };
    if (records[i].status == TargetStatus::reached && std::ranges::none_of(shots_of(log), hits)) count += 1.0;
  }
  return count;
}

/// Returns the row of a target in the table. The clearance of a hit is that of its flight.
std::vector<TableValue> row_of(const std::string& name, const TargetRecord& record, const Log& log) {
  if (record.shots == 0)
    return unshot_row(name, std::string(to_string(record.status)), record.reason, record.done_s);
  const Shot aim = record.shot ? record.shot->shot : Shot{};
  double clearance_m = record.shot ? record.shot->clearance_m : 0.0;
  for (const auto& [time_ns, shot] : shots_of(log)) {
    if (shot.target == name && shot.hit) clearance_m = shot.clearance;
  }
  const Pose2& pose = record.pose;
  return {name,
          std::string(to_string(record.status)),
          record.reason,
          as_number(record.shots),
          record.done_s,
          pose.position.x,
          pose.position.y,
          pose.heading_rad,
          aim.pitch_rad,
          aim.yaw_rad,
          aim.speed_mps,
          clearance_m};
}

}  // namespace

double settled_part(const std::vector<TargetRecord>& records) {
  if (records.empty()) return 1.0;
  const auto waiting = std::ranges::count(records, TargetStatus::waiting, &TargetRecord::status);
  return 1.0 - as_number(waiting) / as_number(records.size());
}

Table target_table() {
  return {"targets",
          {"name", "status", "reason", "shots", "done_s", "x", "y", "heading_rad", "pitch_rad", "yaw_rad",
           "speed_mps", "clearance_m"},
          {}};
}

std::vector<TableValue> unshot_row(const std::string& name, const std::string& status,
                                   const std::string& reason, double done_s) {
  const double none = std::nan("");
  return {name, status, reason, 0.0, done_s, none, none, none, none, none, none, none};
}

std::string ran_dry(const Log& log) {
  constexpr double rounding = 1e-9;
  for (const auto& levels : log.messages<outrider_msgs::StoreLevels>(topic::stores)) {
    if (levels.message.water < -rounding)
      return fmt::format("the tank was empty at {:.1f} s", levels.time_s());
    if (levels.message.charge < -rounding)
      return fmt::format("the battery was empty at {:.1f} s", levels.time_s());
  }
  return {};
}

std::string why_stranded(const Log& log) {
  const auto stranded = events_of(log, "stranded");
  return stranded.empty() ? std::string() : "; " + stranded.front().message.msg;
}

Report judge(const GuardRun& run, const GuardMission& mission, const SimRecord& record, const Log& log,
             double end_s, double expected_hits) {
  const std::vector<Target>& targets = true_problem(run).targets;
  Report report;
  report.world_name = true_problem(run).world.name;
  const auto& records = mission.board().records();
  const Tally tally = tally_of(run, records, end_s);
  report.metrics = {{"targets", tally.targets},
                    {"reached", tally.reached},
                    {"failed", tally.failed},
                    {"unreachable", tally.unreachable}};
  const auto add = [&](const Metrics& more) {
    report.metrics.insert(report.metrics.end(), more.begin(), more.end());
  };
  if (mission.arriving() != nullptr) {
    add(arrival_metrics(run, mission, tally, record, end_s));
  } else if (mission.moving() != nullptr) {
    add(walker_metrics(tally, record, end_s, expected_hits));
  } else {
    add(still_metrics(*mission.tour(), record, reached_by_reference_rule(log, targets), end_s));
  }
  const Supplies& supplies = true_problem(run).supplies;
  if (supplies.any()) add(supply_metrics(log, supplies, mission.stores()));
  if (mission.board().on_the_move()) add(passing_metrics(log));
  if (record.rigid) add(rigid_metrics(*record.rigid));
  if (run.faults.any()) {
    add({{"false_reached", falsely_reached(records, targets, log)},
         {"cut_drives", as_number(events_of(log, "stopped").size())},
         {"contacts", as_number(record.contacts)},
         {"post_contacts", as_number(record.post_contacts)}});
  }
  Table table = target_table();
  for (std::size_t i = 0; i < records.size(); ++i)
    table.rows.push_back(row_of(targets[i].name, records[i], log));
  report.tables = {std::move(table)};
  const std::string dry = ran_dry(log);
  report.status = tally.reached + tally.unreachable == tally.targets && dry.empty() ? "done" : "not_done";
  report.reason = dry.empty() ? reason_of(run, tally) + why_stranded(log) : dry;
  if (report.status != "done")
    report.reason += why_unanswered(mission.board()) + why_held_up(mission.board().cut());
  return report;
}

}  // namespace outrider
