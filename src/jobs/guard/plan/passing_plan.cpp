#include "outrider/jobs/guard/plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plan/hit_table.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr double worth_s = 1e-9;      // the least gain that counts
constexpr double nearer_s = 0.02;     // by which a moved stop has to shorten the drives
constexpr double first_step_m = 0.8;  // of a stop that is moved
constexpr double last_step_m = 0.05;

/// Returns every table that takes all hits, or one, off a stop.
std::vector<HitTable> lighter(const HitTable& table, std::size_t stop) {
  std::vector<HitTable> result;
  const auto& targets = table.stops[stop].targets;
  if (targets.size() > 1) {
    HitTable& next = result.emplace_back(table);
    auto& passing = next.passing_beside(stop);
    passing.insert(passing.end(), targets.begin(), targets.end());
    next.stops[stop].targets.clear();
  }
  for (std::size_t k = 0; k < targets.size(); ++k) {
    HitTable& next = result.emplace_back(table);
    next.passing_beside(stop).push_back(targets[k]);
    auto& left = next.stops[stop].targets;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return result;
}

/// Makes a plan shorter by changes of one stop at a time.
class Descent {
 public:
  Descent(TablePlanner& planner, HitTable table, GuardPlan plan, const std::stop_token& stop)
      : planner_(planner),
        table_(std::move(table)),
        best_(std::move(plan)),
        expected_s_(planner.expected_s(best_)),
        stop_(stop) {}

  GuardPlan run() {
    while (lighten() || move_stops()) {
    }
    return std::move(best_);
  }

 private:
  /// Takes the table if its plan is shorter, with the waits that are to be expected.
  bool take(HitTable& next) {
    auto plan = planner_.plan_of(next);
    if (!plan || plan->cost_s > expected_s_ - worth_s) return false;
    const double expected_s = planner_.expected_s(*plan);
    if (expected_s > expected_s_ - worth_s) return false;
    best_ = std::move(*plan);
    expected_s_ = expected_s;
    table_ = std::move(next);
    return true;
  }

  /// Round after round over the stops, each made as light as helps, until a round changes nothing.
  bool lighten() {
    bool shorter = false;
    const std::size_t stops = table_.stops.size();
    for (std::size_t s = 0, unchanged = 0; unchanged < stops && !stop_.stop_requested();
         s = (s + 1) % stops) {
      ++unchanged;
      while (lighten(s)) shorter = true, unchanged = 0;
    }
    return shorter;
  }

  /// The best of the changes that make a stop lighter.
  bool lighten(std::size_t s) {
    bool shorter = false;
    for (HitTable& next : lighter(std::as_const(table_), s)) shorter = take(next) || shorter;
    return shorter;
  }

  /// Moves each stop to where the drives are shorter, in steps that become smaller.
  bool move_stops() {
    bool shorter = false;
    for (std::size_t s = 0; s < table_.stops.size(); ++s) {
      for (double step = first_step_m; step > 0.5 * last_step_m; step *= 0.5) {
        while (move_stop(s, step)) shorter = true;
      }
    }
    return shorter;
  }

  bool move_stop(std::size_t s, double step_m) {
    if (table_.stops[s].targets.empty() || stop_.stop_requested()) return false;
    const double before_s = planner_.drives_s(table_);
    for (int k = 0; k < 8; ++k) {
      HitTable next = table_;
      next.stops[s].place = next.stops[s].place + step_m * direction(k * pi / 4);
      if (!planner_.may_stop(next.stops[s].place, next.stops[s].targets)) continue;
      if (planner_.drives_s(next) > before_s - nearer_s) continue;
      if (take(next)) return true;
    }
    return false;
  }

  TablePlanner& planner_;
  HitTable table_;
  GuardPlan best_;
  double expected_s_ = 0.0;
  std::stop_token stop_;
};

const GuardPlan& sooner(const GuardPlan& standing, const GuardPlan& passing) {
  return passing.cost_s < standing.cost_s - worth_s ? passing : standing;
}

}  // namespace

GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop) {
  GuardPlan best = plan;
  const bool shoots =
      std::ranges::any_of(plan.stops, [](const PlannedStop& stop) { return !stop.hits.empty(); });
  best.expected_s.reset();
  best.lower_bound_s = best.anywhere_lower_bound_s = 0.0;
  best.tour_proven = false;
  best.stops_offered = 0;
  best.on_the_move = true;
  best.cost_s = mission_time(problem, firing_map, best);
  const GuardPlan standing = best;
  if (!shoots || !standing.routes) return best;

  TablePlanner planner(problem, firing_map, standing);
  HitTable table = hit_table_of(plan);
  // Every candidate has its shots solved again, so the one that all are compared with has, too. That alone
  // may cost time, which is why the given plan is kept in mind.
  if (auto again = planner.plan_of(table)) best = std::move(*again);
  return sooner(standing, Descent(planner, std::move(table), std::move(best), stop).run());
}

}  // namespace outrider
