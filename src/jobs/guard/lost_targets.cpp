#include "lost_targets.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "flying_balls.hpp"
#include "outrider/jobs/guard/passing.hpp"
#include "outrider/jobs/guard/stops.hpp"

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
Detour shortest_detour(const StopTasks& tasks, const FiringMap& firing_map,
                       const std::vector<std::size_t>& cells) {
  Detour best{0, tasks.queue.front().place};
  for (std::size_t k = 0; k < tasks.queue.size(); ++k) {
    const Vec2 from = tasks.queue[k].place;
    const bool last = k + 1 == tasks.queue.size();
    Detour detour{0, from};
    if (!last) detour = detour_between(firing_map, cells, from, tasks.queue[k + 1].place);
    if (const auto place = nearest_place(firing_map, cells, from, 0.0); last && place)
      detour = {0, *place, distance(from, *place)};
    if (detour.longer_m < best.longer_m) best = {k, detour.place, detour.longer_m};
    if (!last && tasks.queue[k + 1].call) return best;
  }
  return best;
}

bool is_among(const FiringMap& firing_map, const std::vector<std::size_t>& sure, Vec2 place) {
  const Cell cell = firing_map.frame.cell_at(place);
  return firing_map.frame.contains(cell) && std::ranges::binary_search(sure, firing_map.frame.index(cell));
}

/// The first of the stops to come from which a target with these sure cells is hit; the end if there is none.
auto stop_among(StopTasks& tasks, const FiringMap& firing_map, const std::vector<std::size_t>& sure) {
  return std::ranges::find_if(tasks.queue, [&](const StopTask& task) {
    return !task.call && is_among(firing_map, sure, task.place);
  });
}

/// Splits the shots planned for the drive to the present task between the drives before and after a stop on
/// the way. Nothing if one of them could not be fired then.
std::optional<std::vector<std::size_t>> planned_before(const StopTasks& tasks,
                                                       const std::vector<std::size_t>& lost, Vec2 place,
                                                       const Observation& seen, const GuardProblem& problem,
                                                       const FiringMap& firing_map) {
  std::vector<std::size_t> planned = tasks.queue.front().passing;
  std::erase_if(planned, [&](std::size_t record) { return std::ranges::count(lost, record) > 0; });
  PassingShots solver(problem, firing_map);
  const auto hit_along = [&](const Pose2& from, Vec2 to, GunState& gun, double& heading_rad) {
    const std::vector<Vec2> way =
        way_between(tasks, from, to, problem, firing_map).value_or(std::vector<Vec2>{from.position});
    std::vector<std::size_t> targets;
    targets.reserve(planned.size());
    for (const std::size_t record : planned) targets.push_back(target_of(tasks, record));
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
  hit_along({place, heading_rad}, tasks.queue.front().place, gun, heading_rad);
  if (!planned.empty()) return std::nullopt;
  return before;
}

/// Shoots first from where the robot stands.
bool stays_for(StopTasks& tasks, std::vector<std::size_t> records, Vec2 here) {
  if (records.empty()) return false;
  for (const std::size_t record : records) std::erase(tasks.queue.front().passing, record);
  tasks.queue.push_front(StopTask{here, std::move(records)});
  return true;
}

}  // namespace

std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m) {
  std::optional<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t cell : cells) {
    const Vec2 place = firing_map.frame.centre(firing_map.frame.cell(cell));
    const double away = distance(here, place);
    if (away < apart_m || away >= least) continue;
    least = away;
    best = place;
  }
  return best;
}

void stop_for(StopTasks& tasks, std::size_t record, const GuardProblem& problem,
              const FiringMap& firing_map) {
  const std::vector<std::size_t> sure = SureCells(problem, firing_map).of(target_of(tasks, record));
  if (const auto task = stop_among(tasks, firing_map, sure); task != tasks.queue.end()) {
    task->targets.push_back(record);
    return;
  }
  if (tasks.queue.empty()) {
    const Vec2 here = tasks.last_place;
    tasks.queue.push_back({nearest_place(firing_map, sure, here, 0.0).value_or(here), {record}});
    tasks.arrived = false;
    return;
  }
  const Detour detour = shortest_detour(tasks, firing_map, sure);
  tasks.queue.insert(tasks.queue.begin() + static_cast<std::ptrdiff_t>(detour.after) + 1,
                     StopTask{detour.place, {record}});
}

bool stops_first(StopTasks& tasks, const std::vector<std::size_t>& records, const Observation& seen,
                 const GuardProblem& problem, const FiringMap& firing_map) {
  const SureCells cells(problem, firing_map);
  const Vec2 here = seen.odometry.position;
  std::vector<std::size_t> from_here;
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> elsewhere;  // with their sure cells
  for (const std::size_t record : records) {
    std::vector<std::size_t> sure = cells.of(target_of(tasks, record));
    if (stop_among(tasks, firing_map, sure) != tasks.queue.end()) continue;
    if (is_among(firing_map, sure, here)) {
      from_here.push_back(record);
    } else {
      elsewhere.emplace_back(record, std::move(sure));
    }
  }
  if (stays_for(tasks, std::move(from_here), here)) return true;
  if (tasks.queue.front().call) return false;
  for (const auto& [record, sure] : elsewhere) {
    const Detour before = detour_between(firing_map, sure, here, tasks.queue.front().place);
    if (before.longer_m + worth_m > shortest_detour(tasks, firing_map, sure).longer_m) continue;
    auto shots = planned_before(tasks, records, before.place, seen, problem, firing_map);
    if (!shots) continue;
    std::erase_if(tasks.queue.front().passing,
                  [&](std::size_t one) { return one == record || std::ranges::count(*shots, one) > 0; });
    tasks.queue.push_front(StopTask{before.place, {record}, {}, std::move(*shots)});
    return true;
  }
  return false;
}

}  // namespace outrider
