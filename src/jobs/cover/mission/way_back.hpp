// WayBack: ways from where a robot is to a piece of its track.
//
// A robot that turns in place goes the shortest way of its disk. One with a turning radius goes a Dubins or
// Reeds-Shepp path, or a chain of them over poses of its track (turning_transit.hpp).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider::cover {

class WayBack {
 public:
  WayBack(const CoverProblem& problem, const Budget& budget) : problem_(problem), budget_(budget) {}

  /// Returns the pieces to the beginning of the piece, none if the robot is there; nothing if no way was
  /// found. `track` are pieces whose poses a chain of turning paths may use.
  std::optional<std::vector<PathPiece>> way(const Pose2& from, const PathPiece& to,
                                            const std::shared_ptr<const PolygonGround>& ground,
                                            std::span<const PathPiece> track);

 private:
  [[nodiscard]] std::optional<std::vector<PathPiece>> turning_way(const Pose2& from, const Pose2& to,
                                                                  const PolygonGround& ground,
                                                                  std::span<const PathPiece> track) const;

  const CoverProblem& problem_;
  Budget budget_;
  Workspace workspace_;
};

}  // namespace outrider::cover
