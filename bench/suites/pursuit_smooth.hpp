// Measures the optimal pursuit on smooth maps made from seeds, beside the plain programme over layers
// (tests/support/layer_programme.hpp) in the same run.
//
// A row holds the processor time of both, and each better catch with the expansions until then. A cost that
// differs, or a time that is more than a tenth and 20 ms above that of the programme, is wrong.
#pragma once

#include "suites.hpp"

namespace outrider::bench {

Outcome<BenchResult> measure_smooth_pursuit(const BenchObserver& observer);

}  // namespace outrider::bench
