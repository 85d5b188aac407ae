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

}  // namespace outrider::testing
