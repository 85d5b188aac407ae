#include "outrider/jobs/guard/team/team_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"
#include "plan/draft.hpp"
#include "team/team_schedule.hpp"
#include "team/team_split.hpp"

namespace outrider {
namespace {

constexpr double spare_m = 0.02;
constexpr int most_splits = 3;  // that are planned

/// The targets by their bearing from the first start, from behind the robot on, counter-clockwise.
std::vector<std::size_t> by_bearing(const GuardProblem& problem, std::vector<std::size_t> targets) {
  const auto bearing = [&](std::size_t t) {
    return wrap_angle(heading_of(xy(problem.targets[t].base) - problem.start.position) -
                      problem.start.heading_rad);
  };
  std::ranges::stable_sort(targets, {}, bearing);
  return targets;
}

/// Plans a team, split after split.
class TeamPlanner {
 public:
  TeamPlanner(const GuardProblem& problem, const FiringMap& firing_map, const std::vector<Pose2>& starts,
              const GuardOptions& options, const Budget& budget)
      : firing_map_(firing_map),
        options_(options),
        budget_(budget),
        problems_(starts.size(), problem),
        planned_(starts.size()) {
    for (std::size_t r = 0; r < starts.size(); ++r) problems_[r].start = starts[r];
  }

  Outcome<TeamPlan> run() {
    auto alone = plan_guard(problems_.front(), firing_map_, options_, budget_);
    if (!alone) return pass_on(alone);
    best_.alone_s = alone->cost_s;
    best_.unreachable = alone->unreachable;
    const std::vector<std::size_t> order = alone->targets();
    std::vector<GuardPlan> plans(problems_.size());
    plans.front() = *alone;
    keep_if_sooner(plans);
    if (auto ok = try_splits(*alone, order); !ok) return pass_on(ok);
    for (std::size_t r = 1; best_.parts.empty() && r < problems_.size(); ++r) {
      TargetSplit all_to_one(problems_.size());
      all_to_one[r] = order;
      if (auto planned = plan_split(all_to_one); !planned) return pass_on(planned);
    }
    if (best_.parts.empty())
      return fault(FaultCode::no_path,
                   "the robots stand in each other's way in every order of their drives that was tried; give "
                   "other starts or fewer robots");
    std::vector<Pose2> starts;
    for (const GuardProblem& problem : problems_) starts.push_back(problem.start);
    best_.lower_bound_s = team_bound(problems_.front(), firing_map_, order, starts, options_, budget_);
    return std::move(best_);
  }

 private:
  /// Stops and drives for estimates, with the starts of all robots among the stops.
  Outcome<StopTable> stops_for_estimates(const GuardPlan& alone) const {
    std::vector<Vec2> others;
    others.reserve(problems_.size());
    for (std::size_t r = 1; r < problems_.size(); ++r) others.push_back(problems_[r].start.position);
    auto stops = precompute_stops(problems_.front(), firing_map_, alone, usual_stops, budget_, others);
    if (!stops || !alone.on_the_move) return stops;
    for (auto& services : stops->table.services) {
      for (Service& service : services) service.duration_s = 0.0;  // most balls are not waited for
    }
    return stops;
  }

  /// The split with the least estimated makespan, cut out of several orders of the targets.
  static TargetSplit best_split(SplitSearch& search, const std::vector<std::vector<std::size_t>>& orders) {
    TargetSplit best = search.improve(search.cut(orders.front()));
    for (std::size_t k = 1; k < orders.size(); ++k) {
      TargetSplit other = search.improve(search.cut(orders[k]));
      if (search.makespan_s(other) < search.makespan_s(best)) best = std::move(other);
    }
    return best;
  }

  Status try_splits(const GuardPlan& alone, const std::vector<std::size_t>& order) {
    const auto stops = stops_for_estimates(alone);
    if (!stops) return pass_on(stops);
    std::vector<SplitStart> starts{{0, problems_.front().start.heading_rad}};
    for (std::size_t r = 1; r < problems_.size(); ++r)
      starts.push_back({stops->stops.size() - problems_.size() + r, problems_[r].start.heading_rad});
    SplitSearch search(*stops, std::move(starts), budget_);
    const std::vector<std::vector<std::size_t>> orders{order, by_bearing(problems_.front(), order),
                                                       search.by_way(order)};
    for (int i = 0; i < most_splits; ++i) {
      if (budget_.stop.stop_requested())
        return fault(FaultCode::cancelled, "it was cancelled while it split the targets");
      TargetSplit split = best_split(search, orders);
      auto planned = plan_split(split);
      if (!planned) return pass_on(planned);
      if (*planned == Planned::before) break;
      if (*planned == Planned::blocked) {
        split = uncross(split);
        if (auto again = plan_split(split); !again) return pass_on(again);
      }
      for (std::size_t r = 0; r < split.size(); ++r) {
        const double estimate_s = search.estimate_s(r, split[r]);
        if (estimate_s > 0.0) search.set_factor(r, planned_[r].cost_s / estimate_s);
      }
    }
    return {};
  }

  /// The outcome of planning a split.
  enum class Planned : std::uint8_t { timed, blocked, before };

  /// Gives the parts of the split that was planned last to the robots such that the sum of the squared
  /// distances from their starts to the first stops is least: ways of robots that start side by side cross no
  /// more.
  [[nodiscard]] TargetSplit uncross(const TargetSplit& split) const {
    std::vector<std::size_t> part_of(split.size());
    std::iota(part_of.begin(), part_of.end(), std::size_t{0});
    std::vector<std::size_t> best = part_of;
    double least = std::numeric_limits<double>::infinity();
    do {
      double sum = 0.0;
      for (std::size_t r = 0; r < split.size(); ++r) {
        const auto& stops = planned_[part_of[r]].stops;
        if (stops.empty()) continue;
        const double way_m = distance(problems_[r].start.position, stops.front().position);
        sum += way_m * way_m;
      }
      if (sum >= least) continue;
      least = sum;
      best = part_of;
    } while (std::next_permutation(part_of.begin(), part_of.end()));
    TargetSplit uncrossed;
    for (const std::size_t part : best) uncrossed.push_back(split[part]);
    return uncrossed;
  }

  /// Plans the parts of a split, and keeps the team if it is the soonest.
  Outcome<Planned> plan_split(const TargetSplit& split) {
    bool changed = false;
    for (std::size_t r = 0; r < split.size(); ++r) {
      std::vector<std::size_t> targets = split[r];
      std::ranges::sort(targets);
      if (targets == targets_of_[r]) continue;
      auto plan = plan_part(problems_[r], firing_map_, targets, options_, budget_);
      if (!plan) return pass_on(plan);
      planned_[r] = std::move(*plan);
      targets_of_[r] = std::move(targets);
      changed = true;
    }
    const bool whole =
        std::ranges::all_of(planned_, [](const GuardPlan& p) { return p.unreachable.empty(); });
    if (!changed) return Planned::before;
    return !whole || keep_if_sooner(planned_) ? Planned::timed : Planned::blocked;
  }

  /// Puts the plans in time, and keeps them if the team is sooner than the best so far. Returns false if no
  /// order was found in which the robots keep apart.
  bool keep_if_sooner(const std::vector<GuardPlan>& plans) {
    std::vector<TeamMember> team;
    team.reserve(plans.size());
    for (std::size_t r = 0; r < plans.size(); ++r) team.push_back({problems_[r], plans[r]});
    auto times = schedule_team(firing_map_, team, team_gap_m(problems_.front()));
    if (!times) times = schedule_team(firing_map_, team, simulated_gap_m(problems_.front()));
    if (!times) return false;
    double makespan_s = 0.0;
    for (const MemberTimes& of_robot : *times) makespan_s = std::max(makespan_s, of_robot.end_s);
    if (!best_.parts.empty() && makespan_s >= best_.makespan_s) return true;
    best_.makespan_s = makespan_s;
    best_.parts.clear();
    for (std::size_t r = 0; r < plans.size(); ++r)
      best_.parts.push_back({problems_[r].start, plans[r], std::move((*times)[r])});
    return true;
  }

  const FiringMap& firing_map_;
  const GuardOptions& options_;
  const Budget& budget_;
  std::vector<GuardProblem> problems_;  // by robot
  std::vector<GuardPlan> planned_;      // by robot, of the last split
  TargetSplit targets_of_ = TargetSplit(planned_.size());
  TeamPlan best_;
};

}  // namespace

double simulated_gap_m(const GuardProblem& problem) {
  return 2.0 * (problem.robot.radius_m + problem.errors.position_m) + spare_m;
}

double team_gap_m(const GuardProblem& problem) {
  return simulated_gap_m(problem) + problem.errors.position_m;
}

Status check_starts(const GuardProblem& problem, const FiringMap& firing_map,
                    const std::vector<Pose2>& starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto& [place, heading] = starts[i];
    if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(heading))
      return bad_input(fmt::format("the start of robot {} has a number that is not finite", i + 1));
    const auto cell = firing_map.cell_of(place);
    const bool reached = cell && firing_map.reachable[*cell] != 0 &&
                         firing_map.ground.clearance(place, 1.0) >= problem.robot.radius_m - 1e-9;
    if (i > 0 && !reached)
      return bad_input(
          fmt::format("robot {} at {:.2f},{:.2f} is not on free ground that is connected with "
                      "the start of robot 1; give another start",
                      i + 1, place.x, place.y));
    for (std::size_t k = 0; k < i; ++k) {
      const double apart_m = distance(place, starts[k].position);
      if (apart_m >= simulated_gap_m(problem)) continue;
      return bad_input(
          fmt::format("robots {} and {} start {:.2f} m apart; give starts at least {:.2f} m apart", k + 1,
                      i + 1, apart_m, simulated_gap_m(problem)));
    }
  }
  return {};
}

Outcome<TeamPlan> plan_team(const GuardProblem& problem, const FiringMap& firing_map,
                            const std::vector<Pose2>& starts, const GuardOptions& options,
                            const Budget& budget) {
  if (starts.empty()) return bad_input("a team needs at least one robot");
  if (auto ok = check_starts(problem, firing_map, starts); !ok) return pass_on(ok);
  return TeamPlanner(problem, firing_map, starts, options, budget).run();
}

}  // namespace outrider
