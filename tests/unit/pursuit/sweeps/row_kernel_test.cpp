// The kernels compute what they say, and the same on every processor.
#include "sweeps/row_kernel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

template <class Cost>
std::vector<Cost> random_row(Rng& rng, int count) {
  std::vector<Cost> row(static_cast<std::size_t>(count + 2 + 2 * row_block<Cost>));
  for (Cost& cost : row)
    cost = rng.below(4) == 0 ? no_catch<Cost>
                             : static_cast<Cost>(rng.below(static_cast<std::uint64_t>(no_catch<Cost>)));
  return row;
}

template <class Cost>
void expect_right(Processor processor) {
  const RowKernel<Cost>& kernel = row_kernel<Cost>(processor);
  Rng rng(7);
  for (int count = 1; count < 70; ++count) {
    const auto row = random_row<Cost>(rng, count), other = random_row<Cost>(rng, count);
    const auto third = random_row<Cost>(rng, count), cost = random_row<Cost>(rng, count);
    std::vector<Cost> least(row.size()), to_go(row.size());
    kernel.narrow(row.data() + 1, least.data(), count);
    kernel.settle(row.data(), other.data(), third.data(), cost.data(), to_go.data(), count);
    for (std::size_t x = 0; x < static_cast<std::size_t>(count); ++x) {
      EXPECT_EQ(least[x], std::min({row[x], row[x + 1], row[x + 2]}));
      const auto sum = std::int64_t{cost[x]} + std::min({row[x], other[x], third[x]});
      EXPECT_EQ(to_go[x], std::min<std::int64_t>(no_catch<Cost>, sum));
    }
  }
}

TEST(RowKernel, ComputesLeastCostsOnAnyProcessor) {
  expect_right<std::uint16_t>(Processor::any);
  expect_right<std::int32_t>(Processor::any);
  expect_right<std::int64_t>(Processor::any);
}

TEST(RowKernel, ComputesTheSameWithAvx2) {
  if (!runs(Processor::avx2)) GTEST_SKIP() << "this processor has no AVX2";
  expect_right<std::uint16_t>(Processor::avx2);
  expect_right<std::int32_t>(Processor::avx2);
  expect_right<std::int64_t>(Processor::avx2);
}

}  // namespace
}  // namespace outrider
