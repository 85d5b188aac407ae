// Row kernels: the inner loops of a backward sweep over layers, for one row of cells in one second.
//
// The least cost to go from a cell at second t is its own cost plus the least over the cell and its
// neighbours at second t + 1. The minimum of nine is taken as a minimum of three in x, then of three in y.
// Each loop is compiled twice: for any processor, 16 bytes at once, and for those with AVX2, 32 bytes at
// once. Both compute the same integers.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace outrider {

/// Cost to go of a place from which there is no catch; also the cost of a wall. Sums of two signed costs do
/// not overflow; sums of unsigned ones end at the largest number.
template <class Cost>
inline constexpr Cost no_catch =
    std::unsigned_integral<Cost> ? std::numeric_limits<Cost>::max()
                                 : static_cast<Cost>((std::int64_t{1} << (8 * sizeof(Cost) - 2)) - 1);

/// The loops write whole blocks: up to this number of values after `count`, less one.
template <class Cost>
inline constexpr int row_block = static_cast<int>(32 / sizeof(Cost));

template <class Cost>
struct RowKernel {
  /// least[x] = min(row[x - 1], row[x], row[x + 1]) for x from 0 to count - 1.
  void (*narrow)(const Cost* row, Cost* least, int count);
  /// to_go[x] = min(no_catch, cost[x] + min(below[x], level[x], above[x])) for x from 0 to count - 1.
  void (*settle)(const Cost* below, const Cost* level, const Cost* above, const Cost* cost, Cost* to_go,
                 int count);
};

enum class Processor { any, avx2 };

/// Returns true if this processor and this compiler have it.
bool runs(Processor processor);

/// Returns the kernel for that processor; it must run() here. Cost is std::uint16_t,
/// std::int32_t or std::int64_t.
template <class Cost>
const RowKernel<Cost>& row_kernel(Processor processor);

/// Returns the processor whose kernel is fastest here.
inline Processor fastest_processor() { return runs(Processor::avx2) ? Processor::avx2 : Processor::any; }

}  // namespace outrider
