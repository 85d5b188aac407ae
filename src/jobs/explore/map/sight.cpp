#include "map/sight.hpp"

#include <algorithm>
#include <utility>

#include "map/beside.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_samples = 12;
constexpr int directions = 96;

std::vector<std::uint32_t> worth_seeing(const Frontier& frontier, const FrontierMap& map) {
  std::vector<std::uint32_t> beside;
  for_each_unknown_beside(frontier, map.ground().known(), [&](std::uint32_t cell) {
    if (!map.given_up(cell)) beside.push_back(cell);
  });
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

std::vector<std::uint32_t> spread(const std::vector<std::uint32_t>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[(2 * i + 1) * all.size() / (2 * most)]);
  return some;
}

/// Notes that a cell sees the cell of the sample with that number.
void note_seat(std::uint32_t block, std::uint32_t cell, std::uint32_t number, SightMemory& memory) {
  std::uint32_t& entry = memory.entry[block];
  if (entry == 0) {
    memory.seats.push_back({block, cell, 0});
    memory.last.push_back(0);
    entry = static_cast<std::uint32_t>(memory.seats.size());
  }
  if (std::exchange(memory.last[entry - 1], number) != number) ++memory.seats[entry - 1].seen;
}

/// Divides the seats into those that see half of the sample, or as much as any, and the poorer.
void sort_seats(std::vector<Seat>& seats, FrontierSight& sight) {
  std::uint32_t most = 0;
  for (const Seat& seat : seats) most = std::max(most, seat.seen);
  const std::uint32_t enough = std::min(static_cast<std::uint32_t>((sight.sample.size() + 1) / 2), most);
  std::ranges::sort(seats, {}, &Seat::block);
  for (const Seat& seat : seats) (seat.seen >= enough ? sight.seats : sight.poorer).push_back(seat);
}

/// Computes the sight from a frontier on the ground as it is now.
FrontierSight made(const Frontier& frontier, const FrontierMap& map, SightMemory& memory) {
  const TraversabilityGrid& ground = map.ground();
  const Grid<std::uint8_t>& known = ground.known();
  memory.entry.resize(std::max(memory.entry.size(), ground.blocks().cells.size()), 0);
  memory.seats.clear();
  memory.last.clear();

  FrontierSight sight;
  sight.sample = spread(worth_seeing(frontier, map), most_samples);
  for (std::uint32_t number = 1; number <= sight.sample.size(); ++number) {
    const Cell seen = known.frame.cell(sight.sample[number - 1]);
    for (const std::vector<Cell>& ray : memory.fan.rays) {
      for (const Cell offset : ray) {
        const Cell at{seen.x + offset.x, seen.y + offset.y};
        if (!known.contains(at)) break;
        const auto cell = static_cast<std::uint32_t>(known.frame.index(at));
        if (known.cells[cell] != free_cell) break;
        if (ground.blocked(cell)) continue;
        note_seat(ground.block_of(cell), cell, number, memory);
      }
    }
  }
  for (const Seat& seat : memory.seats) memory.entry[seat.block] = 0;
  sort_seats(memory.seats, sight);
  return sight;
}

}  // namespace

const FrontierSight& sight_of(const Frontier& frontier, const FrontierMap& map, double view_m,
                              SightMemory& memory) {
  const GridFrame& frame = map.frame();
  const int reach = static_cast<int>(view_m / frame.resolution_m);
  if (memory.fan.cells != reach) {
    memory.fan = RayFan::of(reach, directions);
    memory.known.clear();
  }
  const int wide = reach + 1;  // the rays begin beside the frontier
  const Cell low = frame.cell_at(frontier.bounds.low), high = frame.cell_at(frontier.bounds.high);
  SightMemory::Known& known = memory.known[frontier.id];
  const std::uint64_t changed =
      map.ground().changed_within({low.x - wide, low.y - wide}, {high.x + wide, high.y + wide});
  if (known.clock < changed || known.cells != frontier.cells) {
    known = {map.ground().clock(), frontier.cells, made(frontier, map, memory)};
    ++memory.made;
  }
  return known.sight;
}

void forget_gone(SightMemory& memory, const FrontierMap& map) {
  std::erase_if(memory.known, [&](const auto& entry) { return !map.frontiers().contains(entry.first); });
}

double gain_at(Cell from, const Grid<std::uint8_t>& known, const RayFan& fan) {
  double twice = 0.0;  // sum over the rays of the differences of squared distances, cells
  for (const std::vector<Cell>& ray : fan.rays) {
    int before = 0;
    for (const Cell offset : ray) {
      const Cell at{from.x + offset.x, from.y + offset.y};
      const int squared = offset.x * offset.x + offset.y * offset.y;
      const std::uint8_t value = known.contains(at) ? known[at] : static_cast<std::uint8_t>(unknown_cell);
      if (value == occupied_cell) break;
      if (value == unknown_cell) twice += squared - before;
      before = squared;
    }
  }
  const double resolution = known.frame.resolution_m;
  return pi / static_cast<double>(fan.rays.size()) * twice * resolution * resolution;
}

double gain_behind(Cell from, const Grid<std::uint8_t>& known, const std::vector<std::uint32_t>& sample,
                   double range_m) {
  const double resolution = known.frame.resolution_m;
  const double most = range_m / resolution;
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t through : sample) {
    walk_ray(from, known.frame.cell(through), [&](Cell at) {
      const int x = at.x - from.x, y = at.y - from.y;
      if (x * x + y * y > most * most || !known.contains(at) || known[at] == occupied_cell) return false;
      if (known[at] == unknown_cell) cells.push_back(static_cast<std::uint32_t>(known.frame.index(at)));
      return true;
    });
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return static_cast<double>(cells.size()) * resolution * resolution;
}

}  // namespace outrider
