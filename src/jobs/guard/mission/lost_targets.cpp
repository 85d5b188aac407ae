#include "outrider/jobs/guard/mission/task_board.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "outrider/jobs/guard/plan/passing.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

constexpr double worth_m = 1.0;  // by which a stop before the present one is the shorter detour

/// A place for a new task.
struct Detour {
  std::size_t after = 0;  // task that it follows
  Vec2 place;
  double longer_m = std::numeric_limits<double>::infinity();  // than without it, along straight lines
};

/// The cell that makes the straight way between two places least longer.
Detour detour_between(const FiringMap& firing_map, const std::vector<std::size_t>& cells, Vec2 from,
                      Vec2 to) {
  Detour best{0, from};
  for (const std::size_t cell : cells) {
    const Vec2 place = firing_map.frame.centre(firing_map.frame.cell(cell));
    const double longer_m = distance(from, place) + distance(place, to) - distance(from, to);
    if (longer_m < best.longer_m) best = {0, place, longer_m};
  }
  return best;
}

/// The shortest detour to one of the cells, after some task before the next call at a station.
Detour shortest_detour(const std::deque<StopTask>& queue, const FiringMap& firing_map,
                       const std::vector<std::size_t>& cells) {
  Detour best{0, queue.front().place};
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const Vec2 from = queue[k].place;
    const bool last = k + 1 == queue.size();
    Detour detour{0, from};
    if (!last) detour = detour_between(firing_map, cells, from, queue[k + 1].place);
    if (const auto place = nearest_place(firing_map, cells, from, 0.0); last && place)
      detour = {0, *place, distance(from, *place)};
    if (detour.longer_m < best.longer_m) best = {k, detour.place, detour.longer_m};
    if (!last && queue[k + 1].call) return best;
  }
  return best;
}

bool is_among(const FiringMap& firing_map, const std::vector<std::size_t>& sure, Vec2 place) {
  const Cell cell = firing_map.frame.cell_at(place);
  return firing_map.frame.contains(cell) && std::ranges::binary_search(sure, firing_map.frame.index(cell));
}

}  // namespace

/// The first of the stops to come from which a target with these sure cells is hit; the end if there is none.
std::deque<StopTask>::iterator TaskBoard::stop_among(const std::vector<std::size_t>& sure) {
  return std::ranges::find_if(
      queue_, [&](const StopTask& task) { return !task.call && is_among(*firing_map_, sure, task.place); });
}

/// Splits the shots planned for the drive to the present task between the drives before and after a stop on
/// the way. Nothing if one of them could not be fired then.
std::optional<std::vector<std::size_t>> TaskBoard::planned_before(const std::vector<std::size_t>& lost,
                                                                  Vec2 place, const Observation& seen) const {
  std::vector<std::size_t> planned = queue_.front().passing;
  std::erase_if(planned, [&](std::size_t record) { return std::ranges::count(lost, record) > 0; });
  PassingShots solver(*problem_, *firing_map_);
  const auto hit_along = [&](const Pose2& from, Vec2 to, GunState& gun, double& heading_rad) {
    const std::vector<Vec2> way = way_between(from, to).value_or(std::vector<Vec2>{from.position});
    std::vector<std::size_t> targets;
    targets.reserve(planned.size());
    for (const std::size_t record : planned) targets.push_back(target_of(record));
    const auto hits = solver.along(from.heading_rad, way, gun, targets);
    gun = gun_after(hits, gun);
    if (way.size() > 1) heading_rad = heading_of(way.back() - way[way.size() - 2]);
    std::vector<std::size_t> hit;
    for (const PassingHit& one : hits) {
      const auto nth = std::ranges::find(targets, one.target) - targets.begin();
      hit.push_back(planned[static_cast<std::size_t>(nth)]);
    }
    std::erase_if(planned, [&](std::size_t record) { return std::ranges::count(hit, record) > 0; });
    return hit;
  };
  GunState gun = seen.gun.value_or(GunState{});
  double heading_rad = seen.odometry.heading_rad;
  auto before = hit_along(seen.odometry, place, gun, heading_rad);
  hit_along({place, heading_rad}, queue_.front().place, gun, heading_rad);
  if (!planned.empty()) return std::nullopt;
  return before;
}

/// Shoots first from where the robot stands.
bool TaskBoard::stays_for(std::vector<std::size_t> records, Vec2 here) {
  if (records.empty()) return false;
  for (const std::size_t record : records) std::erase(queue_.front().passing, record);
  queue_.push_front(StopTask{here, std::move(records)});
  return true;
}

void TaskBoard::stop_for(std::size_t record) {
  const std::vector<std::size_t> sure = SureCells(*problem_, *firing_map_).of(target_of(record));
  if (const auto task = stop_among(sure); task != queue_.end()) {
    task->targets.push_back(record);
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

bool TaskBoard::stops_first(const std::vector<std::size_t>& records, const Observation& seen) {
  const SureCells cells(*problem_, *firing_map_);
  const Vec2 here = seen.odometry.position;
  std::vector<std::size_t> from_here;
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> elsewhere;  // with their sure cells
  for (const std::size_t record : records) {
    std::vector<std::size_t> sure = cells.of(target_of(record));
    if (stop_among(sure) != queue_.end()) continue;
    if (is_among(*firing_map_, sure, here)) {
      from_here.push_back(record);
    } else {
      elsewhere.emplace_back(record, std::move(sure));
    }
  }
  if (stays_for(std::move(from_here), here)) return true;
  if (queue_.front().call) return false;
  for (const auto& [record, sure] : elsewhere) {
    const Detour before = detour_between(*firing_map_, sure, here, queue_.front().place);
    if (before.longer_m + worth_m > shortest_detour(queue_, *firing_map_, sure).longer_m) continue;
    auto shots = planned_before(records, before.place, seen);
    if (!shots) continue;
    std::erase_if(queue_.front().passing,
                  [&](std::size_t one) { return one == record || std::ranges::count(*shots, one) > 0; });
    queue_.push_front(StopTask{before.place, {record}, {}, std::move(*shots)});
    return true;
  }
  return false;
}

}  // namespace outrider
