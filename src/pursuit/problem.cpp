#include "outrider/pursuit/problem.hpp"

#include <fmt/format.h>

namespace outrider {
namespace {

Status check_map(const PursuitProblem& problem) {
  if (!problem.costs) return bad_input("the problem has no map; give it a grid of costs");
  const GridFrame& frame = problem.costs->frame;
  const bool sides = frame.width > 0 && frame.height > 0;
  if (!sides || frame.size() != problem.costs->cells.size() || frame.size() > most_pursuit_cells) {
    return bad_input(fmt::format(
        "a map of {} x {} cells with {} costs is not valid; give one cost for each of 1 to {} cells",
        frame.width, frame.height, problem.costs->cells.size(), most_pursuit_cells));
  }
  return {};
}

}  // namespace

std::string cell_text(Cell cell) { return fmt::format("({}, {})", cell.x + 1, cell.y + 1); }

Status check(const PursuitProblem& problem) {
  if (Status good = check_map(problem); !good) return good;
  const GridFrame& frame = problem.costs->frame;
  const std::size_t seconds = problem.target.size();
  if (seconds == 0 || seconds > most_pursuit_seconds) {
    return bad_input(fmt::format("a trajectory of {} seconds is not valid; give the target 1 to {} cells",
                                 seconds, most_pursuit_seconds));
  }
  for (std::size_t s = 0; s < seconds; ++s) {
    if (frame.contains(problem.target[s])) continue;
    return bad_input(
        fmt::format("at second {} the target is in cell {}, which is off the map of {} x {} cells", s,
                    cell_text(problem.target[s]), frame.width, frame.height));
  }
  if (problem.start_s < 0 || static_cast<std::size_t>(problem.start_s) >= seconds) {
    return bad_input(
        fmt::format("a start at second {} is not valid; expected 0 to {}", problem.start_s, seconds - 1));
  }
  if (!frame.contains(problem.start)) {
    return fault(FaultCode::outside_map,
                 fmt::format("the robot starts in cell {}, which is off the map of {} x {} cells",
                             cell_text(problem.start), frame.width, frame.height));
  }
  if (problem.wall(problem.start)) {
    return fault(FaultCode::start_blocked,
                 fmt::format("the robot starts in cell {}, a wall: its cost {} is not below the threshold {}",
                             cell_text(problem.start), (*problem.costs)[problem.start], problem.threshold));
  }
  return {};
}

}  // namespace outrider
