// Data association by joint compatibility branch and bound (JCBB).
//
// A pairing assigns sightings to landmarks, each at most once. It is compatible when the joint Mahalanobis
// distance of its innovations lies within the gate for as many numbers, and so does that of each of its
// beginnings in the order of the sightings. Of the compatible pairings: one with the most pairs, and among
// these one of the least distance. Exponential in the sightings at worst; the gate keeps it small.
// Source: Neira and Tardos, IEEE Transactions on Robotics and Automation 17 (2001) 890-897.
// Thread rule: pure function.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A possible association of a sighting with a landmark.
struct PossiblePair {
  std::size_t sighting = 0;
  std::size_t landmark = 0;
  Vec2 innovation;  ///< sighted less expected
};

/// Returns the indices of the chosen pairs, ascending. `pairs` are in the order of their sightings;
/// `covariance`, 2n x 2n, is that of all innovations in this order.
std::vector<std::size_t> joint_compatibility(const std::vector<PossiblePair>& pairs,
                                             const Eigen::MatrixXd& covariance, double gate);

/// The squared Mahalanobis distance that holds that share of a normal distribution of `numbers` dimensions,
/// an even number (or 0, then 0).
double squared_gate(double share, std::size_t numbers);

}  // namespace outrider
