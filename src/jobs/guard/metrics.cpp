#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "guard_report.hpp"
#include "outrider/jobs/guard/arrival_bound.hpp"

namespace outrider {
namespace {

using Metrics = std::vector<std::pair<std::string, double>>;

double number(auto value) { return static_cast<double>(value); }

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
  tally.targets = number(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i].status == TargetStatus::unreachable) {
      tally.unreachable += 1.0;
      continue;
    }
    const bool reached = records[i].status == TargetStatus::reached;
    if (reached) tally.reached += 1.0;
    if (records[i].status == TargetStatus::failed) tally.failed += 1.0;
    const double enters_s = run.arrivals ? run.arrivals->yard.intruders[i].enters_s : 0.0;
    const double leaves_s = reached ? records[i].done_s : end_s;
    tally.inside_s += std::max(0.0, leaves_s - enters_s);  // it may not have come before the end
    tally.longest_s = std::max(tally.longest_s, leaves_s - enters_s);
    tally.last_s = std::max(tally.last_s, leaves_s);
  }
  return tally;
}

/// Targets that the reference's rule would have counted, whatever ours says.
double reached_by_reference_rule(const Report& report) {
  return number(std::ranges::count_if(report.targets, [&](const ReportTarget& target) {
    return std::ranges::any_of(report.shots, [&](const ReportShot& shot) {
      return shot.target == target.name && shot.hit_by_reference_rule;
    });
  }));
}

Metrics still_metrics(const GuardPlan& plan, const Tally& tally, const Report& report,
                      const SimRecord& record) {
  return {{"targets", tally.targets},
          {"reached", tally.reached},
          {"failed", tally.failed},
          {"unreachable", tally.unreachable},
          {"reached_by_reference_rule", reached_by_reference_rule(report)},
          {"mission_s", report.track.empty() ? 0.0 : report.track.back().time_s},
          {"planned_s", plan.cost_s},
          {"expected_s", plan.bounded_s()},
          {"lower_bound_s", plan.lower_bound_s},
          {"gap", plan.gap()},
          {"anywhere_lower_bound_s", plan.anywhere_lower_bound_s},
          {"anywhere_gap", plan.anywhere_gap()},
          {"tour_proven", plan.tour_proven ? 1.0 : 0.0},
          {"stops_offered", number(plan.stops_offered)},
          {"driven_m", record.driven_m},
          {"turned_rad", record.turned_rad},
          {"shots", number(report.shots.size())},
          {"stops", number(plan.stops.size())},
          {"places", number(plan.places)}};
}

Metrics arrival_metrics(const GuardRun& run, const GuardMission& mission, const Tally& tally,
                        const Report& report, const SimRecord& record) {
  const ArrivalBound bound = arrival_bound(run.arrivals->yard);
  const bool makespan = run.arrivals->objective == ArrivalObjective::makespan;
  Metrics metrics = {{"targets", tally.targets},
                     {"reached", tally.reached},
                     {"failed", tally.failed},
                     {"unreachable", tally.unreachable},
                     {"mission_s", report.track.back().time_s},
                     {"intruder_seconds", tally.inside_s},
                     {"makespan_s", tally.last_s},
                     {"longest_s", tally.longest_s},
                     {"lower_bound_s", makespan ? bound.makespan_s : bound.time_inside_s},
                     {"intruder_seconds_bound", bound.time_inside_s},
                     {"makespan_bound_s", bound.makespan_s},
                     {"plans", number(mission.arriving.plans)},
                     {"driven_m", record.driven_m},
                     {"turned_rad", record.turned_rad},
                     {"shots", number(report.shots.size())}};
  if (run.survival.leave < 1.0) metrics.emplace_back("survived", number(mission.arriving.survived));
  return metrics;
}

Metrics walker_metrics(const std::vector<TargetRecord>& records, const Tally& tally, const Report& report,
                       const SimRecord& record, double expected_hits) {
  double inside_s = 0.0, last_s = 0.0;
  for (const TargetRecord& one : records) {
    inside_s += one.done_s;
    last_s = std::max(last_s, one.done_s);
  }
  const double shots = number(report.shots.size());
  return {{"targets", tally.targets},
          {"reached", tally.reached},
          {"failed", tally.failed},
          {"unreachable", 0.0},
          {"mission_s", report.track.back().time_s},
          {"intruder_seconds", inside_s},
          {"makespan_s", last_s},
          {"driven_m", record.driven_m},
          {"turned_rad", record.turned_rad},
          {"shots", shots},
          {"chance", shots > 0.0 ? expected_hits / shots : 0.0},
          {"expected_hits", expected_hits}};
}

/// How often a store was filled, and how low each was at least.
Metrics supply_metrics(const Report& report, const StoreKeeper& keeper) {
  Metrics metrics = {{"fills", number(std::ranges::count(report.events, "fill", &ReportEvent::kind))},
                     {"unplanned_fills", number(keeper.detours)}};
  double water = report.supplies->tank;
  double charge_j = report.supplies->battery_j;
  for (const ReportLevel& level : report.supplies->levels) {
    water = std::min(water, level.water);
    charge_j = std::min(charge_j, level.charge_j);
  }
  if (std::isfinite(water)) metrics.emplace_back("least_water", water);
  if (std::isfinite(charge_j)) metrics.emplace_back("least_charge_j", charge_j);
  return metrics;
}

/// How many shots left while the robot drove, and how many of them hit.
Metrics passing_metrics(const Report& report) {
  const auto passing = [](const ReportShot& shot) { return shot.platform_velocity_mps.has_value(); };
  const auto hits = [&](const ReportShot& shot) { return passing(shot) && shot.hit; };
  return {{"shots_in_passing", number(std::ranges::count_if(report.shots, passing))},
          {"hits_in_passing", number(std::ranges::count_if(report.shots, hits))}};
}

Metrics rigid_metrics(const RigidRecord& rigid) {
  const auto& errors = rigid.arrival_errors_m;
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {{"arrival_error_mean_m", errors.empty() ? 0.0 : sum / number(errors.size())},
          {"arrival_error_max_m", errors.empty() ? 0.0 : *std::ranges::max_element(errors)},
          {"flight_error_max_m", rigid.flight_error_m},
          {"shots_as_foreseen", number(rigid.as_foreseen)},
          {"bumps", number(rigid.bumps)}};
}

/// When somebody came in, among the other events.
void add_arrival_events(Report& report, const std::vector<Intruder>& intruders) {
  const double end_s = report.track.back().time_s;
  for (const Intruder& one : intruders) {
    if (one.entrance.empty()) continue;  // it was there from the start
    if (one.enters_s > end_s) continue;  // a robot that is stranded does not see it
    report.events.push_back(
        {one.enters_s, "enter", fmt::format("{} comes in by {}", one.name, one.entrance)});
  }
  std::ranges::stable_sort(report.events, {}, &ReportEvent::time_s);
}

/// Of waits that follow one another the first.
void drop_repeated_waits(std::vector<ReportEvent>& events) {
  bool waited = false;
  std::erase_if(events, [&](const ReportEvent& event) {
    const bool waits = event.kind == "wait";
    return std::exchange(waited, waits) && waits;
  });
  for (ReportEvent& event : events) {
    if (event.kind == "wait") event.text = "waits for a shot";
  }
}

/// Why not every target was reached; empty where all were.
std::string reason_of(const GuardRun& run, const Tally& tally) {
  if (tally.reached == tally.targets) return {};
  if (run.walkers) return fmt::format("{} of {} intruders hit", tally.reached, tally.targets);
  if (run.arrivals) {
    return fmt::format("{} of {} intruders reached, {} failed, {} out of reach", tally.reached, tally.targets,
                       tally.failed, tally.unreachable);
  }
  return fmt::format("{} of {} targets reached, {} failed, {} proven to be out of reach", tally.reached,
                     tally.targets, tally.failed, tally.unreachable);
}

}  // namespace

std::string ran_dry(const Report& report) {
  constexpr double rounding = 1e-9;
  if (!report.supplies) return {};
  for (const ReportLevel& level : report.supplies->levels) {
    if (level.water < -rounding) return fmt::format("the tank was empty at {:.1f} s", level.time_s);
    if (level.charge_j < -rounding) return fmt::format("the battery was empty at {:.1f} s", level.time_s);
  }
  return {};
}

std::string why_stranded(const Report& report) {
  const auto event = std::ranges::find(report.events, "stranded", &ReportEvent::kind);
  return event == report.events.end() ? std::string() : "; " + event->text;
}

void close_report(Report& report, const GuardRun& run, const GuardMission& mission, SimRecord& record,
                  double expected_hits) {
  swap_entries(record, report);
  if (run.arrivals) add_arrival_events(report, run.arrivals->yard.intruders);
  if (run.walkers) drop_repeated_waits(report.events);
  list_targets(report, run, mission, record);
  const auto& records = mission.tasks.records;
  const Tally tally = tally_of(run, records, report.track.back().time_s);
  report.metrics = run.arrivals  ? arrival_metrics(run, mission, tally, report, record)
                   : run.walkers ? walker_metrics(records, tally, report, record, expected_hits)
                                 : still_metrics(run.plan, tally, report, record);
  const auto add = [&](const Metrics& more) {
    report.metrics.insert(report.metrics.end(), more.begin(), more.end());
  };
  if (report.supplies) add(supply_metrics(report, mission.stores));
  if (run.options.shoot_on_the_move) add(passing_metrics(report));
  if (record.rigid) add(rigid_metrics(*record.rigid));
  if (mission.stores.stranded) {
    report.events.push_back({report.track.back().time_s, "stranded", mission.stores.reason});
  }
  const std::string dry = ran_dry(report);
  report.status = tally.reached + tally.unreachable == tally.targets && dry.empty() ? "done" : "not_done";
  report.reason = dry.empty() ? reason_of(run, tally) + why_stranded(report) : dry;
}

}  // namespace outrider
