// A building drawn in letters: the map that a robot has, and the world as it is.
//
//   #  wall      (blank)  free      ?  not known, a wall in truth
//   D  a door that is open on the map and closed in truth
//   O  a wall on the map that is an open door in truth
#pragma once

#include <string>
#include <vector>

#include "outrider/slam/map/map_localiser.hpp"
#include "outrider/world/occupancy.hpp"
#include "outrider/world/world.hpp"

namespace outrider::test {

struct Building {
  KnownMap map;
  World world;
};

/// The first row is the top; the lowest corner is at the origin. Every letter is a square of `side_m`, and of
/// `parts` by `parts` cells of the map.
inline Building building(const std::vector<std::string>& rows, double side_m, int parts) {
  Building built;
  const int width = static_cast<int>(rows.front().size()), height = static_cast<int>(rows.size());
  GridFrame frame;
  frame.resolution_m = side_m / parts;
  frame.width = width * parts;
  frame.height = height * parts;
  built.map.occupancy = Grid<std::uint8_t>(frame, free_cell);
  built.world.name = "building";
  built.world.bounds = frame.bounds();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char letter = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      const std::uint8_t mapped = letter == '#' || letter == 'O' ? occupied_cell
                                  : letter == '?'                ? unknown_cell
                                                                 : free_cell;
      for (int i = 0; i < parts * parts; ++i)
        built.map.occupancy[{x * parts + i % parts, y * parts + i / parts}] = mapped;
      if (letter == ' ' || letter == 'O') continue;
      const Vec3 middle{(x + 0.5) * side_m, (y + 0.5) * side_m, 0.5};
      built.world.solids.push_back({"wall", {middle, {}}, BoxShape{{0.5 * side_m, 0.5 * side_m, 0.5}}});
    }
  }
  return built;
}

}  // namespace outrider::test
