// Occupancy: the state of a cell of a map.
#pragma once

#include <cstdint>

namespace outrider {

/// Values of a cell. Every value except 0 means that the cell is not known to be free.
enum Occupancy : std::uint8_t { free_cell = 0, occupied_cell = 1, unknown_cell = 2 };

}  // namespace outrider
