// The maps on which exploration strategies are compared, in groups.
//
// Generated ones need no data: offices (rooms along corridors), rooms (a rectangle cut into rooms with
// doors), halls (open, with pillars and furniture), mazes (with loops), caves, and ground strewn with single
// blocks. With the folder of published grids there are cut-outs of these, closed by a wall. Cells are 0.1 m.
// Everything that is drawn depends on the seed of the map alone.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::bench {

struct ExploreMap {
  std::string name;
  std::string group;
  Grid<std::uint8_t> solid;
};

/// The generated maps, six of each group but the published one.
std::vector<ExploreMap> generated_explore_maps();

/// Cut-outs of the grids that are found under the folder. Faults: those of find_grids().
Outcome<std::vector<ExploreMap>> published_explore_maps(const std::string& folder);

/// Returns the cells that are reached from one over free cells, by their indices, and sets them in `met`.
std::vector<std::size_t> part_of(const Grid<std::uint8_t>& blocked, std::size_t from,
                                 Grid<std::uint8_t>& met);

/// Returns the cells of the largest part in which a disk of that radius gets around; empty if there is none.
std::vector<std::size_t> largest_part(const Grid<std::uint8_t>& solid, double clearance_m);

/// A place where a robot of that radius stands well, drawn from the seed; from it most of the map is reached.
Vec2 explore_start(const Grid<std::uint8_t>& solid, double clearance_m, std::uint64_t seed);

}  // namespace outrider::bench
