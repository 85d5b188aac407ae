// Turn: what has one memory serves one thread at a time, and refuses a second one.
#pragma once

#include <fmt/format.h>

#include <mutex>
#include <string_view>

#include "faults.hpp"

namespace outrider::python {

class Turn {
 public:
  /// Returns the turn, which ends with the lock. Raises BadInput while another thread has it.
  std::unique_lock<std::mutex> take(std::string_view what) {
    std::unique_lock turn(busy_, std::try_to_lock);
    if (turn.owns_lock()) return turn;
    refuse(fmt::format("another thread uses this {}; give each thread its own", what), "");
  }

 private:
  std::mutex busy_;
};

}  // namespace outrider::python
