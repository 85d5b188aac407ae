// Finds the cells of indices of a map without a division.
#pragma once

#include <bit>
#include <cstdint>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Multiplies by 2^k / stride, rounded up, with 2^k >= 2^32 stride: exact for indices below 2^29, which are
/// those of every map. Source: Granlund and Montgomery, Division by invariant integers using multiplication,
/// 1994.
class CellAt {
 public:
  CellAt() = default;
  explicit CellAt(const GridMap& ground)
      : stride_(ground.stride),
        shift_(32 + static_cast<unsigned>(std::bit_width(ground.stride - 1))),
        factor_((std::uint64_t{1} << shift_) / ground.stride + 1) {}

  /// Returns ground.at(index).
  Cell operator()(std::uint32_t index) const {
    const auto row = static_cast<std::uint32_t>(index * factor_ >> shift_);
    return {static_cast<int>(index - row * stride_) - 1, static_cast<int>(row) - 1};
  }

 private:
  std::uint32_t stride_ = 1;
  unsigned shift_ = 0;
  std::uint64_t factor_ = 1;
};

}  // namespace outrider
