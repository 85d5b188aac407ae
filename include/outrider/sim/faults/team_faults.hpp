// TeamFaults: what goes wrong with robots on a grid that pursue a target (simulated_team.hpp).
//
// Each second but the first brings a sighting: the cell of the target, as many seconds ahead as its future is
// known. A sighting may be missing, late or wrong. A robot may be stuck, be put elsewhere, or come upon cells
// that have closed, which it cannot enter and notices only when it tries.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

struct TeamFaults {
  double missing_from_s = 1e9;     ///< from then on no sighting comes
  double missing_for_s = 1e9;      ///< for how long
  double missed = 0.0;             ///< part of the sightings that do not come, drawn for each
  std::int64_t late_s = 0;         ///< seconds by which each sighting is late
  double wrong = 0.0;              ///< part of the sightings that are wrong, drawn for each
  std::int64_t wrong_by = 3;       ///< cells by which a wrong one is off at most, along each axis
  double stuck_from_s = 1e9;       ///< from then on no robot moves
  double stuck_for_s = 1e9;        ///< for how long
  double kidnapped_at_s = 1e9;     ///< when the robot on duty is put elsewhere
  std::int64_t kidnapped_by = 5;   ///< cells away at most, along each axis; drawn
  double closed_at_s = 1e9;        ///< when cells ahead of the robot on duty close
  double closed_for_s = 1e9;       ///< for how long
  std::int64_t closed_ahead = 3;   ///< cells from the robot towards the target to the middle of them
  std::int64_t closed_radius = 1;  ///< cells from their middle, along each axis

  /// Returns true if sightings are missing, late or wrong.
  [[nodiscard]] bool of_sightings() const;
  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const;
};
std::vector<Option> describe(TeamFaults& faults);

}  // namespace outrider
