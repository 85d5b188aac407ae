// Clocks, for what is measured.
#pragma once

#include <chrono>
#include <ctime>

namespace outrider::cli {

/// Spent by this thread alone, s: nothing else of the tool counts.
inline double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace outrider::cli
