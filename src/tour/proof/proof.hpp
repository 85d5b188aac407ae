// Proof: a lower bound on every tour of the given stops, for any number of goals, or the best tour.
#pragma once

#include "local_search/route.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider::tour {

struct Proof {
  std::vector<std::uint32_t> nodes;  ///< a faster tour; empty when none was found
  double lower_bound = 0.0;
  bool optimal = false;  ///< the best tour known is the fastest
  std::uint64_t labels = 0;
};

/// Shows, when it can, that no tour takes less than (1 - options.gap) times the known one: sweeps (sweep.hpp)
/// over ever more of the goals, then the exact end (finish.hpp). Where the operations end before, or there
/// are more than 40 goals, the bound is the better of the last sweep's and of shares (ascent.hpp).
/// Deterministic. Memory: about 2 KB for each label and row; 2^10 * stops * sectors floats for the shares.
Proof prove(const Instance& instance, const Route& known, const TourOptions& options, BudgetMeter& meter);

}  // namespace outrider::tour
