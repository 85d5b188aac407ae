#include <algorithm>
#include <limits>

#include "outrider/jobs/guard/mission/task_board.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

/// A place for a new task.
struct Detour {
  std::size_t after = 0;  // task that it follows
  Vec2 place;
  double longer_m = std::numeric_limits<double>::infinity();  // than without it, along straight lines
};

/// The shortest detour to one of the cells, after some task before the next call at a station.
Detour shortest_detour(const std::deque<StopTask>& queue, const FiringMap& firing_map,
                       const std::vector<std::size_t>& cells) {
  Detour best{0, queue.front().place};
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const Vec2 from = queue[k].place;
    const bool last = k + 1 == queue.size();
    for (const std::size_t cell : cells) {
      const Vec2 place = firing_map.place(cell);
      double longer_m = distance(from, place);
      if (!last)
        longer_m = longer_m + distance(place, queue[k + 1].place) - distance(from, queue[k + 1].place);
      if (longer_m < best.longer_m) best = {k, place, longer_m};
    }
    if (!last && queue[k + 1].call) return best;
  }
  return best;
}

}  // namespace

void TaskBoard::stop_for(std::size_t record) {
  const std::vector<std::size_t> sure = sure_cells(*problem_, *firing_map_, target_of(record));
  for (StopTask& task : queue_) {
    const auto cell = firing_map_->cell_of(task.place);
    if (task.call || !cell || !std::ranges::binary_search(sure, *cell)) continue;
    task.targets.push_back(record);
    return;
  }
  if (queue_.empty()) {
    const Vec2 here = last_place_;
    queue_.push_back({nearest_place(*firing_map_, sure, here, 0.0).value_or(here), {record}});
    arrived_ = false;
    return;
  }
  const Detour detour = shortest_detour(queue_, *firing_map_, sure);
  queue_.insert(queue_.begin() + static_cast<std::ptrdiff_t>(detour.after) + 1,
                StopTask{detour.place, {record}});
}

}  // namespace outrider
