#include "outrider/job/navigation_log.hpp"

#include "outrider/job/map_log.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double map_every_s = 1.0, instant_s = 1e-9;

/// Returns the cells of a live map as an occupancy map: what is not marked is not known.
Grid<std::uint8_t> live_occupancy(const LiveMap& map) {
  Grid<std::uint8_t> cells(map.frame(), unknown_cell);
  for (const Mark& mark : map.marks()) {
    if (!mark.lone) cells[map.frame().cell_at(mark.place)] = occupied_cell;
  }
  return cells;
}

}  // namespace

void NavigationLog::note(const Observation& seen, double time_s, const LiveMap& map) {
  if (seen.scan) log_scan(*log_, time_s, *seen.scan);
  if (time_s < next_map_s_) return;
  next_map_s_ = time_s + map_every_s - instant_s;
  log_map(*log_, live_occupancy(map), 0.0, time_s);
}

}  // namespace outrider
