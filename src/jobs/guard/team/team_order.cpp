#include "team/team_order.hpp"

#include <algorithm>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

bool come_near(const std::vector<Vec2>& one, const std::vector<Vec2>& other, double gap_m) {
  for (std::size_t i = 1; i < one.size(); ++i) {
    for (std::size_t k = 1; k < other.size(); ++k) {
      if (distance(Segment{one[i - 1], one[i]}, Segment{other[k - 1], other[k]}) < gap_m) return true;
    }
  }
  return false;
}

/// Returns true if the drive to a stop has not begun.
bool is_to_come(const TaskBoard& board, Vec2 place) {
  const auto& queue = board.queue();
  const auto first = queue.begin() + (board.arrived() && !queue.empty() ? 1 : 0);
  return std::any_of(first, queue.end(), [&](const StopTask& task) { return task.place == place; });
}

}  // namespace

std::optional<std::size_t> TeamOrder::waits_for(std::size_t robot, Vec2 place,
                                                const std::vector<Vec2>& waypoints,
                                                const std::vector<const TaskBoard*>& tasks) const {
  const TeamPart& own = plan_.parts[robot];
  const auto stop = std::ranges::find(own.plan.stops, place, &PlannedStop::position);
  const auto number = static_cast<std::size_t>(stop - own.plan.stops.begin());
  if (number >= own.turns.size()) return std::nullopt;
  for (std::size_t other = 0; other < plan_.parts.size(); ++other) {
    const TeamPart& part = plan_.parts[other];
    for (std::size_t k = 0; other != robot && k < part.turns.size(); ++k) {
      const PlannedStop& before = part.plan.stops[k];
      if (part.turns[k] < own.turns[number] && is_to_come(*tasks[other], before.position) &&
          come_near(waypoints, before.waypoints, gap_m_))
        return other;
    }
  }
  return std::nullopt;
}

}  // namespace outrider
