// Maps of free, occupied and unknown cells.
#pragma once

#include <cstdint>
#include <memory>

#include "outrider/world/grid.hpp"

namespace outrider::python {

/// Values of Occupancy; never changed after construction.
using SharedOccupancy = std::shared_ptr<Grid<std::uint8_t>>;

}  // namespace outrider::python
