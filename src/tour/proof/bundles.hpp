// Bundles: what one visit can serve, as sets of goals, and the least time that its services and the aims
// between them take in any order.
#pragma once

#include <vector>

#include "instance.hpp"

namespace outrider::tour {

/// Bit i: the i-th of some goals in an order of choice.
using GoalSet = std::uint64_t;
/// Returns the set of the first so many goals.
inline GoalSet first_of(std::size_t count) { return count >= 64 ? ~GoalSet{0} : (GoalSet{1} << count) - 1; }

struct Way {
  std::uint32_t stop = 0;
  float time = 0.0F;    // durations and aims, but for the aim before the first
  bool needed = false;  // a tour that matters may take it
};

struct Bundle {
  GoalSet set = 0;
  std::vector<Way> ways;  // by stop
};

/// The bundles in the order of their sets.
using Bundles = std::vector<Bundle>;

class VisitTimes {
 public:
  explicit VisitTimes(const Instance& instance);

  /// From below, the time of a visit to the stop that serves the set of `goals`, all of which it can serve.
  /// But for the aim before the first it is exact, up to rounding, where the stop has at most 14 services;
  /// else it is the sum of the durations. O(set).
  [[nodiscard]] float least(std::uint32_t stop, const std::vector<std::uint32_t>& goals, GoalSet set) const;

 private:
  void solve(std::uint32_t stop);

  const Instance& instance_;
  std::vector<std::vector<float>> least_;  // stop -> by its nodes as bits; empty where these are too many
};

/// All bundles of `goals`, of which those of `before` are the first `known`: each bundle there that is
/// needed, or none, with any of the further goals.
Bundles extended(const Instance& instance, const VisitTimes& times, const Bundles& before,
                 const std::vector<std::uint32_t>& goals, std::size_t known);

}  // namespace outrider::tour
