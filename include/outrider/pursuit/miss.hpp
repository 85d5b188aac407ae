// Miss: why a target cannot be caught, and how near the robot can come to it.
#pragma once

#include <optional>
#include <string>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

enum class MissReason {
  too_few_seconds,  ///< the target is gone before the first second that counts
  always_on_walls,  ///< the target is on walls in every second that counts
  cut_off,          ///< the robot can reach none of the cells that the target visits
  too_late,         ///< the robot reaches cells of the target, but only after it has left them
};
std::string_view to_string(MissReason reason);

struct Miss {
  MissReason reason = MissReason::too_late;
  std::optional<int> late_by_s;  ///< the least delay at any cell of the target; none when none is reached
  Cell late_at;                  ///< and where
  int late_for_s = 0;            ///< the second in which the target was there
  int short_by_cells = 0;        ///< the least number of king's moves between robot and target in any second
  int short_at_s = 0;            ///< and when
  std::string sentence;          ///< all of it for a person
};

/// Why there is no catch; nothing when there is one. The problem passes check(problem).
/// O(cells log(side) + seconds).
std::optional<Miss> why_no_catch(const PursuitProblem& problem);

}  // namespace outrider
