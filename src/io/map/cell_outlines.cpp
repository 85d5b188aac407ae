#include "map/cell_outlines.hpp"

#include <array>

namespace outrider {
namespace {

constexpr std::array<Cell, 4> ahead = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Walks along the sides between cells, with the cells that count on the left.
class Outliner {
 public:
  explicit Outliner(const Grid<std::uint8_t>& cells)
      : cells_(cells), corners_{{}, 1.0, cells.frame.width + 1, cells.frame.height + 1} {}

  std::vector<std::vector<Vec2>> rings() {
    walked_.assign(corners_.size(), 0);
    std::vector<std::vector<Vec2>> all;
    for (std::size_t i = 0; i < walked_.size(); ++i) {
      for (std::size_t way = 0; way < ahead.size(); ++way) {
        if (is_side(corners_.cell(i), way) && !walked(i, way))
          all.push_back(ring_from(corners_.cell(i), way));
      }
    }
    return all;
  }

 private:
  [[nodiscard]] bool counts(int x, int y) const { return cells_.contains({x, y}) && cells_[{x, y}] != 0; }
  /// Returns true if a side leads that way from a corner, with a cell that counts on its left only.
  [[nodiscard]] bool is_side(Cell at, std::size_t way) const {
    constexpr std::array<Cell, 4> left = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    constexpr std::array<Cell, 4> right = {{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    return counts(at.x + left[way].x, at.y + left[way].y) &&
           !counts(at.x + right[way].x, at.y + right[way].y);
  }
  [[nodiscard]] bool walked(std::size_t corner, std::size_t way) const {
    return ((walked_[corner] >> way) & 1U) != 0;
  }

  std::vector<Vec2> ring_from(Cell at, std::size_t way) {
    std::vector<Vec2> ring;
    std::size_t before = ahead.size();
    for (bool goes_on = true; goes_on;) {
      auto& mark = walked_[corners_.index(at)];
      mark = static_cast<std::uint8_t>(mark | (1U << way));
      if (way != before) ring.push_back(cells_.frame.corner(at));
      before = way;
      at = {at.x + ahead[way].x, at.y + ahead[way].y};
      // Left first, so rings around cells that meet at a corner only stay apart.
      goes_on = false;
      for (const std::size_t turn : {1U, 0U, 3U}) {
        const std::size_t next = (before + turn) % ahead.size();
        if (!is_side(at, next) || walked(corners_.index(at), next)) continue;
        way = next;
        goes_on = true;
        break;
      }
    }
    return ring;
  }

  const Grid<std::uint8_t>& cells_;
  GridFrame corners_;
  std::vector<std::uint8_t> walked_;  // by corner, a bit for each way
};

}  // namespace

std::vector<std::vector<Vec2>> cell_outlines(const Grid<std::uint8_t>& cells) {
  return Outliner(cells).rings();
}

}  // namespace outrider
