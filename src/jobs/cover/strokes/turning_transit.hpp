// TurningTransit: quick ways of a robot with a turning radius between poses, in a roadmap.
//
// Nodes are poses: the ends of strokes, driven either way. Edges are the strokes themselves and, between
// neighbouring nodes, the shortest Dubins or Reeds-Shepp path that is free. Ways are the quickest chains of
// edges: so the robot goes along the headland where no single path leads. A way that is found is free; one
// that is not found may exist. O(n^2) turning paths for n nodes, O(n log n) for the ways from a node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ground/free_room.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"

namespace outrider::cover {

/// Returns the shortest path that is free, as pieces; nothing if none of the words is. `to` of the last piece
/// is the goal.
std::optional<std::vector<PathPiece>> free_turning_path(const Pose2& from, const Pose2& to,
                                                        const CoverProblem& problem, const FreeRoom& room);

class TurningTransit {
 public:
  struct Ways {
    std::vector<double> times_s;        ///< to every node; infinite where none leads
    std::vector<std::uint32_t> before;  ///< the node before each on the way
  };

  TurningTransit(const CoverProblem& problem, const FreeRoom& room) : problem_(problem), room_(room) {}

  std::size_t add(const Pose2& pose);
  [[nodiscard]] const Pose2& pose(std::size_t node) const { return poses_[node]; }
  [[nodiscard]] std::size_t size() const { return poses_.size(); }
  /// Adds an edge: the pieces lead from one node to the other.
  void join(std::size_t from, std::size_t to, std::vector<PathPiece> pieces);
  /// Adds free paths from each of the nodes `from` to its nearest ones in `to`. Fewer once the token is
  /// raised.
  void connect(std::span<const std::size_t> from, std::span<const std::size_t> to,
               const std::stop_token& stop);

  [[nodiscard]] Ways ways_from(std::size_t node) const { return search(node, edges_); }
  /// Returns the times from every node to this one.
  [[nodiscard]] Ways ways_to(std::size_t node) const;
  /// Returns the pieces of a way that ways_from(from) found.
  [[nodiscard]] std::vector<PathPiece> pieces(const Ways& ways, std::size_t from, std::size_t to) const;

 private:
  struct Edge {
    std::uint32_t to;
    double time_s;
    std::vector<PathPiece> pieces;
  };
  using Edges = std::vector<std::vector<Edge>>;
  [[nodiscard]] Ways search(std::size_t node, const Edges& edges) const;

  const CoverProblem& problem_;
  const FreeRoom& room_;
  std::vector<Pose2> poses_;
  Edges edges_;
};

}  // namespace outrider::cover
