// Miss: the reason why a target cannot be caught, and how near the robot can come to it.
#pragma once

#include <optional>
#include <string>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// Reasons why there is no catch.
enum class MissReason {
  too_few_seconds,  ///< the trajectory ends before the first second in which a catch counts
  always_on_walls,  ///< the target is on walls in every second in which a catch counts
  cut_off,          ///< the robot can reach none of the cells that the target visits
  too_late,         ///< the robot reaches cells of the target, but only after it has left them
};
std::string_view to_string(MissReason reason);

/// The reason why there is no catch, with numbers.
struct Miss {
  MissReason reason = MissReason::too_late;  ///< the first reason that applies
  std::optional<int>
      late_by_s;           ///< smallest delay at any cell of the target; empty if the robot reaches none
  Cell late_at;            ///< the cell of that delay
  int late_for_s = 0;      ///< the second in which the target was there
  int short_by_cells = 0;  ///< smallest Chebyshev distance between robot and target in any second
  int short_at_s = 0;      ///< the second of that distance
  std::string sentence;    ///< the explanation for a person
};

/// Returns the reason why there is no catch, or nothing if there is one. The problem must pass
/// check(problem). O(cells log(side) + seconds).
std::optional<Miss> why_no_catch(const PursuitProblem& problem);

}  // namespace outrider
