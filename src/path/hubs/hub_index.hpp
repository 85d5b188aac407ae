// The common parts of the two indices of hubs.
#pragma once

#include <cstdint>
#include <limits>

#include "outrider/core/budget.hpp"

namespace outrider::hub_labelling {

/// The answer of an index to a query for a path that turns.
enum class Found { way, no_path, out_of_budget };

/// The kind of an index, as it is stored.
enum class IndexKind : std::uint64_t { none, labels, guided };

/// The nodes of the best common hub at which the two halves of a path meet.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint32_t start_node = 0, goal_node = 0;
};

/// Work of building labels or trees that is allowed for so much memory: labels visited. 64 MiB allow some
/// seconds.
constexpr std::uint64_t most_work_for(std::size_t bytes) { return std::uint64_t{bytes} << 6U; }

}  // namespace outrider::hub_labelling
