// GridPart<T>: values of the cells of a grid that differ from one value in a part of the grid only.
#pragma once

#include <algorithm>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Values of the cells of a frame, stored for a rectangle of cells; all other cells have the value `outside`.
template <class T>
class GridPart {
 public:
  explicit GridPart(T outside) : outside_(outside) {}

  /// Makes the part of the cells whose centres may lie within `reach_m` of `centre` along x and along y, as
  /// far as the frame has them. All values are `outside` at first.
  GridPart(const GridFrame& frame, Vec2 centre, double reach_m, T outside)
      : outside_(outside), frame_columns_(static_cast<std::size_t>(frame.width)) {
    // Bounded before they become cells: a reach may be infinite.
    const Box2 part = Box2{centre - Vec2{reach_m, reach_m}, centre + Vec2{reach_m, reach_m}};
    const Box2 all = frame.bounds();
    const auto inside = [&](Vec2 p) {
      return Vec2{std::clamp(p.x, all.low.x, all.high.x), std::clamp(p.y, all.low.y, all.high.y)};
    };
    const Cell low = frame.cell_at(inside(part.low)), high = frame.cell_at(inside(part.high));
    low_ = {std::max(0, low.x - 1), std::max(0, low.y - 1)};
    columns_ = static_cast<std::size_t>(std::max(0, std::min(frame.width, high.x + 2) - low_.x));
    rows_ = static_cast<std::size_t>(std::max(0, std::min(frame.height, high.y + 2) - low_.y));
    values_.assign(columns_ * rows_, outside);
  }

  /// Returns the value of a cell of the frame. O(1).
  T operator[](std::size_t cell) const {
    const std::size_t at = place(cell);
    return at < values_.size() ? values_[at] : outside_;
  }
  /// Sets the value of a cell, which must be in the part.
  void set(std::size_t cell, T value) { values_[place(cell)] = value; }

  /// Calls visit(cell, value) for each cell of the part, in ascending order.
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t y = 0; y < rows_; ++y) {
      const std::size_t row =
          (static_cast<std::size_t>(low_.y) + y) * frame_columns_ + static_cast<std::size_t>(low_.x);
      for (std::size_t x = 0; x < columns_; ++x) visit(row + x, values_[y * columns_ + x]);
    }
  }
  /// Returns the part of the same cells with the values of map(cell, value), called in ascending order.
  template <class U, class Map>
  [[nodiscard]] GridPart<U> mapped(U outside, const Map& map) const {
    GridPart<U> result(outside);
    result.frame_columns_ = frame_columns_;
    result.low_ = low_;
    result.columns_ = columns_;
    result.rows_ = rows_;
    result.values_.reserve(values_.size());
    each([&](std::size_t cell, T value) { result.values_.push_back(map(cell, value)); });
    return result;
  }

  friend bool operator==(const GridPart&, const GridPart&) = default;

 private:
  [[nodiscard]] std::size_t place(std::size_t cell) const {
    if (columns_ == 0) return values_.size();
    // Wraps round, to a value above all, where the cell is left of the part or below it.
    const std::size_t x = cell % frame_columns_ - static_cast<std::size_t>(low_.x);
    const std::size_t y = cell / frame_columns_ - static_cast<std::size_t>(low_.y);
    return x < columns_ && y < rows_ ? y * columns_ + x : values_.size();
  }
  template <class U>
  friend class GridPart;

  T outside_;
  std::size_t frame_columns_ = 1;
  Cell low_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<T> values_;
};

}  // namespace outrider
