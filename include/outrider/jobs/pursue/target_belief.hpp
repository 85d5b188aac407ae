// TargetBelief: the target's path that planners use: its known cells, then a forecast.
#pragma once

#include <vector>

#include "outrider/jobs/pursue/target_forecast.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider {

/// The belief about the target.
class TargetBelief {
 public:
  /// `seconds` is the length of the target's path with second 0. The target of `map` is ignored.
  TargetBelief(PursuitProblem map, std::size_t seconds, TargetForecast forecast);

  /// Returns true if the whole path is known.
  [[nodiscard]] bool is_certain() const { return known_ == seconds_ && !doubted_; }
  /// The path has proven wrong: it is not certain any more.
  void doubt() { doubted_ = true; }
  /// Takes in the known cells. Returns true if they differ from the belief.
  bool update(const std::vector<Cell>& known, Cell robot);
  /// Replaces the forecast: the target stays in its last known cell.
  void expect_rest();

  PursuitProblem believed;  ///< the problem with the believed path of the target

 private:
  void foresee(const TargetForecast& forecast, Cell robot);

  TargetForecast forecast_;
  std::size_t seconds_;
  std::size_t known_ = 0;
  bool doubted_ = false;
};

}  // namespace outrider
