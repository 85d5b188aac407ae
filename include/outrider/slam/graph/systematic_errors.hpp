// find_systematic_errors(): how far off can a solved pose graph be, though all its measurements agree?
//
// Information matrices describe errors that differ from one measurement to the next. Wheels that slip, or a
// range finder that adds a length, change all measurements of a kind alike, and the map takes them up: if
// odometry counts 5 % too much and ranges are 5 % too long, the map is 5 % too large and no residual tells.
// So five such errors join the normal equations as unknowns:
//
//   odometry counts ways by a part too long; turns by a part too large; a turn for each metre;
//   ranges to points are too long by a length; by a part.
//
// The equations are solved with three priors. Stated tolerances: 1 % of each range and of the mean range, and
// for odometry what its noise would be if it were always the same over 1 m and 1 rad. The direction in which
// the points then are least certain is what the measurements do not see. The two others say whose fault it is
// if odometry and ranges contradict each other: that of odometry, which may be off by 10 %, or that of
// ranges, which may. Both are asked, since the measurements do not tell them apart. A length that is added to
// ranges may be large with both, 0.3 m: where ranges differ, the measurements see it.
//
// Complexity: one factorisation of the graph and six solutions. Thread rule: pure.
// Source: Schmidt, Application of state-space methods to navigation problems, Advances in Control Systems 3
// (1966) 293-340, for errors that are considered and not solved; Sibley, Matthies and Sukhatme, JFR 27 (2010)
// 587-608, for their elimination.
#pragma once

#include <string>
#include <vector>

#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

/// Shared errors in the order above.
using SharedErrors = Eigen::Matrix<double, 5, 1>;

/// How far the points of a map may be off, or its poses: root mean square distances after a rigid alignment.
struct MapShift {
  double moved_m = 0.0;   ///< by the estimate of the shared errors
  double unseen_m = 0.0;  ///< by one standard deviation along the direction that moves them most
  double most_m = 0.0;  ///< what a map that is done may be off by: 0.1 m, of poses 0.25 m, or 3 % of its size
  SharedErrors direction = SharedErrors::Zero();  ///< one standard deviation along it
};

/// The solution with one prior.
struct SharedSolution {
  SharedErrors estimate = SharedErrors::Zero();
  double gain = 0.0;  ///< by which the errors lower the cost, with their prior and of noise as large as it is
  MapShift points;
  MapShift poses;
};

struct SystematicErrors {
  SharedSolution stated;    ///< with the prior of stated tolerances
  SharedSolution odometry;  ///< if odometry is at fault
  SharedSolution ranges;    ///< if the part of ranges is at fault
};

/// `poses` are those of least cost. Nothing is found in a graph without ranges and points, whose size no
/// second kind of measurement tells.
SystematicErrors find_systematic_errors(const PoseGraph& graph, const std::vector<Pose2>& poses);

/// Returns why the size of a map is in doubt, as a clause; empty if it is not. It is in doubt
/// - if one standard deviation of stated tolerances may move its points by more than they may be off;
/// - if errors of odometry are significant (chi-square with five degrees of freedom, one time in 200), or of
///   ranges (two degrees, one time in 100), and with one standard deviation of what is not seen move the map
///   by more than it may be off.
std::string why_not_believed(const SystematicErrors& errors);

}  // namespace outrider
