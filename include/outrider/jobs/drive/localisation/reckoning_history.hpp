// ReckoningHistory: past states of dead reckoning, so that an image whose tags are known late corrects the
// belief of its own time. The commands since then are kept too: dead reckoning is repeated with them up to
// the present (Larsen, Andersen, Ravn and Poulsen, Incorporation of time delayed measurements in a
// discrete-time Kalman filter, CDC 1998, first method). O(states since the image) an image.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "outrider/jobs/drive/localisation/dead_reckoning.hpp"

namespace outrider {

/// The states and commands of the last time.
struct ReckoningHistory {
  std::deque<Reckoning> states;          ///< in the order of time
  std::deque<Reckoning::Sent> commands;  ///< sent since the oldest of them

  /// Adds a state, and forgets all but one of those that are older than `keep_s`.
  void add(const Reckoning& state, double keep_s);
  /// Forgets all.
  void clear();

  /// Returns the newest state at or before a time, with the commands that were sent since then, and removes
  /// the later ones. `removed_s` receives their times. Returns nothing if all states are later.
  std::optional<Reckoning> rewind(double time_s, std::vector<double>& removed_s);
};

}  // namespace outrider
