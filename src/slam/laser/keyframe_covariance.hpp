// The covariance of the last keyframe relative to the first: its marginal in the linearised pose graph.
//
// A scan is matched with the map of several keyframes, so its match is a constraint to each of them, with a
// share of the information. Such a chain drifts much less than one of matches of each keyframe with the one
// before: where shares w_k of the information W are at lags k, the covariance grows by 1 / (W sum k^2 w_k)
// for each keyframe. Only two lags are kept, which grow as all do.
//
// A keyframe at a place that was seen many times is no node of the graph: it is attached to the one it was
// matched with there. So a robot that goes round and round takes little memory, and time.
//
// After a robot was carried for kilometres the information can be too ill conditioned to be factored. Then
// the covariance is an upper bound: that of the keyframe before, and of the constraint from it.
//
// The factor of the information is updated where constraints were added, and computed anew after poses moved.
// Complexity: a keyframe, the columns of the factor that depend on its neighbours.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "algebra/block_cholesky.hpp"
#include "graph/graph_edges.hpp"
#include "laser/keyframe.hpp"

namespace outrider {

/// A keyframe whose surfaces another one was matched with, together with those of others.
struct MatchedWith {
  std::uint32_t keyframe = 0;
  double share = 0.0;  ///< of the information; those of a match sum to 1
};
using Matched = std::array<MatchedWith, 2>;

/// A constraint between two keyframes, the later one last.
struct KeyframeConstraint {
  GraphEdge edge;
  Eigen::Matrix3d shared = Eigen::Matrix3d::Zero();  ///< part of its information that comes from a match
  Matched matched{};
  bool is_known_place = false;  ///< it joins a place that was seen many times
  double certainty = 1.0;       ///< factor of the information that comes from a match
};

class KeyframeCovariance {
 public:
  /// Returns the covariance of (x, y, heading) of the last keyframe, along the world's axes; zero for the
  /// first. `constraints` are those of the call before, and new ones after them, unless forget() was called.
  Eigen::Matrix3d of_last(std::span<const Keyframe> keyframes,
                          std::span<const KeyframeConstraint> constraints);
  /// The poses or the constraints changed.
  void forget();

 private:
  /// The place of a keyframe in the graph: at a node, or attached to the keyframe of one.
  struct Place {
    std::uint32_t keyframe = 0;
    std::uint32_t node = 0;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< relative to it, along the world's axes
  };

  void add_keyframe(std::span<const Keyframe> keyframes, std::span<const KeyframeConstraint> constraints);
  void add(std::span<const Keyframe> keyframes, const KeyframeConstraint& constraint);
  void join(std::span<const Keyframe> keyframes, std::uint32_t from, std::uint32_t to,
            const Eigen::Matrix3d& covariance);
  bool factor();

  std::vector<Place> places_;  ///< by keyframe
  BlockMatrix<3> matrix_;      ///< information
  BlockCholesky<3> factor_;
  std::vector<std::uint32_t> changed_;  ///< nodes
  std::size_t constraints_ = 0;
  std::size_t ordered_ = 0;  ///< number of nodes when the elimination order was chosen
  bool is_factored_ = false;

  Eigen::Matrix3d last_ = Eigen::Matrix3d::Zero();  ///< of the keyframe `counted_` - 1
  std::size_t counted_ = 0;
};

}  // namespace outrider
