// Intruders of a simulation: when they come in, where they stay, and what becomes of those who are hit.
#pragma once

#include <cstddef>
#include <string>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Intruder {
  std::string name;       ///< of its place; the second one there is called "fox_2", and so on
  std::size_t place = 0;  ///< index of the target in whose box it stays
  std::string entrance;
  Vec2 from;               ///< where that is
  double enters_s = 0.0;   ///< when it comes in, and is known
  double settles_s = 0.0;  ///< when it is in its place
};

/// What becomes of those who are hit.
struct Survival {
  double leave = 1.0;     ///< probability; who does not leave walks to another place
  double walk_mps = 1.0;  ///< 0: it is there at once
};

/// Where one who is hit at `place` goes, if it does not leave: another of the places, drawn uniformly.
/// There are at least two.
std::size_t elsewhere(std::size_t place, std::size_t places, Rng& rng);

}  // namespace outrider
