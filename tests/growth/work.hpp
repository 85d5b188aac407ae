// Counts what a call does, in units that are the same in every run: no clock is read.
//
//   blocks       basic blocks run in the source files that tests/CMakeLists.txt has compiled for counting;
//                what these call elsewhere (other files, other libraries) is not counted
//   allocations  calls of operator new and malloc, of everything but shared libraries' own malloc
//   peak_bytes   most bytes held at once, beyond what was held before
//
// Blocks depend on the compiler, bytes on the standard library. One thread at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

namespace outrider::growth {

struct Work {
  double blocks = 0.0;
  double allocations = 0.0;
  double peak_bytes = 0.0;
};

/// Runs the call with one thread of TBB, and returns what it took.
Work work_of(const std::function<void()>& call);

/// Runs the call with one thread of TBB, and requests a stop when it has run that many blocks. Returns how
/// many it ran in all.
double blocks_when_stopped(double at, const std::function<void(const std::stop_token&)>& call);

}  // namespace outrider::growth
