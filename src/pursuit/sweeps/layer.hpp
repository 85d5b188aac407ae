// Layers of least costs to go, one for each second, and the map on which a sweep computes them.
//
// Costs to go are integers of 16 bits if every catch that matters costs less than 2^16, of 32 bits if it
// costs less than 2^30, and of 64 bits otherwise. Walls have the cost no_catch, so that no cost to go leads
// out of them.
#pragma once

#include <array>
#include <new>
#include <optional>
#include <variant>
#include <vector>

#include "sweeps/pursuit_boxes.hpp"
#include "sweeps/row_kernel.hpp"

namespace outrider {

/// Allocates at whole lines of the processor's cache, which blocks then never cross.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  explicit AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* at, std::size_t) { ::operator delete(at, std::align_val_t{64}); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

/// The costs of a map, each row in whole blocks between two blocks of walls.
template <class Cost>
struct SweepMap {
  SweepMap(const PursuitField& of, int earliest_catch, const RowKernel<Cost>& by)
      : field(&of),
        earliest(earliest_catch),
        kernel(&by),
        blocks((of.box().width() + row_block<Cost> - 1) / row_block<Cost>),
        stride((blocks + 2) * row_block<Cost>),
        costs(static_cast<std::size_t>(stride) * static_cast<std::size_t>(of.box().height() + 2),
              no_catch<Cost>) {
    const CellBox map = of.box();
    for (int y = 0; y < map.height(); ++y) {
      CellIndex i = of.index({0, y});
      Cost* cost = costs.data() + index({0, y});
      for (int x = 0; x < map.width(); ++x, ++i, ++cost) {
        if (of.free.has(i) && of.costs[i] - of.cheapest < static_cast<std::uint64_t>(no_catch<Cost>))
          *cost = static_cast<Cost>(of.costs[i] - of.cheapest);
      }
    }
  }

  [[nodiscard]] std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y + 1) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(c.x + row_block<Cost>);
  }
  /// Returns what a catch at that second costs for being later than the earliest.
  [[nodiscard]] std::uint64_t delay(int second) const {
    return std::uint64_t{field->cheapest} * static_cast<std::uint64_t>(second - earliest);
  }
  /// Returns the cell of the target at that second if the robot can catch it there for a cost that matters.
  [[nodiscard]] std::optional<Cell> goal(int second) const {
    const CellIndex i = field->target[static_cast<std::size_t>(second)];
    if (second < earliest || !field->free.has(i) ||
        delay(second) >= static_cast<std::uint64_t>(no_catch<Cost>))
      return std::nullopt;
    return field->cell(i);
  }
  /// Returns the cost to go from a cell at that second, of which the layer says `rest`.
  [[nodiscard]] std::uint64_t to_go(Cost rest, int second) const {
    if (rest == no_catch<Cost>) return unreachable;
    return static_cast<std::uint64_t>(rest) +
           std::uint64_t{field->cheapest} * static_cast<std::uint64_t>(earliest) -
           std::uint64_t{field->cheapest} * static_cast<std::uint64_t>(second);
  }

  const PursuitField* field;
  int earliest;  ///< second of the earliest catch
  const RowKernel<Cost>* kernel;
  int blocks;  ///< in a row, without those of walls
  int stride;
  std::vector<Cost, AlignedAllocator<Cost>> costs;
};

using AnySweepMap = std::variant<SweepMap<std::uint16_t>, SweepMap<std::int32_t>, SweepMap<std::int64_t>>;

/// Three rows of least costs over three neighbours in x, which move up a layer.
template <class Cost>
class RowWindow {
 public:
  explicit RowWindow(int width) {
    for (auto& row : rows_) row.resize(static_cast<std::size_t>(width + row_block<Cost>));
  }
  Cost* row(int y) { return rows_[static_cast<std::size_t>(y + 3) % 3].data(); }
  /// Computes `to_go` in row y from rows y - 1, y and y + 1 of this window.
  void settle(const RowKernel<Cost>& kernel, int y, const Cost* cost, Cost* to_go, int count) {
    kernel.settle(row(y - 1), row(y), row(y + 1), cost, to_go, count);
  }

 private:
  std::array<std::vector<Cost, AlignedAllocator<Cost>>, 3> rows_;
};

/// The costs to go in one second from the cells of a box; there is no catch from any other.
template <class Cost>
class StoredLayer {
 public:
  explicit StoredLayer(const CellBox& box = {}) : box_(box) {
    if (!box.empty()) values_.assign(static_cast<std::size_t>(stride() * box.height()), no_catch<Cost>);
  }
  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] Cost* row(int y) { return values_.data() + (y - box_.low.y) * std::ptrdiff_t{stride()}; }
  [[nodiscard]] const Cost* row(int y) const {
    return values_.data() + (y - box_.low.y) * std::ptrdiff_t{stride()};
  }
  [[nodiscard]] Cost at(Cell c) const { return box_.has(c) ? row(c.y)[c.x - box_.low.x] : no_catch<Cost>; }
  void set(Cell c, Cost cost) { row(c.y)[c.x - box_.low.x] = cost; }

 private:
  [[nodiscard]] int stride() const { return box_.width() + row_block<Cost>; }
  CellBox box_;
  std::vector<Cost> values_;
};

/// Returns the layer of `second` in that box, from the layer of the second after it.
template <class Cost>
StoredLayer<Cost> layer_before(const SweepMap<Cost>& map, const StoredLayer<Cost>& after, const CellBox& box,
                               int second) {
  StoredLayer<Cost> layer(box);
  if (box.empty()) return layer;
  const int width = box.width();
  std::vector<Cost> padded(static_cast<std::size_t>(width + 2 + row_block<Cost>));
  RowWindow<Cost> window(width);
  const CellBox known = common(after.box(), box.grown(1));
  const auto narrow = [&](int y) {
    std::fill(padded.begin(), padded.end(), no_catch<Cost>);
    if (!known.empty() && y >= known.low.y && y <= known.high.y) {
      const Cost* from = after.row(y) + (known.low.x - after.box().low.x);
      std::copy(from, from + known.width(), padded.begin() + (known.low.x - box.low.x + 1));
    }
    map.kernel->narrow(padded.data() + 1, window.row(y), width);
  };
  narrow(box.low.y - 1);
  narrow(box.low.y);
  for (int y = box.low.y; y <= box.high.y; ++y) {
    narrow(y + 1);
    window.settle(*map.kernel, y, map.costs.data() + map.index({box.low.x, y}), layer.row(y), width);
  }
  if (const auto goal = map.goal(second); goal && box.has(*goal))
    layer.set(*goal, static_cast<Cost>(map.delay(second)));
  return layer;
}

/// Appends the cells of a cheapest way to a catch, from the last cell of `way` on: layers[k] is the layer of
/// second first + k. It ends with the last layer or with the catch; returns true for a catch.
template <class Cost>
bool descend(const SweepMap<Cost>& map, std::span<const StoredLayer<Cost>> layers, int first,
             std::vector<CellIndex>& way) {
  Cell at = map.field->cell(way.back());
  for (std::size_t k = 0; k < layers.size(); ++k) {
    Cell best = at;
    for (int n = 0; n < 9; ++n) {
      const Cell next{at.x + n % 3 - 1, at.y + n / 3 - 1};
      if (layers[k].at(next) < layers[k].at(best)) best = next;
    }
    at = best;
    way.push_back(map.field->index(at));
    if (map.goal(first + static_cast<int>(k)) == at) return true;
  }
  return false;
}

}  // namespace outrider
