#include "sweeps/row_kernel.hpp"

#include <cstring>

#if defined(__x86_64__)
#define OUTRIDER_AVX2 [[gnu::target("avx2")]]
#else
#define OUTRIDER_AVX2
#endif

namespace outrider {
namespace {

template <class Cost, int bytes>
using Block [[gnu::vector_size(bytes)]] = Cost;

template <int bytes, class Cost>
[[gnu::always_inline]] inline void narrow_row(const Cost* row, Cost* least, int count) {
  for (int x = 0; x < count; x += bytes / static_cast<int>(sizeof(Cost))) {
    Block<Cost, bytes> left, middle, right;
    std::memcpy(&left, row + x - 1, sizeof left);
    std::memcpy(&middle, row + x, sizeof middle);
    std::memcpy(&right, row + x + 1, sizeof right);
    middle = left < middle ? left : middle;
    middle = right < middle ? right : middle;
    std::memcpy(least + x, &middle, sizeof middle);
  }
}

template <int bytes, class Cost>
[[gnu::always_inline]] inline void settle_row(const Cost* below, const Cost* level, const Cost* above,
                                              const Cost* cost, Cost* to_go, int count) {
  const Block<Cost, bytes> most = no_catch<Cost> - Block<Cost, bytes>{};
  for (int x = 0; x < count; x += bytes / static_cast<int>(sizeof(Cost))) {
    Block<Cost, bytes> a, b, c, paid;
    std::memcpy(&a, below + x, sizeof a);
    std::memcpy(&b, level + x, sizeof b);
    std::memcpy(&c, above + x, sizeof c);
    std::memcpy(&paid, cost + x, sizeof paid);
    a = a < b ? a : b;
    a = a < c ? a : c;
    a += paid;
    if constexpr (std::unsigned_integral<Cost>) {
      a = a < paid ? most : a;  // the sum wrapped around
    } else {
      a = most < a ? most : a;
    }
    std::memcpy(to_go + x, &a, sizeof a);
  }
}

template <class Cost>
void narrow_any(const Cost* row, Cost* least, int count) {
  narrow_row<16>(row, least, count);
}
template <class Cost>
void settle_any(const Cost* below, const Cost* level, const Cost* above, const Cost* cost, Cost* to_go,
                int count) {
  settle_row<16>(below, level, above, cost, to_go, count);
}
template <class Cost>
OUTRIDER_AVX2 void narrow_avx2(const Cost* row, Cost* least, int count) {
  narrow_row<32>(row, least, count);
}
template <class Cost>
OUTRIDER_AVX2 void settle_avx2(const Cost* below, const Cost* level, const Cost* above, const Cost* cost,
                               Cost* to_go, int count) {
  settle_row<32>(below, level, above, cost, to_go, count);
}

}  // namespace

bool runs(Processor processor) {
  if (processor == Processor::any) return true;
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

template <class Cost>
const RowKernel<Cost>& row_kernel(Processor processor) {
  static constexpr RowKernel<Cost> any{narrow_any<Cost>, settle_any<Cost>},
      avx2{narrow_avx2<Cost>, settle_avx2<Cost>};
  return processor == Processor::avx2 ? avx2 : any;
}

template const RowKernel<std::uint16_t>& row_kernel<std::uint16_t>(Processor);
template const RowKernel<std::int32_t>& row_kernel<std::int32_t>(Processor);
template const RowKernel<std::int64_t>& row_kernel<std::int64_t>(Processor);

}  // namespace outrider
