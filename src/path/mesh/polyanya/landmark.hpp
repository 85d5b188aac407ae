// Lower bounds of the length to the goal by one landmark: a turn from which the lengths of the shortest paths
// to all turns are known.
//
// The length from a turn to the goal is at least the difference of their lengths from the landmark (triangle
// inequality). A block of a single side is a gate: all paths between its two sides lead through it. Towards
// the last gate before the blocks of start and goal meet, the landmark tells nearly the whole length, since
// it lies beyond; from that gate to the goal, the gaps between the gates and the landmark tell the rest.
//
// The lengths take 8 bytes a turn and one sweep over the taut legs of the mesh, about as long as making it.
// Sources: landmarks, Goldberg and Harrelson, Computing the shortest path: A* search meets graph theory
// (2005).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "taut_legs.hpp"

namespace outrider::polyanya_search {

inline double length(double x, double y) { return std::sqrt(x * x + y * y); }
inline double length(Cell a, Cell b) { return length(b.x - a.x, b.y - a.y); }

/// A block of a single side.
struct Gate {
  Cell a, b;  ///< ends of the side
  double most =
      std::numeric_limits<double>::infinity();  ///< at least the length from the landmark to its points

  [[nodiscard]] double distance(Cell p) const {
    const double x = b.x - a.x, y = b.y - a.y, to_x = p.x - a.x, to_y = p.y - a.y;
    const double along = std::clamp((to_x * x + to_y * y) / (x * x + y * y), 0.0, 1.0);
    return length(to_x - along * x, to_y - along * y);
  }
};

class Landmark {
 public:
  void forget() { distances_.clear(); }
  [[nodiscard]] bool known() const { return !distances_.empty(); }
  /// Finds the lengths from the landmark of each connected component. The blocks of all sides must be known.
  void find(const NavigationMesh& mesh);

  /// Returns the length from the landmark to a turn, cells.
  [[nodiscard]] double to(std::uint32_t turn) const { return distances_[turn]; }
  /// Returns at most the length from the landmark to a corner of these polygons.
  [[nodiscard]] double least_to(const NavigationMesh& mesh, const std::vector<std::uint32_t>& polygons,
                                Cell corner) const;
  [[nodiscard]] bool is_gate(std::uint32_t block) const { return gates_[block].a != gates_[block].b; }
  [[nodiscard]] const Gate& gate(std::uint32_t block) const { return gates_[block]; }

 private:
  [[nodiscard]] Gate gate_at(const NavigationMesh& mesh, std::uint32_t s) const;
  [[nodiscard]] double most_to(const NavigationMesh& mesh, std::uint32_t polygon, Cell corner) const;
  void search(const NavigationMesh& mesh, std::uint32_t landmark);

  std::vector<double> distances_;  // by turn
  std::vector<Gate> gates_;        // by block; without a length if it is none
  TautSweep sweep_;
};

/// Bounds of one query.
class LandmarkBounds {
 public:
  /// The gate by which a block is left, as its block; or one of these.
  static constexpr std::uint32_t no_exit = NavigationMesh::none;
  static constexpr std::uint32_t climbs = no_exit - 1;  ///< towards the last gate on the side of the start

  void clear() { landmark_ = nullptr; }
  /// Prepares the bounds; `goal_least`: at most the length from the landmark to the goal. Calls set(block,
  /// exit) for the blocks `up`, from the start to where those of the goal meet them, and `down`, from the
  /// goal. Neither end may be a pinch.
  template <class Set>
  void begin(const Landmark& landmark, const std::vector<std::uint32_t>& up,
             const std::vector<std::uint32_t>& down, Cell goal, double goal_least, Set set) {
    landmark_ = &landmark;
    goal_ = goal_least - rounding * goal_least;
    std::uint32_t exit = no_exit;
    for (const std::uint32_t block : down) {
      set(block, exit);
      if (landmark.is_gate(block)) exit = block;
    }
    std::size_t i = up.size();
    for (; i > 0 && !landmark.is_gate(up[i - 1]); --i) set(up[i - 1], exit);
    if (i > 0) pass_last_gate(landmark.gate(up[i - 1]), exit, goal);
    for (; i > 0; --i) set(up[i - 1], climbs);
  }

  /// Returns the least length to the goal from a turn that was reached at a side of a block with that exit; 0
  /// if nothing is known.
  [[nodiscard]] double remaining(std::uint32_t turn, Cell at, std::uint32_t exit) const {
    if (landmark_ == nullptr || exit == no_exit) return 0.0;
    if (exit == climbs) return landmark_->to(turn) + beyond_gate_;
    const Gate& gate = landmark_->gate(exit);
    return gate.distance(at) + goal_ - gate.most;
  }

 private:
  static constexpr double rounding = 1e-12;
  void pass_last_gate(const Gate& gate, std::uint32_t exit, Cell goal);

  const Landmark* landmark_ = nullptr;
  double beyond_gate_ =
      0.0;             // from the last gate of the climb to the goal, less the length from the landmark there
  double goal_ = 0.0;  // at most the length from the landmark
};

}  // namespace outrider::polyanya_search
