#include "outrider/jobs/guard/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/log/append.hpp"

namespace outrider {
namespace {

constexpr double longest_walk_s = 7200.0;  // walkers stay at their last place then

Outcome<Report> run_arrivals(const ArrivalYard& yard, const PrecomputedStops& stops, const Policy& policy,
                             std::int64_t beam, const ArrivalOptions& arrivals, const GuardOptions& options,
                             std::uint64_t seed, Log& log, const RunWatch& watch,
                             const GuardSimParams& faults) {
  const ArrivalPlan plan{yard,
                         stops,
                         policy.replan,
                         policy.objective,
                         static_cast<std::size_t>(arrivals.group),
                         static_cast<std::size_t>(beam)};
  const GuardPlan none;
  return run_guard({.problem = yard.problem,
                    .firing_map = yard.firing_map,
                    .plan = none,
                    .options = options,
                    .seed = seed,
                    .arrivals = plan,
                    .survival = {arrivals.leave, arrivals.walk_mps},
                    .faults = faults},
                   log, watch);
}

}  // namespace

Outcome<Report> simulate_arriving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const std::vector<Intruder>& intruders,
                                          const ArrivalOptions& arrivals, const GuardOptions& options,
                                          std::uint64_t seed, Log& log, const RunWatch& watch,
                                          const GuardSimParams& faults) {
  const auto policy = find_replan_policy(arrivals.policy);
  if (!policy) return tl::unexpected<Fault>(policy.error());
  const auto objective = find_objective(arrivals.objective);
  if (!objective) return tl::unexpected<Fault>(objective.error());
  const auto yard = arrival_yard(problem, firing_map, intruders);
  if (!yard) return tl::unexpected<Fault>(yard.error());
  const auto stops = precompute_stops(problem, firing_map, plan, arrivals, watch.budget());
  if (!stops) return tl::unexpected<Fault>(stops.error());
  return run_arrivals(*yard, *stops, {*policy, *objective}, arrivals.beam, arrivals, options, seed, log,
                      watch, faults);
}

Outcome<Report> simulate_surviving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& arrivals,
                                           const GuardOptions& options, std::uint64_t seed, Log& log,
                                           const RunWatch& watch, const GuardSimParams& faults) {
  const auto yard = arrival_yard(problem, firing_map, settled_intruders(problem));
  if (!yard) return tl::unexpected<Fault>(yard.error());
  const auto stops = precompute_stops(problem, firing_map, plan, arrivals, watch.budget());
  if (!stops) return tl::unexpected<Fault>(stops.error());
  const ArrivalOptions quick = survivor_options(arrivals);
  const auto [policy, expected] = best_policy(problem, *stops, quick, survivor_missions, watch.stop);
  if (watch.stopped()) return fault(FaultCode::cancelled, "it was cancelled while it chose how to plan");
  log_event(log, 0.0, "plan",
            fmt::format("expects {:.1f} s, to a standard error of {:.1f} s; plans as {}, for the {}",
                        expected.mean_s, expected.error_s, policy.replan.name,
                        policy.objective == ArrivalObjective::makespan ? "makespan" : "time inside"));
  auto report = run_arrivals(*yard, *stops, policy, quick.beam, arrivals, options, seed, log, watch, faults);
  if (!report) return report;
  report->metrics.emplace_back("expected_s", expected.mean_s);
  report->metrics.emplace_back("expected_error_s", expected.error_s);
  return report;
}

Outcome<Report> simulate_moving_targets(const GuardProblem& problem, const FiringMap& firing_map,
                                        const std::vector<double>& weights, const std::vector<Track>& history,
                                        const WanderOptions& wander, const GuardOptions& options,
                                        std::uint64_t seed, Log& log, const RunWatch& watch,
                                        const GuardSimParams& faults) {
  const auto walks = draw_walks(problem, firing_map, weights, wander, seed, longest_walk_s, watch.budget());
  if (!walks) return tl::unexpected<Fault>(walks.error());
  const auto plan = plan_moving(problem, firing_map, visit_map(problem, firing_map, history, wander), options,
                                wander, watch.budget());
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const GuardPlan none;
  return run_guard({.problem = problem,
                    .firing_map = firing_map,
                    .plan = none,
                    .options = options,
                    .seed = seed,
                    .walkers = WalkerRun{*plan, *walks},
                    .faults = faults},
                   log, watch);
}

}  // namespace outrider
