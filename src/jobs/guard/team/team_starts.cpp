#include "outrider/jobs/guard/team/team_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace outrider {
namespace {

/// The next start beside the first one, so far apart from those chosen before.
std::optional<Vec2> next_start(const GuardProblem& problem, const FiringMap& firing_map,
                               const std::vector<Pose2>& chosen, double gap_m) {
  const Vec2 ahead = direction(problem.start.heading_rad);
  std::optional<Vec2> best;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < firing_map.frame.size(); ++c) {
    if (firing_map.reachable[c] == 0) continue;
    const Vec2 place = firing_map.place(c);
    const Vec2 away = place - problem.start.position;
    const double beside_m = std::abs(cross(ahead, away)) + 2.0 * std::abs(dot(ahead, away));
    if (beside_m >= least_m) continue;
    const auto is_near = [&](const Pose2& other) { return distance(place, other.position) < gap_m; };
    if (std::ranges::any_of(chosen, is_near)) continue;
    best = place;
    least_m = beside_m;
  }
  return best;
}

}  // namespace

Outcome<std::vector<Pose2>> starts_of_team(const GuardProblem& problem, const FiringMap& firing_map,
                                           std::size_t robots, const std::vector<Pose2>& others) {
  std::vector<Pose2> starts;
  for (const double gaps : {2.0, 1.0}) {
    starts.assign({problem.start});
    starts.insert(starts.end(), others.begin(), others.end());
    while (starts.size() < robots) {
      const auto place = next_start(problem, firing_map, starts, gaps * simulated_gap_m(problem));
      if (!place) break;
      starts.push_back({*place, problem.start.heading_rad});
    }
    if (starts.size() >= robots) break;
  }
  if (starts.size() < robots)
    return bad_input(fmt::format("there is free ground for {} of {} robots, which start {:.2f} m apart; "
                                 "set robots to {} at most",
                                 starts.size(), robots, simulated_gap_m(problem), starts.size()),
                     "robots");
  if (auto ok = check_starts(problem, firing_map, starts); !ok)
    return bad_input(ok.error().sentence, "robot_starts");
  return starts;
}

}  // namespace outrider
