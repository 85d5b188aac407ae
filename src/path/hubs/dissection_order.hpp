// The free cells of a grid in the order of a nested dissection: a row or column that cuts a rectangle in two
// comes before the cells of both parts.
//
// Cheapest paths between the parts pass the cut, so its cells are good hubs.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider::hub_labelling {

/// Returns the indices of the free cells. Each rectangle is cut across its longer side, in the middle third,
/// where the fewest cells are free; of a cut the cells in the middle come first. O(cells * log(cells)).
std::vector<std::uint32_t> dissection_order(const GridMap& ground, const std::stop_token& stop = {});

}  // namespace outrider::hub_labelling
