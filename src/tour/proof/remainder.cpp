#include "proof/remainder.hpp"

#include <algorithm>
#include <utility>

#include "outrider/core/parallel.hpp"

namespace outrider::tour {
namespace {

constexpr std::size_t at_once = 32;  // sets between two looks at the budget

class Remainder {
 public:
  Remainder(const Instance& instance, const Shares& shares, const std::vector<std::uint32_t>& apart,
            const RelaxedDrives& drives)
      : instance_(instance),
        shares_(shares),
        apart_(apart),
        drives_(drives),
        value_(row_size() << apart.size(), never) {
    std::fill_n(value_.begin(), row_size(), 0.0F);
  }

  /// The values of a set from those of the sets that lack one of it.
  void solve(std::uint32_t set);
  [[nodiscard]] double from_start(std::uint32_t set) const {
    const std::uint32_t sectors = drives_.sectors;
    return static_cast<double>(row(set)[sectors > 1 ? sector_of(instance_.heading, sectors) : 0]);
  }

 private:
  [[nodiscard]] std::size_t row_size() const { return std::size_t{instance_.stops} * drives_.sectors; }
  [[nodiscard]] const float* row(std::uint32_t set) const { return &value_[set * row_size()]; }
  [[nodiscard]] std::vector<bool> serve(std::uint32_t set);
  bool drive(float* values, std::uint32_t from, std::uint32_t to) const;

  const Instance& instance_;
  const Shares& shares_;
  const std::vector<std::uint32_t>& apart_;
  const RelaxedDrives& drives_;
  std::vector<float> value_;  // [(set * stops + stop) * sectors + sector], about to serve or to drive
};

/// Serves one goal where the robot stands; the stops where it may.
std::vector<bool> Remainder::serve(std::uint32_t set) {
  std::vector<bool> stops(instance_.stops, false);
  float* const values = &value_[set * row_size()];
  for (std::uint32_t bits = set; bits != 0; bits &= bits - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
    const float* const after = row(set & ~(1U << bit));
    for (const std::uint32_t node : instance_.nodes_of[apart_[bit]]) {
      const std::uint32_t stop = instance_.nodes[node].stop;
      const std::size_t begin = std::size_t{stop} * drives_.sectors;
      for (std::size_t i = begin; i < begin + drives_.sectors; ++i) {
        values[i] = std::min(values[i], shares_.serve_left[node] + after[i]);
      }
      stops[stop] = true;
    }
  }
  return stops;
}

/// Drives to a stop and goes on from there; whether that is better for some heading.
bool Remainder::drive(float* values, std::uint32_t from, std::uint32_t to) const {
  const std::uint32_t sectors = drives_.sectors;
  const std::size_t entry = instance_.arc(to, from);
  const float* const there = values + std::size_t{to} * sectors;
  float* const here = values + std::size_t{from} * sectors;
  const bool keeps_heading = sectors > 1 && drives_.arriving[entry] == same_sector;
  const float after = there[sectors > 1 && !keeps_heading ? drives_.arriving[entry] : 0];
  bool better = false;
  for (std::uint32_t q = 0; q < sectors; ++q) {
    const float turn = sectors > 1 ? drives_.turn[entry * sectors + q] : 0.0F;
    const float time = drives_.time_to[entry] + (keeps_heading ? there[q] : turn + after);
    better = better || time < here[q];
    here[q] = std::min(here[q], time);
  }
  return better;
}

void Remainder::solve(std::uint32_t set) {
  float* const values = &value_[set * row_size()];
  std::vector<bool> changed = serve(set);
  for (bool again = true; std::exchange(again, false);) {
    std::vector<bool> next(instance_.stops, false);
    for (std::uint32_t to = 0; to < instance_.stops; ++to) {
      if (!changed[to]) continue;
      for (std::uint32_t from = 0; from < instance_.stops; ++from) {
        if (from == to || drives_.time_to[instance_.arc(to, from)] == never) continue;
        if (!drive(values, from, to)) continue;
        next[from] = true;
        again = true;
      }
    }
    changed = std::move(next);
  }
}

}  // namespace

double remainder(const Instance& instance, const Shares& shares, const std::vector<std::uint32_t>& apart,
                 RelaxedDrives drives, BudgetMeter& meter) {
  drives.time_to = shares.drive_left;
  Remainder rest(instance, shares, apart, drives);
  const std::uint32_t sets = 1U << apart.size();
  std::vector<std::vector<std::uint32_t>> by_size(apart.size() + 1);
  for (std::uint32_t set = 1; set < sets; ++set) {
    by_size[static_cast<std::size_t>(std::popcount(set))].push_back(set);
  }
  for (const auto& some : by_size) {
    for (std::size_t begin = 0; begin < some.size(); begin += at_once) {
      const std::size_t count = std::min(at_once, some.size() - begin);
      for (std::size_t i = 0; i < count; ++i) {
        if (!meter.spend()) return 0.0;
      }
      parallel_for(count, [&](std::size_t i) { rest.solve(some[begin + i]); });
    }
  }
  return rounded_down * rest.from_start(sets - 1);
}

}  // namespace outrider::tour
