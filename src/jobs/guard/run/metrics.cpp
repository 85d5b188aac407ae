#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

double as_number(auto value) { return static_cast<double>(value); }

double count(const std::vector<TargetRecord>& records, TargetStatus status) {
  return as_number(std::ranges::count(records, status, &TargetRecord::status));
}

GuardVerdict verdict_of(const std::vector<TargetRecord>& records, std::string_view missed_form) {
  const double targets = as_number(records.size()), reached = count(records, TargetStatus::reached);
  const double unreachable = count(records, TargetStatus::unreachable);
  GuardVerdict verdict{reached + unreachable == targets ? "done" : "not_done", {}};
  if (reached < targets)
    verdict.reason = fmt::format(fmt::runtime(missed_form), reached, targets,
                                 count(records, TargetStatus::failed), unreachable);
  return verdict;
}

std::string_view missed_form_of(const GuardMission& mission) {
  if (mission.arriving() != nullptr) return "{} of {} intruders reached, {} failed, no shot found at {}";
  return mission.moving() != nullptr ? "{} of {} intruders hit" : targets_missed;
}

/// The times of intruders inside. One that was not hit stays until the end; one that cannot be hit at all
/// does not count.
struct Stays {
  double sum_s = 0.0;
  double longest_s = 0.0;
  double last_s = 0.0;  ///< when the last one left
};

/// `intruders` is empty if all are inside from the start.
Stays stays_of(const EndedMission& ended, const std::vector<Intruder>& intruders = {}) {
  Stays stays;
  for (std::size_t i = 0; i < ended.records.size(); ++i) {
    const TargetRecord& record = ended.records[i];
    if (record.status == TargetStatus::unreachable) continue;
    const double enters_s = intruders.empty() ? 0.0 : intruders[i].enters_s;
    const double leaves_s = record.status == TargetStatus::reached ? record.done_s : ended.end_s;
    stays.sum_s += std::max(0.0, leaves_s - enters_s);  // it may not have come before the end
    stays.longest_s = std::max(stays.longest_s, leaves_s - enters_s);
    stays.last_s = std::max(stays.last_s, leaves_s);
  }
  return stays;
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

Metrics arrival_metrics(const EndedMission& ended, const ArrivingTargets& arriving, bool may_survive) {
  const RollingPlan& plan = arriving.plan();
  const ArrivalBound bound = arrival_bound(plan.yard, plan.stops.on_the_move);
  const bool makespan = plan.objective == ArrivalObjective::makespan;
  const Stays stays = stays_of(ended, plan.yard.intruders);
  Metrics metrics = {{"mission_s", ended.end_s},
                     {"intruder_seconds", stays.sum_s},
                     {"makespan_s", stays.last_s},
                     {"longest_s", stays.longest_s},
                     {"lower_bound_s", makespan ? bound.makespan_s : bound.time_inside_s},
                     {"intruder_seconds_bound", bound.time_inside_s},
                     {"makespan_bound_s", bound.makespan_s},
                     {"plans", as_number(arriving.plans())},
                     {"driven_m", ended.record.driven_m},
                     {"turned_rad", ended.record.turned_rad},
                     {"shots", as_number(ended.record.shots)}};
  if (may_survive) metrics.emplace_back("survived", as_number(arriving.survived()));
  return metrics;
}

Metrics walker_metrics(const EndedMission& ended, double expected_hits) {
  const double shots = as_number(ended.record.shots);
  const Stays stays = stays_of(ended);
  return {{"mission_s", ended.end_s},
          {"intruder_seconds", stays.sum_s},
          {"makespan_s", stays.last_s},
          {"driven_m", ended.record.driven_m},
          {"turned_rad", ended.record.turned_rad},
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

/// Returns the text to add to the reason if shots had no result; else an empty one.
std::string why_unanswered(const EndedMission& ended) {
  if (ended.board != nullptr && !ended.board->given_up().empty())
    return fmt::format("; {}: is the gun jammed, or its tank empty?", ended.board->given_up());
  int unanswered = 0;
  for (const TargetRecord& record : ended.records) unanswered += record.unanswered;
  if (unanswered == 0) return {};
  return fmt::format("; {} shot{} had no result: is the gun jammed, or its tank empty?", unanswered,
                     unanswered == 1 ? "" : "s");
}

Metrics navigated_metrics(const NavigatedRecord& record) {
  return {{"contacts", static_cast<double>(record.contacts)},
          {"walked_into", static_cast<double>(record.walked_into)},
          {"recoveries", static_cast<double>(record.recoveries)},
          {"blocked_s", record.blocked_s},
          {"belief_error_m", record.belief_error_m}};
}

/// Takes out what holds of robots only that drive as planned: turn in place, then straight.
void leave_out_bounds(Metrics& metrics) {
  constexpr std::array of_plans = {"expected_s",    "lower_bound_s",    "gap",
                                   "anywhere_gap",  "tour_proven",      "anywhere_lower_bound_s",
                                   "stops_offered", "makespan_bound_s", "intruder_seconds_bound"};
  std::erase_if(metrics, [&](const auto& metric) {
    return std::ranges::find(of_plans, metric.first) != of_plans.end();
  });
}

/// Returns the targets that are called reached and that no ball hit.
double falsely_reached(const EndedMission& ended) {
  double count = 0.0;
  for (std::size_t i = 0; i < ended.records.size(); ++i) {
    const auto hits = [&](const Stamped<outrider_msgs::Shot>& shot) {
      return shot.message.hit && shot.message.target == ended.problem.targets[i].name;
    };
    if (ended.records[i].status == TargetStatus::reached && std::ranges::none_of(shots_of(ended.log), hits))
      count += 1.0;
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

Metrics tour_metrics(const GuardPlan& plan, const EndedMission& ended) {
  return {{"reached_by_reference_rule", reached_by_reference_rule(ended.log, ended.problem.targets)},
          {"mission_s", ended.end_s},
          {"planned_s", plan.cost_s},
          {"expected_s", plan.bounded_s()},
          {"lower_bound_s", plan.lower_bound_s},
          {"gap", plan.gap()},
          {"anywhere_lower_bound_s", plan.anywhere_lower_bound_s},
          {"anywhere_gap", plan.anywhere_gap()},
          {"tour_proven", plan.tour_proven ? 1.0 : 0.0},
          {"stops_offered", as_number(plan.stops_offered)},
          {"driven_m", ended.record.driven_m},
          {"turned_rad", ended.record.turned_rad},
          {"shots", as_number(ended.record.shots)},
          {"stops", as_number(plan.stops.size())},
          {"places", as_number(plan.places)}};
}

Report judge(const EndedMission& ended, const Metrics& known, std::string_view missed_form) {
  const auto& records = ended.records;
  Report report;
  report.world_name = ended.problem.world.name;
  report.metrics = {{"targets", as_number(records.size())},
                    {"reached", count(records, TargetStatus::reached)},
                    {"failed", count(records, TargetStatus::failed)},
                    {"unreachable", count(records, TargetStatus::unreachable)}};
  const auto add = [&](const Metrics& more) {
    report.metrics.insert(report.metrics.end(), more.begin(), more.end());
  };
  add(known);
  if (ended.on_the_move && !ended.record.navigated) add(passing_metrics(ended.log));
  if (ended.record.rigid) add(rigid_metrics(*ended.record.rigid));
  if (ended.record.navigated) add(navigated_metrics(*ended.record.navigated));
  if (ended.has_faults || ended.record.navigated) {
    add({{"false_reached", falsely_reached(ended)},
         {"cut_drives", as_number(events_of(ended.log, "stopped").size())}});
  }
  if (ended.has_faults && !ended.record.navigated) {
    add({{"contacts", as_number(ended.record.contacts)},
         {"post_contacts", as_number(ended.record.post_contacts)}});
  }
  report.tables = {target_table()};
  for (std::size_t i = 0; i < records.size(); ++i)
    report.tables.front().rows.push_back(row_of(ended.problem.targets[i].name, records[i], ended.log));
  const GuardVerdict verdict = verdict_of(records, missed_form);
  const std::string dry = ran_dry(ended.log);
  report.status = dry.empty() ? verdict.status : "not_done";
  report.reason = dry.empty() ? verdict.reason + why_stranded(ended.log) : dry;
  if (ended.record.navigated && ended.record.navigated->contacts > 0) {
    report.status = "not_done";
    report.reason = "something was touched" + (report.reason.empty() ? "" : "; " + report.reason);
  }
  if (report.status == "done") return report;
  report.reason += why_unanswered(ended);
  if (ended.board != nullptr) report.reason += why_held_up(ended.board->cut());
  return report;
}

Report judge(const GuardRun& run, const GuardMission& mission, const SimRecord& record, const Log& log,
             double end_s) {
  const GuardProblem& problem = true_problem(run);
  const GuardScenario& scenario = run.guard.scenario;
  const TaskBoard& board = mission.board();
  const EndedMission ended{
      problem, board.records(), record, log, end_s, board.on_the_move(), scenario.faults.any(), &board};
  Metrics known;
  if (const auto* const arriving = mission.arriving()) {
    known = arrival_metrics(ended, *arriving, scenario.arrivals.may_survive());
  } else if (const auto* const moving = mission.moving()) {
    known = walker_metrics(ended, moving->expected_hits());
  } else {
    known = tour_metrics(*mission.tour(), ended);
  }
  if (record.navigated) leave_out_bounds(known);
  if (problem.supplies.any()) {
    for (auto& metric : supply_metrics(log, problem.supplies, mission.stores()))
      known.push_back(std::move(metric));
  }
  return judge(ended, known, missed_form_of(mission));
}

GuardVerdict verdict_of(const GuardMission& mission) {
  GuardVerdict verdict = verdict_of(mission.board().records(), missed_form_of(mission));
  if (const std::string& why = mission.stores().stranded(); !why.empty()) verdict.reason += "; " + why;
  return verdict;
}

}  // namespace outrider
