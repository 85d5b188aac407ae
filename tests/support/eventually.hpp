// Waits for what another thread or process does.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace outrider::testing {

/// However busy the machine is, nothing that is waited for takes longer; who waits, waits for an event.
inline constexpr std::chrono::seconds patience{300};

/// Asks again and again, for as long as patience lasts. Returns true once it is true.
inline bool eventually(const std::function<bool()>& what) {
  using Clock = std::chrono::steady_clock;
  for (const auto end = Clock::now() + patience; Clock::now() < end;) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace outrider::testing
