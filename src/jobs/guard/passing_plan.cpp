#include "outrider/jobs/guard/passing_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "assemble.hpp"
#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

constexpr double worth_s = 1e-9;  // the least gain that counts

/// Who is hit from where: from a stop of the plan, in order, or in passing.
struct Choice {
  std::vector<std::vector<std::size_t>> standing;  // targets, by stop of the plan
  std::vector<std::size_t> passing;
};

Choice choice_of(const GuardPlan& plan) {
  Choice choice;
  for (const PlannedStop& stop : plan.stops) {
    choice.standing.emplace_back();
    for (const PlannedHit& hit : stop.hits) choice.standing.back().push_back(hit.target);
  }
  return choice;
}

/// Every choice that takes all hits, or one, off a stop.
std::vector<Choice> lighter(const Choice& choice, std::size_t stop) {
  std::vector<Choice> result;
  const auto& targets = choice.standing[stop];
  if (targets.size() > 1) {
    Choice& next = result.emplace_back(choice);
    next.passing.insert(next.passing.end(), targets.begin(), targets.end());
    next.standing[stop].clear();
  }
  for (std::size_t k = 0; k < targets.size(); ++k) {
    Choice& next = result.emplace_back(choice);
    next.passing.push_back(targets[k]);
    next.standing[stop].erase(next.standing[stop].begin() + static_cast<std::ptrdiff_t>(k));
  }
  return result;
}

/// Makes plans of choices.
class Assembly {
 public:
  Assembly(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
           const Routes& routes)
      : problem_(problem),
        firing_map_(firing_map),
        plan_(plan),
        routes_(routes),
        passing_(problem, firing_map) {}

  /// Nothing when some target cannot be hit in passing.
  std::optional<GuardPlan> plan_of(const Choice& choice) {
    GuardPlan result = plan_;
    result.stops.clear();
    Pose2 pose = problem_.start;
    std::size_t place = 0;  // of the routes
    GunState rest;
    std::vector<std::size_t> left = choice.passing;
    for (std::size_t s = 0; s < choice.standing.size(); ++s) {
      if (choice.standing[s].empty()) continue;
      PlannedStop stop{plan_.stops[s].position, way(place, pose.heading_rad, s), {}};
      if (stop.waypoints.empty()) return std::nullopt;
      stop.passing = passing_.along(pose.heading_rad, stop.waypoints, rest, left);
      for (const PassingHit& hit : stop.passing) std::erase(left, hit.target);
      rest = gun_after(stop.waypoints, stop.passing, rest);
      pose = {stop.position, drive_cost(problem_.robot, pose.heading_rad, stop.waypoints).heading_rad};
      place = s + 1;
      for (const std::size_t target : choice.standing[s]) {
        const auto& shot = standing_shot(s, target, rest.pitch_rad);
        if (!shot) return std::nullopt;
        stop.hits.push_back({target, *shot});
        rest = {wrap_angle(shot->gun.yaw_rad - pose.heading_rad), shot->gun.pitch_rad};
      }
      result.stops.push_back(std::move(stop));
    }
    if (!left.empty()) return std::nullopt;
    result.cost_s = mission_time(problem_, firing_map_, result);
    return result;
  }

 private:
  /// The fastest drive from a place of the routes, with the turn before it.
  const std::vector<Vec2>& way(std::size_t place, double heading_rad, std::size_t stop) {
    const auto [entry, added] = ways_.try_emplace({place, stop, heading_rad});
    if (added) {
      const Vec2 from = place == 0 ? problem_.start.position : plan_.stops[place - 1].position;
      auto route = routes_.route({from, heading_rad}, plan_.stops[stop].position);
      entry->second = route ? std::move(route->waypoints) : routes_.waypoints(place, stop + 1);
    }
    return entry->second;
  }

  const std::optional<PlannedShot>& standing_shot(std::size_t stop, std::size_t target, double pitch_rad) {
    const auto [entry, added] = standing_.try_emplace({stop, target, pitch_rad});
    if (added) {
      entry->second = best_shot(firing_map_.rules, firing_map_.space(target), problem_.targets[target],
                                plan_.stops[stop].position, pitch_rad);
    }
    return entry->second;
  }

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  const GuardPlan& plan_;
  const Routes& routes_;
  PassingShots passing_;
  std::map<std::tuple<std::size_t, std::size_t, double>, std::vector<Vec2>> ways_;
  std::map<std::tuple<std::size_t, std::size_t, double>, std::optional<PlannedShot>> standing_;
};

const GuardPlan& sooner(const GuardPlan& standing, const GuardPlan& passing) {
  return passing.cost_s < standing.cost_s - worth_s ? passing : standing;
}

}  // namespace

GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop) {
  GuardPlan best = plan;
  bool fills = false, shoots = false;
  for (const PlannedStop& planned : plan.stops) {
    fills = fills || planned.call;
    shoots = shoots || !planned.hits.empty();
  }
  best.expected_s.reset();
  best.lower_bound_s = best.anywhere_lower_bound_s = 0.0;
  best.tour_proven = false;
  best.stops_offered = 0;
  best.on_the_move = !fills && !firing_map.rules.terrain;
  best.cost_s = mission_time(problem, firing_map, best);
  const GuardPlan standing = best;
  if (!shoots || fills || firing_map.rules.terrain || !standing.routes) return best;

  Assembly assembly(problem, firing_map, standing, *standing.routes);
  Choice choice = choice_of(plan);
  // Every candidate has its shots solved again, so the one that all are compared with has, too. That alone
  // may cost time, which is why the given plan is kept in mind.
  if (auto again = assembly.plan_of(choice)) best = std::move(*again);
  // Round after round over the stops, each made as light as helps, until a round changes nothing.
  for (std::size_t s = 0, unchanged = 0; unchanged < choice.standing.size();
       s = (s + 1) % choice.standing.size()) {
    ++unchanged;
    for (bool shorter = true; std::exchange(shorter, false);) {
      Choice chosen;
      for (Choice& next : lighter(choice, s)) {
        if (stop.stop_requested()) return sooner(standing, best);
        auto candidate = assembly.plan_of(next);
        if (!candidate || candidate->cost_s > best.cost_s - worth_s) continue;
        best = std::move(*candidate);
        chosen = std::move(next);
        shorter = true;
      }
      if (shorter) choice = std::move(chosen), unchanged = 0;
    }
  }
  return sooner(standing, best);
}

}  // namespace outrider
