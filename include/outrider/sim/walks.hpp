// draw_walks(): the true motion of simulated targets that walk about.
//
// A target alternates between resting and walking. It rests at a place for an exponential time. Then it walks
// to another place along the shortest path around the obstacles. The next place is drawn by weight from those
// that can be reached. Units: m, s.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/path/routes/routes.hpp"

namespace outrider {

/// The habits of targets that walk about.
struct Walkers {
  std::vector<Vec2> places;     ///< where they rest; target i begins at place i
  std::vector<double> weights;  ///< by place
  double speed_mps = 1.0;       ///< of walking
  double rest_s = 15.0;         ///< mean duration of a rest
};

/// Draws the walks of all targets until `until_s`, with routes between the places. The result is a pure
/// function of the arguments, except for the stop token. Fault: cancelled.
Outcome<std::vector<Walk>> draw_walks(const Walkers& walkers, const Routes& routes, std::uint64_t seed,
                                      double until_s, const std::stop_token& stop = {});

}  // namespace outrider
