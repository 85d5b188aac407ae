// Which sighting is of which landmark: joint compatibility branch and bound.
//
// A pairing gives sightings to landmarks, each at most once. It is compatible when the joint Mahalanobis
// distance of its innovations lies within the gate for as many numbers, and so does that of each of its
// beginnings in the order of the sightings. Of the compatible pairings: one with the most pairs, and among
// these one of the least distance. Exponential in the sightings at worst; the gate keeps it small.
// Source: Neira and Tardos, IEEE Transactions on Robotics and Automation 17 (2001) 890-897.
// Thread rule: pure function.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A sighting and a landmark that may be the same.
struct PossiblePair {
  std::size_t sighting = 0;
  std::size_t landmark = 0;
  Vec2 innovation;  ///< sighted less expected
};

/// Indices of pairs, ascending; `covariance` is that of all innovations in their order, (2n)^2 numbers by
/// rows. `pairs` stand in the order of their sightings.
std::vector<std::size_t> joint_compatibility(const std::vector<PossiblePair>& pairs,
                                             const std::vector<double>& covariance, double gate);

/// The squared Mahalanobis distance that holds that share of a normal distribution of `numbers` dimensions,
/// an even number (or 0, then 0).
double squared_gate(double share, std::size_t numbers);

}  // namespace outrider
