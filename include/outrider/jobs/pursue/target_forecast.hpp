// Forecasts of a target whose future is not known: where it will be, from where it was.
//
// A forecast is a pure function of the cells seen so far and of the robot's cell. A target that has never
// stood on a wall is not expected to. Each row says what it takes the target for; none is a promise.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// What a forecast goes by.
struct TargetSeen {
  const PursuitProblem& map;    ///< its costs and threshold; not its target
  std::span<const Cell> cells;  ///< of the target at second 0, 1, ... as far as known; not empty
  Cell robot;                   ///< where the robot is
};

struct TargetForecast {
  std::string_view name;
  std::string_view sentence;
  /// The target's cells in the `seconds` after the last one seen. O(seconds), `evade` O(cells + seconds).
  std::function<std::vector<Cell>(const TargetSeen&, std::size_t seconds)> predict;
};

/// last_velocity, visit_map, evade, stay.
const std::vector<TargetForecast>& target_forecasts();

/// Fault: bad_input with the nearest known name.
Outcome<TargetForecast> find_target_forecast(std::string_view name);

}  // namespace outrider
