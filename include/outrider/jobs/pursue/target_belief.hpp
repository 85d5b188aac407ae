// TargetBelief: what a planner is told of the target: its cells as far as they are known, then a forecast.
#pragma once

#include <vector>

#include "outrider/jobs/pursue/target_forecast.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider {

class TargetBelief {
 public:
  /// The path of the target has so many seconds, second 0 included; the target of `map` is not looked at.
  TargetBelief(PursuitProblem map, std::size_t seconds, TargetForecast forecast);

  /// True when all of the path is known.
  [[nodiscard]] bool is_certain() const { return known_ == seconds_; }
  /// Takes in what is known now; returns true when it was not as believed.
  bool update(const std::vector<Cell>& known, Cell robot);
  /// Gives up the forecast: the target stays where it was seen last.
  void expect_rest();

  PursuitProblem believed;

 private:
  void foresee(const TargetForecast& forecast, Cell robot);

  TargetForecast forecast_;
  std::size_t seconds_;
  std::size_t known_ = 0;
};

}  // namespace outrider
