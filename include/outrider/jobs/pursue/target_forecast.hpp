// TargetForecast: predictions of the unknown future of a target from its past.
//
// A forecast is a pure function of the cells seen so far and of the robot's cell. It assumes that a target
// which was never on a wall stays off walls. Each row states its assumption about the target; none is a
// guarantee.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// The input of a forecast.
struct TargetSeen {
  const PursuitProblem& map;    ///< only its costs and threshold, not its target
  std::span<const Cell> cells;  ///< known cells of the target at second 0, 1, ...; not empty
  Cell robot;                   ///< current cell of the robot
};

/// A row of the catalogue of forecasts.
struct TargetForecast {
  std::string_view name;
  std::string_view sentence;
  /// Returns the target's cells in the `seconds` after the last known one. O(seconds), `evade` O(cells +
  /// seconds).
  std::function<std::vector<Cell>(const TargetSeen&, std::size_t seconds)> predict;
};

/// Returns all forecasts: last_velocity, visit_map, evade, stay.
const std::vector<TargetForecast>& target_forecasts();

/// Fault: bad_input with the nearest known name.
Outcome<TargetForecast> find_target_forecast(std::string_view name);

}  // namespace outrider
