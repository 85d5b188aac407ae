// Pibt: one step of all robots by priority inheritance with backtracking.
//
// A robot takes the free neighbour that is nearest to its goal. If another robot is there that has not moved
// yet, that one moves first, with the priority of the robot that pushes it; if it cannot, the next neighbour
// is tried. Source: Okumura, Machida, Defago and Tamura (2022).
#pragma once

#include <array>
#include <vector>

#include "fleet_query.hpp"

namespace outrider::fleet {

class Pibt {
 public:
  explicit Pibt(const Query& query);

  /// Begins a step from these cells.
  void begin(const std::vector<State>& now);
  /// Fixes where a robot goes. Returns false if another one that was fixed is there, or comes from there.
  bool fix(std::size_t robot, State to);
  /// Moves a robot, and those that it pushes, unless it has moved. Returns false if it must collide.
  bool move(std::size_t robot);
  /// Returns the cells after the step.
  [[nodiscard]] const std::vector<State>& next() const { return next_; }

 private:
  [[nodiscard]] bool taken(std::size_t robot, State to) const;
  void take(std::size_t robot, State to);

  const Query& query_;
  std::vector<State> now_, next_;  // by robot; `unreachable` before it moves
  std::vector<std::uint32_t> here_,
      there_;  // by state: the robot that is there, or will be; `unreachable`: none
};

}  // namespace outrider::fleet
