// Data association by joint compatibility branch and bound (JCBB).
//
// A pairing assigns sightings to landmarks; each sighting and each landmark appears at most once. A pairing
// is compatible if the joint squared Mahalanobis distance of its innovations is within the gate for their
// number of dimensions, and if the same holds for each of its prefixes in the order of the sightings. Of the
// compatible pairings, the function chooses one with the most pairs, and among these one of least distance.
// Exponential in the number of sightings at worst; the gate keeps it small.
// Source: Neira and Tardos, IEEE Transactions on Robotics and Automation 17 (2001) 890-897. Thread rule: pure
// function.
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
  Vec2 innovation;  ///< sighted minus expected position
};

/// Returns the indices of the chosen pairs, ascending. `pairs` are in the order of their sightings.
/// `covariance` (2n x 2n) is that of all innovations in the same order. `gate` is a probability, see
/// squared_gate(). Where so many pairings are compatible that the search would take more than about a tenth
/// of a second, the best that it has found by then.
std::vector<std::size_t> joint_compatibility(const std::vector<PossiblePair>& pairs,
                                             const Eigen::MatrixXd& covariance, double gate);

/// Returns the squared Mahalanobis distance that contains the fraction `share` of a normal distribution of
/// `numbers` dimensions. `numbers` must be even; for 0 the result is 0.
double squared_gate(double share, std::size_t numbers);

}  // namespace outrider
