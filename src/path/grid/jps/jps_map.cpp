#include "jps_map.hpp"

namespace outrider::jump {
namespace {

/// A cell counted from the border.
void write(Map& map, Cell c, bool blocked) {
  for (unsigned d = 0; d < 4; ++d) {
    const std::int32_t p = map.position(d, c);
    Lines& lines = map.lines[d];
    const std::ptrdiff_t word = lines.stride * (horizontal(d) ? c.y : c.x) + (p >> 6);
    const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(p & 63);
    std::uint64_t& bits = lines.bits[static_cast<std::size_t>(word)];
    bits = blocked ? bits | bit : bits & ~bit;
  }
}

}  // namespace

Map map_of(const GridMap& ground) {
  Map map;
  map.width = ground.frame.width + 2;
  map.height = ground.frame.height + 2;
  for (unsigned d = 0; d < 4; ++d) {
    Lines& lines = map.lines[d];
    const int length = horizontal(d) ? map.width : map.height, count = horizontal(d) ? map.height : map.width;
    lines.stride = (length >> 6) + 2;  // a window may begin at the last position
    lines.bits.assign(static_cast<std::size_t>(lines.stride) * static_cast<std::size_t>(count),
                      ~std::uint64_t{0});
  }
  for (int y = 1; y + 1 < map.height; ++y) {
    const std::uint8_t* marks = ground.marks.data() + ground.index({-1, y - 1});
    for (int x = 1; x + 1 < map.width; ++x) {
      if ((marks[x] & GridMap::blocked_bit) == 0) write(map, {x, y}, false);
    }
  }
  return map;
}

void rewrite(Map& map, const GridMap& ground, const std::vector<Cell>& changed) {
  for (const Cell c : changed) write(map, {c.x + 1, c.y + 1}, ground.blocked(c));
}

}  // namespace outrider::jump
