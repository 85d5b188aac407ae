// find_systematic_errors(): how far off can a solved pose graph be, though all its measurements agree?
//
// Information matrices describe errors that differ from one measurement to the next. Wheels of another size
// than told, or a range finder that adds a length, change all measurements of a kind alike, and the map takes
// them up: if odometry counts 5 % too much and ranges are 5 % too long, the map is 5 % too large and no
// residual tells. So five such errors join the normal equations as unknowns:
//
//   odometry counts ways by a part too long; turns by a part too large; a turn for each metre;
//   ranges to points are too long by a length; by a part.
//
// Their prior is what the noise of a measurement would be if it were always the same: of odometry over 1 m
// and 1 rad, of a range at its mean length. Wheels of a wrong size err by the same part in ways and in turns,
// so these two are correlated. The posterior of the errors then gives that of the map, up to a rigid motion:
// directions that the measurements do not see keep the width of the prior, and errors that they see stand out
// as a mean.
//
// Complexity: one factorisation of the graph and six solutions. Thread rule: pure.
// Source: Schmidt, Application of state-space methods to navigation problems, Advances in Control Systems 3
// (1966) 293-340, for errors that are considered and not solved; Sibley, Matthies and Sukhatme, JFR 27 (2010)
// 587-608, for their elimination.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "outrider/slam/pose_graph.hpp"

namespace outrider {

/// Shared errors in the order above.
using SharedErrors = Eigen::Matrix<double, 5, 1>;

/// How far the points of a map may be off, or its poses: root mean square distances after a rigid alignment.
struct MapShift {
  double moved_m = 0.0;   ///< by the estimate of the shared errors
  double unseen_m = 0.0;  ///< by one standard deviation along the direction that moves them most
  double most_m = 0.0;    ///< what a map that is done may be off by
  SharedErrors worst = SharedErrors::Zero();  ///< the estimate, and 1.5 times that direction on top of it
};

struct SystematicErrors {
  SharedErrors prior_sd = SharedErrors::Zero();
  SharedErrors estimate = SharedErrors::Zero();
  SharedErrors sd = SharedErrors::Zero();
  double gain = 0.0;  ///< by which the errors lower the cost, with their prior and of noise as large as it is
  MapShift points;
  MapShift poses;
};

/// `poses` are those of least cost. Nothing is found in a graph without ranges and points, whose scale no
/// second kind of measurement tells.
SystematicErrors find_systematic_errors(const PoseGraph& graph, const std::vector<Pose2>& poses);

/// Returns why the size of a map is in doubt, as a clause; empty if it is not. Points may be off by 0.1 m and
/// poses by 0.25 m, or by 3 % of the size of the map. It is in doubt if what the measurements do not see is
/// more, or if they are implausible without shared errors (chi-square, one time in 20), and these with 1.5
/// standard deviations of what is not seen are more.
std::string why_not_believed(const SystematicErrors& errors);

}  // namespace outrider
