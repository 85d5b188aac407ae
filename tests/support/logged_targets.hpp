// The targets of a log: the newest message of each name, and its places.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "support/logged_run.hpp"

namespace outrider::testing {

struct TargetPlace {
  double time_s = 0.0;
  Vec3 centre;
  Vec2 believed;  ///< by the robot
};

/// A target in the end; `status`, `reason` and the like are those of its newest message.
struct LoggedTarget : outrider_msgs::Target {
  double done_s = 0.0;              ///< when its status became that
  std::vector<TargetPlace> places;  ///< it goes straight from each to the next

  [[nodiscard]] bool comes_in() const { return !entrance.empty(); }
  /// When it comes in by its entrance; infinite if it never did.
  [[nodiscard]] double enters_s() const { return time_of_place(0); }
  /// When it reaches the place of its own.
  [[nodiscard]] double settles_s() const { return time_of_place(1); }
  /// Its places from the one where it settled on: one if it never moved after that.
  [[nodiscard]] std::span<const TargetPlace> moves() const {
    const std::size_t way_in = comes_in() ? 1 : 0;
    return std::span(places).subspan(std::min(way_in, places.size()));
  }

 private:
  [[nodiscard]] double time_of_place(std::size_t i) const {
    return i < places.size() ? places[i].time_s : std::numeric_limits<double>::infinity();
  }
};

/// The targets of a log, in the order of their first messages.
inline std::vector<LoggedTarget> targets_of(const Log& log) {
  std::vector<LoggedTarget> targets;
  std::map<std::string, std::size_t> numbers;
  for (const auto& stamped : log.messages<outrider_msgs::Target>(topic::targets)) {
    const auto [found, added] = numbers.try_emplace(stamped.message.name, targets.size());
    if (added) targets.emplace_back();
    LoggedTarget& target = targets[found->second];
    if (target.status != stamped.message.status) target.done_s = stamped.time_s();
    static_cast<outrider_msgs::Target&>(target) = stamped.message;
  }
  for (const auto& stamped : log.messages<outrider_msgs::TargetPosition>(topic::target_positions)) {
    const auto& place = stamped.message;
    const auto found = numbers.find(place.name);
    if (found == numbers.end()) continue;
    targets[found->second].places.push_back(
        {stamped.time_s(), vec3_of(place.centre), vec2_of(place.believed)});
  }
  return targets;
}

}  // namespace outrider::testing
