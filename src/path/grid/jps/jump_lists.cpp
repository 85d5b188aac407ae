#include "jump_lists.hpp"

#include <limits>

#include "jps_index.hpp"
#include "jps_scan.hpp"

namespace outrider::jump {

void JumpLists::clear() {
  points_.clear();
  words_.clear();
  slots_.assign(512, JumpPoint::none);
}

std::uint32_t JumpLists::number(Cell c) {
  std::size_t slot = slot_of(c);
  for (; slots_[slot] != JumpPoint::none; slot = (slot + 1) & (slots_.size() - 1)) {
    if (points_[slots_[slot]].cell == c) return slots_[slot];
  }
  const auto point = static_cast<std::uint32_t>(points_.size());
  slots_[slot] = point;
  points_.push_back({c});
  if (2 * points_.size() > slots_.size()) grow();
  return point;
}

void JumpLists::grow() {
  slots_.assign(4 * slots_.size(), JumpPoint::none);
  for (std::uint32_t point = 0; point < points_.size(); ++point) {
    std::size_t slot = slot_of(points_[point].cell);
    while (slots_[slot] != JumpPoint::none) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = point;
  }
}

std::uint32_t JumpLists::scan(const Map& map, const GridMap& ground, Cell c, unsigned direction) {
  const auto list = static_cast<std::uint32_t>(words_.size());
  words_.resize(list + header);
  auto emit = [&](Cell found, unsigned d) { words_.push_back(4 * number(found) + d); };
  std::array<std::int32_t, header - 1> lengths{scan_straight(map, c, direction, 0, emit)};
  const unsigned sides = forced_sides(ground.moves[ground.index({c.x - 1, c.y - 1})], direction);
  for (const unsigned side : {lower, higher}) {
    if ((sides & side) == 0) continue;
    const unsigned turn = side_of(direction, side);
    const unsigned h = horizontal(turn) ? turn : direction, v = horizontal(turn) ? direction : turn;
    lengths[side == lower ? 1 : 3] = scan_straight(map, c, turn, 0, emit);
    lengths[side == lower ? 2 : 4] = scan_diagonal(map, c, h, v, std::numeric_limits<int>::max(), emit);
  }
  words_[list] = static_cast<std::uint32_t>(words_.size() - list - header);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    words_[list + 1 + i] = static_cast<std::uint32_t>(lengths[i]);
  return list;
}

JumpList JumpLists::next(const Map& map, const GridMap& ground, std::uint32_t point, unsigned direction) {
  std::uint32_t list = points_[point].lists[direction];
  if (list == JumpPoint::none) {
    list = scan(map, ground, points_[point].cell, direction);
    points_[point].lists[direction] = list;
  }
  const std::uint32_t* words = words_.data() + list;
  const auto length = [&](int i) { return static_cast<std::int32_t>(words[i]); };
  return {length(1), {{{length(2), length(3)}, {length(4), length(5)}}}, {words + header, words[0]}};
}

}  // namespace outrider::jump
