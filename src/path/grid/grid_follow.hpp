// Updates of what was computed for one grid to the next grid.
#pragma once

#include <memory>
#include <utility>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Calls `make()` for a first or very different ground, `change(cells)` if few cells differ from the ground
/// for which the object was made, and nothing if the ground is the same. `made_for` keeps that ground alive,
/// because the next ground is compared with it; so any ground can follow any other.
template <class Make, class Change>
void follow(std::shared_ptr<const GridMap>& made_for, const std::shared_ptr<const GridMap>& now, Make make,
            Change change) {
  if (made_for == now) return;
  const std::shared_ptr<const GridMap> before = std::move(made_for);
  made_for = nullptr;
  const auto cells = before ? cells_changed(*before, *now, now->frame.size() / 32) : std::nullopt;
  cells ? change(*cells) : make();
  made_for = now;
}

}  // namespace outrider
