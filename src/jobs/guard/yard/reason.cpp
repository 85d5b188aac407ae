#include "outrider/jobs/guard/yard/firing_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

/// Returns the best blocked flight in words, as the end of a sentence; empty if there is none.
std::string nearest_words(const std::optional<BlockedFlight>& blocked, const FlightSpace& space) {
  if (!blocked) return "";
  const std::string from =
      fmt::format("; the best flight, from ({:.2f}, {:.2f}) at {:.0f} degrees", blocked->position.x,
                  blocked->position.y, degrees(blocked->shot.pitch_rad));
  const std::string where =
      fmt::format("({:.2f}, {:.2f}, {:.2f})", blocked->at.x, blocked->at.y, blocked->at.z);
  const std::string& what = space.solids()[blocked->solid].name;
  if (blocked->impact.hit) {
    return fmt::format("{}, would hit and passes {} at {} with {:.3f} m to spare", from, what, where,
                       blocked->clearance_m);
  }
  return fmt::format("{}, touches {} at {}, {:.2f} m from the target", from, what, where, blocked->short_m);
}

}  // namespace

std::string why_unreachable(const GuardProblem& problem, const FiringMap& firing_map,
                            const GuardOptions& options, std::size_t target) {
  const Exhausted& tried = *firing_map.no_shots[target].exhausted;
  if (tried.places == 0) {
    return fmt::format("no place that can be driven to is within reach of it ({:.1f} m at {:g} m/s)",
                       longest_range(firing_map.rules, problem.targets[target]),
                       problem.gun.muzzle_speed_mps);
  }
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < tried.blocked_by.size(); ++s) {
    if (tried.blocked_by[s] > 0) order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tried.blocked_by[a] > tried.blocked_by[b]; });
  std::string who;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) {
    who += fmt::format(
        "{}{} stops {:.0f} %", i == 0 ? "" : ", ", firing_map.space(target).solids()[order[i]].name,
        100.0 * static_cast<double>(tried.blocked_by[order[i]]) / static_cast<double>(tried.flights));
  }
  return fmt::format(
      "none of {} flights from the {} places within reach hits it with {:g} m to spare ({}); places every "
      "{:g} m, pitches every {:g} degrees, aim points every {:g} m{}{}",
      tried.flights, tried.places, options.margin_m, who, options.resolution_m,
      degrees(options.pitch_step_rad), options.aim_step_m,
      firing_map.no_shots[target].from_elsewhere ? "; from ground that cannot be driven to it could be hit"
                                                 : "",
      nearest_words(firing_map.no_shots[target].blocked, firing_map.space(target)));
}

}  // namespace outrider
