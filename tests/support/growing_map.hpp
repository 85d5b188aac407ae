// Maps that become known bit by bit, at random, as a robot's map does: cells turn, the frame grows, all is
// drawn anew.
#pragma once

#include <algorithm>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/slam/map/occupancy_map.hpp"

namespace outrider::testing {

struct GrowingMap {
  Grid<std::uint8_t> map;
  Rng rng;

  explicit GrowingMap(std::uint64_t seed) : rng(seed) {
    GridFrame frame;
    frame.resolution_m = 0.05;
    frame.origin = {-0.2, 0.35};
    frame.width = 12 + static_cast<int>(rng.below(12));
    frame.height = 12 + static_cast<int>(rng.below(12));
    map = Grid<std::uint8_t>(frame, unknown_cell);
  }

  /// A patch of cells takes one value, or values at random; now and then the frame grows, on any side.
  MapUpdate change() {
    MapUpdate update;
    const std::uint64_t kind = rng.below(12);
    if (kind == 0) grow();
    update.redrawn = kind <= 1;
    const int patches = update.redrawn ? 4 : 1;
    for (int i = 0; i < patches; ++i) paint(update.cells);
    std::sort(update.cells.begin(), update.cells.end());
    update.cells.erase(std::unique(update.cells.begin(), update.cells.end()), update.cells.end());
    if (update.redrawn) update.cells.clear();
    return update;
  }

 private:
  void grow() {
    const auto more = [&] { return static_cast<int>(rng.below(3) == 0 ? rng.below(70) : 0); };
    const int left = more(), below = more();
    GridFrame frame = map.frame;
    frame.origin = map.frame.corner({-left, -below});
    frame.width += left + more();
    frame.height += below + more();
    if (frame.width > 220 || frame.height > 220) return;
    Grid<std::uint8_t> larger(frame, unknown_cell);
    for (int y = 0; y < map.frame.height; ++y) {
      for (int x = 0; x < map.frame.width; ++x) larger[{x + left, y + below}] = map[{x, y}];
    }
    map = larger;
  }

  void paint(std::vector<std::size_t>& changed) {
    const auto side = [&](int most) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(most))); };
    const Cell low{side(map.frame.width), side(map.frame.height)};
    const int width = 1 + side(12), height = 1 + side(12);
    const std::uint64_t value = rng.below(6);  // mostly free, sometimes mixed
    for (int y = low.y; y < std::min(low.y + height, map.frame.height); ++y) {
      for (int x = low.x; x < std::min(low.x + width, map.frame.width); ++x) {
        const std::uint64_t now = value == 5 ? rng.below(3) : value > 2 ? 0 : value;
        if (map[{x, y}] == now) continue;
        map[{x, y}] = static_cast<std::uint8_t>(now);
        changed.push_back(map.frame.index({x, y}));
      }
    }
  }
};

}  // namespace outrider::testing
