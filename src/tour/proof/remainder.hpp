// Remainder: the least that a tour still has to pay for its drives, its turns and the goals apart, once the
// shares of an ascent are paid.
#pragma once

#include "proof/ascent.hpp"
#include "proof/relaxation.hpp"

namespace outrider::tour {

/// `drives` are those of the instance, by sector. A dynamic program over sets of `apart` goals, at most 16,
/// as in relaxation.hpp; but a stop may be passed where nobody of them is served, since what is left of two
/// drives can be less than what is left of one. 0 when the budget ends, one expansion a set; never above the
/// true remainder. The same for any number of threads. O(2^apart * stops^2 * sectors) a pass, of which a set
/// takes a few; 2^apart * stops * sectors floats.
double remainder(const Instance& instance, const Shares& shares, const std::vector<std::uint32_t>& apart,
                 RelaxedDrives drives, BudgetMeter& meter);

}  // namespace outrider::tour
