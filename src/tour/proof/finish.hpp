// Finish: the exact end of a proof. It sweeps forward over the sets of goals served, with partial tours for
// states, which fall by dominance and by what the last sweep backward says is still to come.
#pragma once

#include "proof/sweep.hpp"

namespace outrider::tour {

struct Finish {
  std::vector<std::uint32_t> nodes;  ///< the fastest tour below the limit; empty when there is none
  double cost = infinity;
  bool finished = false;  ///< or else a faster one may exist
  std::uint64_t labels = 0;
};

/// Looks for the fastest tour below the limit. `goals` are all, at most 64, those of `back` first; `bundles`
/// are all that are left of them. It ends at `most_labels` partial tours, with the budget, or at a visit of
/// more than 16 goals.
Finish finish(const SweepContext& context, const Sweep& back, const std::vector<std::uint32_t>& goals,
              const Bundles& bundles, std::uint64_t most_labels, BudgetMeter& meter);

}  // namespace outrider::tour
