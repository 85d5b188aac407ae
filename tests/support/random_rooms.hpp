// A house at random: rooms in rows, with doors between neighbours and sometimes a pillar.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::testing {

struct RandomRooms {
  Grid<std::uint8_t> solid;  ///< other than 0 is
  Vec2 start;                ///< m, in the room at the lower left
};

/// `count` x `count` rooms of 1.6 m with doors 0.6 m wide: each room has one to its left or below.
inline RandomRooms random_rooms(Rng& rng, int count, double resolution_m) {
  const auto cells = [&](double m) { return static_cast<int>(m / resolution_m + 0.5); };
  const int room = cells(1.6), wall = cells(0.3), door = cells(0.6), pitch = room + wall;
  GridFrame frame;
  frame.resolution_m = resolution_m;
  frame.width = frame.height = count * pitch + wall;
  RandomRooms made{Grid<std::uint8_t>(frame, 1), {}};
  const auto fill = [&](Cell low, int width, int height, std::uint8_t value) {
    for (int y = low.y; y < low.y + height; ++y) {
      for (int x = low.x; x < low.x + width; ++x) made.solid[{x, y}] = value;
    }
  };
  const auto offset = [&](int within, int size) {
    return static_cast<int>(rng.below(static_cast<std::uint64_t>(within - size + 1)));
  };
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const Cell low{wall + i * pitch, wall + j * pitch};
      fill(low, room, room, 0);
      const bool left = i > 0 && (j == 0 || rng.below(2) == 0), below = j > 0 && (!left || rng.below(3) == 0);
      if (left) fill({low.x - wall, low.y + offset(room, door)}, wall, door, 0);
      if (below) fill({low.x + offset(room, door), low.y - wall}, door, wall, 0);
    }
  }
  for (int n = 0; n < count; ++n) {  // pillars in the middle of rooms other than the first
    const Cell at{static_cast<int>(rng.below(static_cast<std::uint64_t>(count))),
                  static_cast<int>(rng.below(static_cast<std::uint64_t>(count)))};
    if (at.x + at.y == 0) continue;
    const int side = cells(0.2);
    fill({wall + at.x * pitch + (room - side) / 2, wall + at.y * pitch + (room - side) / 2}, side, side, 1);
  }
  made.start = frame.corner({wall + room / 2, wall + room / 2}) + 0.3 * resolution_m * Vec2{1.0, 1.0};
  return made;
}

}  // namespace outrider::testing
