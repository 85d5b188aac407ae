// Simulated intruders: when they enter, where they stay, and whether they leave after a hit.
#pragma once

#include <cstddef>
#include <string>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// An intruder: where and when it enters, and the place where it stays.
struct Intruder {
  std::string name;        ///< name of its place; the second intruder there is called "fox_2", and so on
  std::size_t place = 0;   ///< index of the target in whose box it stays
  std::string entrance;    ///< name of the entrance
  Vec2 from;               ///< position of the entrance
  double enters_s = 0.0;   ///< time at which it enters and becomes known
  double settles_s = 0.0;  ///< time at which it reaches its place
};

/// The behaviour of an intruder after a hit: it leaves the yard, or survives and walks to another place.
struct Survival {
  double leave = 1.0;     ///< probability that it leaves
  double walk_mps = 1.0;  ///< walking speed of survivors; 0: they reach the next place at once
};

/// Draws the next place of an intruder that survives a hit at `place`, uniformly from the other places.
/// Requires at least two places.
std::size_t elsewhere(std::size_t place, std::size_t places, Rng& rng);

}  // namespace outrider
