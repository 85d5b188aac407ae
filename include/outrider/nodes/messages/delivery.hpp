// Delivery: how messages of a topic are delivered, as Nav2 has it.
#pragma once

#include <cstdint>

namespace outrider {

enum class Delivery : std::uint8_t {
  reliable,  ///< every message, to who listens now; the newest 10 wait
  sensor,    ///< best effort; the newest 10
  latched,   ///< every message, and the newest one to who comes later
  fixed      ///< latched, and sent by several: a reader keeps 100
};

}  // namespace outrider
