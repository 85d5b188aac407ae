#include "guard_arrivals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "outrider/core/parallel.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/jobs/guard/yard/inputs.hpp"

namespace outrider::bench {
namespace {

/// Holds what a row needs from one run.
struct Sample {
  double inside_s = 0.0;
  double longest_s = 0.0;
  double makespan_s = 0.0;
  double driven_m = 0.0;
  double lost = 0.0;
  bool below_bound = false;
};

struct Yard {
  GuardScenario scenario;
  FiringMap firing_map;
  StopTable precomputed;
  std::vector<ArrivalYard> watches;  // one per seed
};

Outcome<Yard> prepared(const std::string& path, std::int64_t seeds) {
  GuardJob job;
  if (auto ok = read_scenario(job, path); !ok) return pass_on(ok);
  if (auto ok = job.load(); !ok) return pass_on(ok);
  GuardScenario& scenario = job.scenario;
  if (!scenario.arrivals.any()) return bad_input("nobody comes; give arrivals.count", path);
  auto firing_map = build_firing_map(scenario.problem, scenario.options);
  if (!firing_map) return pass_on(firing_map);
  // The stops are those of a robot that stands when it shoots; the policies shoot on the move if they may.
  const bool on_the_move = std::exchange(scenario.options.shoot_on_the_move, false);
  auto plan = plan_guard(scenario.problem, *firing_map, scenario.options, {});
  if (!plan) return pass_on(plan);
  plan->on_the_move = on_the_move;
  auto precomputed = precompute_stops(scenario.problem, *firing_map, *plan,
                                      static_cast<std::size_t>(scenario.arrivals.stops), {});
  if (!precomputed) return pass_on(precomputed);
  Yard yard{std::move(scenario), std::move(*firing_map), std::move(*precomputed), {}};
  for (std::int64_t seed = 1; seed <= seeds; ++seed) {
    auto intruders =
        load_arrivals(yard.scenario.problem, yard.scenario.arrivals, static_cast<std::uint64_t>(seed));
    if (!intruders) return pass_on(intruders);
    yard.watches.push_back(arrival_yard(yard.scenario.problem, yard.firing_map, std::move(*intruders)));
  }
  return yard;
}

Sample sample_of(const Yard& yard, std::size_t i, const ReplanPolicy& policy, ArrivalObjective objective) {
  const ArrivalYard& watch = yard.watches[i];
  const ArrivalOptions& arrivals = yard.scenario.arrivals;
  const RollingPlan plan{watch,
                         yard.precomputed,
                         policy,
                         objective,
                         static_cast<std::size_t>(arrivals.group),
                         static_cast<std::size_t>(arrivals.beam)};
  PreparedGuard guard{yard.scenario};
  guard.scenario.seed = static_cast<std::int64_t>(i) + 1;
  guard.scenario.arrivals.leave = 1.0;
  guard.mission.emplace(plan);
  Log log;
  const Report report = run_guard({guard}, log).value();
  const double inside = metric(report, "intruder_seconds");
  const double makespan = metric(report, "makespan_s");
  const double count = metric(report, "targets") - metric(report, "unreachable");
  return {inside / std::max(1.0, count),
          metric(report, "longest_s"),
          makespan - watch.intruders.back().enters_s,
          metric(report, "driven_m"),
          metric(report, "failed"),
          inside < metric(report, "intruder_seconds_bound") || makespan < metric(report, "makespan_bound_s")};
}

Sample bound_of(const ArrivalYard& watch, bool on_the_move) {
  const ArrivalBound bound = arrival_bound(watch, on_the_move);
  const auto count =
      std::ranges::count_if(watch.firing_map.regions, [](const auto& r) { return r.hits > 0; });
  Sample sample;
  sample.inside_s = bound.time_inside_s / std::max(1.0, static_cast<double>(count));
  sample.makespan_s = bound.makespan_s - watch.intruders.back().enters_s;
  return sample;
}

Estimate estimate(const std::vector<Sample>& samples, double Sample::* member) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const Sample& sample : samples) sum += sample.*member;
  for (const Sample& sample : samples) squares += std::pow(sample.*member - sum / n, 2.0);
  return {sum / n, n > 1.0 ? 1.96 * std::sqrt(squares / (n - 1.0) / n) : 0.0};
}

ArrivalsRow row_of(const Yard& yard, std::string policy, std::string objective,
                   const std::vector<Sample>& samples) {
  ArrivalsRow row;
  row.yard = yard.scenario.problem.world.name;
  row.policy = std::move(policy);
  row.objective = std::move(objective);
  row.runs = samples.size();
  row.inside_s = estimate(samples, &Sample::inside_s);
  row.longest_s = estimate(samples, &Sample::longest_s);
  row.makespan_s = estimate(samples, &Sample::makespan_s);
  row.driven_m = estimate(samples, &Sample::driven_m);
  for (const Sample& sample : samples) {
    row.lost += sample.lost;
    row.below_bound += sample.below_bound ? 1.0 : 0.0;
  }
  return row;
}

std::string text_of(const Estimate& estimate) {
  return fmt::format("{:.1f} +- {:.1f}", estimate.mean, estimate.half_width);
}

nlohmann::ordered_json json_of(const Estimate& estimate) {
  return {{"mean", estimate.mean}, {"half_width_95", estimate.half_width}};
}

constexpr const char* bound_name = "lower bound";

}  // namespace

Outcome<std::vector<ArrivalsRow>> measure_arrivals(const std::string& scenario_path, std::int64_t seeds) {
  auto yard = prepared(scenario_path, seeds);
  if (!yard) return pass_on(yard);
  std::vector<ArrivalsRow> rows;
  std::vector<Sample> samples(yard->watches.size());
  for (const auto& [objective, name] :
       {std::pair{ArrivalObjective::time_inside, "time_inside"}, {ArrivalObjective::makespan, "makespan"}}) {
    for (const ReplanPolicy& policy : replan_policies()) {
      parallel_for(samples.size(),
                   [&](std::size_t i) { samples[i] = sample_of(*yard, i, policy, objective); });
      rows.push_back(row_of(*yard, std::string(policy.name), name, samples));
    }
    parallel_for(samples.size(), [&](std::size_t i) {
      samples[i] = bound_of(yard->watches[i], yard->precomputed.on_the_move);
    });
    rows.push_back(row_of(*yard, bound_name, name, samples));
  }
  return rows;
}

std::string arrivals_table(const std::vector<ArrivalsRow>& rows) {
  std::string text =
      fmt::format("  {:<8} {:<12} {:<14} {:>5} {:>5} {:>16} {:>16} {:>20} {:>16}\n", "yard", "objective",
                  "policy", "runs", "lost", "inside s each", "longest s", "last s after entry", "driven m");
  for (const ArrivalsRow& row : rows) {
    const bool bound = row.policy == bound_name;
    text += fmt::format("  {:<8} {:<12} {:<14} {:>5} {:>5} {:>16} {:>16} {:>20} {:>16}\n", row.yard,
                        row.objective, row.policy, row.runs, bound ? "-" : fmt::format("{:.0f}", row.lost),
                        text_of(row.inside_s), bound ? "-" : text_of(row.longest_s), text_of(row.makespan_s),
                        bound ? "-" : text_of(row.driven_m));
  }
  return text;
}

nlohmann::ordered_json arrivals_json(const std::vector<ArrivalsRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const ArrivalsRow& row : rows) {
    nlohmann::ordered_json object = {{"yard", row.yard},
                                     {"objective", row.objective},
                                     {"policy", row.policy},
                                     {"runs", row.runs},
                                     {"inside_s", json_of(row.inside_s)},
                                     {"makespan_after_entry_s", json_of(row.makespan_s)}};
    if (row.policy != bound_name) {
      object["lost"] = row.lost;
      object["below_bound"] = row.below_bound;
      object["longest_s"] = json_of(row.longest_s);
      object["driven_m"] = json_of(row.driven_m);
    }
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace outrider::bench
