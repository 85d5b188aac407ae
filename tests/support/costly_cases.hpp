// How much of a costly test is done: all of it, or a part where sanitizers slow it down.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace outrider::testing {

/// As cases() of random_cases.hpp, and with OUTRIDER_CASES=0.1, as `make asan` sets it, a tenth of them,
/// but one at least.
inline int costly_cases(int usual) {
  const char* factor = std::getenv("OUTRIDER_CASES");
  return factor == nullptr ? usual : std::max(1, static_cast<int>(usual * std::atof(factor)));
}

/// The same, and never more than `all`: where more of it would tell nothing more.
inline int part_of(int all) { return std::min(all, costly_cases(all)); }

/// False where only a part is done: too little for counts and averages to mean anything.
inline bool in_full() { return part_of(10) == 10; }

}  // namespace outrider::testing
