// FrontierSight: the unknown cells beside a frontier, and the places from which they are seen.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "map/rays.hpp"
#include "outrider/jobs/explore/map/frontier.hpp"

namespace outrider {

/// A place of the robot on the known ground that sees cells of the sample.
struct Seat {
  std::uint32_t block = 0;
  std::uint32_t cell = 0;  ///< in it
  std::uint32_t seen = 0;  ///< cells of the sample
};

struct FrontierSight {
  std::vector<std::uint32_t> sample;  ///< unknown cells, spread evenly over those beside the frontier
  std::vector<Seat> seats;            ///< those that see half of the sample, or as much as any; by block
  std::vector<Seat> poorer;           ///< those that see less of it; by block
};

/// Results for one map that are kept between calls while their inputs do not change, and scratch memory.
struct SightMemory {
  struct Known {
    std::uint64_t clock = 0;           ///< TraversabilityGrid::clock() when it was made
    std::vector<std::uint32_t> cells;  ///< of the frontier then
    FrontierSight sight;
  };
  std::map<std::uint32_t, Known> known;  ///< by the id of the frontier
  std::size_t made = 0;                  ///< sights so far
  RayFan fan;
  std::vector<std::uint32_t> entry;  // of a block in `seats`, one more; 0 but within a call
  std::vector<std::uint32_t> last;   // of a seat: number of the cell that it saw last
  std::vector<Seat> seats;
};

/// Cells that were given up do not count. Valid until the next call of forget_gone() or for that frontier.
const FrontierSight& sight_of(const Frontier& frontier, const FrontierMap& map, double view_m,
                              SightMemory& memory);
/// Drops what is known of frontiers that are no more.
void forget_gone(SightMemory& memory, const FrontierMap& map);

inline constexpr int gain_rays = 180;  ///< of the fan for gain_at()

/// Returns the unknown area visible from a cell within that range if only occupied cells hide anything, m2.
double gain_at(Cell from, const Grid<std::uint8_t>& known, const RayFan& fan);

/// Returns the part of that area along the rays through the sample, with each cell counted once, m2.
double gain_behind(Cell from, const Grid<std::uint8_t>& known, const std::vector<std::uint32_t>& sample,
                   double range_m);

}  // namespace outrider
