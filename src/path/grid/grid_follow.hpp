// How what was made for one grid follows the next one.
#pragma once

#include <memory>
#include <utility>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Calls `make()` for a first or a very different ground, `change(cells)` when few cells differ from those
/// of the ground it was made for, and nothing when it is the same one. `made_for` is kept alive, because it
/// is what the next ground is compared with: so any ground can follow any other, whoever made it.
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
